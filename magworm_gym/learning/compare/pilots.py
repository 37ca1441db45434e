"""Rivals of a policy that has a goal: cycles of the stage that are mirrored towards the goal."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from magworm_gym import MagWormVectorEnv, Scene
from magworm_gym.learning.crawl_policy import LearnedController
from magworm_gym.tasks import Turn

Floats = NDArray[np.float64]

POSITION, LATERAL, HEIGHT, SPEED, YAW = range(5)
ACTIONS = 5
MIRRORED = np.array([1.0, -1.0, 1.0, 1.0, -1.0])
"""A cycle that turns left turns right where its sideways parts change their sign."""
PARK = np.array([0.0, 0.0, -1.0, 1.0, 0.0])

TURN_PARKED_RAD = np.deg2rad(2.0)
REACH_STRAIGHT_RAD = np.deg2rad(10.0)

SLOWEST_BELT_M_S, FASTEST_BELT_M_S = 0.100, 0.210
SHORTEST_PERIOD_S, LONGEST_PERIOD_S = 0.2, 2.0
CONTROL_POINTS = 6
RISE_S = 0.25
"""Long enough to rise from the lowest to the highest place at full speed."""


class Pilot(Protocol):
    """Answers observations of a task with actions."""

    def start(self, worms: MagWormVectorEnv) -> None:
        """Called once after the reset of all environments."""

    def act(self, observations: NDArray[np.float32]) -> Floats:
        """Actions (N, 5) of the next control step for observations (N, O)."""


@dataclass(frozen=True)
class Cycle:
    """Actions that repeat.

    Attributes:
        durations_s: How long each action holds (K,) [s].
        points: The actions (K, 5).
        smooth: Whether the actions go over into each other linearly, in place of holding.
    """

    durations_s: Floats
    points: Floats
    smooth: bool = False


class Learned:
    """Acts with the mean action of a trained policy.

    Args:
        folder: Folder ``policy`` that a training has left.
        algorithm: "ppo" or "sac".
    """

    def __init__(self, folder: Path, algorithm: str) -> None:
        self._policy = LearnedController(folder)

    def start(self, worms: MagWormVectorEnv) -> None:
        """Nothing to prepare: the policy has no memory."""

    def act(self, observations: NDArray[np.float32]) -> Floats:
        """See :class:`Pilot`."""
        return self._policy.answer(observations)


class Steered:
    """Runs a cycle in each environment, mirrored to the side on which the goal is.

    Of the goal it knows the side alone. Turning, it parks the magnet while the heading is within 2° of
    the goal's; reaching, it keeps to the middle while the goal is within 10° of straight ahead.

    Args:
        cycles: One for each environment (N), or a single one for all, with equal numbers of points.
    """

    def __init__(self, cycles: list[Cycle]) -> None:
        self._ends_s = np.cumsum([cycle.durations_s for cycle in cycles], axis=1)
        self._points = np.stack([cycle.points for cycle in cycles])
        self._smooth = np.array([cycle.smooth for cycle in cycles])
        self._time_s = 0.0

    def start(self, worms: MagWormVectorEnv) -> None:
        """Begins every cycle.

        Raises:
            ValueError: There are neither one nor N cycles.
        """
        if len(self._ends_s) not in (1, worms.num_envs):
            raise ValueError(f"{len(self._ends_s)} cycles do not fit {worms.num_envs} environments")
        self._time_s = 0.0
        self._step_s = worms.scene.control_step_s
        self._side: Callable[[Floats], tuple[Floats, NDArray[np.bool_]]]
        layout = worms.observation_layout
        if isinstance(worms.task, Turn):
            self._seen, self._side = layout["heading_error"], _turn_side
        else:
            self._seen, self._side = layout["goal_position"], _reach_side

    def act(self, observations: NDArray[np.float32]) -> Floats:
        """See :class:`Pilot`."""
        side, parked = self._side(observations[:, self._seen].astype(np.float64))
        actions = np.broadcast_to(self._now(), (len(side), ACTIONS))
        sideways = np.where(MIRRORED < 0.0, side[:, None], 1.0)
        self._time_s += self._step_s
        return np.where(parked[:, None], PARK, actions * sideways)

    def _now(self) -> Floats:
        """Actions of each cycle at this time (C, 5)."""
        count = self._points.shape[1]
        every = np.arange(len(self._points))
        time = self._time_s % self._ends_s[:, -1]
        at = np.minimum((time[:, None] >= self._ends_s).sum(axis=1), count - 1)
        here, there = self._points[every, at], self._points[every, (at + 1) % count]
        ends = self._ends_s[every, at]
        begins = np.where(at > 0, self._ends_s[every, at - 1], 0.0)
        share = np.where(self._smooth, (time - begins) / np.maximum(ends - begins, 1e-9), 0.0)[:, None]
        return np.asarray((1.0 - share) * here + share * there)


def _turn_side(seen: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    error_rad = np.pi * seen[:, 0]
    return np.sign(error_rad), np.abs(error_rad) < TURN_PARKED_RAD


def _reach_side(seen: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    bearing_rad = np.arctan2(seen[:, 1], -seen[:, 0])
    ahead = np.abs(bearing_rad) < REACH_STRAIGHT_RAD
    return np.where(ahead, 0.0, np.sign(bearing_rad)), np.zeros(len(seen), np.bool_)


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
