"""The bench on which environments are checked: it makes them, plays them, and turns errors into findings."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from copy import deepcopy
from dataclasses import dataclass, field
from functools import wraps
from itertools import count, islice
from typing import Any

import numpy as np
from gymnasium.utils.env_checker import data_equivalence
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import concatenate, create_empty_array, iterate
from numpy.typing import NDArray

from magworm_gym.testing.report import Finding, Noted, Skipped

AnyVectorEnv = VectorEnv[Any, Any, Any]
Flags = NDArray[np.bool_]
Change = Callable[[int, Any], Any]
Examination = Callable[["Bench", AnyVectorEnv], None]

RETURNED = ("observations", "rewards", "terminated", "truncated")
"""What `step` returns, but for infos."""

FEW_STEPS = 20
NUM_ENVS = 3


@dataclass
class Transition:
    """A call of `step`: its actions, what it returned, and the observations before it."""

    before: Any
    actions: Any
    observations: Any
    rewards: Any
    terminated: Any
    truncated: Any
    infos: Any

    @property
    def done(self) -> Flags:
        """Environments whose episode ended (N,)."""
        ended: Flags = np.logical_or(self.terminated, self.truncated)
        return ended

    def outcome(self, env: AnyVectorEnv, i: int) -> tuple[Any, ...]:
        """What environment i returned, without its info."""
        row = rows(env.observation_space, self.observations)[i]
        return (row, self.rewards[i], self.terminated[i], self.truncated[i])


@dataclass
class Bench:
    """Makes environments and plays them with random actions.

    Attributes:
        given: An environment, or a callable that makes one.
        seed: Of resets and actions.
        max_steps: Steps after which waiting for the end of an episode is given up.
        reset_options: Options of each reset.
        name: Of the environment made last.

    Raises:
        TypeError: `given` is neither.
    """

    given: Any
    seed: int
    max_steps: int
    reset_options: dict[str, Any] | None
    name: str = field(init=False)

    def __post_init__(self) -> None:
        if not isinstance(self.given, VectorEnv) and not callable(self.given):
            raise TypeError(f"expected a VectorEnv or a callable that makes one, got {self.given!r}")
        self.name = repr(self.given)

    @property
    def is_factory(self) -> bool:
        """Whether a new environment can be made."""
        return not isinstance(self.given, VectorEnv)

    @property
    def takes_num_envs(self) -> bool:
        """Whether the number of environments can be chosen."""
        try:
            return self.is_factory and "num_envs" in inspect.signature(self.given).parameters
        except (TypeError, ValueError):
            return False

    def make(self, num_envs: int = NUM_ENVS) -> AnyVectorEnv:
        """A new environment where possible."""
        if not self.is_factory:
            return self.given  # type: ignore[no-any-return]
        env: AnyVectorEnv = self.given(num_envs=num_envs) if self.takes_num_envs else self.given()
        self.name = repr(env)
        return env

    def reset(self, env: AnyVectorEnv, seed: Any = None, **more: Any) -> Any:
        """What a reset with the options, and more of them, returns; None as seed gives none."""
        return env.reset(seed=seed, options=self.options(**more))

    def assert_refused(self, env: AnyVectorEnv, what: str, **reset: Any) -> None:
        """A reset with these arguments has to raise something."""
        try:
            self.reset(env, **reset)
        except Exception:
            return
        raise AssertionError(f"{what} accepted for {env.num_envs} environments")

    def options(self, **more: Any) -> dict[str, Any] | None:
        """A fresh copy of the options: an environment may keep or change what it is given."""
        return deepcopy({**(self.reset_options or {}), **more}) or None

    def play(
        self, env: AnyVectorEnv, seed: Any = None, *, change: Change | None = None
    ) -> Iterator[Transition]:
        """Resets, then steps for ever; an environment that waits for a reset gets one.

        Args:
            env: The environment.
            seed: Of the reset; None for the seed of the bench.
            change: Returns other actions, from the number of the step and the actions drawn.
        """
        env.action_space.seed(self.seed)
        after, _ = self.reset(env, self.seed if seed is None else seed)
        for step in count():
            actions = env.action_space.sample()
            actions = actions if change is None else change(step, actions)
            before = deepcopy(after)
            transition = Transition(before, deepcopy(actions), *env.step(actions))
            # Whoever gets the transition may write into it.
            after, done = deepcopy(transition.observations), transition.done.copy()
            yield transition
            if declared_mode(env) is AutoresetMode.DISABLED and done.any():
                after, _ = self.reset(env, reset_mask=done)

    def record(
        self, env: AnyVectorEnv, seed: Any = None, *, change: Change | None = None
    ) -> list[Transition]:
        """Copies of a few transitions."""
        return [deepcopy(t) for t in islice(self.play(env, seed, change=change), FEW_STEPS)]

    def play_to_end(self, env: AnyVectorEnv) -> tuple[list[Transition], Iterator[Transition]]:
        """Copies of the transitions up to the first end of an episode, and the play that goes on.

        Raises:
            Noted: No episode ended.
        """
        past, play = [], self.play(env)
        for transition in islice(play, self.max_steps):
            past.append(deepcopy(transition))
            if transition.done.any():
                return past, play
        raise Noted(
            f"no episode ended within {self.max_steps} steps, so what happens then was not checked: "
            "pass an environment with shorter episodes"
        )


def finding(title: str) -> Callable[[Examination], Callable[[Bench], Finding]]:
    """Turns a function that raises into a check that reports, on an environment of its own."""

    def decorate(examine: Examination) -> Callable[[Bench], Finding]:
        @wraps(examine)
        def check(bench: Bench) -> Finding:
            env = None
            try:
                env = bench.make()
                examine(bench, env)
            except (Noted, Skipped) as reason:
                return Finding(title, reason.outcome, str(reason))
            except AssertionError as failure:
                return Finding(title, "failed", str(failure) or "an assertion within the environment failed")
            except Exception as error:
                return Finding(title, "failed", f"raised {type(error).__name__}: {error}")
            finally:
                if env is not None and bench.is_factory:
                    # Closing has a check of its own.
                    with suppress(Exception):
                        env.close()
            return Finding(title, "passed")

        return check

    return decorate


def declared_mode(env: AnyVectorEnv) -> AutoresetMode:
    """The autoreset mode that an environment declares. Raises AssertionError if it declares none."""
    mode = env.metadata.get("autoreset_mode")
    assert isinstance(mode, AutoresetMode), (
        f'metadata["autoreset_mode"] is {mode!r}; it must be a member of the enum AutoresetMode'
    )
    return mode


def rows(space: Any, batched: Any) -> list[Any]:
    """Actions or observations of a batched space, one by one."""
    return list(iterate(space, batched))


def mixed(env: AnyVectorEnv, actions: Any, others: Any, mask: Sequence[bool] | Flags) -> Any:
    """Actions, with those of `others` where mask is set."""
    pairs = zip(rows(env.action_space, actions), rows(env.action_space, others), mask, strict=True)
    return batched(env, [other if chosen else own for own, other, chosen in pairs])


def batched(env: AnyVectorEnv, actions: Sequence[Any]) -> Any:
    """Actions of single environments as one action of a vector environment."""
    space = env.single_action_space
    out: Any = create_empty_array(space, n=len(actions))
    return concatenate(space, actions, out)


def equal(one: Any, other: Any) -> bool:
    """Whether two pieces of data are equal in structure, type and bits of value."""
    return data_equivalence(one, other, exact=True)


def share_memory(one: Any, other: Any) -> bool:
    """Whether two pieces of data share a dictionary or memory of an array."""
    if isinstance(one, dict) and isinstance(other, dict):
        common = one.keys() & other.keys()
        return one is other or any(share_memory(one[key], other[key]) for key in common)
    if isinstance(one, tuple) and isinstance(other, tuple):
        return any(share_memory(*pair) for pair in zip(one, other, strict=False))
    if not (isinstance(one, np.ndarray) and isinstance(other, np.ndarray)):
        return False
    if one.dtype == np.object_:
        return one is other or any(share_memory(*pair) for pair in zip(one.flat, other.flat, strict=False))
    return bool(np.shares_memory(one, other))
