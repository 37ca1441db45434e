"""Cycles of a stage in space that are steered towards a goal."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines.runner import Runner
from magworm_gym.vector_env import MagWormVectorEnv

Floats = NDArray[np.float64]

ACTIONS = 5
MIRRORED = np.array([1.0, -1.0, 1.0, 1.0, -1.0])
"""A cycle that turns left turns right where its sideways parts change their sign."""
PARK = np.array([0.0, 0.0, -1.0, 1.0, 0.0])

TURN_PARKED_RAD = np.deg2rad(2.0)
REACH_STRAIGHT_RAD = np.deg2rad(10.0)


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

    def start(self, worms: Runner | MagWormVectorEnv) -> None:
        """Begins every cycle.

        Raises:
            ValueError: There are neither one nor N cycles.
        """
        if len(self._ends_s) not in (1, worms.num_envs):
            raise ValueError(f"{len(self._ends_s)} cycles do not fit {worms.num_envs} environments")
        self._time_s = 0.0
        self._step_s = worms.scene.control_step_s
        layout = (worms.env if isinstance(worms, Runner) else worms).observation_layout
        self._seen, self._side = next((layout[name], side) for name, side in SIDES.items() if name in layout)

    def act(self, worms: Runner) -> Floats:
        """Actions (N, 5) of the next control step."""
        return self.answer(worms.observations)

    def answer(self, observations: NDArray[np.float32]) -> Floats:
        """Actions (N, 5) of the next control step for observations (N, O)."""
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


SIDES: dict[str, Callable[[Floats], tuple[Floats, NDArray[np.bool_]]]] = {
    "heading_error": _turn_side,
    "goal_position": _reach_side,
}
"""To which side a goal is, and whether to park, by the part of an observation that tells it."""
