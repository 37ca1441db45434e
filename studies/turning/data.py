"""The results as tables of comma-separated values."""

import csv
import math
from collections.abc import Mapping, Sequence
from io import StringIO

from studies.turning.passes import Drive, Outcome, Point
from studies.turning.plane import Comparison
from studies.turning.sweeps import ROBOTS

DRIVE = ("magnets", "offset_mm", "drive_yaw_deg", "height_mm", "speed_mm_s", "step_ms")
MEANS = ("yaw_deg", "side_mm", "stride_mm")
ROLLS = tuple(f"roll_{i + 1}_deg" for i in range(max(ROBOTS)))


def points_csv(sweeps: Mapping[str, Sequence[Point]]) -> str:
    """One row a point; what has no value is empty. Rolls are counted from the head."""
    spreads = [f"{name}_{part}" for name in MEANS for part in ("mean", "low", "high")]
    rows: list[Sequence[object]] = [
        ["sweep", *DRIVE, "passes", "tipped", "overturned", "carried", *spreads, *ROLLS]
    ]
    for name, points in sweeps.items():
        for point in points:
            values = [
                _number(value)
                for spread in (point.yaw_deg, point.side_mm, point.stride_mm)
                for value in (spread.mean, spread.low, spread.high)
            ]
            counts = [point.passes, point.tipped, point.overturned, point.carried]
            rows.append([name, *_drive(point.drive), *counts, *values, *_rolls(list(point.roll_deg))])
    return _text(rows)


def tipping_csv(drives: Sequence[Drive], found: Sequence[Outcome]) -> str:
    """One row a single pass."""
    rows: list[Sequence[object]] = [[*DRIVE, *ROLLS, "end_roll_deg"]]
    for drive, outcome in zip(drives, found, strict=True):
        rows.append([*_drive(drive), *_rolls(list(outcome.roll_deg)), _number(outcome.end_roll_deg)])
    return _text(rows)


def plane_csv(comparisons: Sequence[Comparison]) -> str:
    """One row a figure of a preset."""
    rows: list[Sequence[object]] = [
        [
            "preset",
            "case",
            "figure",
            "plane_mm",
            "space_mm",
            "apart_mm",
            "roll_deg",
            "aside_mm",
            "aside_roll_deg",
        ]
    ]
    for each in comparisons:
        lengths = [f"{value:.4f}" for value in (each.plane_mm, each.space_mm, each.apart_mm)]
        rest = [f"{each.roll_deg:.1e}", f"{each.aside_mm:.4f}", f"{each.aside_roll_deg:.3f}"]
        rows.append([each.preset, each.case, each.figure, *lengths, *rest])
    return _text(rows)


def _drive(drive: Drive) -> list[object]:
    numbers = (drive.offset_mm, drive.yaw_deg, drive.height_mm, drive.speed_mm_s, drive.step_ms)
    return [drive.magnets, *(f"{value:g}" for value in numbers)]


def _rolls(values: Sequence[float]) -> list[str]:
    return [_number(value) for value in values] + [""] * (len(ROLLS) - len(values))


def _number(value: float) -> str:
    """Three decimals, without a negative zero; empty for what is not a number."""
    return "" if math.isnan(value) else f"{round(value, 3) + 0.0:.3f}"


def _text(rows: Sequence[Sequence[object]]) -> str:
    written = StringIO()
    csv.writer(written, lineterminator="\n").writerows(rows)
    return written.getvalue()
