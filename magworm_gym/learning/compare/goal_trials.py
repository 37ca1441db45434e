"""Episodes towards set goals, the same for every pilot."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym import MagWormVectorEnv, Recording, Scene
from magworm_gym.learning.compare.pilots import Pilot
from magworm_gym.tasks import Goal, Turn, task_of

Floats = NDArray[np.float64]

FIRST_SEED = 900_000_000
"""Seed of the first start; no training or search uses it or one that follows."""
TURN_TOLERANCE_DEG = 3.0


@dataclass(frozen=True)
class Flight:
    """What came of E episodes.

    Attributes:
        left: Heading error [°] with its sign, or distance [m], at each control step (T + 1, E); what was
            left at the end of an episode is held.
        lost: Episodes in which the robot tipped over or broke (E,).
        step_s: Control step [s].
        way_m: How far the centre went from its start until the episode ended (E,) [m]; None if unknown.
    """

    left: Floats
    lost: NDArray[np.bool_]
    step_s: float
    way_m: Floats | None = None

    @property
    def duration_s(self) -> float:
        """Longest time of an episode [s]."""
        return (len(self.left) - 1) * self.step_s

    def time_until_s(self, tolerance: float) -> Floats:
        """First time with less than that left (E,) [s]; the end of the episode where there is none."""
        near = np.abs(self.left) < tolerance
        return np.where(near.any(axis=0), near.argmax(axis=0) * self.step_s, self.duration_s)


def fly(
    scene: Scene, task: str, pilot: Pilot, goals: Floats, seeds: Sequence[int], duration_s: float
) -> Flight:
    """Flies an episode for each goal.

    Args:
        scene: Scene in space.
        task: "turn" or "reach".
        pilot: Gives the actions.
        goals: (E,) [°] or (E, 2) [m], as the task's option takes them.
        seeds: Seeds of the starts (E,).
        duration_s: Longest time of an episode [s].
    """
    worms, observations = _begun(scene, task, pilot, goals, seeds, duration_s)
    lost, over = np.zeros((2, len(goals)), np.bool_)
    lefts = [_left(worms)]
    began = worms.batch.robot_poses()[:, :2].copy()
    way_m = np.zeros(len(goals))
    for _ in range(worms.max_episode_steps):
        actions = pilot.act(observations)
        observations, _, terminated, truncated, infos = worms.step(actions)
        lefts.append(np.where(over, lefts[-1], _left(worms)))
        gone = np.linalg.norm(worms.batch.robot_poses()[:, :2] - began, axis=1)
        way_m = np.where(over, way_m, gone)
        timed = infos.get("time_limit", np.zeros(len(goals), np.bool_))
        ended = (terminated | truncated) & ~over
        lost |= ended & ~timed & ~(terminated & (task == "reach"))
        over |= ended
        if over.all():
            lefts += [lefts[-1]] * (worms.max_episode_steps + 1 - len(lefts))
            break
    worms.close()
    return Flight(np.array(lefts), lost, scene.control_step_s, way_m)


def filmed(
    scene: Scene, task: str, pilot: Pilot, goal: Floats, seed: int, duration_s: float
) -> tuple[Recording, Goal, Floats]:
    """Records one episode until it ends.

    Returns:
        The recording, the goal, and what was left at each instant as in :class:`Flight` (T,).
    """
    worms, observations = _begun(scene, task, pilot, goal[None], [seed], duration_s)
    batch, goal_seen = worms.batch, worms.task.goal(0)
    assert goal_seen is not None, "the task has a goal"
    nodes, poses, drives, lefts = [], [], [], []
    for step in range(worms.max_episode_steps + 1):
        ended = False
        if step:
            observations, _, terminated, truncated, _ = worms.step(pilot.act(observations))
            ended = bool((terminated | truncated)[0])
        nodes.append(batch.node_positions()[0])
        poses.append(batch.magnet_poses()[0])
        drives.append(batch.drive_positions()[0])
        lefts.append(float(_left(worms)[0]))
        if ended:
            break
    time_s = np.arange(len(nodes), dtype=np.float64) * scene.control_step_s
    recording = Recording(
        time_s, np.array(nodes), np.array(poses), batch.magnets_present()[0], np.array(drives)
    )
    worms.close()
    return recording, goal_seen, np.array(lefts)


def _begun(
    scene: Scene, task: str, pilot: Pilot, goals: Floats, seeds: Sequence[int], duration_s: float
) -> tuple[MagWormVectorEnv, NDArray[np.float32]]:
    steps = max(1, round(duration_s / scene.control_step_s))
    worms = MagWormVectorEnv(len(goals), scene, max_episode_steps=steps, task=task_of(task))
    option = worms.task.goal_option
    assert option is not None, "the task has a goal"
    observations, _ = worms.reset(seed=[int(seed) for seed in seeds], options={option.name: goals})
    pilot.start(worms)
    return worms, observations


def _left(worms: MagWormVectorEnv) -> Floats:
    """Heading error [°], or distance [m] (N,)."""
    state = worms.task.state
    if isinstance(worms.task, Turn):
        return np.asarray(np.rad2deg(state["goal_rad"] - state["heading_rad"]))
    return np.array(state["distance_m"])
