"""Families of cycles: rivals of a policy that has a goal, each with parameters to search."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene
from magworm_gym.baselines.cycle import ACTIONS, Cycle

Floats = NDArray[np.float64]

SLOWEST_BELT_M_S, FASTEST_BELT_M_S = 0.100, 0.210
SHORTEST_PERIOD_S, LONGEST_PERIOD_S = 0.2, 2.0
CONTROL_POINTS = 6
RISE_S = 0.25
"""Long enough to rise from the lowest to the highest place at full speed."""


@dataclass(frozen=True)
class Family:
    """A kind of cycle with parameters to search.

    Attributes:
        title: Name for tables and pictures.
        size: Number of parameters P.
        cycle: Makes a cycle of parameters (P,) in [-1, 1] and the stage's limits.
        edits: Changes of the scene.
        what: One sentence about it.
    """

    title: str
    size: int
    cycle: Callable[[Floats, dict[str, float]], Cycle]
    what: str
    edits: tuple[tuple[str, Any], ...] = ()

    def scene(self, scene: Scene) -> Scene:
        """The scene with this drive."""
        return scene.with_values(dict(self.edits)) if self.edits else scene


def _passes(unit: Floats, limits: dict[str, float], laterals: tuple[float, float]) -> Cycle:
    """Two passes under the robot at belt speed, each with its lateral offset; the way back is low."""
    speed, height, half, offset, forth = (float(value) for value in unit[:5])
    fastest = limits["speed_m_s"]
    slow = min(SLOWEST_BELT_M_S, fastest)
    speed_m_s = slow + 0.5 * (1.0 + speed) * (min(FASTEST_BELT_M_S, fastest) - slow)
    half_stroke = 0.2 + 0.4 * (1.0 + half)
    direction = 1.0 if forth > 0.0 else -1.0
    begin, end = np.clip(0.5 * offset + half_stroke * direction * np.array([-1.0, 1.0]), -1.0, 1.0)
    way_m = abs(end - begin) * limits["reach_m"]
    durations: list[float] = []
    points: list[list[float]] = []
    for lateral, after in (laterals, laterals[::-1]):
        durations += [RISE_S, way_m / speed_m_s, RISE_S, max(way_m / fastest, RISE_S)]
        points += [
            [begin, lateral, height, 1.0, 0.0],
            [end, lateral, height, 2.0 * speed_m_s / fastest - 1.0, 0.0],
            [end, lateral, -1.0, 1.0, 0.0],
            [begin, after, -1.0, 1.0, 0.0],
        ]
    return Cycle(np.array(durations), np.array(points))


def _misaligned(unit: Floats, limits: dict[str, float]) -> Cycle:
    return _passes(unit, limits, (float(unit[5]), float(unit[5])))


def _alternating(unit: Floats, limits: dict[str, float]) -> Cycle:
    return _passes(unit, limits, (float(unit[5]), float(unit[6])))


def _pair(unit: Floats, limits: dict[str, float]) -> Cycle:
    """Rise beneath the outer feet at one yaw, drag them to another, sink, yaw back."""
    height, begin, turn, speed, place = (float(value) for value in unit)
    end = min(max(begin, -1.0) + 1.0 + turn, 1.0)
    share = 0.1 + 0.45 * (1.0 + speed)
    quick_s = abs(end - begin) * limits["yaw_reach_deg"] / limits["yaw_speed_deg_s"]
    height = 0.5 * (1.0 + height)
    durations = np.array([RISE_S, quick_s / share + 0.1, RISE_S, quick_s + 0.1])
    points = np.array(
        [
            [0.5 * place, 0.0, height, 1.0, begin],
            [0.5 * place, 0.0, height, 2.0 * share - 1.0, end],
            [0.5 * place, 0.0, -1.0, 1.0, end],
            [0.5 * place, 0.0, -1.0, 1.0, begin],
        ]
    )
    return Cycle(durations, points)


def _free(unit: Floats, _: dict[str, float]) -> Cycle:
    period_s = SHORTEST_PERIOD_S * (LONGEST_PERIOD_S / SHORTEST_PERIOD_S) ** (0.5 * (1.0 + float(unit[0])))
    durations = np.full(CONTROL_POINTS, period_s / CONTROL_POINTS)
    return Cycle(durations, unit[1:].reshape(CONTROL_POINTS, ACTIONS), smooth=True)


DRIVE = "drive.arrangement"
SINGLE: tuple[tuple[str, Any], ...] = ((DRIVE, {"kind": "single"}),)
PAIR: tuple[tuple[str, Any], ...] = ((DRIVE, {"kind": "pair", "spacing_m": 0.040, "second_polarity": 1}),)
FAMILIES = {
    "misaligned": Family(
        "misaligned belt",
        6,
        _misaligned,
        "passes at 100 to 210 mm/s with one lateral offset, the way back low; speed, height, stroke, its "
        "middle, direction and offset searched; one drive magnet",
        SINGLE,
    ),
    "alternating": Family(
        "alternating offset",
        7,
        _alternating,
        "the same with a lateral offset of its own for every second pass; one drive magnet",
        SINGLE,
    ),
    "pair": Family(
        "two drive magnets (Joyee & Pan)",
        5,
        _pair,
        "two magnets 40 mm apart rise beneath the outer feet, yaw to drag them, sink and yaw back; height, "
        "both yaws, speed and place searched",
        PAIR,
    ),
    "free": Family(
        "CMA-ES stroke",
        1 + CONTROL_POINTS * ACTIONS,
        _free,
        "a periodic trajectory of all five actions, six control points, period 0.2 to 2 s; the drive that "
        "the policy has",
    ),
}
"""The rivals, by name."""
