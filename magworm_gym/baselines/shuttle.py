"""One magnet that shuttles under the robot: a slow work stroke, a fast return."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch, Scene
from magworm_gym.baselines.trial import Trial, centre_x_m, crawl_speed_m_s

Floats = NDArray[np.float64]

ARRIVED_M = 1e-3
HALF_STROKES = (0.1, 0.2, 0.35, 0.5, 0.75, 1.0)
OFFSETS = (-0.25, 0.0, 0.25)

# Corners of the path: end of the stroke (+1 towards the tail), height, whether at work speed.
CORNERS = np.array([[1.0, 1.0, 1.0], [1.0, -1.0, 0.0], [-1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]], dtype=np.float64)


class Shuttle:
    """Moves one magnet to and fro, relative to the robot.

    Work stroke: towards the tail at constant speed and greatest height. Return: at full speed, after
    sinking to the lowest height, or at the same height. Every argument may be an array (N,), so that
    one batch can compare many shuttles.

    Args:
        work_speed: Speed of the work stroke, as a share of the stage's limit, 0 to 1.
        half_stroke: Half the stroke, as a share of the stage's reach, 0 to 1.
        offset: Middle of the stroke relative to the robot centre, as a share of the reach.
        low_return: Whether to sink before returning.
    """

    def __init__(
        self,
        work_speed: Floats | float,
        half_stroke: Floats | float,
        offset: Floats | float = 0.0,
        low_return: NDArray[np.bool_] | bool = True,
    ) -> None:
        self._work_speed = np.asarray(work_speed, dtype=np.float64)
        self._half_stroke = np.asarray(half_stroke, dtype=np.float64)
        self._offset = np.asarray(offset, dtype=np.float64)
        self._low_return = np.asarray(low_return, dtype=np.bool_)
        self._corner = np.zeros(0, dtype=np.int64)

    def start(self, batch: Batch) -> None:
        """Sends every magnet to the beginning of its work stroke."""
        self._corner = np.full(batch.num_envs, 3, dtype=np.int64)

    def act(self, batch: Batch) -> Floats:
        """Actions (N, 3); a corner is passed once the drive is within 1 mm of it.

        Raises:
            ValueError: The scene's drive is not controlled.
        """
        limits = batch.scene.stage_limits
        if limits is None:
            raise ValueError("a shuttle needs a scene with a controlled drive")
        actions = self._actions()
        half_height = 0.5 * (limits["highest_m"] - limits["lowest_m"])
        middle = 0.5 * (limits["highest_m"] + limits["lowest_m"])
        target = np.stack(
            [centre_x_m(batch) + limits["reach_m"] * actions[:, 0], middle + half_height * actions[:, 1]],
            axis=1,
        )
        distance = np.linalg.norm(target - batch.drive_positions()[:, 0], axis=1)
        self._corner = np.where(distance < ARRIVED_M, (self._corner + 1) % len(CORNERS), self._corner)
        return self._actions()

    def _actions(self) -> Floats:
        end, height, works = CORNERS[self._corner].T
        x = np.clip(self._offset + self._half_stroke * end, -1.0, 1.0)
        height = np.where(self._low_return, height, 1.0)
        speed = np.where(works > 0.0, 2.0 * self._work_speed - 1.0, 1.0)
        return np.stack(np.broadcast_arrays(x, height, speed), axis=1)


@dataclass(frozen=True)
class ShuttleCurve:
    """Crawling speed against the speed of the work stroke.

    Attributes:
        drive_speed_m_s: Speeds of the work stroke (S,) [m/s].
        speed_m_s: Crawling speed (S, strokes, offsets, 2, starts) [m/s]; the last but one axis is the
            return: at the same height, low.
        half_strokes: Half strokes, as shares of the reach.
        offsets: Middles of the stroke, as shares of the reach.
    """

    drive_speed_m_s: Floats
    speed_m_s: Floats
    half_strokes: tuple[float, ...]
    offsets: tuple[float, ...]

    @property
    def best(self) -> tuple[int, ...]:
        """Indices (speed, stroke, offset, return) of the greatest mean crawling speed."""
        mean = self.speed_m_s.mean(axis=-1)
        return tuple(int(index) for index in np.unravel_index(mean.argmax(), mean.shape))

    @property
    def best_per_drive_speed_m_s(self) -> Floats:
        """Mean crawling speed (S,) [m/s] of the best stroke, offset and return at each speed."""
        return np.asarray(self.speed_m_s.mean(axis=-1).reshape(len(self.drive_speed_m_s), -1).max(axis=1))

    def best_shuttle(self, limit_m_s: float) -> Shuttle:
        """The shuttle at ``best``, for a stage with this speed limit [m/s]."""
        speed, stroke, offset, low = self.best
        return Shuttle(
            float(self.drive_speed_m_s[speed]) / limit_m_s,
            self.half_strokes[stroke],
            self.offsets[offset],
            bool(low),
        )


def sweep_shuttle(
    scene: Scene,
    drive_speed_m_s: Sequence[float] | Floats,
    trial: Trial,
    *,
    starts: int = 2,
    seed: int = 0,
    present: NDArray[np.bool_] | None = None,
    half_strokes: tuple[float, ...] = HALF_STROKES,
    offsets: tuple[float, ...] = OFFSETS,
) -> ShuttleCurve:
    """Measures every combination of speed, stroke, offset and return in one batch.

    Args:
        scene: Scene with a controlled drive.
        drive_speed_m_s: Speeds of the work stroke (S,) [m/s], up to the stage's limit.
        trial: How a speed is measured.
        starts: Seeds for each combination; the scene draws the start from the seed.
        seed: First seed.
        present: Which body magnets are in place (M,); None for all.
        half_strokes: Half strokes to try, as shares of the reach.
        offsets: Middles of the stroke to try, as shares of the reach.

    Returns:
        The curve.

    Raises:
        ValueError: The scene has no controlled drive.
    """
    limits = scene.stage_limits
    if limits is None:
        raise ValueError("a shuttle needs a scene with a controlled drive")
    speeds = np.asarray(drive_speed_m_s, dtype=np.float64)
    shape = (len(speeds), len(half_strokes), len(offsets), 2, starts)
    speed, stroke, offset, low, number = (axis.ravel() for axis in np.indices(shape))
    batch = Batch(scene, speed.size)
    if present is not None:
        batch.set_magnets_present(np.tile(present, (batch.num_envs, 1)))
    shuttle = Shuttle(
        speeds[speed] / limits["speed_m_s"],
        np.array(half_strokes)[stroke],
        np.array(offsets)[offset],
        low == 1,
    )
    seeds = number.astype(np.uint64) + np.uint64(seed)
    measured = crawl_speed_m_s(batch, trial, seeds, shuttle)
    return ShuttleCurve(speeds, measured.reshape(shape), half_strokes, offsets)
