"""Checks of seeds."""

from __future__ import annotations

from itertools import islice
from typing import Any

from magworm_gym.testing.bench import FEW_STEPS, AnyVectorEnv, Bench, equal, finding, rows
from magworm_gym.testing.report import Noted

RETURNED = ("observations", "rewards", "terminated", "truncated")


@finding("same seed, same trajectory")
def trajectory(bench: Bench, env: AnyVectorEnv) -> None:
    """Twice in one environment, and in a second one."""
    first = bench.record(env)
    others = [("the same environment", env)]
    if bench.is_factory:
        others.append(("a second environment", bench.make()))
    for name, other in others:
        for number, (one, again) in enumerate(zip(first, islice(bench.play(other), FEW_STEPS), strict=True)):
            for part in RETURNED:
                assert equal(getattr(one, part), getattr(again, part)), (
                    f"with the same seed and actions, {part} of step {number} differ in {name}"
                )
        if other is not env:
            other.close()


@finding("a reset without seed goes on from the seed before")
def continuation(bench: Bench, env: AnyVectorEnv) -> None:
    """Seeding once makes all later episodes reproducible."""

    def second_episode() -> Any:
        env.reset(seed=bench.seed, options=bench.options())
        return env.reset(options=bench.options())[0]

    first = second_episode()
    assert equal(first, second_episode()), (
        "reset(seed=s) and then reset() gave different observations when done again"
    )


@finding("a seed of its own for each environment")
def own_seeds(bench: Bench, env: AnyVectorEnv) -> None:
    """A number s seeds environment i with s + i; a list gives each its own."""
    listed = [bench.seed + i for i in range(env.num_envs)]
    from_number, _ = env.reset(seed=bench.seed, options=bench.options())
    from_number = [*rows(env.observation_space, from_number)]
    try:
        observations, _ = env.reset(seed=listed, options=bench.options())  # type: ignore[arg-type]
    except Exception as error:
        raise Noted(f"a list of seeds is not accepted, which SyncVectorEnv does: {error}") from error
    from_list = rows(env.observation_space, observations)
    assert equal(from_number, from_list), f"seed={bench.seed} and seed={listed} gave different observations"

    shifted = [listed[0], *(seed + 1000 for seed in listed[1:])]
    observations, _ = env.reset(seed=shifted, options=bench.options())  # type: ignore[arg-type]
    assert equal(from_list[0], rows(env.observation_space, observations)[0]), (
        "the observation of environment 0 depends on the seeds of the others"
    )
    _assert_refused(env, listed[:-1], bench)


def _assert_refused(env: AnyVectorEnv, seeds: list[int], bench: Bench) -> None:
    try:
        env.reset(seed=seeds, options=bench.options())  # type: ignore[arg-type]
    except Exception:
        return
    raise AssertionError(f"{len(seeds)} seeds were accepted for {env.num_envs} environments")


CHECKS = (trajectory, continuation, own_seeds)
