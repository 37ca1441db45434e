"""Environments of several scenes: each is what it is among those of its scene alone."""

import pickle
from copy import deepcopy
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence

from magworm_gym import CRAWL_ID, Batch, MagWormEnv, MagWormVectorEnv, Scene, SceneError

ENVS, STEPS = 14, 12
SEEDS = [7 * i + 1 for i in range(ENVS)]


def scenes(dimensions: int = 2) -> list[Scene]:
    """A robot, a soft one whose state has more rows, and one that lacks a magnet."""
    first = Scene.preset("paper-3" if dimensions == 2 else "turn-3")
    soft = {
        "name": "soft",
        "material.youngs_modulus_pa": 30000.0,
        "material.relaxation": [{"ratio": 0.3, "time_s": 0.05}],
    }
    lacking = {"name": "lacking", "body.removed": [1], "ground.static_friction": 1.1}
    return [first, first.with_values(soft), first.with_values(lacking)]


def environments(scene: Any, count: int = ENVS, **more: Any) -> MagWormVectorEnv:
    return MagWormVectorEnv(count, scene=scene, **{"max_episode_steps": 8, "threads": 2, **more})


def actions(count: int = ENVS) -> np.ndarray[Any, Any]:
    size = (STEPS, ENVS, 5)
    return np.random.default_rng(4).uniform(-1.0, 1.0, size)[:, :count]


def play(env: MagWormVectorEnv, rows: np.ndarray[Any, Any]) -> list[Any]:
    size = env.single_action_space.shape[0]  # type: ignore[index]
    return [env.step(row) for row in rows[:, :, :size]]


def started(scene: Any, **more: Any) -> MagWormVectorEnv:
    env = environments(scene, **more)
    env.reset(seed=SEEDS)
    return env


def picked(results: list[Any], chosen: slice) -> list[Any]:
    """The same results for some of the environments."""

    def of(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: of(part) for key, part in value.items()}
        return value[chosen]

    return [tuple(of(part) for part in result) for result in results]


def test_environments_have_their_scenes_in_order() -> None:
    env = environments(scenes())
    assert env.scenes == tuple(scenes()) and env.scene == scenes()[0]
    np.testing.assert_array_equal(env.batch.scene_indices, np.arange(ENVS) * 3 // ENVS)
    env.reset(seed=0)
    lacks = env.batch.scene_indices == 2
    np.testing.assert_array_equal(~env.batch.magnets_present()[:, 1], lacks)
    assert env.batch.magnets_present()[:, [0, 2]].all()


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
@pytest.mark.parametrize("lanes", ["wide", "scalar"])
def test_an_environment_is_what_it_is_with_its_scene_alone(dimensions: int, mode: str, lanes: str) -> None:
    several = scenes(dimensions)
    together = started(several, autoreset_mode=mode, lanes=lanes)
    seen = play(together, actions())
    for number, scene in enumerate(several):
        mine = np.flatnonzero(together.batch.scene_indices == number)
        chosen = slice(mine[0], mine[-1] + 1)
        alone = environments(scene, len(mine), autoreset_mode=mode)
        alone.reset(seed=SEEDS[chosen])
        assert data_equivalence(picked(seen, chosen), play(alone, actions()[:, chosen]), exact=True)


@pytest.mark.parametrize("task", ["turn", "reach"])
def test_tasks_with_goals_are_as_with_one_scene(task: str) -> None:
    several = scenes(3)
    together = started(several, task=task)
    seen = play(together, actions())
    chosen = slice(5, 10)
    assert set(together.batch.scene_indices[chosen]) == {1}
    alone = environments(several[1], 5, task=task)
    alone.reset(seed=SEEDS[chosen])
    assert data_equivalence(picked(seen, chosen), play(alone, actions()[:, chosen]), exact=True)


def by_state(env: MagWormVectorEnv) -> MagWormVectorEnv:
    other = environments(scenes(), lanes="scalar")
    other.set_state(env.get_state())
    return other


@pytest.mark.parametrize("copied", [by_state, deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_a_copy_goes_on_bit_for_bit(copied: Any) -> None:
    env = started(scenes())
    play(env, actions()[:3])
    copy = copied(env)
    assert copy.scenes == env.scenes
    assert data_equivalence(play(env, actions()), play(copy, actions()), exact=True)


def test_copies_in_any_order_have_the_scenes_of_their_originals() -> None:
    env = started(scenes())
    play(env, actions()[:3])
    chosen = [13, 0, 0, 6, 12, 5, 4]
    copies = env.batch.copies(chosen)
    for batch in (copies, pickle.loads(pickle.dumps(copies))):
        assert batch.scenes == env.batch.scenes
        np.testing.assert_array_equal(batch.scene_indices, env.batch.scene_indices[chosen])
        np.testing.assert_array_equal(batch.observe(), env.batch.observe()[chosen])
        np.testing.assert_array_equal(batch.step(actions()[5, chosen, :3])[0], played(env, chosen))


def played(env: MagWormVectorEnv, chosen: list[int]) -> Any:
    """Observations of some environments after a control step of a copy of all."""
    return deepcopy(env.batch).step(actions()[5, :, :3])[0][chosen]


def test_a_rollout_is_what_stepping_gives() -> None:
    env = started(scenes(), max_episode_steps=100)
    plans, start = actions()[:, :, :3], np.arange(ENVS)[::-1].copy()
    rollout = env.rollout(plans[:, start], start=start, observations=True)
    assert rollout.observations is not None
    for t, (observations, rewards, *_) in enumerate(play(env, plans)):
        np.testing.assert_array_equal(rollout.observations[t], observations[start])
        np.testing.assert_array_equal(rollout.rewards[t], rewards[start])


def test_a_state_of_other_scenes_is_refused_by_environment_and_name() -> None:
    first, soft, lacking = scenes()
    state = started([first, soft, lacking]).get_state()
    other = started([first, lacking, soft])
    before = other.get_state()
    with pytest.raises(ValueError, match=r"^state of environment 5 .* than \"lacking\""):
        other.set_state(state)
    assert other.get_state() == before


def test_scenes_of_another_shape_are_refused_by_what_differs() -> None:
    first = Scene.preset("paper-3")
    with pytest.raises(SceneError, match=r"^scenes\[1\] is a scene with body magnets = 4; allowed: .* = 3"):
        Batch([first, Scene.preset("paper-4")], 8)
    short = first.with_values({"control.episode_s": 1.0})
    with pytest.raises(SceneError, match=r"^scenes\[2\] is a scene with control.episode_s = 1 s; ") as raised:
        environments([first, first, short])
    assert raised.value.field == "scenes[2]"
    with pytest.raises(SceneError, match=r"^scenes is an empty list; allowed: one scene or more"):
        environments([])
    with pytest.raises(ValueError, match=r"^num_envs is 2; allowed: 3 or more, one for each scene"):
        environments(scenes(), 2)
    with pytest.raises(TypeError, match=r"^scene\[1\] is 'paper-4'; allowed: a Scene"):
        Batch([first, "paper-4"], 8)  # type: ignore[list-item]
    with pytest.raises(ValueError, match=r"^num_envs is 1; allowed: 2 or more"):
        MagWormEnv(scene=[first, first])  # type: ignore[arg-type]


def test_names_and_files_stand_in_a_list_too() -> None:
    env: Any = gymnasium.make_vec(CRAWL_ID, num_envs=4, scene=["paper-3", Scene.preset("paper-3")])
    assert [scene.name for scene in env.unwrapped.scenes] == ["paper-3", "paper-3"]


def test_a_factor_is_checked_by_the_scene_of_its_environment() -> None:
    first = Scene.preset("paper-3")
    without = first.with_values({"magnetic_terms.mutual": False})
    assert "mutual" in Batch(first, 1).parameter_names
    for several in ([first, without], [without, first]):
        batch = Batch(several, 4)
        assert "mutual" not in batch.parameter_names
        factors = np.where(batch.scene_indices == several.index(first), 0.5, 1.0)
        batch.set_parameter("mutual", factors)
        np.testing.assert_array_equal(batch.parameter("mutual"), factors)
        refused = f"^factor of mutual in environment {2 * several.index(without)} is 0.5; allowed: 1, "
        with pytest.raises(ValueError, match=refused):
            batch.set_parameter("mutual", np.full(4, 0.5))
        np.testing.assert_array_equal(batch.parameter("mutual"), factors)


def test_each_environment_is_drawn_as_its_scene() -> None:
    pytest.importorskip("PIL")
    first = Scene.preset("paper-3")
    slim = first.with_values({"magnet.height_m": 0.0012, "name": "slim"})
    both = MagWormVectorEnv(2, scene=[first, slim], render_mode="rgb_array", render_envs=(0, 1))
    both.reset(seed=0)
    frames = both.render()
    assert frames is not None
    for seed, (frame, scene) in enumerate(zip(frames, (first, slim), strict=True)):
        alone = MagWormVectorEnv(1, scene=scene, render_mode="rgb_array")
        alone.reset(seed=seed)
        drawn = alone.render()
        assert drawn is not None and np.array_equal(frame, drawn[0])
    assert not np.array_equal(*frames)


def test_ensembles_that_do_not_exist_are_told_with_those_that_do() -> None:
    with pytest.raises(SceneError, match=r"^there is no ensemble \"paper-9\"; ensembles: "):
        Scene.ensemble("paper-9")
