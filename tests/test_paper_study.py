"""The study of the paper: stages, strides, bands, words. No full run."""

import math

import msgspec
import numpy as np
import pytest

pytest.importorskip("matplotlib")

from magworm_gym import Recording, record_scenes
from studies.kit.passes import PASS_S, SIMULATION, one_pass, robot
from studies.paper.ablations import only
from studies.paper.bands import margin, outside, read_bands, written
from studies.paper.bouncing import takeoffs
from studies.paper.cantilever import SOFT_M, arc, exact_angle
from studies.paper.damaged import NAMES, SETS, Damaged
from studies.paper.damaged import SPEEDS_MM_S as DAMAGED_MM_S
from studies.paper.displacements import differing
from studies.paper.experiment import Experiment
from studies.paper.feet import sole_heights
from studies.paper.loads import magnetic_loads
from studies.paper.page import paper_page
from studies.paper.passes import CARRIED_M, PASSES, Strides, Walk, averaged, pass_ends_s, strides_of
from studies.paper.quantity import AGAIN, REQUIRED, Origin, Quantity, Row, read_rows
from studies.paper.stages import spans, stage_of
from studies.paper.stride import SPEEDS_MM_S, Curve, crossing_mm_s, slow_spread_percent


def quantity(key="stride.five", model=6.0, origin=Origin.HELD_BACK, spread=0.0, **more):
    if origin in REQUIRED:
        more.setdefault("band", (5.0, 7.0))
    return Quantity(key, Row(what="what", origin=origin, unit="mm", **more), model, spread)


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
    walk = Walk(robot(3, SIMULATION), 100.0)
    ends = pass_ends_s(walk, 0.05)
    assert len(ends) == PASSES
    assert np.allclose(np.diff(ends), 3.0)
    assert ends[0] == pytest.approx((0.05 + 0.027 + 0.15) / 0.1)


def test_passes_after_a_robot_was_carried_along_do_not_count():
    ways = np.array([[1.0, 2.0, 3.0], [1.0, -1.0, 9.0]])
    ways[1] *= 2 * CARRIED_M
    mean, _, carried = averaged(ways)
    assert mean == pytest.approx(1e3 * (6.0 + 2 * CARRIED_M) / 4)
    assert carried == 0.5
    assert averaged(np.full((2, 3), -1.0)) == (-1e3, 0.0, 1.0)


def test_a_robot_crawls_where_it_is_clear_of_its_spread_and_never_carried():
    strides = Strides(
        np.array([0.6, 0.6, 0.4, 9.0]), np.array([0.5, 0.7, 0.1, 0.0]), np.array([0.0, 0.0, 0.0, 0.1])
    )
    assert strides.crawls.tolist() == [True, False, False, False]
    assert strides.reshaped(2, 2)[1].mean_mm.tolist() == [0.4, 9.0]


def test_the_best_of_a_damaged_robot_was_not_carried_and_is_told_forward_where_both_ways_are_equal():
    shape = (len(SETS), 2, len(DAMAGED_MM_S))
    mean, spread, carried = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    mean[:, :, 2] = 3.0
    mean[0, 1, 3], carried[0, 1, 3] = 9.0, 0.5
    mean[1, 1, 4] = 4.0
    carried[2] = 1.0
    found = Damaged(Strides(mean, spread, carried))
    assert [where for _, where in found.best[:2]] == ["forward, 140 mm/s", "backward, 210 mm/s"]
    rows = list(found.rows)
    assert [row[0] for row in rows] == NAMES and NAMES[0] == "○●●●●"
    assert rows[2][2].carried == 1.0 and not rows[2][2].crawls
    assert next(iter(found.groups)).startswith("five magnets, 1 taken out: 4 of 5 crawl: ○●●●●")


def test_the_crossing_is_where_five_magnets_lead_for_good():
    three, five = np.full(len(SPEEDS_MM_S), 2.0), np.full(len(SPEEDS_MM_S), 1.0)
    five[[1, *range(10, len(five))]] = 3.0
    curves = [curve(values) for values in (three, five)]
    assert crossing_mm_s(*curves) == SPEEDS_MM_S[10]
    assert crossing_mm_s(*curves[::-1]) == math.inf
    names = {"three": curves[0], "four": curves[0], "five": curve(1.5 * three)}
    assert slow_spread_percent(names) == pytest.approx(50.0)


def curve(mean):
    return Curve(Strides(mean, 0 * mean, 0 * mean), 54.0)


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
    known = {"a.b": (1.0, 2.0)}
    assert outside([quantity("a.b", 1.5)], known) == []
    (sentence,) = outside([quantity("a.b", 2.5)], known)
    assert sentence == "a.b is 2.5 mm; allowed: 1 to 2 (what the model gave before)"
    assert "a.b" in outside([quantity("a.b", math.nan)], known)[0]
    assert "no band" in outside([quantity("a.b", 1.5), quantity("e.f")], known)[0]
    assert outside([], known) == ["a.b has a band but no figure"]
    target = quantity(model=4.0, origin=Origin.TARGET, why="target")
    assert outside([target], {}) == ["stride.five is 4 mm; allowed: 5 to 7 (target)"]
    assert outside([quantity("a.b", math.inf)], {"a.b": (1.0, math.inf)}) != []


def test_written_bands_follow_the_model(tmp_path):
    found = [quantity("a.target", origin=Origin.TARGET), quantity(), quantity("a.never", math.inf)]
    (tmp_path / "bands.toml").write_text(written(found))
    bands = read_bands(tmp_path / "bands.toml")
    assert bands == {"stride.five": (5.7, 6.3), "a.never": (math.inf, math.inf)}
    assert outside(found, bands) == []


def test_the_margin_is_the_greatest_of_share_spread_and_smallest():
    assert margin(quantity(model=10.0)) == pytest.approx(0.5)
    assert margin(quantity(model=10.0, spread=0.4)) == pytest.approx(0.8)
    assert margin(quantity(model=0.0)) == pytest.approx(0.15)


def test_a_target_without_a_band_is_an_error():
    with pytest.raises(ValueError, match="targets and closed forms have a band"):
        Row(what="what", origin=Origin.TARGET)


def test_a_row_with_an_unknown_field_is_refused(tmp_path):
    (tmp_path / "rows.toml").write_text('[stride.five]\nwhat = "w"\norigin = "held back"\npapers = 3.0\n')
    with pytest.raises(msgspec.ValidationError, match="papers"):
        read_rows(tmp_path / "rows.toml")


def test_the_robot_of_the_papers_simulation_was_fitted_to_no_stride():
    rows = read_rows()
    again = {key: row for key, row in rows.items() if key.startswith(AGAIN)}
    assert len(again) == sum(key.startswith("stride.") for key in rows)
    assert all(row.origin is Origin.HELD_BACK and not row.listed for row in again.values())


@pytest.mark.parametrize(
    ("found", "words"),
    [
        (quantity(origin=Origin.TARGET), "met"),
        (quantity(model=8.0, origin=Origin.TARGET), "**missed**"),
        (quantity(origin=Origin.CLOSED_FORM), "agrees"),
        (quantity(paper=6.1), "agrees"),
        (quantity(paper=5.5), "close, high"),
        (quantity(paper=10.0, note="why"), "**disagrees, too low**; why"),
        (quantity(paper=6.1, note="why"), "agrees"),
        (quantity(holds=(0.0, 1.0)), "**contradicts the paper**"),
        (quantity(holds=(5.0, 7.0)), "as the paper says"),
        (quantity(origin=Origin.MODEL), "no figure in the paper"),
        (quantity(model=math.inf, paper=5.0), "**disagrees**"),
    ],
)
def test_a_verdict_follows_from_the_numbers(found, words):
    assert found.verdict == words


def test_a_page_states_every_figure_and_how_many_agree_and_guesses_why_not():
    class Found(Experiment):
        name = "mirror"
        passes, parts = (), False

        @classmethod
        def measured(cls):
            raise NotImplementedError

        def numbers(self):
            return {"pass.peak": 9.0, "lift.robot": 9.0, "stages.wave": 2.0, "stride.crossing": (150.0, 10.0)}

    text = paper_page([Found()])
    assert "The model meets 1 of 1 identification targets and 0 of 0 exact results" in text
    assert "It disagrees with 0 of 1 fitted trends, and with 1 of 1 figures" in text
    assert "| Case 1: lift of the middle, `paper-3` | 7.7 mm | 9.00 mm | +16.9 % | held back |" in text
    assert "- *Case 1: lift of the middle, `paper-3`.* The lift belongs" in text
    assert "II: crest" not in text and "150 ± 10 mm/s" in text
    assert "## Mirror symmetry" in text
