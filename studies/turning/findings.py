"""What the page asks of the results."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np

from studies.kit.words import listed, number, plain
from studies.turning.passes import Tipping
from studies.turning.points import Point
from studies.turning.sweeps import HEIGHTS_MM, ROBOTS, TIPPING_OFFSETS_MM, UNIT_MM

AMPLIFIED = 2.0
"""Ours: roll that exceeds its share so many times is amplified."""
EVEN_DEG = 1.0
"""Ours: a roll that falls by less than this between two offsets counts as level."""
RUGGED_MM, SIGN_DEG = 1.0, 1.0
"""Ours: neighbours whose strides differ, or whose turns oppose each other, by more are named."""
MEASURES = {"turn_deg": ("yaw", "°"), "side_mm": ("side-step", "mm"), "stride_mm": ("stride", "mm")}
"""What a point has a mean of, with its word and unit."""


def of(points: Iterable[Point], magnets: int, offset_mm: float | None = None) -> list[Point]:
    """Points of the robot with this many magnets, and of a drive at this offset."""
    return [
        point
        for point in points
        if point.drive.magnets == magnets and offset_mm in (None, point.drive.offset_mm)
    ]


def most_turned(points: Sequence[Point]) -> Point:
    """The point that turns furthest, to whichever side."""
    return max(points, key=lambda point: abs(point.turn_deg.mean))


def span(values: Iterable[float]) -> str:
    """The range of values in words."""
    each = list(values)
    low, high = number(min(each), 1), number(max(each), 1)
    return low if low == high else f"{low} to {high}"


def offsets(points: Iterable[Point]) -> str:
    """The offsets of points; many in a row as a range."""
    found = [point.drive.offset_mm for point in points]
    if len(found) > 2 and {round(b - a, 6) for a, b in pairwise(found)} == {1.0}:
        return f"every offset from {found[0]:g} to {found[-1]:g} mm"
    return f"{listed([plain(offset) for offset in found])} mm"


def grows(points: Sequence[Point]) -> bool:
    """Whether the greatest roll falls nowhere from one point to the next."""
    return all(b.most_rolled >= a.most_rolled - EVEN_DEG for a, b in pairwise(points))


def rugged(points: Iterable[Point]) -> list[Point]:
    """Points whose neighbours have different strides."""
    return [point for point in points if point.stride_mm.high - point.stride_mm.low > RUGGED_MM]


def left_out(points: Sequence[Point], field: str, unit: str) -> str:
    """Where neighbours tipped over or were carried along, as the end of a sentence."""
    parts = []
    for what, count in (("tip over", "tipped"), ("are carried along", "carried")):
        gone = [point for point in points if getattr(point, count)]
        if gone:
            who = "all neighbours" if all(getattr(p, count) == p.passes for p in gone) else "neighbours"
            places = listed([plain(getattr(point.drive, field)) for point in gone])
            parts.append(f"; {who} {what} at {places}{unit}")
    return "".join(parts)


class Margin(NamedTuple):
    """How firmly a robot stands over a drive at one height.

    Greatest rolls at the smallest offset and at 1 mm, whether it tips over there, and where it first does.
    """

    least_deg: float
    unit_deg: float
    tips: bool
    first: str

    @property
    def amplified(self) -> bool:
        """Whether the roll at the smallest offset exceeds its share of that at 1 mm."""
        return self.tips or self.least_deg > AMPLIFIED * self.unit_deg * TIPPING_OFFSETS_MM[0] / UNIT_MM


def margins(passes: Iterable[Tipping]) -> dict[float, dict[int, Margin]]:
    """Margins by the height of the drive [mm] and the magnets of the robot."""
    rolls = {(each.drive.height_mm, each.drive.magnets, each.drive.offset_mm): each.rolls for each in passes}
    found: dict[float, dict[int, Margin]] = {height: {} for height in HEIGHTS_MM}
    for height, count in product(HEIGHTS_MM, ROBOTS):
        least, unit = (rolls[height, count, offset] for offset in (TIPPING_OFFSETS_MM[0], UNIT_MM))
        first = first_tipping([rolls[height, count, offset].tipped for offset in TIPPING_OFFSETS_MM])
        found[height][count] = Margin(max(least.roll_deg), max(unit.roll_deg), unit.tipped, first)
    return found


def first_tipping(tipped: Sequence[bool]) -> str:
    """Between which offsets of the map a robot first tips over.

    Args:
        tipped: Whether it did, for each of :data:`TIPPING_OFFSETS_MM`.
    """
    if not any(tipped):
        return f"not up to {TIPPING_OFFSETS_MM[-1]:g} mm"
    first = list(tipped).index(True)
    low = TIPPING_OFFSETS_MM[first - 1] if first else 0.0
    return f"{low:g} to {TIPPING_OFFSETS_MM[first]:g} mm"


def shortened(points: Sequence[Point]) -> dict[tuple[int, float], list[Point]]:
    """Points of each robot and offset [mm] from the longest step to the shortest."""
    places = dict.fromkeys((point.drive.magnets, point.drive.offset_mm) for point in points)
    return {place: sorted(of(points, *place), key=lambda point: -point.drive.step_ms) for place in places}


def moved(found: Mapping[tuple[int, float], Sequence[Point]], measure: str) -> float:
    """How far a shorter step moves a mean at most."""
    means = np.array([[getattr(point, measure).mean for point in here] for here in found.values()])
    return float(np.nanmax(np.abs(means - means[:, :1])))


def inside(found: Mapping[tuple[int, float], Sequence[Point]]) -> list[bool]:
    """Whether means with the shortest step lie among the neighbours with the longest.

    Those that are 0 because nothing distinguishes left from right are left out.
    """
    ends = [
        (getattr(here[0], measure), getattr(here[-1], measure))
        for (_, offset_mm), here in found.items()
        for measure in MEASURES
        if offset_mm or measure == "stride_mm"
    ]
    return [longest.low <= shortest.mean <= longest.high for longest, shortest in ends]
