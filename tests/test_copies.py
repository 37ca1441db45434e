"""States, copies, other processes."""

import multiprocessing
import pickle
from collections.abc import Callable
from copy import copy, deepcopy
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence
from worms import crawl, out_of_band, play_randomly, told

from magworm_gym import CRAWL_ID, MagWormEnv, MagWormVectorEnv

OPTIONS = {"removed": [[0], [], [1]], "parameters": {"mass": [1.0, 1.1, 1.2]}, "start": {"x_m": 0.01}}
PATIENCE_S = 60


def started(**kwargs: Any) -> MagWormVectorEnv:
    env = crawl(**kwargs)
    env.reset(seed=[5, 6, 7], options=OPTIONS)
    env.reset(options={**OPTIONS, "reset_mask": np.array([False, True, False])})
    play_randomly(env, 5, seed=0)
    return env


def by_state(env: MagWormVectorEnv) -> MagWormVectorEnv:
    other = crawl(autoreset_mode=env.metadata["autoreset_mode"])
    other.set_state(env.get_state())
    return other


def by_pickle(env: MagWormVectorEnv) -> MagWormVectorEnv:
    other: MagWormVectorEnv = pickle.loads(pickle.dumps(env))
    return other


COPIED = [by_state, by_pickle, out_of_band, deepcopy, copy]


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
@pytest.mark.parametrize("copied", COPIED)
def test_a_copy_goes_on_bit_for_bit(copied: Callable[[Any], Any], mode: str) -> None:
    env = started(autoreset_mode=mode)
    other = copied(env)
    assert data_equivalence(play_randomly(env, 12, seed=1), play_randomly(other, 12, seed=1), exact=True)
    assert data_equivalence(env.reset(), other.reset(), exact=True)


@pytest.mark.parametrize("copied", COPIED)
def test_a_copy_before_the_first_reset(copied: Callable[[Any], Any]) -> None:
    env = crawl()
    other = copied(env)
    assert data_equivalence(env.reset(), other.reset(), exact=True)


def test_going_back_to_a_state() -> None:
    env = started()
    state = env.get_state()
    first = play_randomly(env, 9, seed=2)
    env.set_state(state)
    assert env.get_state() == state
    assert data_equivalence(first, play_randomly(env, 9, seed=2), exact=True)


def test_a_copied_specification() -> None:
    env = gymnasium.make_vec(CRAWL_ID, num_envs=2)
    assert pickle.loads(pickle.dumps(env)).spec == env.spec


@pytest.mark.parametrize("seed", [None, 4])
def test_the_single_environment_is_copied(seed: int | None) -> None:
    env = MagWormEnv(max_episode_steps=4)
    fresh = pickle.loads(pickle.dumps(env))
    assert data_equivalence(env.reset(seed=seed), fresh.reset(seed=seed), exact=True)
    copies = [made(env) for made in COPIED[1:]] + [MagWormEnv(max_episode_steps=4)]
    copies[-1].set_state(env.get_state())
    action = np.array([0.3, 0.5, 1.0])
    expected = [*(env.step(action) for _ in range(4)), env.reset()]
    for other in copies:
        assert data_equivalence(
            expected, [*(other.step(action) for _ in range(4)), other.reset()], exact=True
        )


@pytest.mark.parametrize("task", ["turn", "reach"])
def test_tasks_go_on_out_of_band(task: str) -> None:
    env = MagWormVectorEnv(2, max_episode_steps=3, threads=1, task=task)
    env.reset(seed=0)
    other = out_of_band(env)
    for actions in np.random.default_rng(0).uniform(-1, 1, (6, *env.action_space.shape)):
        assert data_equivalence(env.step(actions), other.step(actions), exact=True)


def test_what_is_given_may_be_read_only() -> None:
    env, twin = crawl(), crawl()
    mask, mass, actions = np.array([True, False, True]), np.ones(3), np.full((3, 3), 0.5)
    for array in (mask, mass, actions):
        array.flags.writeable = False
    for each in (env, twin):
        each.reset(seed=0)
        each.reset(options={"reset_mask": mask, "parameters": {"mass": mass}, "start": {"x_m": mass}})
    for _ in range(7):
        assert data_equivalence(env.step(actions), twin.step(actions.copy()), exact=True)


def bad_states() -> dict[str, Any]:
    good = started().get_state()
    other_size = MagWormVectorEnv(2, max_episode_steps=5, threads=1)
    other_scene = MagWormVectorEnv(3, "paper-4", threads=1)
    for env in (other_size, other_scene):
        env.reset(seed=0)
    return {
        "empty": b"",
        "noise": b"worm" * 20,
        "short": good[: len(good) // 2],
        "text": "state",
        "size": other_size.get_state(),
        "scene": other_scene.get_state(),
        "mode": started(autoreset_mode="SameStep").get_state(),
    }


@pytest.mark.parametrize("kind", ["empty", "noise", "short", "text", "size", "scene", "mode"])
def test_bad_states_change_nothing(kind: str) -> None:
    env = started()
    before = env.get_state()
    with pytest.raises(ValueError):
        env.set_state(bad_states()[kind])
    assert env.get_state() == before


def _play_and_send(connection: Any, env: MagWormVectorEnv) -> None:
    fresh = MagWormVectorEnv(64, max_episode_steps=5, threads=2)
    fresh.reset(seed=0)
    fresh.step(np.zeros((64, 3)))
    connection.send(play_randomly(env, 4, seed=3))


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork on this platform")
def test_fork_with_a_live_thread_pool() -> None:
    warm = MagWormVectorEnv(64, max_episode_steps=5, threads=2)
    warm.reset(seed=0)
    warm.step(np.zeros((64, 3)))
    env = started(threads=2)
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    child = context.Process(target=_play_and_send, args=(sender, env))
    child.start()
    try:
        assert receiver.poll(PATIENCE_S), "the forked process hangs"
        assert data_equivalence(play_randomly(env, 4, seed=3), receiver.recv(), exact=True)
        child.join(PATIENCE_S)
        assert child.exitcode == 0
    finally:
        child.kill()


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_processes_of_single_environments(context: str) -> None:
    if context not in multiprocessing.get_all_start_methods():
        pytest.skip(f"no {context} on this platform")
    processes = gymnasium.vector.AsyncVectorEnv(
        [lambda: MagWormEnv(max_episode_steps=3)] * 2, context=context
    )
    native = MagWormVectorEnv(2, max_episode_steps=3, threads=2)
    try:
        assert data_equivalence(native.reset(seed=0), processes.reset(seed=0), exact=True)
        for actions in np.random.default_rng(0).uniform(-1, 1, (5, 2, 3)).astype(np.float32):
            *stepped, infos = native.step(actions)
            assert data_equivalence((*stepped, told(infos)), processes.step(actions), exact=True)
    finally:
        processes.close()
