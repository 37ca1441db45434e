"""The native vector environment: interface, seeds, options, modes, broken worms."""

from types import SimpleNamespace
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import data_equivalence
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from worms import crawl, play, random_actions, told

from magworm_gym import MagWormEnv, MagWormVectorEnv, Scene, SceneError
from magworm_gym.spaces import box

MODES = list(AutoresetMode)


def assert_equal(one: Any, other: Any) -> None:
    assert data_equivalence(one, other, exact=True), f"{one}\ndiffers from\n{other}"


class Breaking:
    """A simulation in which one environment breaks in one step."""

    def __init__(self, batch: Any, environment: int, step: int) -> None:
        self._batch, self._environment, self._left = batch, environment, step

    def __getattr__(self, name: str) -> Any:
        return getattr(self._batch, name)

    def step(self, actions: np.ndarray) -> tuple[Any, Any, Any]:
        observations, progress_m, status = self._batch.step(actions)
        self._left -= 1
        if self._left == 0:
            status[self._environment] = 1
        return observations, progress_m, status


def breaking(env: MagWormVectorEnv, environment: int, step: int) -> MagWormVectorEnv:
    env._worlds.batch = Breaking(env.batch, environment, step)  # type: ignore[assignment]
    return env


def test_spaces_follow_from_the_simulator() -> None:
    env = crawl()
    size = sum(part.size for part in env.batch.observation_specification)
    assert env.single_action_space == gymnasium.spaces.Box(-1, 1, (3,), np.float32)
    assert env.single_observation_space.shape == (size,)
    parts = env.observation_layout
    assert parts["last_action"] == slice(size - 3, size)
    unbounded = np.arange(size) < size - 3
    assert (env.single_observation_space.low == np.where(unbounded, -np.inf, -1.0)).all()
    assert (env.single_observation_space.high == np.where(unbounded, np.inf, 1.0)).all()


def test_bounds_are_rounded_outwards() -> None:
    third = SimpleNamespace(name="third", size=2, low=-1.0 / 3.0, high=0.1)
    space, open_space = box([third]), box([SimpleNamespace(name="open", size=1, low=-np.inf, high=np.inf)])
    assert (space.low.astype(np.float64) <= third.low).all() and (
        space.high.astype(np.float64) >= third.high
    ).all()
    np.testing.assert_allclose(space.high, third.high, rtol=1e-6)
    assert not open_space.is_bounded("above") and not open_space.is_bounded("below")
    beyond = box([SimpleNamespace(name="beyond", size=1, low=1e39, high=2e39)])
    assert [beyond.low[0], beyond.high[0]] == [np.finfo(np.float32).max, np.inf]


def test_previous_action_is_observed() -> None:
    env = crawl()
    env.reset(seed=0)
    actions = random_actions(env, 1)[0]
    observations = env.step(actions)[0]
    np.testing.assert_array_equal(observations[:, env.observation_layout["last_action"]], actions)


def test_reward_is_progress_in_millimetres() -> None:
    env = crawl(max_episode_steps=100)
    env.reset(seed=0)
    for actions in random_actions(env, 10):
        _, rewards, _, _, infos = env.step(actions)
        np.testing.assert_array_equal(rewards, 1000.0 * infos["progress_m"])
        assert rewards.dtype == np.float64


def test_time_limit_is_the_scene_s_by_default() -> None:
    scene = Scene.preset("paper-3").with_values({"control.episode_s": 0.1})
    env = MagWormVectorEnv(2, scene, threads=1)
    env.reset(seed=0)
    ends = [env.step(rows)[3] for rows in random_actions(env, 5)]
    assert env.max_episode_steps == 5
    assert [end.all() for end in ends] == [False] * 4 + [True]


def test_time_limit_is_told_from_breaking() -> None:
    env = breaking(crawl(max_episode_steps=4), environment=1, step=2)
    env.reset(seed=0)
    actions = random_actions(env, 4)
    env.step(actions[0])
    _, rewards, terminated, truncated, infos = env.step(actions[1])
    assert truncated.tolist() == [False, True, False]
    assert not terminated.any()
    assert rewards[1] == 0.0
    assert infos["_broken"].tolist() == infos["_time_limit"].tolist() == [False, True, False]
    assert isinstance(infos["broken"][1], str) and infos["broken"][0] is None
    assert not infos["time_limit"].any()
    assert not env.step(actions[2])[4]["_broken"].any()
    _, _, _, truncated, infos = env.step(actions[3])
    assert (
        truncated.tolist()
        == infos["time_limit"].tolist()
        == infos["_time_limit"].tolist()
        == [True, False, True]
    )
    assert not infos["_broken"].any()


def test_a_worm_that_is_torn_apart_truncates_alone() -> None:
    env, calm = crawl(max_episode_steps=50), crawl(max_episode_steps=50)
    calm.reset(seed=0)
    env.reset(seed=0, options={"parameters": {"stiffness": [1.0, 1e-3, 1.0], "remanence": [1.0, 1e3, 1.0]}})
    actions = random_actions(env, 1)[0]
    observations, rewards, _, truncated, infos = env.step(actions)
    expected = calm.step(actions)
    assert truncated.tolist() == infos["_broken"].tolist() == [False, True, False]
    assert "stretched" in infos["broken"][1]
    assert observations in env.observation_space
    np.testing.assert_array_equal(observations[[0, 2]], expected[0][[0, 2]])
    np.testing.assert_array_equal(rewards, [expected[1][0], 0.0, expected[1][2]])


@pytest.mark.parametrize("mode", MODES)
def test_the_others_go_on_when_one_breaks(mode: AutoresetMode) -> None:
    calm, broken = crawl(autoreset_mode=mode), breaking(crawl(autoreset_mode=mode), environment=1, step=2)
    actions = random_actions(calm, 4)
    for env in (calm, broken):
        env.reset(seed=4)
    for step, rows in enumerate(actions):
        one, other = calm.step(rows), broken.step(rows)
        for part in range(4):
            np.testing.assert_array_equal(one[part][[0, 2]], other[part][[0, 2]])
        if step == 1 and mode is AutoresetMode.DISABLED:
            broken.reset(options={"reset_mask": other[3]})


@pytest.mark.parametrize("mode", MODES)
def test_equals_sync_vector_env_of_single_ones(mode: AutoresetMode) -> None:
    native = crawl(autoreset_mode=mode)
    sync = SyncVectorEnv([lambda: MagWormEnv(max_episode_steps=5)] * 3, autoreset_mode=mode)
    mask = np.array([True, False, False])
    assert_equal(native.reset(seed=11), sync.reset(seed=11))
    for step, rows in enumerate(random_actions(native, 18)):
        one, other = native.step(rows), sync.step(rows)
        assert_equal((*one[:4], told(one[4])), other)
        if step == 2:
            # From here on, episodes end at different times.
            assert_equal(native.reset(options={"reset_mask": mask}), sync.reset(options={"reset_mask": mask}))
        elif mode is AutoresetMode.DISABLED and one[3].any():
            assert_equal(
                native.reset(options={"reset_mask": one[3]}), sync.reset(options={"reset_mask": other[3]})
            )
    assert sync.metadata["render_modes"] == native.metadata["render_modes"]


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("task", ["crawl", "reach"])
def test_infos_have_the_same_keys_in_every_step(mode: AutoresetMode, task: str) -> None:
    env = crawl(autoreset_mode=mode, max_episode_steps=2, task=task)
    reset_keys = env.reset(seed=0)[1].keys() - {"time_s", "_time_s"}
    steps = []
    for rows in random_actions(env, 6):
        *_, truncated, infos = env.step(rows)
        if "final_info" in infos:
            steps.append(set(infos["final_info"]))
        steps.append({key for key in infos if key not in reset_keys and "final_" not in key})
        if mode is AutoresetMode.DISABLED and truncated.any():
            env.reset(options={"reset_mask": truncated})
    assert all(keys == steps[0] for keys in steps)
    assert {"progress_m", "time_s", "time_limit", "broken"} < steps[0]
    assert ("is_success" in steps[0]) == (task == "reach")


@pytest.mark.parametrize("mode", MODES)
def test_the_autoreset_mode_is_an_attribute(mode: AutoresetMode) -> None:
    env = crawl(autoreset_mode=mode)
    assert env.autoreset_mode is mode is env.metadata["autoreset_mode"]


def test_frames_follow_each_other_once_a_second_at_least() -> None:
    slow = Scene.preset("paper-3").with_values({"control.step_s": 4.0, "control.episode_s": 400.0})
    assert crawl(scene=slow).metadata["render_fps"] == 1
    assert crawl().metadata["render_fps"] == 50


def test_next_step_ignores_the_action_of_an_ended_episode() -> None:
    env = crawl(max_episode_steps=2)
    env.reset(seed=0)
    play(env, random_actions(env, 2))
    observations, rewards, _, truncated, infos = env.step(np.full((3, 3), np.nan))
    assert not rewards.any() and not truncated.any()
    assert infos["episode_number"].tolist() == [1, 1, 1]
    assert not observations[:, env.observation_layout["last_action"]].any()


def test_disabled_waits_for_the_reset() -> None:
    env = crawl(autoreset_mode="Disabled", max_episode_steps=1)
    env.reset(seed=0)
    env.step(np.zeros((3, 3)))
    before = env.get_state()
    with pytest.raises(ResetNeeded, match="environment 0 has ended"):
        env.step(np.zeros((3, 3)))
    assert env.get_state() == before


def test_step_before_reset_is_refused() -> None:
    with pytest.raises(ResetNeeded, match="environment 0 was never reset"):
        crawl().step(np.zeros((3, 3)))


@pytest.mark.parametrize("seed", [7, [7, 8, 9]])
def test_seeds_are_each_environment_s_own(seed: Any) -> None:
    expected = [crawl(1).reset(seed=7 + i)[0][0] for i in range(3)]
    np.testing.assert_array_equal(crawl().reset(seed=seed)[0], expected)


def test_draws_follow_seed_and_episode_alone() -> None:
    """A worm's episodes are the same in any batch, wherever its neighbours are in theirs."""
    alone, among = crawl(1), crawl(4)
    alone.reset(seed=21)
    among.reset(seed=[1, 2, 21, 3])
    for _ in range(3):
        among.reset(options={"reset_mask": np.array([True, True, False, False])})
    for _ in range(4):
        np.testing.assert_array_equal(alone.reset()[0][0], among.reset()[0][2])


def test_without_seed_environments_differ_and_seeds_are_told() -> None:
    _, infos = crawl(8).reset()
    assert len(set(infos["seed"].tolist())) == 8
    again = crawl(8)
    observations, _ = again.reset(seed=infos["seed"].tolist())
    env = crawl(8)
    env.np_random = np.random.default_rng(5)
    first = env.reset()[0]
    env = crawl(8)
    env.np_random = np.random.default_rng(5)
    np.testing.assert_array_equal(first, env.reset()[0])
    assert observations.shape == first.shape


@pytest.mark.parametrize("seed", [-1, 2**63, [1, 2], [1, 2, -3], [1, 2, 0.5]])
def test_bad_seeds_are_refused(seed: Any) -> None:
    env = crawl()
    env.reset(seed=1)
    before = env.get_state()
    with pytest.raises(ValueError, match="seed"):
        env.reset(seed=seed)
    assert env.get_state() == before


@pytest.mark.parametrize(
    "actions",
    [
        np.zeros((2, 3)),
        np.zeros(3),
        np.zeros((3, 3, 1)),
        np.full((3, 3), np.nan),
        np.full((3, 3), np.inf),
        "left",
        None,
    ],
)
def test_bad_actions_leave_the_state_untouched(actions: Any) -> None:
    env, twin = crawl(), crawl()
    rows = random_actions(env, 5)
    for each in (env, twin):
        each.reset(seed=2)
        play(each, rows[:2])
    with pytest.raises(ValueError):
        env.step(actions)
    assert env.get_state() == twin.get_state()
    for one, other in zip(play(env, rows[2:]), play(twin, rows[2:]), strict=True):
        assert_equal(one, other)


def test_a_bad_action_names_its_environment() -> None:
    env = crawl()
    env.reset(seed=0)
    actions = np.zeros((3, 3))
    actions[2, 1] = np.nan
    with pytest.raises(ValueError, match="2"):
        env.step(actions)


def test_actions_are_clipped_and_left_alone() -> None:
    env, twin = crawl(), crawl()
    for each in (env, twin):
        each.reset(seed=0)
    wide = np.full((3, 3), 7.0)
    assert_equal(env.step(wide), twin.step(np.ones((3, 3))))
    assert (wide == 7.0).all()
    wide.flags.writeable = False
    env.step(wide)


@pytest.mark.parametrize("lanes", ["wide", "scalar"])
@pytest.mark.parametrize("num_envs", [1, 9])
def test_lanes_threads_and_batch_size_give_equal_bits(lanes: str, num_envs: int) -> None:
    reference = MagWormVectorEnv(13, max_episode_steps=6, lanes="wide", threads=2)
    env = MagWormVectorEnv(num_envs, max_episode_steps=6, lanes=lanes, threads=1)
    expected, observations = reference.reset(seed=3)[0], env.reset(seed=3)[0]
    np.testing.assert_array_equal(observations, expected[:num_envs])
    for rows in random_actions(reference, 10):
        expected_returns, found = reference.step(rows), env.step(rows[:num_envs])
        for part in range(4):
            np.testing.assert_array_equal(found[part], expected_returns[part][:num_envs])


def test_returned_arrays_are_the_caller_s() -> None:
    env = crawl()
    first = env.reset(seed=0)[0]
    kept = first.copy()
    rows = random_actions(env, 2)
    second = env.step(rows[0])
    assert not np.shares_memory(first, second[0])
    for array in second[:4]:
        array[...] = 1
    third = env.step(rows[1])
    np.testing.assert_array_equal(first, kept)
    assert not third[2].any()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"num_envs": 0}, "num_envs is 0"),
        ({"max_episode_steps": 0}, "max_episode_steps is 0"),
        ({"render_mode": "ansi"}, "render_mode is 'ansi'"),
        ({"render_envs": (3,)}, "render_envs is"),
        ({"render_envs": ()}, "render_envs is"),
        ({"autoreset_mode": "Sometimes"}, "autoreset_mode is 'Sometimes'; allowed: 'NextStep', 'SameStep'"),
        ({"autoreset_mode": None}, "autoreset_mode is None; allowed: 'NextStep'"),
        ({"lanes": "narrow"}, "narrow"),
    ],
)
def test_bad_arguments_are_named(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        crawl(**arguments)


def test_unknown_scene_is_named() -> None:
    with pytest.raises(SceneError, match=r"paper-33.*paper-3"):
        crawl(scene="paper-33")


def test_scene_from_a_file(tmp_path: Any) -> None:
    path = tmp_path / "worm.toml"
    path.write_text(Scene.preset("paper-4").to_toml(), encoding="utf-8")
    for name in (path, str(path)):
        assert crawl(scene=name).scene.magnets == 4


def test_close_twice() -> None:
    env = crawl()
    env.reset(seed=0)
    env.close()
    env.close()
    assert env.closed
