"""Tasks in space: goals, rewards, ends, infos, modes, states, adapters."""

import json
import pickle
from copy import deepcopy
from functools import partial
from types import SimpleNamespace
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env, data_equivalence
from gymnasium.vector import AutoresetMode
from worms import crawl, play_randomly

from magworm_gym import REACH_ID, TURN_ID, MagWormEnv, MagWormVectorEnv, Scene
from magworm_gym.draws import TASK, uniform
from magworm_gym.tasks import Reach, Task, Turn
from magworm_gym.testing import check_vector_env

MODES = list(AutoresetMode)
NOTHING = np.zeros(1)
EVERYONE = np.ones(1, np.bool_)
TASKS = ["turn", "reach"]
GOALS: dict[str, dict[str, Any]] = {"turn": {"goal_deg": 40.0}, "reach": {"goal_m": [-0.03, 0.02]}}
OBSERVED = MagWormVectorEnv(task="turn", threads=1).batch.observation_specification


def made(task: str, num_envs: int = 3, **kwargs: Any) -> MagWormVectorEnv:
    return crawl(num_envs, task=task, **kwargs)


def seen(x_m: float = 0.0, z_m: float = 0.0, heading_deg: float = 0.0, roll_deg: float = 0.0) -> Any:
    """A batch of one that stands where it is told; its only magnet in place rolls, one taken out lies."""
    half = np.deg2rad(0.5 * roll_deg)
    rows = np.zeros((1, 2, 7))
    rows[0, :, 3:5] = [[np.cos(half), np.sin(half)], [0.0, 1.0]]
    heading = np.angle(np.exp(1j * np.deg2rad(heading_deg)))
    return SimpleNamespace(
        num_envs=1,
        robot_poses=lambda: np.array([[x_m, z_m, heading]]),
        magnet_poses=lambda: rows,
        magnets_present=lambda: np.array([[True, False]]),
    )


def begun(kind: type[Task], goal: Any, batch: Any) -> Task:
    task = kind().prepared(Scene.preset("turn-3"), OBSERVED, 1)
    task.begin(batch, EVERYONE, np.atleast_2d(np.asarray(goal, float)), np.zeros((1, kind.draws)))
    return task


def test_the_heading_counts_whole_turns() -> None:
    task = begun(Turn, 170.0, seen(heading_deg=100.0))
    assert task.goal(0).heading_rad == pytest.approx(np.deg2rad(270.0))
    rewards = [
        task.evaluate(seen(heading_deg=h), NOTHING, EVERYONE).rewards[0] for h in (150.0, 200.0, 260.0, 275.0)
    ]
    assert rewards == pytest.approx([50.0, 50.0, 60.0, 5.0])
    near = task.evaluate(seen(heading_deg=272.0), NOTHING, EVERYONE)
    assert near.rewards[0] == pytest.approx(3.1)
    assert near.success is not None and near.success[0]
    assert near.infos["heading_error_rad"][0] == pytest.approx(np.deg2rad(-2.0))
    assert task.observe(seen())[0] == pytest.approx([np.cos(np.deg2rad(2)), -np.sin(np.deg2rad(2)), -2 / 180])


@pytest.mark.parametrize(
    ("roll_deg", "tips"), [(0.0, False), (59.0, False), (61.0, True), (-61.0, True), (180.0, True)]
)
def test_tipping_over_ends_a_turn(roll_deg: float, tips: bool) -> None:
    task = begun(Turn, 1.0, seen())
    result = task.evaluate(seen(roll_deg=roll_deg), NOTHING, EVERYONE)
    assert result.terminated[0] == tips
    assert result.success is not None and result.success[0] != tips
    assert result.rewards[0] == pytest.approx(0.1 - 30.0 * tips)
    assert abs(np.rad2deg(result.infos["roll_rad"][0])) == pytest.approx(abs(roll_deg))
    if 0.0 < abs(roll_deg) < 180.0:
        assert np.sign(result.infos["roll_rad"][0]) == np.sign(roll_deg)


def test_a_goal_is_reached_within_five_millimetres() -> None:
    # A quarter turn anticlockwise from above: the head, once towards -x, looks towards z.
    task = begun(Reach, [-0.03, 0.0], seen(x_m=0.1, heading_deg=90.0))
    assert task.goal(0).point_m == pytest.approx((0.1, 0.03))
    assert task.observe(seen(x_m=0.1, heading_deg=90.0))[0] == pytest.approx([-1.5, 0.0, 1.5])
    far = task.evaluate(seen(x_m=0.1, z_m=0.024), NOTHING, EVERYONE)
    assert (far.rewards[0], far.terminated[0]) == (pytest.approx(24.0), False)
    there = task.evaluate(seen(x_m=0.104, z_m=0.03), NOTHING, EVERYONE)
    assert (there.rewards[0], there.terminated[0]) == (pytest.approx(2.0), True)
    assert there.infos["distance_m"][0] == pytest.approx(0.004)


def test_goals_are_drawn_within_their_ranges() -> None:
    turned = made("turn", 500).reset(seed=0)[1]["goal_rad"]
    assert np.abs(turned).max() <= 0.5 * np.pi and np.ptp(turned) > 0.98 * np.pi
    env = made("reach", 500)
    env.reset(seed=0)
    ahead, aside, distance = (env.reset(seed=0)[0][:, -3:] * 0.020).astype(np.float64).T
    assert distance.min() >= 0.030 - 1e-6 and distance.max() <= 0.080 + 1e-6
    angle = np.rad2deg(np.arctan2(aside, -ahead))
    assert np.abs(angle).max() <= 60.001 and np.ptp(angle) > 115.0


def test_draws_depend_on_seed_and_episode_alone() -> None:
    seeds, episodes = np.array([3, 4, 3, 2**62]), np.array([0, 0, 1, 7])
    rows = uniform(seeds, episodes, 3, TASK)
    assert len(np.unique(rows)) == rows.size and ((rows >= 0.0) & (rows < 1.0)).all()
    np.testing.assert_array_equal(rows[2:3, :2], uniform(seeds[2:3], episodes[2:3], 2, TASK))
    assert uniform(np.arange(4000), np.zeros(4000, int), 1, TASK).mean() == pytest.approx(0.5, abs=0.02)


@pytest.mark.parametrize("task", TASKS)
def test_a_goal_holds_until_the_next_reset(task: str) -> None:
    env = made(task, autoreset_mode="SameStep", max_episode_steps=2)
    key = {"turn": "goal_rad", "reach": "goal_m"}[task]
    drawn = env.reset(seed=0)[1][key]
    given = env.reset(seed=0, options=GOALS[task])[1][key]
    assert (given != drawn).any()
    for _ in range(4):
        infos = env.step(env.action_space.sample())[4]
        if key in infos and task == "turn":
            np.testing.assert_allclose(infos[key], given, atol=1e-9)
    again = env.reset(seed=0)[1][key]
    np.testing.assert_array_equal(again, drawn)
    assert (env.reset()[1][key] != drawn).any()


@pytest.mark.parametrize(
    ("task", "options", "named"),
    [
        ("turn", {"goal_deg": 181.0}, "goal_deg.*181.*-180 to 180"),
        ("turn", {"goal_deg": [1.0, 2.0]}, r"goal_deg.*\(3,\)"),
        ("turn", {"goal_m": [0.0, 0.0]}, "goal_m.*allowed.*goal_deg"),
        ("reach", {"goal_m": [0.0, np.nan]}, r"goal_m.*\(3, 2\)"),
        ("reach", {"goal_m": [0.0, 2.0]}, "goal_m.*-1 to 1"),
        ("crawl", {"goal_deg": 3.0}, "goal_deg"),
    ],
)
def test_goals_that_are_not_allowed(task: str, options: dict[str, Any], named: str) -> None:
    env = made(task)
    env.reset(seed=0)
    before = env.get_state()
    with pytest.raises(ValueError, match=named):
        env.reset(options=options)
    assert env.get_state() == before


@pytest.mark.parametrize("task", TASKS)
def test_goals_for_each_environment(task: str) -> None:
    name, one = next(iter(GOALS[task].items()))
    rows = np.array([one, 0.5 * np.asarray(one), -np.asarray(one)])
    np.testing.assert_array_equal(
        made(task).reset(seed=0, options={name: rows})[0][0],
        made(task, 1).reset(seed=0, options={name: one})[0][0],
    )


def test_tasks_need_space_and_a_name() -> None:
    with pytest.raises(ValueError, match=r"Turn.*dimensions = 3.*paper-3"):
        made("turn", scene="paper-3")
    with pytest.raises(ValueError, match="task is 'fly'; allowed: 'crawl', 'turn', 'reach'"):
        made("fly")


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", [TURN_ID, REACH_ID])
def test_vector_environments_pass_strictly(name: str, mode: AutoresetMode) -> None:
    make = partial(gymnasium.make_vec, name, autoreset_mode=mode, max_episode_steps=6, threads=1)
    report = check_vector_env(make, strict=True)
    assert {f.check for f in report.with_outcome("skipped")} == {"render returns one frame per environment"}


@pytest.mark.filterwarnings("ignore:.*infinity:UserWarning")
@pytest.mark.parametrize("name", [TURN_ID, REACH_ID])
def test_single_environments_pass(name: str) -> None:
    check_env(gymnasium.make(name).unwrapped, skip_render_check=True)
    made_again = gymnasium.make(gymnasium.envs.registration.EnvSpec.from_json(gymnasium.spec(name).to_json()))
    assert json.loads(made_again.spec.to_json())["kwargs"] == gymnasium.spec(name).kwargs


@pytest.mark.parametrize("mode", MODES)
def test_reaching_a_goal_ends_an_episode_in_every_mode(mode: AutoresetMode) -> None:
    env = made("reach", autoreset_mode=mode, max_episode_steps=50)
    env.reset(seed=0, options={"goal_m": [[0.0, 0.0], [-0.05, 0.0], [0.0, 0.004]]})
    *_, terminated, truncated, infos = env.step(np.zeros(env.action_space.shape))
    assert terminated.tolist() == [True, False, True] and not truncated.any()
    infos = infos["final_info"] if mode is AutoresetMode.SAME_STEP else infos
    assert infos["is_success"].tolist() == infos["_is_success"].tolist() == terminated.tolist()
    assert not infos["time_limit"].any()


@pytest.mark.parametrize("task", TASKS)
def test_copies_go_on_bit_for_bit(task: str) -> None:
    env = made(task, autoreset_mode="SameStep")
    env.reset(seed=5, options={**GOALS[task], "removed": [1], "parameters": {"mass": [1.0, 1.1, 1.2]}})
    env.reset(options={"reset_mask": np.array([False, True, False]), "start": {"z_m": 0.01, "yaw_deg": 30.0}})
    play_randomly(env, 3)
    loaded = made(task, autoreset_mode="SameStep")
    loaded.set_state(env.get_state())
    copies = [loaded, pickle.loads(pickle.dumps(env)), deepcopy(env)]
    expected = play_randomly(env, 12, seed=1)
    for copy in copies:
        assert data_equivalence(expected, play_randomly(copy, 12, seed=1), exact=True)


def test_a_state_of_another_task_is_refused() -> None:
    turn, reach = made("turn"), made("reach")
    turn.reset(seed=0)
    with pytest.raises(ValueError, match="fields"):
        reach.set_state(turn.get_state())


@pytest.mark.parametrize("task", TASKS)
def test_bits_do_not_depend_on_lanes_and_number(task: str) -> None:
    many = made(task, 11, lanes="wide", threads=2)
    one = made(task, 1, lanes="scalar")
    np.testing.assert_array_equal(many.reset(seed=0)[0][:1], one.reset(seed=0)[0])
    rows = np.random.default_rng(0).uniform(-1, 1, (12, *many.action_space.shape))
    for actions in rows:
        for left, right in zip(many.step(actions)[:4], one.step(actions[:1])[:4], strict=True):
            np.testing.assert_array_equal(left[:1], right)


def test_a_broken_worm_has_no_success() -> None:
    env = made("turn")
    env.reset(seed=0, options={"goal_deg": 0.0})
    batch = env.batch

    class Breaking:
        def __getattr__(self, name: str) -> Any:
            return getattr(batch, name)

        def step(self, actions: Any) -> Any:
            observations, progress_m, status = batch.step(actions)
            status[1] = 1
            return observations, progress_m, status

    env._worlds.batch = Breaking()  # type: ignore[assignment]
    _, rewards, terminated, truncated, infos = env.step(np.zeros(env.action_space.shape))
    assert rewards[1] == 0.0 and truncated.tolist() == [False, True, False] and not terminated.any()
    assert infos["_is_success"].tolist() == [False, True, False] and not infos["is_success"].any()


@pytest.mark.parametrize("task", TASKS)
def test_stable_baselines3_sees_the_task(task: str) -> None:
    pytest.importorskip("stable_baselines3")
    from stable_baselines3.common.env_checker import check_env as check_for_sb3

    from magworm_gym.sb3 import MagWormSB3VecEnv

    check_for_sb3(MagWormEnv(task=task))
    worms = MagWormSB3VecEnv(2, max_episode_steps=3, threads=1, task=task)
    worms.seed(0)
    worms.set_options(GOALS[task])
    worms.reset()
    for _ in range(3):
        _, _, dones, infos = worms.step(np.zeros((2, *worms.action_space.shape)))
    assert dones.all()
    assert [info["is_success"] for info in infos] == [False, False]
    assert all(info["TimeLimit.truncated"] for info in infos)
