"""Whole trajectories from the present states of environments: for planning and searches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from numpy.typing import ArrayLike, NDArray

from magworm_gym._magworm import Batch, Trajectories
from magworm_gym.arguments import numbers, shown
from magworm_gym.outcome import outcome_of
from magworm_gym.worlds import Worlds

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Rollout:
    """What came of K plans of T control steps; row t is what a step with action t gives.

    Nothing is reset. After the end of its episode (task over, time limit, broken, or ended before) a plan
    gets no more rewards, and both flags are False; a worm that broke stands still, others are simulated on.

    Attributes:
        rewards: (T, K).
        terminated: (T, K).
        truncated: (T, K).
        progress_m: Progress towards the head in the control step (T, K) [m].
        status: (T, K): 0 running, others see :meth:`Batch.status_text`.
        robot_poses: (T, K, 3): x, z of the robot's centre [m] and its heading [rad].
        observations: (T, K, O) float32; None where they were not asked for.
        batch: The K environments at the end, to read poses from or to go on with.
    """

    rewards: Floats
    terminated: Flags
    truncated: Flags
    progress_m: Floats
    status: NDArray[np.uint8]
    robot_poses: Floats
    observations: NDArray[np.float32] | None
    batch: Batch

    @property
    def returns(self) -> Floats:
        """Sum of the rewards of each plan (K,)."""
        return np.asarray(self.rewards.sum(axis=0))


@dataclass(frozen=True)
class Instant:
    """What a task sees after one control step of a rollout."""

    robots: Floats
    magnets: Floats | None
    present: Flags

    @property
    def num_envs(self) -> int:
        """Number of plans K."""
        return len(self.robots)

    def robot_poses(self) -> Floats:
        """As :meth:`Batch.robot_poses`."""
        return self.robots

    def magnet_poses(self) -> Floats:
        """As :meth:`Batch.magnet_poses`."""
        assert self.magnets is not None, "a task that looks at single magnets says so: uses_magnet_poses"
        return self.magnets

    def magnets_present(self) -> Flags:
        """As :meth:`Batch.magnets_present`."""
        return self.present


def roll_out(
    worlds: Worlds,
    actions: ArrayLike,
    start: int | Sequence[int] | NDArray[Any] | None,
    observations: bool,
) -> Rollout:
    """What :meth:`magworm_gym.MagWormVectorEnv.rollout` gives, of these environments."""
    values = numbers(actions)
    size = sum(part.size for part in worlds.batch.action_specification)
    if values is None:
        raise ValueError(f"actions are {shown(actions)}; they must be numbers of shape (T, K, {size})")
    shape = values.shape
    if len(shape) != 3 or 0 in shape[:2] or shape[2] != size:
        raise ValueError(f"actions have shape {shape}; expected (T, K, {size}), T and K 1 or more")
    environments = _begun(worlds, start, shape[1])
    batch = worlds.batch.copies(environments.tolist())
    task = worlds.task.copies(environments)
    seen = batch.rollout(values, observations=observations, magnet_poses=task.uses_magnet_poses)
    going = ~worlds.episodes.ended[environments]
    left = worlds.max_episode_steps - worlds.episodes.elapsed_steps[environments]
    rewards = np.zeros(shape[:2])
    terminated, truncated = np.zeros((2, *shape[:2]), np.bool_)
    appended = []
    for t, instant in enumerate(_instants(seen, batch.magnets_present())):
        result = task.evaluate(instant, seen.progress_m[t], going)
        outcome = outcome_of(result, seen.status[t], going, t + 1 >= left)
        rewards[t], terminated[t], truncated[t] = outcome.rewards, outcome.terminated, outcome.truncated
        if observations and task.parts:
            appended.append(task.observe(instant).astype(np.float32))
        going = going & ~outcome.ended
    observed = seen.observations
    if observed is not None and appended:
        observed = np.concatenate([observed, np.stack(appended)], axis=2)
    return Rollout(
        rewards, terminated, truncated, seen.progress_m, seen.status, seen.robot_poses, observed, batch
    )


def _begun(worlds: Worlds, start: int | Sequence[int] | NDArray[Any] | None, plans: int) -> NDArray[np.int64]:
    """The environment that each plan starts from (K,).

    Raises:
        ValueError: `start` does not fit.
        ResetNeeded: One of them was never reset.
    """
    count = worlds.batch.num_envs
    if start is None:
        if plans != count:
            raise ValueError(
                f"actions have {plans} plans for {count} environments; start must name where they begin"
            )
        start = range(count)
    try:
        chosen = np.asarray(start)
    except (ValueError, RecursionError):  # ragged, or a list that holds itself
        chosen = np.empty(())
    if chosen.dtype.kind not in "iu" or chosen.shape not in ((), (plans,)):
        raise ValueError(f"start is {shown(start)}; it must be one index, or one for each plan ({plans})")
    if ((chosen < 0) | (chosen >= count)).any():
        raise ValueError(f"start is {shown(start)}; allowed: indices from 0 to {count - 1}")
    if (worlds.episodes.numbers[chosen] < 0).any():
        raise ResetNeeded("an environment to start from was never reset: call reset() before rollout()")
    return np.broadcast_to(chosen, plans).astype(np.int64)


def _instants(seen: Trajectories, present: Flags) -> list[Instant]:
    magnets = seen.magnet_poses
    poses = [None] * len(seen.status) if magnets is None else list(magnets)
    return [Instant(robots, of, present) for robots, of in zip(seen.robot_poses, poses, strict=True)]
