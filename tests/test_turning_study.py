"""The study of turning: what a pass did, means over neighbours, tables. No full run."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

sys.path.insert(0, str(Path(__file__).parent.parent))

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.passes import PASS_S, one_pass
from studies.turning.data import points_csv, tipping_csv
from studies.turning.findings import first_tipping
from studies.turning.page import page
from studies.turning.passes import (
    MM,
    Drive,
    Outcome,
    averaged,
    outcome_of,
    outcomes,
    points,
    rolls_deg,
)
from studies.turning.plane import PRESETS, Comparison, comparisons
from studies.turning.sweeps import SWEEPS, TIPPING, TIPPING_OFFSETS_MM


def outcome(stride_mm: float = 3.0, roll_deg: float = 10.0, end_roll_deg: float = 0.0) -> Outcome:
    return Outcome(2.0, 0.5, stride_mm, np.array([1.0, roll_deg, 1.0]), end_roll_deg)


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
    assert found.yaw_deg == pytest.approx(30.0)
    assert (found.stride_mm, found.side_mm) == (pytest.approx(3.0), pytest.approx(1.0))
    assert not found.tipped and not found.carried


def test_a_broken_simulation_is_no_pass() -> None:
    nothing = np.zeros((1, 0, 3))
    record = Recording(np.zeros(1), nothing, np.zeros((1, 1, 7)), np.ones(1, bool), nothing, "it blew up")
    with pytest.raises(RuntimeError, match="it blew up"):
        outcome_of(record)


def test_passes_that_tip_or_are_carried_are_counted_and_left_out() -> None:
    found = [outcome(3.0), outcome(4.0), outcome(-30.0), outcome(99.0, 70.0), outcome(99.0, 180.0, 180.0)]
    point = averaged(Drive(3), found)
    assert (point.kept, point.tipped, point.overturned, point.carried) == (2, 2, 1, 1)
    assert (point.stride_mm.mean, point.stride_mm.low, point.stride_mm.high) == (3.5, 3.0, 4.0)
    assert point.roll_deg[1] == pytest.approx(np.mean([10.0, 10.0, 10.0, 70.0, 180.0]))
    none = averaged(Drive(3), [outcome(0.0, 90.0)])
    assert none.kept == 0 and math.isnan(none.yaw_deg.mean)


def test_the_first_offset_that_tips_is_bracketed() -> None:
    never = [False] * len(TIPPING_OFFSETS_MM)
    assert first_tipping(never) == "not up to 15 mm"
    assert first_tipping([*never[:4], True, *never[5:]]) == "1 to 2 mm"
    assert first_tipping([True, *never[1:]]) == "0 to 0.01 mm"


def test_tables_have_a_row_a_point() -> None:
    sweeps = {"offset": [averaged(Drive(3, 1.0), [outcome()]), averaged(Drive(5), [outcome(0.0, 90.0)])]}
    header, first, second = (line.split(",") for line in points_csv(sweeps).splitlines())
    row, empty = dict(zip(header, first, strict=True)), dict(zip(header, second, strict=True))
    assert (row["offset_mm"], row["yaw_deg_mean"], row["roll_4_deg"]) == ("1", "2.000", "")
    assert (empty["magnets"], empty["tipped"], empty["stride_mm_mean"]) == ("5", "1", "")
    assert tipping_csv([Drive(3)], [outcome()]).count("\n") == 2


def test_a_page_is_written_from_results_alone() -> None:
    sweeps = {
        name: [averaged(drive, [outcome(3.0), outcome(3.5 + 0.01 * i)]) for i, drive in enumerate(drives)]
        for name, drives in SWEEPS.items()
    }
    tipping = [outcome(roll_deg=90.0 if drive.magnets == 4 else 1.0) for drive in TIPPING]
    same = Comparison("paper-3", "pass", "peak", 9.0, 9.01, 0.1, 0.0, 9.0, 0.5)
    apart = Comparison("paper-4", "pass", "stride", 2.0, 2.2, 0.3, 0.0, 2.0, 7.0)
    text = page(sweeps, TIPPING, tipping, [same, apart])
    assert text == page(sweeps, TIPPING, tipping, [same, apart])
    assert "nan" not in text and "1 of 2 figures agree within 1 %" in text and "10.00 % | **no**" in text


def test_a_pass_on_the_line_turns_nothing_and_mirrored_passes_turn_oppositely() -> None:
    middle, left, right = outcomes([Drive(3), Drive(3, 3.0), Drive(3, -3.0)])
    (flat,) = record_scenes([one_pass(Scene.preset("paper-3"))], PASS_S)
    assert abs(middle.yaw_deg) < 1e-3 and middle.stride_mm == pytest.approx(MM * flat.progress_m[-1], abs=0.1)
    assert left.yaw_deg > 0.5 and not left.tipped
    assert right.yaw_deg == pytest.approx(-left.yaw_deg, abs=0.3)


def test_neighbours_are_run_around_a_point() -> None:
    (point,) = points([Drive(3, 3.0, speed_mm_s=210.0)], (-0.1, 0.1))
    assert point.passes == 2 and point.yaw_deg.low < point.yaw_deg.mean < point.yaw_deg.high


def test_a_planar_preset_keeps_its_lift_in_space() -> None:
    lifts = [each for each in comparisons() if each.case == "lift"]
    assert len(lifts) == len(PRESETS) and all(abs(each.difference) < 0.01 for each in lifts)
