"""Checks of seeds."""

from __future__ import annotations

from itertools import islice
from typing import Any

from magworm_gym.testing.bench import FEW_STEPS, RETURNED, AnyVectorEnv, Bench, equal, finding, rows
from magworm_gym.testing.report import Noted


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
        bench.reset(env, bench.seed)
        return bench.reset(env)[0]

    first = second_episode()
    assert equal(first, second_episode()), (
        "reset(seed=s) and then reset() gave different observations when done again"
    )


@finding("a seed of its own for each environment")
def own_seeds(bench: Bench, env: AnyVectorEnv) -> None:
    """A number s seeds environment i with s + i; a list gives each its own."""
    listed = [bench.seed + i for i in range(env.num_envs)]
    from_number = [*rows(env.observation_space, bench.reset(env, bench.seed)[0])]
    try:
        observations, _ = bench.reset(env, listed)
    except Exception as error:
        raise Noted(f"a list of seeds is not accepted, which SyncVectorEnv does: {error}") from error
    from_list = rows(env.observation_space, observations)
    assert equal(from_number, from_list), f"seed={bench.seed} and seed={listed} gave different observations"

    shifted = [listed[0], *(seed + 1000 for seed in listed[1:])]
    observations, _ = bench.reset(env, shifted)
    assert equal(from_list[0], rows(env.observation_space, observations)[0]), (
        "the observation of environment 0 depends on the seeds of the others"
    )
    bench.assert_refused(env, f"{len(listed) - 1} seeds were", seed=listed[:-1])


CHECKS = (trajectory, continuation, own_seeds)
