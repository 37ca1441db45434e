"""The adapter for Stable-Baselines3."""

from copy import copy, deepcopy
from typing import Any

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

import torch
from gymnasium.utils.env_checker import data_equivalence
from stable_baselines3 import PPO, SAC
from stable_baselines3.common.env_checker import check_env
from stable_baselines3.common.evaluation import evaluate_policy
from stable_baselines3.common.monitor import Monitor
from stable_baselines3.common.vec_env import DummyVecEnv, SubprocVecEnv, VecNormalize
from worms import out_of_band

import magworm_gym.sb3
from magworm_gym import MagWormEnv
from magworm_gym.sb3 import MagWormSB3VecEnv

torch.set_num_threads(1)


def crawl(num_envs: int = 3, **kwargs: Any) -> MagWormSB3VecEnv:
    return MagWormSB3VecEnv(num_envs, **{"max_episode_steps": 5, "threads": 1, **kwargs})


def monitored(num_envs: int = 3) -> list[Any]:
    return [lambda: Monitor(MagWormEnv(max_episode_steps=5))] * num_envs


def random_actions(steps: int, num_envs: int = 3) -> np.ndarray:
    return np.random.default_rng(0).uniform(-1, 1, (steps, num_envs, 3)).astype(np.float32)


def untimed(info: dict[str, Any]) -> dict[str, Any]:
    """An info without the wall clock."""
    return {**info, "episode": {key: info["episode"][key] for key in ("r", "l")}}


def test_the_single_environment_passes_the_checker() -> None:
    check_env(MagWormEnv())


def test_equals_dummy_vec_env_of_single_ones() -> None:
    native, dummy = crawl(), DummyVecEnv(monitored())
    for each in (native, dummy):
        each.seed(3)
    np.testing.assert_array_equal(native.reset(), dummy.reset())
    assert native.reset_infos == dummy.reset_infos
    for actions in random_actions(12):
        one, other = native.step(actions), dummy.step(actions)
        for part in range(3):
            np.testing.assert_array_equal(one[part], other[part])
            assert one[part].dtype == other[part].dtype
        for done, info, expected in zip(one[2], one[3], other[3], strict=True):
            assert data_equivalence(untimed(info), untimed(expected)) if done else info == {}
        assert native.reset_infos == dummy.reset_infos


def test_infos_are_nobody_else_s() -> None:
    env = crawl()
    env.reset()
    *_, first = env.step(random_actions(1)[0])
    first[0]["mine"] = 1
    *_, second = env.step(random_actions(1)[0])
    assert second == [{}, {}, {}]
    assert len({id(info) for info in second}) == 3


def test_rewards_and_observations_are_the_caller_s() -> None:
    env, twin = crawl(), crawl()
    for each in (env, twin):
        each.seed(0)
        each.reset()
    for actions in random_actions(7):
        one, other = env.step(actions), twin.step(actions)
        for part in range(3):
            np.testing.assert_array_equal(one[part], other[part])
            one[part][...] = 1


def test_options_of_the_next_reset() -> None:
    env = crawl()
    env.set_options({"removed": [1]})
    env.reset()
    assert env.worms.batch.magnets_present().tolist() == [[True, False, True]] * 3
    env.reset()
    assert env.worms.batch.magnets_present().all()
    env.seed(5)
    env.set_options([{"removed": [0]}, {}, {"start": {"x_m": 0.01}}])
    observations = env.reset()
    assert env.worms.batch.magnets_present().tolist() == [[False, True, True], [True] * 3, [True] * 3]
    assert [info["seed"] for info in env.reset_infos] == [5, 6, 7]
    np.testing.assert_array_equal(observations, env.worms.batch.observe())


def test_attributes_and_methods() -> None:
    env = crawl()
    assert env.get_attr("max_episode_steps") == [5, 5, 5]
    assert env.get_attr("scene", indices=1)[0].magnets == 3
    assert env.has_attr("batch") and not env.has_attr("wings")
    env.set_attr("note", "mine")
    assert env.get_attr("note", indices=[0, 2]) == ["mine", "mine"]
    with pytest.raises(ValueError, match="whole batch"):
        env.set_attr("note", "yours", indices=[0])
    assert env.env_method("get_state", indices=[0]) == [env.worms.get_state()]
    assert env.env_is_wrapped(Monitor) == [True] * 3
    assert env.env_is_wrapped(VecNormalize, indices=0) == [False]  # type: ignore[arg-type]


def test_env_method_resets_the_environments_that_it_names() -> None:
    native, dummy = crawl(), DummyVecEnv(monitored())
    actions = random_actions(9)
    for each in (native, dummy):
        each.seed(3)
        each.reset()
        for rows in actions[:3]:
            each.step(rows)
    for arguments in ({"seed": 8}, {"options": {"removed": [1]}}, {}):
        one, other = (each.env_method("reset", indices=[2, 0], **arguments) for each in (native, dummy))
        assert data_equivalence(one, other, exact=True)
    for rows in actions[3:]:
        one, other = native.step(rows), dummy.step(rows)
        for part in range(3):
            np.testing.assert_array_equal(one[part], other[part])
        for done, info, expected in zip(one[2], one[3], other[3], strict=True):
            assert not done or data_equivalence(untimed(info), untimed(expected))


@pytest.mark.parametrize("method", ["step", "set_state", "close"])
def test_methods_that_change_all_are_not_called_for_some(method: str) -> None:
    env = crawl()
    env.reset()
    before = env.get_state()
    with pytest.raises(ValueError, match=f"{method} belongs to the whole batch"):
        env.env_method(method, np.zeros((3, 3)), indices=[1])
    assert env.get_state() == before


@pytest.mark.parametrize(
    "options",
    [
        {"removed": [7]},
        [{"removed": [0]}, {}, {"removed": [7]}],
        [{"removed": [0]}, {}, {"parameters": {"mass": -1.0}}],
        [{"removed": [0]}, {"reset_mask": np.ones(1, np.bool_)}, {}],
    ],
)
def test_a_refused_option_changes_nothing(options: Any) -> None:
    env = crawl()
    env.seed(4)
    env.reset()
    env.step(random_actions(1)[0])
    before, told = env.get_state(), deepcopy(env.reset_infos)
    env.set_options(options)
    env.seed(9)
    with pytest.raises(ValueError, match="allowed"):
        env.reset()
    assert env.get_state() == before and env.reset_infos == told
    env.set_options()
    env.reset()
    assert [info["seed"] for info in env.reset_infos] == [9, 10, 11], "seeds wait for a reset that is done"


def test_a_mask_resets_some_and_their_statistics() -> None:
    env = crawl()
    env.reset()
    env.step(random_actions(1)[0])
    env.set_options({"reset_mask": np.array([True, False, False])})
    env.reset()
    for rows in random_actions(4):
        *_, infos = env.step(rows)
    assert [info.get("episode", {}).get("l") for info in infos] == [None, 5, 5]


@pytest.mark.parametrize("copied", [copy, deepcopy, out_of_band])
def test_copies_go_on_bit_for_bit(copied: Any) -> None:
    env = crawl(randomise={"parameters": 0.1})
    env.reset()
    for rows in random_actions(3):
        env.step(rows)
    other = copied(env)
    for rows in random_actions(9):
        for one, again in zip(env.step(rows)[:3], other.step(rows)[:3], strict=True):
            np.testing.assert_array_equal(one, again)


def test_the_name_that_it_had_before_warns() -> None:
    with pytest.warns(DeprecationWarning, match="MagWormSB3VecEnv"):
        assert magworm_gym.sb3.MagWormVecEnv is MagWormSB3VecEnv


def test_a_state_goes_on_bit_for_bit() -> None:
    env, other = crawl(), crawl()
    env.reset()
    actions = random_actions(9)
    for rows in actions[:3]:
        env.step(rows)
    other.set_state(env.get_state())
    for rows in actions[3:]:
        one, two = env.step(rows), other.step(rows)
        for part in range(3):
            np.testing.assert_array_equal(one[part], two[part])
        for done, info, again in zip(one[2], one[3], two[3], strict=True):
            assert not done or data_equivalence(untimed(info), untimed(again), exact=True)
    with pytest.raises(ValueError, match="state"):
        other.set_state(b"noise")


def test_frames() -> None:
    pytest.importorskip("PIL")
    env = crawl(render_mode="rgb_array", render_envs=(0, 2))
    env.reset()
    assert [bool(image.any()) for image in env.get_images()] == [True, False, True]
    tiled = env.render()
    assert tiled is not None and tiled.shape == (720, 1280, 3)
    assert crawl().get_images() == [None] * 3


def test_close_twice() -> None:
    env = crawl()
    env.close()
    env.close()


def test_ppo_learns_on_it() -> None:
    env = crawl(8)
    model = PPO("MlpPolicy", env, n_steps=8, batch_size=64, n_epochs=2, seed=0, device="cpu")
    model.learn(128)
    assert model.num_timesteps == 128
    assert len(model.ep_info_buffer) > 0
    assert {episode["l"] for episode in model.ep_info_buffer} == {5}


def test_sac_learns_on_it() -> None:
    env = crawl(4)
    model = SAC("MlpPolicy", env, learning_starts=40, batch_size=32, buffer_size=500, seed=0, device="cpu")
    model.learn(120)
    assert model.replay_buffer.timeouts.any()


def test_normalised_and_evaluated() -> None:
    env = VecNormalize(crawl(4))
    model = PPO("MlpPolicy", env, n_steps=8, batch_size=32, n_epochs=1, seed=0, device="cpu")
    model.learn(32)
    returns, lengths = evaluate_policy(model, crawl(2), n_eval_episodes=4, return_episode_rewards=True)
    assert lengths == [5] * 4 and len(returns) == 4


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_of_single_environments(method: str) -> None:
    processes, native = SubprocVecEnv(monitored(2), start_method=method), crawl(2)
    try:
        for each in (native, processes):
            each.seed(3)
        np.testing.assert_array_equal(native.reset(), processes.reset())
        for actions in random_actions(6, num_envs=2):
            for one, other in zip(native.step(actions)[:3], processes.step(actions)[:3], strict=True):
                np.testing.assert_array_equal(one, np.asarray(other, one.dtype))
    finally:
        processes.close()
