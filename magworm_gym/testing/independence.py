"""Checks that environments of a batch do not know of each other."""

from __future__ import annotations

from itertools import islice
from typing import Any

from magworm_gym.testing.bench import (
    FEW_STEPS,
    AnyVectorEnv,
    Bench,
    Transition,
    batched,
    equal,
    finding,
    mixed,
    rows,
)
from magworm_gym.testing.report import Skipped


@finding("environments do not depend on their neighbours")
def neighbours(bench: Bench, env: AnyVectorEnv) -> None:
    """Environment 0 does the same whatever the others do."""
    if env.num_envs == 1:
        raise Skipped("there is one environment only")
    expected = bench.record(env)
    others = [index > 0 for index in range(env.num_envs)]

    def change(_: int, actions: Any) -> Any:
        # A second draw for the others; the first environment keeps what it drew.
        return mixed(env, actions, drawn.pop(0), others)

    env.action_space.seed(bench.seed + 1)
    drawn = [env.action_space.sample() for _ in range(FEW_STEPS + 1)]
    _assert_first_equal(
        env, expected, islice(bench.play(env, change=change), FEW_STEPS), env, "the others' actions"
    )


@finding("environments do not depend on their number")
def number(bench: Bench, env: AnyVectorEnv) -> None:
    """Environment 0 does the same alone."""
    if not bench.takes_num_envs:
        raise Skipped("the factory takes no argument num_envs")
    expected = bench.record(env)
    alone = bench.make(num_envs=1)

    def change(step: int, _: Any) -> Any:
        return batched(alone, rows(env.action_space, expected[step].actions)[:1])

    transitions = islice(bench.play(alone, change=change), FEW_STEPS)
    _assert_first_equal(env, expected, transitions, alone, "the number of environments")
    alone.close()


def _assert_first_equal(
    env: AnyVectorEnv, expected: list[Transition], found: Any, other: AnyVectorEnv, reason: str
) -> None:
    for step, (one, two) in enumerate(zip(expected, found, strict=True)):
        assert equal(one.outcome(env, 0), two.outcome(other, 0)), (
            f"what environment 0 returns in step {step} depends on {reason}"
        )


CHECKS = (neighbours, number)
