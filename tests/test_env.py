"""The single environment and the registry."""

import json
import subprocess
import sys
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env

import magworm_gym
from magworm_gym import CRAWL_ID, MagWormEnv, MagWormVectorEnv

# The checker warns of every component without bounds, as it does for CartPole-v1.
UNBOUNDED = pytest.mark.filterwarnings("ignore:.*infinity:UserWarning")


@UNBOUNDED
def test_gymnasium_s_checker_passes() -> None:
    check_env(gymnasium.make(CRAWL_ID).unwrapped, skip_render_check=True)


@UNBOUNDED
@pytest.mark.usefixtures("windowless")
@pytest.mark.parametrize("render_mode", ["rgb_array", "human"])
def test_gymnasium_s_checker_passes_with_frames(render_mode: str) -> None:
    check_env(gymnasium.make(CRAWL_ID, render_mode=render_mode).unwrapped)


def test_frames() -> None:
    pytest.importorskip("PIL")
    env = gymnasium.make(CRAWL_ID, render_mode="rgb_array")
    env.reset(seed=0)
    frame = env.render()
    assert isinstance(frame, np.ndarray) and frame.dtype == np.uint8 and frame.shape == (360, 640, 3)


def test_an_episode() -> None:
    env = MagWormEnv(max_episode_steps=3)
    observation, info = env.reset(seed=9)
    assert observation in env.observation_space
    assert info == {"time_s": 0.0, "seed": 9, "episode_number": 0}
    for _ in range(3):
        observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
        assert type(reward) is float and type(terminated) is bool and type(truncated) is bool
        assert reward == 1000.0 * info["progress_m"]
    assert truncated and not terminated
    assert info["time_limit"] is True and "broken" not in info
    with pytest.raises(ResetNeeded):
        env.step(env.action_space.sample())
    assert env.reset()[1]["episode_number"] == 1


@pytest.mark.parametrize("action", [np.zeros(2), np.zeros((1, 3)), [0.0, np.nan, 0.0], "up"])
def test_bad_actions_leave_the_state_untouched(action: Any) -> None:
    env = MagWormEnv()
    env.reset(seed=0)
    before = env.get_state()
    with pytest.raises(ValueError):
        env.step(action)
    assert env.get_state() == before


def test_unseeded_environments_draw_from_np_random() -> None:
    first, second = MagWormEnv(), MagWormEnv()
    for env in (first, second):
        env.np_random = np.random.default_rng(3)
    assert first.reset()[1] == second.reset()[1]
    assert MagWormEnv().reset()[1]["seed"] != MagWormEnv().reset()[1]["seed"]


@pytest.mark.parametrize("name", [CRAWL_ID, f"magworm_gym:{CRAWL_ID}"])
def test_made_by_name(name: str) -> None:
    assert isinstance(gymnasium.make(name).unwrapped, MagWormEnv)
    env = gymnasium.make_vec(name, num_envs=2, max_episode_steps=7, autoreset_mode="SameStep", threads=1)
    assert isinstance(env, MagWormVectorEnv)
    assert env.max_episode_steps == 7
    assert env.metadata["autoreset_mode"] is gymnasium.vector.AutoresetMode.SAME_STEP


def test_specifications_are_json() -> None:
    assert json.loads(gymnasium.spec(CRAWL_ID).to_json())["id"] == CRAWL_ID
    single = gymnasium.make(CRAWL_ID, scene="paper-4")
    made = gymnasium.make(gymnasium.envs.registration.EnvSpec.from_json(single.spec.to_json()))
    assert made.unwrapped.scene.magnets == 4
    many = gymnasium.make_vec(CRAWL_ID, num_envs=2, autoreset_mode="Disabled")
    made_many = gymnasium.make_vec(gymnasium.envs.registration.EnvSpec.from_json(many.spec.to_json()))
    assert made_many.num_envs == 2
    assert made_many.metadata["autoreset_mode"] is gymnasium.vector.AutoresetMode.DISABLED


def test_a_scene_is_an_argument() -> None:
    scene = magworm_gym.Scene.preset("paper-5")
    assert gymnasium.make(CRAWL_ID, scene=scene).unwrapped.scene.magnets == 5
    assert gymnasium.make_vec(CRAWL_ID, num_envs=2, scene=scene).scene.magnets == 5


def test_importing_needs_numpy_and_gymnasium_only() -> None:
    code = (
        "import sys; before = set(sys.modules); import gymnasium; import magworm_gym; "
        "heavy = {'stable_baselines3', 'torch', 'PIL', 'cv2', 'pygame', 'matplotlib', 'scipy'}; "
        "print(sorted(heavy & (set(sys.modules) - before)))"
    )
    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert printed.strip() == "[]"
