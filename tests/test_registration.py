"""What an ID of Gymnasium's registry decides: the task, its settings, the limit of time."""

import json
import warnings
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.envs.registration import EnvSpec

from magworm_gym import CRAWL_ID, CUSTOM_ID, REACH_ID, TURN_ID, MagWormEnv, MagWormVectorEnv, Scene
from magworm_gym.scene import episode_steps, load_scene
from magworm_gym.tasks import TASKS, Crawl, Reach, Turn

IDS = {CRAWL_ID: Crawl, TURN_ID: Turn, REACH_ID: Reach}
FIRST_IDS = {"MagWorm/Turn-v0": Turn, "MagWorm/Reach-v0": Reach}


def length_and_last_info(env: Any) -> tuple[int, dict[str, Any]]:
    env.reset(seed=0)
    for step in range(1, 2000):
        *_, terminated, truncated, info = env.step(np.zeros(env.action_space.shape))
        if np.any(terminated | truncated):
            return step, info
    return 0, {}


@pytest.mark.parametrize(("name", "task"), IDS.items())
def test_an_id_chooses_the_task(name: str, task: type) -> None:
    single, many = gymnasium.make(name), gymnasium.make_vec(name, num_envs=2)
    assert isinstance(single.unwrapped, MagWormEnv) and type(single.unwrapped.task) is task
    assert isinstance(many, MagWormVectorEnv) and type(many.task) is task
    for make in (gymnasium.make, gymnasium.make_vec):
        with pytest.raises(ValueError, match="task is 'turn'; the ID chooses the task"):
            make(name, task="turn")


@pytest.mark.parametrize("name", [TURN_ID, REACH_ID])
def test_turning_and_reaching_have_two_drive_magnets(name: str) -> None:
    assert gymnasium.make(name).unwrapped.scene == Scene.preset("turn-3-pair")


@pytest.mark.parametrize("name", FIRST_IDS)
def test_the_first_versions_keep_their_drive_magnet(name: str) -> None:
    with pytest.warns(DeprecationWarning, match="out of date"):
        env = gymnasium.make(name)
    assert env.unwrapped.scene == Scene.preset("turn-3")


@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
def test_rewards_and_goals_are_arguments(make: Any) -> None:
    env = make(TURN_ID, near_reward=0.5, greatest_goal_deg=np.float32(10.0))
    assert env.unwrapped.task == Turn(near_reward=0.5, greatest_goal_deg=10.0)
    for _ in range(20):
        assert abs(np.rad2deg(env.reset()[1]["goal_rad"])) <= 10.0
    env.reset(seed=0, options={"goal_deg": 0.0})
    assert env.step(np.zeros(env.action_space.shape))[1] == pytest.approx(0.5, abs=0.3)


@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
@pytest.mark.parametrize(
    ("name", "arguments", "sentence"),
    [
        (TURN_ID, {"near_rewrad": 1.0}, "near_rewrad is no argument.*near_reward"),
        (TURN_ID, {"near_reward": np.nan}, "near_reward of Turn is nan; allowed"),
        (CRAWL_ID, {"near_reward": 1.0}, "near_reward is no argument"),
        (REACH_ID, {"nearest_m": 0.09}, "nearest_m of Reach is 0.09; allowed: at most furthest_m = 0.08"),
        (CUSTOM_ID, {}, "task is None; allowed: a Task"),
        (CUSTOM_ID, {"task": "crawl"}, "task is 'crawl'; allowed: a Task"),
    ],
)
def test_arguments_that_are_refused(make: Any, name: str, arguments: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        make(name, **arguments)


@pytest.mark.parametrize("name", IDS)
def test_the_limit_of_an_id_is_its_scene_s(name: str) -> None:
    limit = gymnasium.spec(name).max_episode_steps
    assert limit == episode_steps(load_scene(IDS[name].default_scene)) == 500
    assert gymnasium.make(name).spec.max_episode_steps == limit
    assert gymnasium.make_vec(name, num_envs=2).spec.max_episode_steps == limit


@pytest.mark.parametrize("steps", [5, 800])
def test_a_limit_means_the_same_in_every_form(steps: int) -> None:
    given: dict[str, Any] = {"max_episode_steps": steps}
    forms = [
        gymnasium.make(CRAWL_ID, **given),
        gymnasium.make(CUSTOM_ID, task=Crawl(), **given),
        gymnasium.make_vec(CRAWL_ID, num_envs=1, **given),
        gymnasium.make_vec(CRAWL_ID, num_envs=1, vectorization_mode="sync", **given),
        MagWormEnv(**given),
        MagWormVectorEnv(1, **given),
    ]
    assert [length_and_last_info(env)[0] for env in forms] == [steps] * len(forms)
    assert [env.spec.max_episode_steps for env in forms[:3]] == [steps] * 3


def test_no_limit_is_none() -> None:
    env = gymnasium.make(CRAWL_ID, max_episode_steps=-1)
    assert length_and_last_info(env) == (0, {}) and env.spec.max_episode_steps is None


@pytest.mark.parametrize("arguments", [{}, {"max_episode_steps": 5}, {"max_episode_steps": 700}])
@pytest.mark.parametrize("name", [TURN_ID, REACH_ID])
def test_an_end_by_the_limit_has_all_its_infos(name: str, arguments: dict[str, Any]) -> None:
    steps, info = length_and_last_info(gymnasium.make(name, **arguments))
    assert steps == arguments.get("max_episode_steps", 500)
    assert info["time_limit"] is True and info["is_success"] is False


def test_another_limit_of_the_scene_is_said_once() -> None:
    scene = Scene.preset("paper-3").with_values({"control.episode_s": 1.5})
    with pytest.warns(UserWarning, match=r"Crawl-v0 ends episodes after 500 .* 'paper-3' after 75"):
        env = gymnasium.make(CRAWL_ID, scene=scene)
    assert length_and_last_info(env)[0] == 500
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        gymnasium.make(CRAWL_ID, scene=scene)
        gymnasium.make(CRAWL_ID, scene=scene.with_values({"control.episode_s": 1.0}), max_episode_steps=9)
    assert MagWormEnv(scene).max_episode_steps == 75
    custom = gymnasium.make(CUSTOM_ID, task=Crawl(), scene=scene)
    assert length_and_last_info(custom)[0] == custom.spec.max_episode_steps == 75


@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
def test_specifications_hold_paths_and_numbers_of_numpy(make: Any, tmp_path: Path) -> None:
    path = tmp_path / "five.toml"
    path.write_text(Scene.preset("paper-5").to_toml())
    env = make(CRAWL_ID, scene=path, max_episode_steps=7, threads=np.int64(1))
    told = json.loads(env.spec.to_json())
    assert told["kwargs"]["scene"] == str(path) and told["kwargs"]["threads"] == 1
    again = make(EnvSpec.from_json(env.spec.to_json()))
    assert again.unwrapped.scene.magnets == 5 and again.unwrapped.max_episode_steps == 7


def test_a_specification_holds_a_list_of_paths(tmp_path: Path) -> None:
    path = tmp_path / "three.toml"
    path.write_text(Scene.preset("paper-3").to_toml())
    env = gymnasium.make_vec(CRAWL_ID, num_envs=2, scene=[path, "paper-3"], autoreset_mode="SameStep")
    assert json.loads(env.spec.to_json())["kwargs"]["scene"] == [str(path), "paper-3"]


def test_an_argument_imports_no_module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / "sly.py").write_text("raise SystemExit('imported')")
    with pytest.raises(ValueError, match=r"task_class is 'sly:Task'; allowed: 'magworm_gym\.tasks"):
        gymnasium.make_vec(CRAWL_ID, task_class="sly:Task")


def test_a_task_is_chosen_by_its_name_in_the_classes() -> None:
    assert {name: type(MagWormEnv(task=name).task) for name in TASKS} == TASKS  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="task is 'fly'; allowed: 'crawl', 'turn', 'reach'"):
        MagWormEnv(task="fly")  # type: ignore[arg-type]
