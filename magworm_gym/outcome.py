"""What a control step came to: rewards, ends and infos, of a step as of a rollout."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym.infos import Flags, Infos, add, reasons
from magworm_gym.tasks import TaskResult

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Outcome:
    """Of one control step of N environments.

    Attributes:
        rewards: (N,); 0 where a worm broke or did not step.
        terminated: Whether the task is over (N,).
        timed_out: Whether the episode ended by the time limit (N,).
        broken: Whether the simulation broke in an episode that was going on (N,).
        status: Codes of the simulator (N,).
        result: What the task made of it.
    """

    rewards: Floats
    terminated: Flags
    timed_out: Flags
    broken: Flags
    status: NDArray[np.uint8]
    result: TaskResult

    @property
    def truncated(self) -> Flags:
        """By the time limit, or since the simulation broke (N,)."""
        return self.broken | self.timed_out

    @property
    def ended(self) -> Flags:
        """Whether the episode ended (N,)."""
        return self.terminated | self.truncated


def outcome_of(result: TaskResult, status: NDArray[np.uint8], stepping: Flags, at_limit: Flags) -> Outcome:
    """Brings the task's result together with what the simulator and the clock say.

    Args:
        result: The task's.
        status: Codes of the simulator (N,).
        stepping: Environments in whose episode the step was (N,).
        at_limit: Episodes as long as they may be (N,).

    Raises:
        ValueError: An array of the task's has another shape.
    """
    result.check(len(stepping))
    broken = stepping & (status != 0)
    sound = stepping & ~broken
    terminated = sound & result.terminated
    timed_out = sound & ~terminated & at_limit
    rewards = np.where(sound, result.rewards, 0.0)
    return Outcome(rewards, terminated, timed_out, broken, status, result)


def step_infos(outcome: Outcome, seen: Mapping[str, Floats], mask: Flags) -> Infos:
    """Infos of the environments of mask (N,): what was seen, what the task adds, how episodes ended.

    The keys are the same in every step; where a key holds for no environment its mask says so.
    """
    infos: Infos = {}
    for key, values in (*seen.items(), *outcome.result.infos.items()):
        add(infos, key, values, mask)
    ended = mask & outcome.ended
    add(infos, "time_limit", outcome.timed_out, ended)
    if outcome.result.success is not None:
        add(infos, "is_success", outcome.result.success & ~outcome.broken, ended)
    add(infos, "broken", reasons(outcome.status), mask & outcome.broken)
    return infos
