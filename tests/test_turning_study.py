"""The study of turning: what a pass did, means over neighbours, tables. No full run."""

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.data import read_rows, write_rows
from studies.kit.passes import MM, PASS_S, one_pass
from studies.kit.study import main
from studies.turning import study
from studies.turning.figures import per_pass
from studies.turning.findings import first_tipping, inside, left_out, margins, moved, shortened
from studies.turning.passes import Drive, Outcome, Rolls, Tipping, outcome_of, outcomes, rolls_deg
from studies.turning.plane import PRESETS, Comparison, comparisons
from studies.turning.points import Point, Spread, averaged, points
from studies.turning.study import text
from studies.turning.sweeps import SWEEPS, TIPPING, TIPPING_OFFSETS_MM


def outcome(stride_mm: float = 3.0, roll_deg: float = 10.0, end_roll_deg: float = 0.0) -> Outcome:
    return Outcome(2.0, 0.5, stride_mm, Rolls((1.0, roll_deg, 1.0), end_roll_deg))


def about(axis: int, angle_deg: float) -> np.ndarray:
    half = math.radians(0.5 * angle_deg)
    quaternion = np.zeros(4)
    quaternion[0], quaternion[1 + axis] = math.cos(half), math.sin(half)
    return quaternion


def test_roll_is_about_the_magnets_own_length() -> None:
    np.testing.assert_allclose(rolls_deg(about(0, 30.0)), 30.0)
    np.testing.assert_allclose(rolls_deg(about(0, -170.0)), -170.0)
    # Neither yaw nor pitch is roll.
    np.testing.assert_allclose(rolls_deg(np.stack([about(1, 50.0), about(2, 40.0)])), 0.0, atol=1e-12)


def test_a_turn_and_a_step_of_a_recording_are_read() -> None:
    poses = np.zeros((2, 2, 7))
    poses[..., 3] = 1.0
    poses[0, 1, 0] = 0.02
    # Ahead by 3 mm, beside by 1 mm; the tail swings to -z: anticlockwise from above.
    angle = math.radians(30.0)
    along = 0.01 * np.array([math.cos(angle), 0.0, -math.sin(angle)])
    poses[1, :, :3] = np.array([0.007, 0.0, 0.001]) + np.stack([-along, along])
    nothing = np.zeros((2, 0, 3))
    record = Recording(np.array([0.0, 1.0]), nothing, poses, np.ones(2, bool), nothing)
    found = outcome_of(record)
    assert found.turn_deg == pytest.approx(30.0)
    assert (found.stride_mm, found.side_mm) == (pytest.approx(3.0), pytest.approx(1.0))
    assert not found.rolls.tipped and not found.carried


def test_a_broken_simulation_is_no_pass() -> None:
    nothing = np.zeros((1, 0, 3))
    record = Recording(np.zeros(1), nothing, np.zeros((1, 1, 7)), np.ones(1, bool), nothing, "it blew up")
    with pytest.raises(RuntimeError, match="it blew up"):
        outcome_of(record)


def test_passes_that_tip_or_are_carried_are_counted_and_left_out() -> None:
    found = [outcome(3.0), outcome(4.0), outcome(-30.0), outcome(99.0, 70.0), outcome(99.0, 180.0, 180.0)]
    point = averaged("offset", Drive(3), found)
    assert (point.kept, point.tipped, point.overturned, point.carried) == (2, 2, 1, 1)
    assert (point.stride_mm.mean, point.stride_mm.low, point.stride_mm.high) == (3.5, 3.0, 4.0)
    assert point.roll_deg[1] == point.most_rolled == pytest.approx(np.mean([10.0, 10.0, 10.0, 70.0, 180.0]))
    none = averaged("offset", Drive(3), [outcome(0.0, 90.0)])
    assert none.kept == 0 and math.isnan(none.turn_deg.mean) and str(none.turn_deg) == "–"


def test_the_first_offset_that_tips_is_bracketed() -> None:
    never = [False] * len(TIPPING_OFFSETS_MM)
    assert first_tipping(never) == "not up to 15 mm"
    assert first_tipping([*never[:4], True, *never[5:]]) == "1 to 2 mm"
    assert first_tipping([True, *never[1:]]) == "0 to 0.01 mm"


def test_a_roll_beyond_its_share_is_amplified() -> None:
    def rolled(drive: Drive) -> Rolls:
        grown = 0.05 if drive.magnets == 4 and drive.offset_mm == 0.01 else drive.offset_mm
        return Rolls((0.0, 70.0 if drive.offset_mm > 9.0 else grown), 0.0)

    for row in margins(Tipping(drive, rolled(drive)) for drive in TIPPING).values():
        assert [margin.amplified for margin in row.values()] == [False, True, False]
        assert {margin.first for margin in row.values()} == {"8 to 10 mm"}


def test_points_come_back_from_their_table(tmp_path) -> None:
    found = [
        averaged("offset", Drive(3, 1.0), [outcome()]),
        averaged("offset", Drive(5), [outcome(0.0, 90.0)]),
    ]
    write_rows(tmp_path / "points.csv", Point, found)
    first, second = read_rows(tmp_path / "points.csv", Point)
    assert first == found[0] and first.turn_deg == Spread(2.0, 2.0, 2.0)
    assert second.roll_deg == (1.0, 90.0, 1.0) and math.isnan(second.stride_mm.mean)


def made() -> dict[str, list[Point]]:
    return {
        name: [
            averaged(name, drive, [outcome(3.0), outcome(3.5 + 0.01 * i)]) for i, drive in enumerate(drives)
        ]
        for name, drives in SWEEPS.items()
    }


def test_a_page_is_written_from_results_alone() -> None:
    single = [
        Tipping(drive, outcome(roll_deg=90.0 if drive.magnets == 4 else 1.0).rolls) for drive in TIPPING
    ]
    same = Comparison("paper-3", "pass", "peak", 9.0, 9.01, 0.1, 0.0, 9.0, 0.5)
    apart = Comparison("paper-4", "pass", "stride", 2.0, 2.2, 0.3, 0.0, 2.0, 7.0)
    page = text(made(), single, [same, apart])
    assert "nan" not in page and "1 of 2 figures agree within 1 %" in page and "10.00 % | **no**" in page
    assert "four magnets at −20, −22, −24, −26, −28, −30, −32 and −34 mm" in page
    assert "tip over" not in page.split("## Yaw of the drive")[1].split("## Roll")[0]


def test_a_page_says_where_robots_tip_over_and_are_carried_along() -> None:
    sweeps = made()
    over = [averaged("offset", point.drive, [outcome(roll_deg=90.0)]) for point in sweeps["offset"]]
    away = [replace(point, turn_deg=Spread(-2.0, -3.0, 3.0)) for point in sweeps["yaw"]]
    carried = [averaged("height", point.drive, [outcome(-30.0)]) for point in sweeps["height"]]
    single = [Tipping(drive, outcome().rolls) for drive in TIPPING]
    same = Comparison("paper-3", "pass", "peak", 9.0, 9.01, 0.1, 0.0, 9.0, 0.5)
    page = text(sweeps | {"offset": over, "yaw": away, "height": carried}, single, [same])
    assert "Four magnets tip over at every offset from 0 to 15 mm" in page and "**not within**" in page
    assert "**neighbours turn to opposite sides** at 0, 10, 20" in page
    assert "Three magnets: at least one neighbour tips over at every offset from 0 to 15 mm" in page
    assert left_out(carried[:2], "height_mm", " mm") == "; all neighbours are carried along at −20 and −22 mm"


def test_a_figure_marks_points_without_a_mean() -> None:
    points = made()["height"]
    gone = replace(points[0], tipped=2, turn_deg=Spread(math.nan, math.nan, math.nan))
    panel = per_pass([gone, *points[1:]], "height_mm", "height").axes[0]
    assert [list(line.get_xdata()) for line in panel.lines if line.get_marker() == "x"] == [[-20.0], [], []]


def test_shorter_steps_are_set_beside_the_longest() -> None:
    found = shortened(made()["step"])
    assert all([point.drive.step_ms for point in here] == [2.0, 1.0, 0.5] for here in found.values())
    assert moved(found, "stride_mm") == pytest.approx(0.01) and moved(found, "turn_deg") == 0.0
    # Of a drive on the line the stride alone counts.
    assert inside(found) == [True] * (3 * len(found) - 2)
    apart = {
        place: [here[0], replace(here[-1], stride_mm=Spread(9.0, 9.0, 9.0))] for place, here in found.items()
    }
    assert inside(apart).count(False) == len(found)


def test_a_pass_on_the_line_turns_nothing_and_mirrored_passes_turn_oppositely() -> None:
    middle, left, right = outcomes([Drive(3), Drive(3, 3.0), Drive(3, -3.0)])
    (flat,) = record_scenes([one_pass(Scene.preset("paper-3"))], PASS_S)
    assert abs(middle.turn_deg) < 1e-3 and middle.stride_mm == pytest.approx(
        MM * flat.progress_m[-1], abs=0.1
    )
    assert left.turn_deg > 0.5 and not left.rolls.tipped
    assert right.turn_deg == pytest.approx(-left.turn_deg, abs=0.3)


def test_neighbours_are_run_around_a_point() -> None:
    (point,) = points("speed", [Drive(3, 3.0, speed_mm_s=210.0)], (-0.1, 0.1))
    assert point.passes == 2 and point.turn_deg.low < point.turn_deg.mean < point.turn_deg.high


def test_a_planar_preset_keeps_its_lift_in_space() -> None:
    lifts = [each for each in comparisons() if each.case == "lift"]
    assert len(lifts) == len(PRESETS) and all(abs(each.difference) < 0.01 for each in lifts)


def test_measuring_leaves_the_tables(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(study, "DATA", tmp_path)
    monkeypatch.setattr(study, "SWEEPS", {"offset": [Drive(3, 2.0, speed_mm_s=210.0)], "yaw": []})
    monkeypatch.setattr(study, "TIPPING", [Drive(3, 2.0, speed_mm_s=210.0)])
    monkeypatch.setattr(study, "comparisons", lambda: [])
    assert main({"turning": "studies.turning.study"}, ["measure", "turning"]) == 0
    found = study.sweeps()
    (single,) = read_rows(tmp_path / "tipping.csv", Tipping)
    assert [point.passes for point in found["offset"]] == [5] and found["yaw"] == []
    assert single.rolls.roll_deg == pytest.approx(found["offset"][0].roll_deg, rel=0.1)
