"""Rollouts: whole trajectories in one call, on copies."""

import os
import signal
import threading
from typing import Any

import numpy as np
import pytest
from gymnasium.error import ResetNeeded

from magworm_gym import Batch, MagWormEnv, MagWormVectorEnv, Scene

STEPS = 25
TASKS = ("crawl", "turn", "reach")


def made(task: str, num_envs: int = 13, **options: Any) -> MagWormVectorEnv:
    """Environments that have been stepped; one is about to break."""
    env = MagWormVectorEnv(num_envs, task=task, autoreset_mode="Disabled", **options)
    stiffness = np.ones(num_envs)
    stiffness[3 % num_envs] = 1e-3
    env.reset(seed=4, options={"parameters": {"stiffness": stiffness}})
    generator = np.random.default_rng(0)
    for _ in range(2):
        env.step(generator.uniform(-1.0, 1.0, env.action_space.shape))
    return env


def plans(env: MagWormVectorEnv, count: int, steps: int = STEPS) -> Any:
    """A little beyond the bounds, so that clipping is part of the test."""
    size = env.single_action_space.shape[0]
    return np.random.default_rng(1).uniform(-1.1, 1.1, (steps, count, size))


@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize("layout", [("wide", 1), ("wide", 2), ("scalar", 1), ("scalar", 3)])
def test_a_rollout_equals_stepping_bit_for_bit(task: str, layout: tuple[str, int]) -> None:
    lanes, threads = layout
    limit = 20
    env = made(task, max_episode_steps=limit, lanes=lanes, threads=threads)
    actions = plans(env, env.num_envs)
    rollout = env.rollout(actions, observations=True)
    over = np.zeros(env.num_envs, np.bool_)
    assert rollout.observations is not None
    for t in range(limit - 2):
        going = ~over
        observations, rewards, terminated, truncated, infos = env.step(actions[t])
        np.testing.assert_array_equal(rollout.observations[t, going], observations[going])
        np.testing.assert_array_equal(rollout.rewards[t], np.where(going, rewards, 0.0))
        np.testing.assert_array_equal(rollout.terminated[t], terminated & going)
        np.testing.assert_array_equal(rollout.truncated[t], truncated & going)
        np.testing.assert_array_equal(rollout.progress_m[t, going], infos["progress_m"][going])
        np.testing.assert_array_equal(rollout.robot_poses[t, going], env.batch.robot_poses()[going])
        over |= terminated | truncated
        env._worlds.episodes.ended[:] = (
            False  # those that are over go on beside the others, and are not looked at
        )
    assert over.all(), "the time limit ends all"
    assert rollout.status[-1].any() and not rollout.status[-1].all(), "some break, others do not"
    assert not (rollout.rewards[limit - 2 :].any() or rollout.truncated[limit - 2 :].any())
    np.testing.assert_array_equal(rollout.returns, rollout.rewards.sum(axis=0))


@pytest.mark.parametrize("task", TASKS)
def test_plans_start_from_any_environment_and_leave_all_alone(task: str) -> None:
    env = made(task)
    before = env.get_state()
    counted = env.batch.counters()
    actions = plans(env, 3)
    start = [5, 0, 5]
    some = env.rollout(actions, start=start)
    everyone = np.zeros((STEPS, env.num_envs, actions.shape[2]))
    everyone[:, [0, 5]] = actions[:, [1, 2]]
    all_of_them = env.rollout(everyone)
    np.testing.assert_array_equal(some.rewards[:, [1, 2]], all_of_them.rewards[:, [0, 5]])
    np.testing.assert_array_equal(some.batch.magnet_poses()[[1, 2]], all_of_them.batch.magnet_poses()[[0, 5]])
    one = env.rollout(actions, start=5)
    np.testing.assert_array_equal(one.rewards[:, [0, 2]], some.rewards[:, [0, 2]])
    assert (one.rewards[:, 0] != one.rewards[:, 2]).any(), "plans differ"
    assert env.get_state() == before and env.batch.counters() == counted


def test_a_plan_that_is_done_gets_no_more_rewards() -> None:
    env = MagWormVectorEnv(2, task="reach", autoreset_mode="Disabled")
    env.reset(seed=0, options={"goal_m": [[-0.05, 0.0], [-0.004, 0.0]]})
    rollout = env.rollout(plans(env, 2))
    assert rollout.terminated[0].tolist() == [False, True] and rollout.terminated.sum() == 1
    assert rollout.rewards[0].all() and rollout.rewards[1:, 0].all() and not rollout.rewards[1:, 1].any()
    assert (rollout.status == 0).all() and not rollout.truncated.any()


def test_an_episode_that_has_ended_gives_no_rewards() -> None:
    env = MagWormVectorEnv(2, max_episode_steps=1, autoreset_mode="NextStep")
    env.reset(seed=0)
    env.step(np.zeros((2, 3)))
    rollout = env.rollout(plans(env, 4), start=1)
    assert not rollout.rewards.any() and rollout.progress_m.any()


def test_a_batch_goes_on_from_the_end_of_its_rollout() -> None:
    scene = Scene.preset("paper-3")
    rolled, stepped = (Batch(scene, 11) for _ in range(2))
    everyone, numbers = np.ones(11, np.bool_), np.arange(11, dtype=np.uint64)
    for batch in (rolled, stepped):
        batch.reset(everyone, numbers, numbers)
    actions = np.random.default_rng(2).uniform(-1.0, 1.0, (9, 11, 3))
    seen = rolled.rollout(actions, observations=True, magnet_poses=True)
    steps = [stepped.step(of_step) for of_step in actions]
    assert rolled.get_state() == stepped.get_state()
    np.testing.assert_array_equal(seen.observations, [observation for observation, _, _ in steps])
    assert seen.magnet_poses is not None
    np.testing.assert_array_equal(seen.magnet_poses[-1], stepped.magnet_poses())
    bare = rolled.copies([0] * 11).rollout(actions)
    assert bare.observations is None and bare.magnet_poses is None


@pytest.mark.parametrize(
    ("shape", "start", "message"),
    [
        ((3, 4), None, r"actions have shape \(3, 4\); expected \(T, K, 3\)"),
        ((0, 4, 3), None, r"expected \(T, K, 3\), T and K 1 or more"),
        ((5, 4, 2), None, r"actions have shape \(5, 4, 2\); expected \(T, K, 3\)"),
        ((5, 3, 3), None, "actions have 3 plans for 4 environments; start must name"),
        ((5, 3, 3), 4, "start is 4; allowed: indices from 0 to 3"),
        ((5, 3, 3), [0, -1, 1], r"start is \[0, -1, 1\]; allowed: indices from 0 to 3"),
        ((5, 3, 3), [0, 1], r"start is \[0, 1\]; it must be one index, or one for each plan \(3\)"),
        ((5, 3, 3), 0.5, "start is 0.5; it must be one index"),
    ],
)
def test_what_does_not_fit_is_refused(shape: tuple[int, ...], start: Any, message: str) -> None:
    env = MagWormVectorEnv(4)
    env.reset(seed=0)
    with pytest.raises(ValueError, match=message):
        env.rollout(np.zeros(shape), start=start)


def test_numbers_that_are_not_finite_are_refused_and_change_nothing() -> None:
    batch = Batch(Scene.preset("paper-3"), 4)
    before = batch.get_state()
    actions = np.zeros((5, 4, 3))
    actions[2, 3, 1] = np.nan
    with pytest.raises(
        ValueError, match="control step 2, environment 3, component 1, is NaN; allowed: finite"
    ):
        batch.rollout(actions)
    with pytest.raises(ValueError, match=r"actions have shape \[5, 3, 3\]; expected \[T, 4, 3\]"):
        batch.rollout(np.zeros((5, 3, 3)))
    assert batch.get_state() == before


@pytest.mark.parametrize("environments", [[], [0, 4], [-1]])
def test_copies_of_environments_that_are_not_there_are_refused(environments: list[int]) -> None:
    with pytest.raises(ValueError, match="allowed: "):
        Batch(Scene.preset("paper-3"), 4).copies(environments)


def test_plans_from_a_single_environment() -> None:
    env = MagWormEnv()
    env.reset(seed=3)
    actions = np.random.default_rng(0).uniform(-1.0, 1.0, (6, 9, 3))
    rollout = env.rollout(actions)
    rewards = [env.step(action)[1] for action in actions[:, 4]]
    assert rewards == rollout.rewards[:, 4].tolist() and any(rewards)


def test_a_rollout_needs_a_reset() -> None:
    with pytest.raises(ResetNeeded, match="never reset"):
        MagWormVectorEnv(2).rollout(np.zeros((1, 2, 3)))


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_stops_a_rollout_and_leaves_the_environments_alone(threads: int) -> None:
    env = MagWormVectorEnv(2, threads=threads)
    env.reset(seed=0)
    before = env.get_state()
    actions = np.zeros((4000, 512, 3))
    interrupt = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    interrupt.start()
    with pytest.raises(KeyboardInterrupt):
        env.rollout(actions, start=0)
    interrupt.join()
    assert env.get_state() == before
