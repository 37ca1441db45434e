"""Robots that differ from episode to episode."""

import pickle
from collections import Counter
from typing import Any

import gymnasium
import numpy as np
import pytest
import worms
from gymnasium.utils.env_checker import data_equivalence
from worms import play_randomly

from magworm_gym import CRAWL_ID, MagWormEnv, MagWormVectorEnv, Randomise, Scene
from magworm_gym.randomise import VARIED
from magworm_gym.testing import check_vector_env

BOTH = Randomise(parameters=0.2, removed=0.5)


def crawl(num_envs: int = 6, **kwargs: Any) -> MagWormVectorEnv:
    return worms.crawl(num_envs, **{"scene": "paper-5", "max_episode_steps": 3, "randomise": BOTH, **kwargs})


def robots(env: MagWormVectorEnv | MagWormEnv) -> list[Any]:
    """The robot of each environment: its factors and its magnets."""
    factors = np.stack([env.batch.parameter(name) for name in VARIED], axis=1)
    return [*zip(factors.tolist(), env.batch.magnets_present().tolist(), strict=True)]


def test_robots_are_the_same_in_any_batch_at_any_place() -> None:
    among, alone = crawl(), crawl(1, lanes="scalar")
    among.reset(seed=[1, 2, 3, 4, 5, 6])
    alone.reset(seed=4)
    rows = np.random.default_rng(8).uniform(-1, 1, (9, 3))
    for actions in rows:
        assert robots(alone)[0] == robots(among)[3]
        one, many = alone.step(actions[None]), among.step(np.tile(actions, (6, 1)))
        for part in range(4):
            np.testing.assert_array_equal(one[part][0], many[part][3])


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_each_episode_draws_anew_and_the_same_from_the_same_seed(mode: Any) -> None:
    env, again = crawl(autoreset_mode=mode), crawl(autoreset_mode=mode)
    for each in (env, again):
        each.reset(seed=2)
    seen = []
    for _ in range(3):
        seen += robots(env)
        assert data_equivalence(play_randomly(env, 4), play_randomly(again, 4), exact=True)
    assert len({str(robot) for robot in seen}) == len(seen)
    env.reset(seed=2)
    assert robots(env) == seen[:6]


def test_the_single_environment_draws_the_same() -> None:
    env, many = MagWormEnv("paper-5", randomise=BOTH), crawl(1)
    env.reset(seed=9)
    many.reset(seed=9)
    assert robots(env) == robots(many)
    env.reset()
    many.reset()
    assert robots(env) == robots(many)


@pytest.mark.parametrize("copied", [lambda env: pickle.loads(pickle.dumps(env)), "state"])
def test_states_and_copies_keep_robots_and_what_follows(copied: Any) -> None:
    env = crawl()
    env.reset(seed=0, options={"parameters": {"mass": 1.05}})
    play_randomly(env, 5)
    if copied == "state":
        other = crawl()
        other.set_state(env.get_state())
    else:
        other = copied(env)
    assert robots(other) == robots(env)
    assert data_equivalence(play_randomly(env, 9), play_randomly(other, 9), exact=True)
    assert robots(other) == robots(env)


def test_draws_keep_to_their_ranges_and_frequencies() -> None:
    env = crawl(4000, scene="paper-4", randomise=Randomise(parameters=0.2, removed=0.4))
    env.reset(seed=0)
    factors = np.stack([env.batch.parameter(name) for name in VARIED])
    assert (factors >= 0.8).all() and (factors <= 1.2).all()
    np.testing.assert_allclose(factors.mean(axis=1), 1.0, atol=0.01)
    np.testing.assert_allclose(factors.std(axis=1), 0.2 / np.sqrt(3.0), rtol=0.05)
    assert np.abs(np.corrcoef(factors) - np.eye(len(VARIED))).max() < 0.06
    assert (env.batch.parameter("drive_speed") == 1.0).all()
    counts = Counter(tuple(np.flatnonzero(~row)) for row in env.batch.magnets_present())
    assert counts[()] == pytest.approx(2400, abs=130)
    assert set(counts) == {(), (0,), (1,), (2,), (3,)}
    assert all(counts[(magnet,)] == pytest.approx(400, abs=80) for magnet in range(4))


def test_sets_of_missing_magnets_are_as_likely_and_leave_three() -> None:
    env = crawl(8000, randomise={"removed": 1.0})
    env.reset(seed=0)
    counts = Counter(tuple(np.flatnonzero(~row)) for row in env.batch.magnets_present())
    assert len(counts) == 15  # five with one missing, ten with two
    np.testing.assert_allclose(list(counts.values()), 8000 / 15, rtol=0.2)


def test_what_a_scene_lacks_stays_away() -> None:
    lacking = Scene.preset("paper-5").with_values({"body.removed": [1]})
    env = crawl(200, scene=lacking, randomise=Randomise(removed=1.0))
    env.reset(seed=0)
    present = env.batch.magnets_present()
    assert not present[:, 1].any() and (present.sum(axis=1) == 3).all()
    three = crawl(20, scene="paper-3", randomise=Randomise(removed=1.0))
    three.reset(seed=0)
    assert three.batch.magnets_present().all()


def test_options_stand_in_place_of_draws_until_the_next_reset() -> None:
    env, drawn = crawl(), crawl()
    env.reset(seed=5, options={"parameters": {"stiffness": 1.5}, "removed": [[0], *[[]] * 5]})
    drawn.reset(seed=5)
    for _ in range(2):
        assert (env.batch.parameter("stiffness") == 1.5).all()
        np.testing.assert_array_equal(env.batch.parameter("mass"), drawn.batch.parameter("mass"))
        assert env.batch.magnets_present().sum(axis=1).tolist() == [4, 5, 5, 5, 5, 5]
        play_randomly(env, 4), play_randomly(drawn, 4)
    mask = np.array([True, *[False] * 5])
    env.reset(options={"reset_mask": mask})
    assert ((env.batch.parameter("stiffness") == 1.5) == ~mask).all()


def test_a_reset_that_is_refused_keeps_the_robots() -> None:
    env = crawl()
    env.reset(seed=5)
    before, state = robots(env), env.get_state()
    with pytest.raises(ValueError, match="mass"):
        env.reset(seed=6, options={"parameters": {"mass": -1.0}})
    assert robots(env) == before and env.get_state() == state


def test_drawing_nothing_changes_nothing() -> None:
    env, plain = crawl(randomise=Randomise()), crawl(randomise=None)
    for each in (env, plain):
        each.reset(seed=1)
    assert data_equivalence(play_randomly(env, 9), play_randomly(plain, 9), exact=True)
    assert env.get_state() == plain.get_state()


def test_scenes_of_an_ensemble_draw_too() -> None:
    stiff = Scene.preset("paper-5").with_values({"material.youngs_modulus_pa": 1e5})
    env, alone = crawl(scene=["paper-5", stiff]), crawl(1, scene=stiff)
    env.reset(seed=[0, 1, 2, 3, 4, 5])
    alone.reset(seed=4)
    assert data_equivalence(robots(alone)[0], robots(env)[4], exact=True)
    np.testing.assert_array_equal(alone.batch.observe()[0], env.batch.observe()[4])


def test_the_checker_passes() -> None:
    assert check_vector_env(lambda num_envs=3: crawl(num_envs), strict=True).passed


def test_gymnasium_makes_them() -> None:
    for vectorization in (None, "sync"):
        env = gymnasium.make_vec(CRAWL_ID, 2, vectorization_mode=vectorization, randomise={"parameters": 0.1})
        env.reset(seed=0)
        env.step(np.zeros(env.action_space.shape))
        env.close()
    env = gymnasium.make(CRAWL_ID, randomise=BOTH)
    assert env.spec is not None
    again = gymnasium.make(gymnasium.envs.registration.EnvSpec.from_json(env.spec.to_json()))
    assert data_equivalence(env.reset(seed=0), again.reset(seed=0), exact=True)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"parameters": 1.0}, "randomise.parameters is 1.0; allowed: 0 to below 1"),
        ({"parameters": -0.1}, "randomise.parameters is -0.1"),
        ({"parameters": "much"}, "randomise.parameters is 'much'"),
        ({"parameters": [0.1]}, "randomise.parameters is"),
        ({"parameters": True}, "randomise.parameters is True"),
        ({"removed": 1.5}, "randomise.removed is 1.5; allowed: 0 to 1"),
        ({"removed": np.nan}, "randomise.removed is nan"),
        ({"colour": 0.1}, "randomise is .*colour.*allowed: a Randomise"),
        (0.2, "randomise is 0.2; allowed: a Randomise"),
    ],
)
def test_what_cannot_be_drawn_is_named(given: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        crawl(randomise=given)
