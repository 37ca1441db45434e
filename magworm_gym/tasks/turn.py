"""Turn to a commanded heading."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene, Specification, atan2, sin_cos
from magworm_gym.spaces import Part
from magworm_gym.tasks.task import Flags, Floats, Goal, GoalOption, Simulation, Task, TaskResult, setting


@dataclass
class Turn(Task):
    """Turn the robot until its heading is the goal's, and stay there.

    **Start**: the robot lies straight and at rest, its head towards −x, at the scene's start or that of the
    option ``start``; the stage stands anywhere within its limits about it, at random.

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

    Args:
        greatest_goal_deg: Goals are drawn up to this angle to either side [°].
        tolerance_deg: The heading is the goal's where less is left [°].
        near_reward: Reward of a step after which it is.
        tipped_roll_deg: A robot tips over where a magnet rolls further [°].
        tipped_reward: Reward of the step in which it does.
    """

    default_scene = "turn-3-pair"
    reward_unit = "°"
    needs_space = True
    goal_option = GoalOption("goal_deg", (), 180.0)
    draws = 1
    uses_magnet_poses = True
    parts = (
        Part("goal_direction", "1", 2, -1.0, 1.0, "cosine and sine of the goal's heading from the robot's"),
        Part("heading_error", "π rad", 1, -np.inf, np.inf, "goal − heading, whole turns counted"),
    )

    greatest_goal_deg: float = setting(90.0, 0.0, 180.0)
    tolerance_deg: float = setting(3.0, 0.0, 180.0)
    near_reward: float = setting(0.1, -1e6, 1e6)
    tipped_roll_deg: float = setting(60.0, 0.0, 180.0)
    tipped_reward: float = setting(-30.0, -1e6, 1e6)

    def prepare(self, scene: Scene, observed: Sequence[Specification], num_envs: int) -> None:
        """Remembers the goal and the heading, whole turns counted."""
        self.state = {"goal_rad": np.zeros(num_envs), "heading_rad": np.zeros(num_envs)}

    @property
    def error_rad(self) -> Floats:
        """Goal − heading (N,) [rad]."""
        return self.state["goal_rad"] - self.state["heading_rad"]

    def begin(self, simulation: Simulation, mask: Flags, requested_goal: Floats, uniform: Floats) -> None:
        """Draws or takes goals about the heading at the start."""
        heading = simulation.robot_poses()[:, 2]
        drawn_deg = self.greatest_goal_deg * (2.0 * uniform - 1.0)
        turn_deg = np.where(np.isnan(requested_goal), drawn_deg, requested_goal)[:, 0]
        self.state["heading_rad"] = np.where(mask, heading, self.state["heading_rad"])
        self.state["goal_rad"] = np.where(mask, heading + np.deg2rad(turn_deg), self.state["goal_rad"])

    def evaluate(self, simulation: Simulation, progress_m: Floats, mask: Flags) -> TaskResult:
        """Follows the heading; rewards what it came nearer to the goal."""
        before = np.abs(np.rad2deg(self.error_rad))
        change = simulation.robot_poses()[:, 2] - self.state["heading_rad"]
        heading = self.state["heading_rad"] + np.where(mask, _within_half_turn(change), 0.0)
        self.state["heading_rad"] = heading
        left = np.abs(np.rad2deg(self.error_rad))
        near = left < self.tolerance_deg
        roll, upside_down = _furthest_roll(simulation)
        tipped = (np.abs(roll) > np.deg2rad(self.tipped_roll_deg)) | upside_down
        return TaskResult(
            rewards=before - left + self.near_reward * near + self.tipped_reward * tipped,
            terminated=tipped,
            success=near & ~tipped,
            infos={"heading_rad": heading, "heading_error_rad": self.error_rad, "roll_rad": roll},
        )

    def observe(self, simulation: Simulation) -> Floats:
        """The direction and the angle that are left."""
        error = self.error_rad
        sine, cosine = sin_cos(error)
        return np.stack([cosine, sine, error / np.pi], axis=1)

    def reset_infos(self) -> dict[str, NDArray[np.float64]]:
        """The heading asked for."""
        return {"goal_rad": self.state["goal_rad"]}

    def goal(self, i: int) -> Goal:
        """The heading asked for, as an arrow."""
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
