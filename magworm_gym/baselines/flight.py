"""Episodes towards set goals, the same for every controller."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magworm_gym.baselines.runner import Controller, Runner
from magworm_gym.tasks import Reach, Task, Turn

Floats = NDArray[np.float64]

TURN_STAGES_DEG = (30.0, 90.0)


@dataclass(frozen=True)
class Flight:
    """What came of E episodes.

    Attributes:
        left: What was left to the goal at each control step (T + 1, E), see :class:`Aim`; what was left at
            the end of an episode is held.
        lost: Episodes in which the robot tipped over or broke (E,).
        step_s: Control step [s].
        way_m: How far the centre went from its start until the episode ended (E,) [m].
    """

    left: Floats
    lost: NDArray[np.bool_]
    step_s: float
    way_m: Floats

    @property
    def duration_s(self) -> float:
        """Longest time of an episode [s]."""
        return (len(self.left) - 1) * self.step_s

    def time_until_s(self, tolerance: float) -> Floats:
        """First time with less than that left (E,) [s]; the end of the episode where there is none."""
        near = np.abs(self.left) < tolerance
        return np.where(near.any(axis=0), near.argmax(axis=0) * self.step_s, self.duration_s)


@dataclass(frozen=True)
class Aim:
    """What the goal of a task is to those who fly towards it.

    Attributes:
        left: What is left to the goal of each robot (N,), from the state of the task.
        tried: Goals of a search, taken in turn (G, …).
        score: What a search maximises (E,).
    """

    left: Callable[[Task], Floats]
    tried: Floats
    score: Callable[[Flight], Floats]


def fly(worms: Runner, controller: Controller, goals: Floats, seeds: ArrayLike, duration_s: float) -> Flight:
    """Flies an episode for each goal.

    Args:
        worms: A robot for each goal, with a task of :data:`AIMS`.
        controller: Gives the actions.
        goals: (E,) [°] or (E, 2) [m], as the task's option takes them.
        seeds: Seeds of the starts (E,).
        duration_s: Longest time of an episode [s].
    """
    task = worms.env.task
    left, steps = AIMS[type(task)].left, max(1, worms.steps(duration_s))
    worms.begin(seeds, controller, goals=goals)
    began, way_m = worms.batch.robot_poses()[:, :2].copy(), np.zeros(len(goals))
    lefts, going = [], worms.going
    for _ in worms.instants(steps):
        lefts.append(left(task))
        gone = np.linalg.norm(worms.batch.robot_poses()[:, :2] - began, axis=1)
        way_m, going = np.where(going, gone, way_m), worms.going
    lefts += [lefts[-1]] * (steps + 1 - len(lefts))
    return Flight(np.array(lefts), worms.lost, worms.scene.control_step_s, way_m)


def _turn_left(task: Task) -> Floats:
    """Heading error with its sign [°]."""
    return np.asarray(np.rad2deg(task.state["goal_rad"] - task.state["heading_rad"]))


def _reach_left(task: Task) -> Floats:
    """Distance [m]."""
    return np.array(task.state["distance_m"])


def _turn_score(flight: Flight) -> Floats:
    """Shares of 30° and of 90° that are turned, averaged over the time: the first 30° count as much."""
    done = np.abs(flight.left[0]) - np.abs(flight.left)
    shares = [np.clip(done, -stage, stage) / stage for stage in TURN_STAGES_DEG]
    return np.asarray(np.mean(shares, axis=0).mean(axis=0))


def _reach_score(flight: Flight) -> Floats:
    """Share of the way that is done, averaged over the time."""
    done = np.abs(flight.left[0]) - np.abs(flight.left)
    return np.asarray((done / flight.left[0]).mean(axis=0))


AIMS: dict[type[Task], Aim] = {
    Turn: Aim(_turn_left, np.array([90.0, -90.0]), _turn_score),
    Reach: Aim(_reach_left, np.array([[-0.050, 0.015], [-0.045, -0.030]]), _reach_score),
}
"""What the goals of tasks are."""
