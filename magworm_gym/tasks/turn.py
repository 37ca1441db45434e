"""Turn to a commanded heading."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene, Specification, atan2, sin_cos
from magworm_gym.spaces import Part
from magworm_gym.tasks.task import Flags, Floats, Goal, GoalOption, Simulation, Task, TaskResult

GREATEST_GOAL_DEG = 90.0
"""Goals are drawn up to this angle to either side of the heading at the start."""
TOLERANCE_DEG = 3.0
NEAR_REWARD = 0.1
TIPPED_ROLL_DEG = 60.0
TIPPED_REWARD = -30.0


class Turn(Task):
    """Turn the robot until its heading is the goal's, and stay there.

    **Goal**: drawn uniformly from ±90° about the heading at the start; option ``goal_deg`` sets it, from
    -180 to 180, positive anticlockwise as seen from above.

    **Reward**: decrease of |goal − heading| within the control step [°], and 0.1 where that is less
    than 3° after it; −30 in the step in which the robot tips over. The heading counts whole turns: it
    is followed from step to step, so that nothing jumps at ±180°.

    **Terminated**: where the robot tips over: a magnet that is in place rolls beyond 60° to either
    side, or its upper face points down.

    **Info** of a step: ``heading_rad``, ``heading_error_rad`` (goal − heading), ``roll_rad`` of the
    magnet that rolls furthest; where an episode ends ``is_success``: less than 3° are left, and the
    robot has neither tipped over nor broken. Of a reset: ``goal_rad``, the heading asked for.
    """

    name = "turn"
    goal_option = GoalOption("goal_deg", (), 180.0)
    draws = 1
    uses_magnet_poses = True
    parts = (
        Part("goal_direction", "1", 2, -1.0, 1.0, "cosine and sine of the goal's heading from the robot's"),
        Part("heading_error", "π rad", 1, -np.inf, np.inf, "goal − heading, whole turns counted"),
    )

    def __init__(self, scene: Scene, observed: Sequence[Specification], num_envs: int) -> None:
        super().__init__(scene, observed, num_envs)
        self.state = {"goal_rad": np.zeros(num_envs), "heading_rad": np.zeros(num_envs)}

    @property
    def error_rad(self) -> Floats:
        """Goal − heading (N,) [rad]."""
        return self.state["goal_rad"] - self.state["heading_rad"]

    def begin(self, simulation: Simulation, mask: Flags, requested_goal: Floats, uniform: Floats) -> None:
        """See the class."""
        heading = simulation.robot_poses()[:, 2]
        drawn_deg = GREATEST_GOAL_DEG * (2.0 * uniform - 1.0)
        turn_deg = np.where(np.isnan(requested_goal), drawn_deg, requested_goal)[:, 0]
        self.state["heading_rad"] = np.where(mask, heading, self.state["heading_rad"])
        self.state["goal_rad"] = np.where(mask, heading + np.deg2rad(turn_deg), self.state["goal_rad"])

    def evaluate(self, simulation: Simulation, progress_m: Floats, mask: Flags) -> TaskResult:
        """See the class."""
        before = np.abs(np.rad2deg(self.error_rad))
        change = simulation.robot_poses()[:, 2] - self.state["heading_rad"]
        heading = self.state["heading_rad"] + np.where(mask, _within_half_turn(change), 0.0)
        self.state["heading_rad"] = heading
        left = np.abs(np.rad2deg(self.error_rad))
        near = left < TOLERANCE_DEG
        roll, upside_down = _furthest_roll(simulation)
        tipped = (np.abs(roll) > np.deg2rad(TIPPED_ROLL_DEG)) | upside_down
        return TaskResult(
            rewards=before - left + NEAR_REWARD * near + TIPPED_REWARD * tipped,
            terminated=tipped,
            success=near & ~tipped,
            infos={"heading_rad": heading, "heading_error_rad": self.error_rad, "roll_rad": roll},
        )

    def observe(self, simulation: Simulation) -> Floats:
        """See the class."""
        error = self.error_rad
        sine, cosine = sin_cos(error)
        return np.stack([cosine, sine, error / np.pi], axis=1)

    def reset_infos(self) -> dict[str, NDArray[np.float64]]:
        """See the class."""
        return {"goal_rad": self.state["goal_rad"]}

    def goal(self, i: int) -> Goal:
        """See the class."""
        return Goal(heading_rad=float(self.state["goal_rad"][i]))


def _within_half_turn(angle_rad: Floats) -> Floats:
    """The same angle from -π to π."""
    return angle_rad - 2.0 * np.pi * np.round(angle_rad / (2.0 * np.pi))


def _furthest_roll(simulation: Simulation) -> tuple[Floats, Flags]:
    """The greatest roll of the magnets in place (N,) [rad], and whether one of them is upside down (N,).

    Roll is about the magnet's own tangent, positive where its up leans towards its side.
    """
    w, x, y, z = np.moveaxis(simulation.magnet_poses()[..., 3:], -1, 0).copy()
    up_y, side_y = 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)
    present = simulation.magnets_present()
    roll = np.where(present, atan2(-side_y, up_y), 0.0)
    furthest = np.abs(roll).argmax(axis=1)[:, None]
    return np.take_along_axis(roll, furthest, axis=1)[:, 0], (present & (up_y < 0.0)).any(axis=1)
