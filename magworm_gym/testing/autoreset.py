"""Checks of what happens when an episode ends, in each mode. See https://farama.org/Vector-Autoreset-Mode."""

from __future__ import annotations

from itertools import islice
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode

from magworm_gym.testing.bench import (
    AnyVectorEnv,
    Bench,
    Flags,
    Transition,
    declared_mode,
    equal,
    finding,
    mixed,
    rows,
    share_memory,
)
from magworm_gym.testing.report import Noted


@finding("episodes end and start as the autoreset mode says")
def autoreset(bench: Bench, env: AnyVectorEnv) -> None:
    """What the declared mode promises."""
    examine = {
        AutoresetMode.NEXT_STEP: _next_step,
        AutoresetMode.SAME_STEP: _same_step,
        AutoresetMode.DISABLED: _disabled,
    }
    examine[declared_mode(env)](bench, env)


def _next_step(bench: Bench, env: AnyVectorEnv) -> None:
    """The step after the end ignores the action and returns the reset's observation with reward 0."""
    past, play = bench.play_to_end(env)
    done, following = past[-1].done, next(play)
    assert (following.rewards[done] == 0.0).all(), (
        f"the step after the end of an episode has rewards {following.rewards[done]}; NEXT_STEP promises 0"
    )
    assert not following.done[done].any(), "the step after the end of an episode ended it again"
    again = _following(bench, env, len(past), done, action_seed=bench.seed + 1)
    for i in np.flatnonzero(done).tolist():
        assert equal(following.outcome(env, i), again.outcome(env, i)), (
            f"the step after the end of an episode depends on the action of environment {i}; "
            "NEXT_STEP promises to ignore it"
        )
    if "final_obs" in past[-1].infos:
        raise Noted("infos have 'final_obs' in the mode NEXT_STEP, where the observations are the final ones")


def _same_step(bench: Bench, env: AnyVectorEnv) -> None:
    """The step that ends an episode returns the next one's first observation; infos hold the last."""
    past, play = bench.play_to_end(env)
    last, done = past[-1], past[-1].done
    for key in ("final_obs", "final_info"):
        assert key in last.infos, f"an episode ended, but infos lack {key!r}, which SAME_STEP promises"
        mask = last.infos.get(f"_{key}")
        assert mask is not None and np.array_equal(mask, done), (
            f"the mask '_{key}' is {mask}; the episodes that ended are {done}"
        )
    assert isinstance(last.infos["final_info"], dict), "infos['final_info'] is no dict of arrays"
    for i in np.flatnonzero(done).tolist():
        final = last.infos["final_obs"][i]
        assert final in env.single_observation_space, (
            f"final_obs of environment {i} lies outside single_observation_space"
        )
    _assert_final_kept(bench, env)
    following = next(play)
    seeds = range(bench.seed + 1, bench.seed + 6)
    tried = [_following(bench, env, len(past), done, action_seed=seed) for seed in seeds]
    rewarded = (following.rewards[done] != 0.0).any()
    if not rewarded and all(equal(following.observations, other.observations) for other in tried):
        raise Noted("the step after the end of an episode ignores actions, as if the mode were NEXT_STEP")
    _note_unreset(env, last, done)


def _assert_final_kept(bench: Bench, env: AnyVectorEnv) -> None:
    """`final_obs` must not be a view of what the environment writes into next."""
    for transition in islice(bench.play(env), bench.max_steps):
        if transition.done.any():
            for i in np.flatnonzero(transition.done).tolist():
                final = transition.infos["final_obs"][i]
                assert not share_memory(final, rows(env.observation_space, transition.observations)[i]), (
                    f"final_obs of environment {i} shares memory with the observations"
                )
            return


def _note_unreset(env: AnyVectorEnv, last: Transition, done: Flags) -> None:
    observations = rows(env.observation_space, last.observations)
    ended = np.flatnonzero(done)
    if all(equal(last.infos["final_obs"][i], observations[i]) for i in ended):
        raise Noted("final_obs equals the observation returned: one of them seems to be the wrong one")


def _disabled(bench: Bench, env: AnyVectorEnv) -> None:
    """The caller resets chosen environments; the others stay as they are."""
    past, _ = bench.play_to_end(env)
    last, done = past[-1], past[-1].done
    observations, infos = bench.reset(env, reset_mask=done.copy())
    before, after = rows(env.observation_space, last.observations), rows(env.observation_space, observations)
    for i in np.flatnonzero(~done).tolist():
        assert equal(before[i], after[i]), (
            f"the reset of environments {np.flatnonzero(done)} changed the observation of environment {i}"
        )
    for key, mask in infos.items():
        if key.startswith("_"):
            assert not mask[~done].any(), (
                f"the infos of a reset set {key!r} for environments that were not reset"
            )
    if all(equal(before[i], after[i]) for i in np.flatnonzero(done)):
        raise Noted("observations are the same before and after the reset of an episode that ended")
    env.step(env.action_space.sample())
    mask = np.ones(env.num_envs + 1, np.bool_)
    bench.assert_refused(env, f"a reset_mask of shape {mask.shape} was", reset_mask=mask)


def _following(bench: Bench, env: AnyVectorEnv, steps: int, done: Flags, *, action_seed: int) -> Transition:
    """The same play again up to the step after the end, there with other actions where done."""

    def change(step: int, actions: Any) -> Any:
        if step < steps:
            return actions
        env.action_space.seed(action_seed)
        return mixed(env, actions, env.action_space.sample(), done)

    return next(islice(bench.play(env, change=change), steps, None))


CHECKS = (autoreset,)
