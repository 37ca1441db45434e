"""A checker for vector environments of Gymnasium, of any make.

Gymnasium checks single environments (``gymnasium.utils.env_checker.check_env``); nothing checks a
``gymnasium.vector.VectorEnv``. :func:`check_vector_env` does: it plays short episodes and compares
what comes back with the interface of Gymnasium 1.2 and later, autoreset mode by autoreset mode.

>>> import gymnasium
>>> print(check_vector_env(lambda: gymnasium.make_vec("CartPole-v1", num_envs=3)))
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass
from functools import wraps
from typing import Any, Literal

import gymnasium
import numpy as np
from gymnasium.spaces import Space
from gymnasium.utils.env_checker import data_equivalence
from gymnasium.utils.passive_env_checker import data_shares_objects
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space, iterate

AnyVectorEnv = VectorEnv[Any, Any, Any]
Flags = np.typing.NDArray[np.bool_]


@dataclass(frozen=True)
class Finding:
    """The outcome of one check.

    Attributes:
        check: What was checked.
        outcome: "passed"; "failed"; "noted", where the interface permits what users may trip over;
            "skipped", where the environment gave no occasion.
        sentence: What was found; empty if it passed.
    """

    check: str
    outcome: Literal["passed", "failed", "noted", "skipped"]
    sentence: str = ""


@dataclass(frozen=True)
class Report:
    """The outcomes of all checks. Printed, it is one line per check."""

    environment: str
    findings: tuple[Finding, ...]

    def with_outcome(self, outcome: str) -> tuple[Finding, ...]:
        """The findings with this outcome."""
        return tuple(finding for finding in self.findings if finding.outcome == outcome)

    @property
    def passed(self) -> bool:
        """Whether no check failed."""
        return not self.with_outcome("failed")

    def __str__(self) -> str:
        """One line per check."""
        lines = [f"{f.outcome:8}{f.check}" + (f": {f.sentence}" if f.sentence else "") for f in self.findings]
        return "\n".join([self.environment, *lines])


def check_vector_env(
    env_or_factory: AnyVectorEnv | Callable[..., AnyVectorEnv],
    *,
    seed: int = 0,
    max_steps: int = 300,
    options: dict[str, Any] | None = None,
    strict: bool = False,
    raise_on_failure: bool = True,
) -> Report:
    """Checks that a vector environment keeps to Gymnasium's interface.

    Checked are: attributes and spaces; signature of ``reset``, same trajectories from same seeds,
    a seed of its own for each environment; shapes, dtypes and bounds of what ``reset`` and ``step``
    return, and that no later call changes it; the form of infos; the declared autoreset mode,
    with what ends and starts in which step; options left unchanged; independence of each
    environment from the others and, where the factory takes ``num_envs``, from their number;
    shape of rendered frames; closing twice.

    Args:
        env_or_factory: An environment, or better a callable that makes a new one on each call; if
            it takes an argument ``num_envs`` it is called with several. An environment given itself
            is reset and stepped, and not closed: checks that need a second one are skipped.
        seed: Of resets and of the random actions.
        max_steps: Steps after which waiting for the end of an episode is given up. Autoreset can
            only be checked on episodes that end: pass environments with short ones.
        options: Passed to the resets; None for none.
        strict: Counts what is noted or skipped as failed.
        raise_on_failure: False returns the report whatever was found.

    Returns:
        The report of all checks.

    Raises:
        AssertionError: Checks failed; one sentence for each.
        TypeError: `env_or_factory` is neither an environment nor a callable.
    """
    bench = _Bench(env_or_factory, seed, max_steps, options)
    findings = tuple(check(bench) for check in _CHECKS)
    report = Report(bench.name, findings)
    bad = [f for f in findings if f.outcome == "failed" or (strict and f.outcome != "passed")]
    if bad and raise_on_failure:
        raise AssertionError("\n".join([f"{bench.name}:", *(f"- {f.check}: {f.sentence}" for f in bad)]))
    return report


@dataclass
class _Transition:
    """What a call of step returned, with the observations before and the actions."""

    before: Any
    actions: Any
    observations: Any
    rewards: Any
    terminated: Any
    truncated: Any
    infos: Any

    @property
    def done(self) -> Flags:
        return np.logical_or(self.terminated, self.truncated)


class _Noted(Exception):
    """The interface permits it, users may trip over it."""


class _Skipped(Exception):
    """No occasion to check."""


class _Bench:
    """Makes environments and plays them."""

    def __init__(self, given: Any, seed: int, max_steps: int, options: dict[str, Any] | None) -> None:
        if not isinstance(given, VectorEnv) and not callable(given):
            raise TypeError(f"expected a VectorEnv or a callable that makes one, got {given!r}")
        self.given = given
        self.seed = seed
        self.max_steps = max_steps
        self._options = options
        self.name = repr(given)

    @property
    def is_factory(self) -> bool:
        return not isinstance(self.given, VectorEnv)

    @property
    def takes_num_envs(self) -> bool:
        if not self.is_factory:
            return False
        try:
            return "num_envs" in inspect.signature(self.given).parameters
        except ValueError:
            return False

    def make(self, num_envs: int | None = None) -> AnyVectorEnv:
        if not self.is_factory:
            return self.given  # type: ignore[no-any-return]
        env = self.given() if num_envs is None else self.given(num_envs=num_envs)
        self.name = repr(env)
        return env  # type: ignore[no-any-return]

    def options(self, **more: Any) -> dict[str, Any] | None:
        """A fresh copy of the options, since an environment may keep or change it."""
        return deepcopy({**self._options, **more}) if self._options is not None else (more or None)

    def reset(self, env: AnyVectorEnv, seed: Any = None, **more: Any) -> tuple[Any, dict[str, Any]]:
        return env.reset(seed=seed, options=self.options(**more))

    def play(
        self, env: AnyVectorEnv, seed: Any, action_seed: int, change: Callable[[int, Any], Any] | None = None
    ) -> Iterator[_Transition]:
        """Resets and steps with random actions, for ever; environments that wait for a reset get one."""
        env.action_space.seed(action_seed)
        observations, _ = self.reset(env, seed)
        step = 0
        while True:
            actions = env.action_space.sample()
            actions = actions if change is None else change(step, actions)
            before = deepcopy(observations)
            transition = _Transition(before, deepcopy(actions), *env.step(actions))
            yield transition
            observations, step = transition.observations, step + 1
            if mode_of(env) is AutoresetMode.DISABLED and transition.done.any():
                observations, _ = self.reset(env, reset_mask=transition.done.copy())

    def play_until_done(self, env: AnyVectorEnv, seed: Any = None) -> tuple[list[_Transition], Iterator[_Transition]]:
        """The transitions until the first episode ends, and those to come."""
        play = self.play(env, self.seed if seed is None else seed, self.seed)
        past = []
        for transition in play:
            past.append(deepcopy(transition))
            if transition.done.any():
                return past, play
            if len(past) >= self.max_steps:
                break
        raise _Skipped(f"no episode ended within {self.max_steps} steps: pass an environment with shorter episodes")


_CHECKS: list[Callable[[_Bench], Finding]] = []


def _check(title: str) -> Callable[[Callable[[_Bench, AnyVectorEnv], None]], Callable[[_Bench], Finding]]:
    """Turns a function that raises into a check that reports."""

    def decorate(examine: Callable[[_Bench, AnyVectorEnv], None]) -> Callable[[_Bench], Finding]:
        @wraps(examine)
        def check(bench: _Bench) -> Finding:
            env = None
            try:
                env = bench.make()
                examine(bench, env)
            except _Noted as note:
                return Finding(title, "noted", str(note))
            except _Skipped as reason:
                return Finding(title, "skipped", str(reason))
            except AssertionError as failure:
                return Finding(title, "failed", str(failure) or "an assertion of the environment failed")
            except Exception as error:
                return Finding(title, "failed", f"raised {type(error).__name__}: {error}")
            finally:
                if env is not None and bench.is_factory:
                    env.close()
            return Finding(title, "passed")

        _CHECKS.append(check)
        return check

    return decorate


def mode_of(env: AnyVectorEnv) -> AutoresetMode:
    """The autoreset mode that an environment declares. Raises AssertionError for none."""
    mode = env.metadata.get("autoreset_mode")
    assert isinstance(mode, AutoresetMode), (
        f'metadata["autoreset_mode"] is {mode!r}; it must be a member of the enum AutoresetMode'
    )
    return mode
