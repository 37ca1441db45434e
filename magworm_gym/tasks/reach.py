"""Crawl to a point on the ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene, Specification, sin_cos
from magworm_gym.spaces import Part
from magworm_gym.tasks.task import (
    MM_PER_M,
    Flags,
    Floats,
    Goal,
    GoalOption,
    Simulation,
    Task,
    TaskResult,
    metres,
    named,
    setting,
)


@dataclass
class Reach(Task):
    """Bring the robot's centre to a point on the ground.

    **Start**: as for :class:`Turn`.

    **Goal**: drawn 30 to 80 mm from the robot's centre, up to 60° to either side of straight ahead, both
    uniformly; option ``goal_m`` sets it: ``[x, z]`` [m] from the robot's centre at the start, x towards
    its tail (so ahead is negative) and z to its left; a pair for all or an array (N, 2).

    **Reward**: decrease of the distance of the robot's centre from the goal within the control step [mm].

    **Terminated**: within 5 mm of the goal.

    **Info** of a step: ``distance_m`` left; where an episode ends ``is_success``: 5 mm or less. Of a
    reset: ``goal_m``, x and z in the world.

    Args:
        nearest_m: Goals are drawn from this distance on [m].
        furthest_m: Goals are drawn up to this distance [m].
        widest_deg: Goals are drawn up to this angle to either side of straight ahead [°].
        tolerance_m: A goal is reached within this distance [m].
    """

    default_scene = "turn-3-pair"
    reward_unit = "mm"
    needs_space = True
    goal_option = GoalOption("goal_m", (2,), 1.0)
    draws = 2

    nearest_m: float = setting(0.030, 0.0, 1.0)
    furthest_m: float = setting(0.080, 0.0, 1.0)
    widest_deg: float = setting(60.0, 0.0, 180.0)
    tolerance_m: float = setting(0.005, 0.0, 1.0)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.nearest_m > self.furthest_m:
            raise ValueError(
                f"nearest_m of Reach is {self.nearest_m}; allowed: at most furthest_m = {self.furthest_m}"
            )

    def prepare(self, scene: Scene, observed: Sequence[Specification], num_envs: int) -> None:
        """Remembers the goal and its distance, and tells them in the unit of the drive's position."""
        place = named(observed, "drive_position")
        self._unit_m = metres(place)
        self.parts = (
            Part("goal_position", place.unit, 2, -np.inf, np.inf, "x and z of the goal"),
            Part("goal_distance", place.unit, 1, 0.0, np.inf, "distance of the goal from the robot's centre"),
        )
        self.state = {"goal_m": np.zeros((num_envs, 2)), "distance_m": np.zeros(num_envs)}

    def begin(self, simulation: Simulation, mask: Flags, requested_goal: Floats, uniform: Floats) -> None:
        """Draws or takes goals about the robot at the start."""
        distance = self.nearest_m + (self.furthest_m - self.nearest_m) * uniform[:, 0]
        aside = np.deg2rad(self.widest_deg) * (2.0 * uniform[:, 1] - 1.0)
        sine, cosine = sin_cos(aside)
        drawn_m = distance[:, None] * np.stack([-cosine, sine], axis=1)
        x, z = np.where(np.isnan(requested_goal), drawn_m, requested_goal).T.copy()
        poses = simulation.robot_poses()
        sin, cos = sin_cos(poses[:, 2])
        goal_m = poses[:, :2] + np.stack([x * cos + z * sin, z * cos - x * sin], axis=1)
        self.state["goal_m"] = np.where(mask[:, None], goal_m, self.state["goal_m"])
        self.state["distance_m"] = np.where(mask, self._distance_m(poses), self.state["distance_m"])

    def evaluate(self, simulation: Simulation, progress_m: Floats, mask: Flags) -> TaskResult:
        """Rewards what the centre came nearer to the goal."""
        before = self.state["distance_m"]
        distance = np.where(mask, self._distance_m(simulation.robot_poses()), before)
        self.state["distance_m"] = distance
        reached = distance <= self.tolerance_m
        return TaskResult(MM_PER_M * (before - distance), reached, reached, {"distance_m": distance})

    def observe(self, simulation: Simulation) -> Floats:
        """Place and distance of the goal, from the robot."""
        poses = simulation.robot_poses()
        x, z = (self.state["goal_m"] - poses[:, :2]).T.copy()
        sin, cos = sin_cos(poses[:, 2])
        seen = np.stack([x * cos - z * sin, x * sin + z * cos, np.sqrt(x * x + z * z)], axis=1)
        return np.asarray(seen / self._unit_m)

    def reset_infos(self) -> dict[str, NDArray[np.float64]]:
        """The place of the goal."""
        return {"goal_m": self.state["goal_m"]}

    def goal(self, i: int) -> Goal:
        """The point, with the circle that counts as reached."""
        x, z = self.state["goal_m"][i].tolist()
        return Goal(point_m=(x, z), radius_m=self.tolerance_m)

    def _distance_m(self, poses: Floats) -> Floats:
        return np.asarray(np.linalg.norm(self.state["goal_m"] - poses[:, :2], axis=1))
