"""Periodic open-loop trajectories of the stage."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines.runner import Runner

Floats = NDArray[np.float64]

SHORTEST_PERIOD_S = 0.1
LONGEST_PERIOD_S = 1.5


@dataclass(frozen=True)
class Stroke:
    """Repeats a trajectory of actions, blind to what the robot does.

    Between control points the actions are interpolated linearly and cyclically.

    Attributes:
        period_s: Duration of one repetition [s].
        points: Control points (K, 3) in [-1, 1], evenly spaced over the period.
    """

    period_s: float
    points: Floats


def stroke_from_unit(parameters: Floats) -> Stroke:
    """Reads a stroke from optimiser's coordinates.

    Args:
        parameters: (1 + 3 K,) in [-1, 1]: logarithm of the period between 0.1 and 1.5 s, then the
            control points in order. Values outside are clipped.

    Returns:
        The stroke.

    Raises:
        ValueError: The number of parameters fits no K.
    """
    if parameters.ndim != 1 or parameters.size < 4 or parameters.size % 3 != 1:
        raise ValueError(f"a stroke has 1 + 3 K parameters, K at least 1, not {parameters.shape}")
    unit = np.clip(parameters, -1.0, 1.0)
    share = 0.5 * (1.0 + float(unit[0]))
    period = SHORTEST_PERIOD_S * (LONGEST_PERIOD_S / SHORTEST_PERIOD_S) ** share
    return Stroke(period, unit[1:].reshape(-1, 3))


class PeriodicStrokes:
    """Runs a stroke in each environment.

    Args:
        strokes: One stroke for each environment (N), or a single one for all; equal numbers of
            control points.
    """

    def __init__(self, strokes: list[Stroke]) -> None:
        self._period_s = np.array([stroke.period_s for stroke in strokes])
        points = np.stack([stroke.points for stroke in strokes])
        self._points = np.concatenate([points, points[:, :1]], axis=1)
        self._steps = 0

    def start(self, worms: Runner) -> None:
        """Begins every stroke at its first control point.

        Raises:
            ValueError: There are neither one nor N strokes.
        """
        if len(self._period_s) not in (1, worms.num_envs):
            raise ValueError(f"{len(self._period_s)} strokes do not fit {worms.num_envs} environments")
        self._steps = 0

    def act(self, worms: Runner) -> Floats:
        """Actions (N, 3) at the time since ``start``."""
        return np.asarray(self.plan(worms, 1)[0])

    def plan(self, worms: Runner, steps: int) -> Floats:
        """Actions (T, N, 3) of the next control steps."""
        time_s = (self._steps + np.arange(steps))[:, None] * worms.scene.control_step_s
        self._steps += steps
        place = time_s / self._period_s % 1.0 * (self._points.shape[1] - 1)
        before = np.minimum(place.astype(np.int64), self._points.shape[1] - 2)
        share = (place - before)[..., None]
        every = np.arange(len(self._period_s))
        actions = (1.0 - share) * self._points[every, before] + share * self._points[every, before + 1]
        return np.array(np.broadcast_to(actions, (steps, worms.num_envs, 3)))
