"""A task and a scene of one's own: in all forms of environments, in rollouts, with Stable-Baselines3."""

import importlib
import json
import subprocess
import sys
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.envs.registration import EnvSpec
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

from magworm_gym import CRAWL_ID, CUSTOM_ID, MagWormVectorEnv, arguments_of, load_policy, register_task
from magworm_gym.spaces import Part
from magworm_gym.tasks import Crawl, GoalOption, Simulation, TaskResult, Turn
from magworm_gym.testing import check_vector_env

EXAMPLES = Path(__file__).parents[1] / "examples"
OWN_ID = "Own/Stop-v0"


@pytest.fixture(autouse=True)
def own_task(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(EXAMPLES))
    return importlib.import_module("own_task")


def test_the_example_runs() -> None:
    ran = subprocess.run(
        [sys.executable, EXAMPLES / "own_task.py"], capture_output=True, text=True, check=True
    )
    assert "of 10 mm in 2 s" in ran.stdout


@pytest.mark.parametrize("name", ["own_task.py", "own_scene.toml"])
def test_an_example_is_short(name: str) -> None:
    assert len((EXAMPLES / name).read_text().splitlines()) < 60


@pytest.mark.filterwarnings("ignore:.*infinity:UserWarning")
def test_a_single_environment_of_one_s_own_task_passes() -> None:
    check_env(gymnasium.make(OWN_ID).unwrapped, skip_render_check=True)


@pytest.mark.parametrize("mode", list(AutoresetMode))
def test_vector_environments_of_one_s_own_task_pass_strictly(mode: AutoresetMode) -> None:
    make = partial(gymnasium.make_vec, OWN_ID, autoreset_mode=mode, max_episode_steps=6, threads=1)
    report = check_vector_env(make, strict=True)
    assert {f.check for f in report.with_outcome("skipped")} == {"render returns one frame per environment"}


def test_rollouts_and_steps_of_one_s_own_task_agree() -> None:
    worms: Any = gymnasium.make_vec(OWN_ID, num_envs=3)
    worms.reset(seed=0)
    plan = np.random.default_rng(0).uniform(-1.0, 1.0, (40, 3, 3))
    planned = worms.rollout(plan, observations=True)
    for t, actions in enumerate(plan):
        observations, rewards, *_ = worms.step(actions)
        np.testing.assert_array_equal(planned.rewards[t], rewards)
        np.testing.assert_array_equal(planned.observations[t], observations)
    assert np.abs(planned.rewards).sum() > 0.0


def test_one_s_own_task_is_saved_with_its_environments() -> None:
    worms, others = (MagWormVectorEnv(3, **arguments_of(OWN_ID, threads=1)) for _ in range(2))
    worms.reset(seed=0)
    plan = np.random.default_rng(1).uniform(-1.0, 1.0, (20, 3, 3))
    for actions in plan[:10]:
        worms.step(actions)
    others.set_state(worms.get_state())
    for actions in plan[10:]:
        for mine, theirs in zip(worms.step(actions)[:4], others.step(actions)[:4], strict=True):
            np.testing.assert_array_equal(mine, theirs)


def test_stable_baselines3_learns_one_s_own_task() -> None:
    sb3 = pytest.importorskip("stable_baselines3")
    from magworm_gym.sb3 import MagWormSB3VecEnv

    worms = MagWormSB3VecEnv(4, **arguments_of(f"own_task:{OWN_ID}", distance_m=0.01, threads=1))
    model = sb3.PPO("MlpPolicy", worms, n_steps=8, batch_size=32, n_epochs=1, device="cpu").learn(32)
    assert model.num_timesteps == 32 and worms.worms.task.distance_m == 0.01


def test_a_training_takes_one_s_own_task(tmp_path: Path, own_task: ModuleType) -> None:
    pytest.importorskip("stable_baselines3")
    from magworm_gym.learning import train

    flags = ["--num-envs", "4", "--steps", "128", "--seeds", "0", "--workers", "1", "--out", str(tmp_path)]
    train.main([f"own_task:{OWN_ID}", *flags])
    policy = load_policy(tmp_path / "seed-0" / "policy")
    worms = policy.make_vec(num_envs=2)
    assert worms.task == own_task.Stop() and policy(worms.reset(seed=0)[0]).shape == (2, 3)


def test_one_s_own_task_needs_no_id(own_task: ModuleType) -> None:
    env = gymnasium.make(CUSTOM_ID, task=own_task.Stop(distance_m=0.03), scene="paper-3")
    assert env.reset(seed=0)[0][-1] == pytest.approx(0.03)
    again = gymnasium.make(EnvSpec.from_json(env.spec.to_json()))
    assert again.reset(seed=0)[0][-1] == pytest.approx(0.03)
    assert json.loads(env.spec.to_json())["kwargs"]["task_class"] == "own_task:Stop"


def test_environments_do_not_share_what_a_task_remembers(own_task: ModuleType) -> None:
    task = own_task.Stop()
    first, second = (MagWormVectorEnv(1, task=task, threads=1) for _ in range(2))
    first.reset(seed=0), second.reset(seed=0)
    first.step([[1.0, 1.0, 1.0]])
    assert first.task.state["left_m"] != second.task.state["left_m"] and not hasattr(task, "state")


class Local(Crawl):
    """For its name alone."""


@pytest.mark.parametrize(
    ("task", "settings", "sentence"),
    [
        ("turn", {}, "task is 'turn'; allowed: a class"),
        (Turn(), {}, r"task is Turn\(.*; allowed: a class"),
        (Turn, {"near_rewrad": 1.0}, "near_rewrad is no argument.*near_reward"),
        (Turn, {"near_reward": "much"}, "near_reward of Turn is 'much'; allowed: -1e"),
        (Turn, {"near_reward": True}, "near_reward of Turn is True"),
        (Turn, {"max_episode_steps": 0}, "max_episode_steps is 0"),
    ],
)
def test_entries_that_are_refused(task: Any, settings: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        register_task("Own/Refused-v0", task, **settings)
    assert "Own/Refused-v0" not in gymnasium.registry


def test_a_class_inside_a_function_is_no_entry() -> None:
    class Hidden(Crawl):
        """Nobody else can import it."""

    with pytest.raises(ValueError, match="at the top of a module"):
        register_task("Own/Hidden-v0", Hidden)


def test_modules_that_cannot_be_imported_are_named() -> None:
    with pytest.raises(ValueError, match=r"nowhere.*cannot be imported.*PYTHONPATH"):
        arguments_of("nowhere:Own/Stop-v0")


def test_an_entry_is_json(own_task: ModuleType) -> None:
    scene = EXAMPLES / "own_scene.toml"
    register_task("Own/Json-v0", own_task.Stop, scene=scene, distance_m=np.float32(0.5))
    told = json.loads(gymnasium.spec("Own/Json-v0").to_json())
    assert told["kwargs"] == {"task_class": "own_task:Stop", "scene": str(scene), "distance_m": 0.5}
    assert told["max_episode_steps"] == 300


def test_an_entry_is_replaced() -> None:
    for steps in (7, 9):
        register_task("Own/Again-v0", Local, max_episode_steps=steps)
        assert gymnasium.spec("Own/Again-v0").max_episode_steps == steps
    assert arguments_of("Own/Again-v0")["max_episode_steps"] == 9
    assert arguments_of(CRAWL_ID, max_episode_steps=3)["max_episode_steps"] == 3


class Aim(Crawl):
    """Has a goal in the plane, and tells it."""

    goal_option = GoalOption("aim_m", (), 1.0)
    draws = 1
    parts = (Part("aim", "m", 1, -1.0, 1.0, "the goal"),)

    def prepare(self, scene: Any, observed: Any, num_envs: int) -> None:
        self.state = {"aim_m": np.zeros((num_envs, 1))}

    def begin(self, simulation: Simulation, mask: Any, requested_goal: Any, uniform: Any) -> None:
        aim_m = np.where(np.isnan(requested_goal), uniform, requested_goal)
        self.state["aim_m"] = np.where(mask[:, np.newaxis], aim_m, self.state["aim_m"])

    def observe(self, simulation: Simulation) -> Any:
        return self.state["aim_m"]


def test_goals_of_one_s_own_are_drawn_or_given() -> None:
    worms = MagWormVectorEnv(2, task=Aim(), threads=1)
    drawn = worms.reset(seed=0)[0][:, -1]
    assert len(set(drawn)) == 2 and (drawn >= 0.0).all()
    assert worms.reset(seed=0, options={"aim_m": [-0.5, 0.5]})[0][:, -1].tolist() == [-0.5, 0.5]
    with pytest.raises(ValueError, match=r"aim_m.*is 2; allowed: -1 to 1"):
        worms.reset(options={"aim_m": 2})
    np.testing.assert_array_equal(worms.reset(seed=0)[0][:, -1], drawn)


class Broad(Crawl):
    """Its rewards have an axis too many."""

    def evaluate(self, simulation: Simulation, progress_m: Any, mask: Any) -> TaskResult:
        return TaskResult(progress_m[:, np.newaxis], np.zeros(len(mask), np.bool_))


def test_results_of_another_shape_are_refused() -> None:
    worms = MagWormVectorEnv(3, task=Broad(), threads=1)
    worms.reset(seed=0)
    with pytest.raises(ValueError, match=r"rewards of a task have shape \(3, 1\); allowed: \(3,\)"):
        worms.step(np.zeros((3, 3)))
