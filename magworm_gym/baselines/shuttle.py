"""One magnet that shuttles under the robot: a slow work stroke, a fast return."""

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines.runner import Runner
from magworm_gym.baselines.trial import centre_x_m

Floats = NDArray[np.float64]

ARRIVED_M = 1e-3
SHUTTLE_AXES = {
    "half_stroke": np.array([0.1, 0.2, 0.35, 0.5, 0.75, 1.0]),
    "offset": np.array([-0.25, 0.0, 0.25]),
    "low_return": np.array([0.0, 1.0]),
}
"""What of a shuttle is worth sweeping, beside its speed."""

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
        low_return: Whether to sink before returning: 1, or 0.
    """

    def __init__(
        self,
        work_speed: Floats | float,
        half_stroke: Floats | float,
        offset: Floats | float = 0.0,
        low_return: Floats | float = 1.0,
    ) -> None:
        self._work_speed = np.asarray(work_speed, dtype=np.float64)
        self._half_stroke = np.asarray(half_stroke, dtype=np.float64)
        self._offset = np.asarray(offset, dtype=np.float64)
        self._low_return = np.asarray(low_return, dtype=np.float64) > 0.0
        self._corner = np.zeros(0, dtype=np.int64)

    def start(self, worms: Runner) -> None:
        """Sends every magnet to the beginning of its work stroke."""
        self._corner = np.full(worms.num_envs, 3, dtype=np.int64)

    def act(self, worms: Runner) -> Floats:
        """Actions (N, 3); a corner is passed once the drive is within 1 mm of it."""
        limits, batch = worms.scene.stage_limits or {}, worms.batch
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
