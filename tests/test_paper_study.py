"""The study of the paper: stages, strides, bands, words. No full run."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

sys.path.insert(0, str(Path(__file__).parent.parent))

from magworm_gym import Recording, record_scenes
from studies.paper import bands
from studies.paper.bands import Band, Margins, outside, read_bands, read_margins, rewritten
from studies.paper.bouncing import takeoffs
from studies.paper.cantilever import SOFT_M, arc, exact_angle
from studies.paper.displacements import differing
from studies.paper.feet import sole_heights
from studies.paper.hypotheses import hypotheses
from studies.paper.loads import magnetic_loads
from studies.paper.page import overview, page
from studies.paper.passes import CARRIED_M, PASSES, Walk, averaged, pass_ends_s, strides_of
from studies.paper.quantity import Origin, Quantity, number, verdict
from studies.paper.scenes import PASS_S, SIMULATION, one_pass, only, robot
from studies.paper.section import Section
from studies.paper.stages import spans, stage_of
from studies.paper.stride import SPEEDS_MM_S, Curve, crossing_mm_s, slow_spread_percent
from studies.paper.wording import listed, ranking, trend

UPPER = """[margins]
relative = 0.05
spreads = 2.0
smallest = { mm = 0.1 }

[bands.pass.peak]
low = 8.8
high = 9.3
why = "target"

"""


def quantity(key="stride.five", model=6.0, origin=Origin.HELD_BACK, **more):
    return Quantity(key, "what", "mm", model, origin, **more)


def still(centre_x):
    """A recording of a robot of one magnet that is at the given places, one a second."""
    poses = np.zeros((len(centre_x), 1, 3))
    poses[:, 0, 0] = centre_x
    time_s = np.arange(len(centre_x), dtype=float)
    nothing = np.zeros((len(centre_x), 0, 2))
    return Recording(time_s, nothing, poses, np.ones(1, bool), nothing)


def test_a_stage_that_is_reached_stays_reached():
    drive = np.array([-1.0, 0.5, 0.4, 1.5, 2.5])
    magnets = np.tile([0.0, 1.0, 2.0], (5, 1))
    magnets[2, 0] = 0.45  # the first magnet overtakes the drive
    assert stage_of(drive, magnets).tolist() == [0, 1, 1, 2, 3]


def test_the_pass_has_four_stages_in_a_row_and_loads_of_the_right_sign():
    scene = one_pass(robot(3))
    (record,) = record_scenes([scene], PASS_S, 0.01)
    found = spans(record)
    assert [span.start for span in found[1:]] == [span.stop for span in found[:-1]]
    assert (found[0].start, found[-1].stop) == (0, len(record.time_s))
    force, torque = magnetic_loads(scene, record)
    over = int(np.abs(record.drive_positions[:, 0, 0] - record.magnet_poses[:, 1, 0]).argmin())
    assert force[over, 1, 1] > 0.0 > force[found[1].start, 0, 1]  # repelled, attracted
    assert torque.shape == (len(record.time_s), 3)
    soles = sole_heights(scene, record)
    # A pad gives by 7 µm under the robot's weight, and more where the drive pulls a foot down.
    assert np.allclose(soles[0], 0.0) and soles.min() > -2e-5


def test_a_pass_that_never_ends_has_no_four_stages():
    (record,) = record_scenes([one_pass(robot(3))], 0.1, 0.01)
    with pytest.raises(ValueError, match="four stages"):
        spans(record)


def test_strides_count_against_the_motion_of_the_drive():
    record = still([0.0, -1.0, -3.0, -3.5])
    ends = np.array([1.0, 2.0, 9.0])  # the last is beyond the recording
    assert strides_of(record, ends, backward=False).tolist() == [1.0, 2.0, 0.5]
    assert strides_of(record, ends, backward=True).tolist() == [-1.0, -2.0, -0.5]


def test_a_broken_simulation_has_no_stride():
    record = still([0.0, 1.0])
    broken = Recording(
        record.time_s, record.nodes, record.magnet_poses, record.present, record.nodes, "no limit"
    )
    with pytest.raises(RuntimeError, match="no limit"):
        strides_of(broken, np.array([1.0]), backward=False)


def test_passes_end_half_way_between_two_drive_magnets():
    walk = Walk(robot(3, SIMULATION), 0.1)
    ends = pass_ends_s(walk, 0.05)
    assert len(ends) == PASSES
    assert np.allclose(np.diff(ends), 3.0)
    assert ends[0] == pytest.approx((0.05 + 0.027 + 0.15) / 0.1)


def test_passes_after_a_robot_was_carried_along_do_not_count():
    ways = np.array([[1.0, 2.0, 3.0], [1.0, -1.0, 9.0]])
    ways[1] *= 2 * CARRIED_M
    stride = averaged(ways)
    assert stride.mean_m == pytest.approx((6.0 + 2 * CARRIED_M) / 4)
    assert stride.carried == 0.5
    lost = averaged(np.full((2, 3), -1.0))
    assert (lost.mean_m, lost.carried) == (-1.0, 1.0)


def test_the_crossing_is_where_five_magnets_lead_for_good():
    three, five = np.full(len(SPEEDS_MM_S), 2.0), np.full(len(SPEEDS_MM_S), 1.0)
    five[[1, *range(10, len(five))]] = 3.0
    curves = [Curve(values, 0 * values, 0 * values, 54.0) for values in (three, five)]
    assert crossing_mm_s(*curves) == SPEEDS_MM_S[10]
    assert crossing_mm_s(*curves[::-1]) == math.inf
    names = {"three": curves[0], "four": curves[0], "five": Curve(1.5 * three, three, three, 94.0)}
    assert slow_spread_percent(names) == pytest.approx(50.0)


def test_takeoffs_count_the_ways_up():
    assert takeoffs(np.array([0.0, 1e-3, 1e-3, 0.0, 1e-3])) == 2


def test_an_ablation_leaves_one_component():
    terms = only(robot(3), "torque").to_toml()
    assert "torque = true" in terms
    assert "horizontal_force = false" in terms and "vertical_force = false" in terms


def test_validates_the_closed_form_of_the_cantilever():
    """Physics brief: θ = c sin(90° − θ) has 25.794°, 42.346°, 59.007° for c = 0.5, 1, 2."""
    for load, degrees in ((0.5, 25.794), (1.0, 42.346), (2.0, 59.007)):
        assert math.degrees(exact_angle(load, 0.5 * math.pi)) == pytest.approx(degrees, abs=1e-3)
    quarter = arc(0.5 * math.pi, np.array([SOFT_M]))
    assert np.allclose(quarter, SOFT_M / (0.5 * math.pi))


def test_scenes_that_differ_are_told_apart_by_path():
    first = robot(3)
    assert differing(first, first.with_values({"ground.static_friction": 2.0, "name": "other"})) == [
        ["`ground.static_friction`", _friction(first), "2"]
    ]


def _friction(scene):
    (line,) = (line for line in scene.to_toml().splitlines() if line.startswith("static_friction"))
    return f"{float(line.split('=')[1]):g}"


def test_a_figure_outside_its_band_is_named_with_what_is_allowed():
    known = {"a.b": Band(1.0, 2.0, "target")}
    assert outside([quantity("a.b", 1.5)], known) == []
    (sentence,) = outside([quantity("a.b", 2.5)], known)
    assert sentence == "a.b is 2.5 mm; allowed: 1 to 2 (target)"
    assert "a.b" in outside([quantity("a.b", math.nan)], known)[0]
    assert "no band" in outside([quantity("a.b", 1.5), quantity("e.f")], known)[0]
    assert outside([], known) == ["a.b has a band but no figure"]


def test_rows_that_disagree_come_with_a_guess():
    rows = [quantity("stride.stall", paper=3.0), quantity("new.row", paper=3.0), quantity("a.b", paper=6.0)]
    told = hypotheses(rows).splitlines()[3:]
    assert len(told) == 2 and "damping" in told[0] and told[1].endswith("No hypothesis yet.")
    assert hypotheses([quantity("stride.stall", paper=3.0, listed=False)]).count("- *") == 0


def test_bands_by_hand_stay_and_the_others_follow_the_model():
    text = rewritten(UPPER + bands.MARK + "old = 1", [quantity("pass.peak", 5.0, Origin.TARGET), quantity()])
    assert text.startswith(UPPER + bands.MARK) and "old" not in text
    found = read_bands(text)
    assert (found["pass.peak"].low, found["pass.peak"].high) == (8.8, 9.3)
    assert (found["stride.five"].low, found["stride.five"].high) == pytest.approx((5.7, 6.3))
    assert rewritten(text, [quantity("pass.peak", 5.0, Origin.TARGET), quantity()]) == text


def test_a_target_without_a_band_by_hand_is_an_error():
    with pytest.raises(ValueError, match=r"lift\.final"):
        rewritten(UPPER, [quantity("lift.final", origin=Origin.TARGET)])


def test_the_margin_is_the_greatest_of_share_spread_and_smallest():
    margins = Margins(relative=0.05, spreads=2.0, smallest={"mm": 0.1})
    assert margins.of(quantity(model=10.0)) == pytest.approx(0.5)
    assert margins.of(quantity(model=10.0, spread=0.4)) == pytest.approx(0.8)
    assert margins.of(quantity(model=0.0)) == pytest.approx(0.1)


def test_the_bands_of_the_repository_can_be_read():
    text = bands.PATH.read_text(encoding="utf-8")
    assert read_margins(text).relative > 0.0
    assert all(band.low <= band.high and band.why for band in read_bands(text).values())
    targets = {"lift.final", "pass.peak", "pass.stride", "ablation.horizontal", "ablation.vertical"}
    assert targets <= set(read_bands(text.split(bands.MARK)[0]))


@pytest.mark.parametrize(
    ("found", "inside", "words"),
    [
        (quantity(origin=Origin.TARGET), True, "met"),
        (quantity(origin=Origin.TARGET), False, "**missed**"),
        (quantity(paper=6.1), True, "agrees"),
        (quantity(paper=5.5), True, "close, high"),
        (quantity(paper=10.0, note="why"), True, "**disagrees, too low**; why"),
        (quantity(holds=(0.0, 1.0)), True, "**contradicts the paper**"),
        (quantity(holds=(5.0, 7.0)), False, "as the paper says"),
        (quantity(origin=Origin.MODEL), True, "no figure in the paper"),
    ],
)
def test_a_verdict_follows_from_the_numbers(found, inside, words):
    assert verdict(found, inside) == words


def test_words_follow_from_numbers():
    assert trend([1.0, 2.0, 3.0]) == "rises"
    assert trend([3.0, 2.0, 2.5]) == "falls"
    assert trend([1.0, 1.01, 1.0]) == "stays level"
    assert ranking({"three": 1.0, "five": 2.0, "four": -1.0}) == "five > three > four"
    assert listed(["a"]) == "a" and listed(["a", "b", "c"]) == "a, b and c"
    assert number(-0.001, 2) == "0.00" and number(-1.5, 1) == "−1.5"


def test_a_page_states_every_figure_and_how_many_agree():
    found = [
        quantity("pass.peak", 9.0, Origin.TARGET, paper=9.07),
        quantity(paper=3.0),
        quantity(listed=False),
        quantity(origin=Origin.FITTED, paper=6.1),
        quantity(origin=Origin.FITTED, claim="falls (below 0)", holds=(-math.inf, 0.0)),
    ]
    text = page([Section("Title", "Text.", quantities=found)], {"pass.peak": Band(8.8, 9.3, "target")})
    assert "Of 1 identification targets 1 are met" in text
    assert "Of 2 trends that were fitted the model disagrees with 1" in text
    assert "of 1 figures and statements held back with 1" in text
    assert overview(found, {}).count("\n") == 5
    assert "## Title" in text
