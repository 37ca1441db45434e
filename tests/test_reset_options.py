"""Options of a reset."""

from copy import deepcopy
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence
from worms import crawl

from magworm_gym import MagWormEnv, Scene


def test_start_for_all_and_for_each() -> None:
    env = crawl()
    env.reset(seed=0)
    origin = env.batch.node_positions()[:, 0]
    env.reset(seed=0, options={"start": {"x_m": [0.0, 0.01, 0.02], "height_m": 0.005}})
    moved = env.batch.node_positions()[:, 0] - origin
    np.testing.assert_allclose(moved[:, 0], [0.0, 0.01, 0.02], atol=1e-12)
    np.testing.assert_allclose(moved[:, 1], 0.005, atol=1e-12)


def test_start_turns_the_body() -> None:
    env = crawl()
    env.reset(seed=0)
    flat = env.batch.magnet_poses()[:, 0, 2]
    env.reset(seed=0, options={"start": {"height_m": 0.05, "angle_deg": 30.0}})
    np.testing.assert_allclose(env.batch.magnet_poses()[:, 0, 2] - flat, np.deg2rad(30.0), atol=1e-12)


def test_start_moves_a_bent_body_and_keeps_its_shape() -> None:
    bent = Scene.preset("paper-3").with_values({"start.bends_deg": [40, -90.0], "start.x_m": 0.5})
    env = crawl(scene=bent)
    env.reset(seed=0)
    own = env.batch.node_positions()
    assert own[:, 0, 0].tolist() == [0.5] * 3
    env.reset(seed=0, options={"start": {"x_m": 0.1, "angle_deg": [0.0, 0.0, 30.0]}})
    moved = env.batch.node_positions()
    np.testing.assert_allclose(moved[:2] - own[:2], np.broadcast_to([-0.4, 0.0], own[:2].shape), atol=1e-12)
    np.testing.assert_allclose(
        np.linalg.norm(moved - moved[:, :1], axis=-1), np.linalg.norm(own - own[:, :1], axis=-1), atol=1e-12
    )
    turn = np.arctan2(*(moved[2, 1] - moved[2, 0])[::-1]) - np.arctan2(*(own[2, 1] - own[2, 0])[::-1])
    assert turn == pytest.approx(np.deg2rad(30.0))
    with pytest.raises(ValueError, match="'bends_deg'; allowed: x_m, height_m, angle_deg"):
        env.reset(options={"start": {"bends_deg": [0.0]}})


def test_removed_for_all_and_for_each() -> None:
    env = crawl()
    env.reset(seed=0, options={"removed": [1]})
    assert env.batch.magnets_present().tolist() == [[True, False, True]] * 3
    env.reset(seed=0, options={"removed": [[], [0, 2], (1,)]})
    assert env.batch.magnets_present().tolist() == [[True] * 3, [False, True, False], [True, False, True]]


def test_parameters_for_all_and_for_each() -> None:
    env = crawl()
    env.reset(seed=0, options={"parameters": {"stiffness": 1.5, "mass": np.array([1.0, 1.1, 1.2])}})
    np.testing.assert_array_equal(env.batch.parameter("stiffness"), 1.5)
    np.testing.assert_array_equal(env.batch.parameter("mass"), [1.0, 1.1, 1.2])


def test_options_hold_through_autoresets_until_the_next_reset() -> None:
    env = crawl(max_episode_steps=1)
    options = {"start": {"x_m": 0.01}, "removed": [0], "parameters": {"mass": 1.1}}
    env.reset(seed=0, options=options)
    started_m = env.batch.node_positions()
    for _ in range(2):
        env.step(np.zeros((3, 3)))
    np.testing.assert_array_equal(env.batch.node_positions(), started_m)
    assert not env.batch.magnets_present()[:, 0].any()

    env.reset(options={"reset_mask": np.array([False, True, False])})
    assert env.batch.parameter("mass").tolist() == [1.1, 1.0, 1.1]
    assert env.batch.magnets_present()[:, 0].tolist() == [False, True, False]
    assert env.batch.node_positions()[:, 0, 0].tolist() == pytest.approx([0.01, 0.0, 0.01])

    plain = crawl()
    assert data_equivalence(env.reset(seed=5), plain.reset(seed=5), exact=True)


def test_options_are_never_changed() -> None:
    env = crawl(autoreset_mode="Disabled")
    options = {
        "start": {"x_m": np.array([0.0, 0.01, 0.02]), "angle_deg": 1.0},
        "removed": [[0], [], [1]],
        "parameters": {"mass": [1.0, 1.1, 1.2]},
        "reset_mask": np.ones(3, np.bool_),
    }
    copy = deepcopy(options)
    env.reset(seed=0, options=options)
    assert data_equivalence(options, copy, exact=True)


def test_mask_resets_some_only() -> None:
    env = crawl(autoreset_mode="Disabled", max_episode_steps=10)
    env.reset(seed=0)
    before = env.step(np.ones((3, 3)))[0]
    observations, infos = env.reset(options={"reset_mask": np.array([False, True, False])})
    np.testing.assert_array_equal(observations[[0, 2]], before[[0, 2]])
    assert infos["_seed"].tolist() == [False, True, False]
    assert env.batch.time_s()[1] == 0.0
    assert (env.batch.time_s()[[0, 2]] > 0.0).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"begin": 1}, "begin.*allowed: start, removed, parameters, reset_mask"),
        ([1], "options is"),
        ({"start": 0.1}, r'options\["start"\] is 0.1'),
        ({"start": {"x": 0.1}}, "'x'; allowed: x_m, height_m, angle_deg"),
        ({"start": {"x_m": "far"}}, "x_m.*'far'.*finite"),
        ({"start": {"x_m": [0.1, 0.2]}}, r"x_m.*\(3,\)"),
        ({"start": {"height_m": [0.0, 11.0, 0.0]}}, "height_m.*11.*allowed: -10 to 10"),
        ({"start": {"angle_deg": np.nan}}, "angle_deg.*nan"),
        ({"removed": 1}, r'options\["removed"\] is 1'),
        ({"removed": "12"}, r'options\["removed"\] is'),
        ({"removed": [3]}, "3; allowed: 0 to 2"),
        ({"removed": [-1]}, "-1; allowed: 0 to 2"),
        ({"removed": [True, False]}, "True; allowed: 0 to 2"),
        ({"removed": [[0], [1]]}, "3 such sequences"),
        ({"removed": [[0], 1, [2]]}, "3 such sequences"),
        ({"parameters": {"colour": 2.0}}, "colour.*allowed:.*stiffness"),
        ({"parameters": {"mass": np.inf}}, "mass.*inf"),
        ({"parameters": {"mass": [1.0, 2.0]}}, r"mass.*\(3,\)"),
        ({"parameters": {"stiffness": 1.5, "mass": -1.0}}, "mass.*-1.*allowed"),
        ({"reset_mask": [True, False, True]}, "reset_mask"),
        ({"reset_mask": np.ones(2, np.bool_)}, r"reset_mask.*\(3,\)"),
        ({"reset_mask": np.ones(3)}, "reset_mask.*bool"),
        ({"reset_mask": np.zeros(3, np.bool_)}, "True for one"),
    ],
)
def test_bad_options_change_nothing(options: Any, message: str) -> None:
    env = crawl()
    env.reset(seed=1)
    before = env.get_state()
    with pytest.raises(ValueError, match=message) as raised:
        env.reset(seed=2, options=options)
    assert "\n" not in str(raised.value)
    assert env.get_state() == before


def test_the_single_environment_takes_the_same_options() -> None:
    env = MagWormEnv()
    options = {"start": {"x_m": 0.01}, "removed": [2], "parameters": {"mass": 1.2}}
    one = env.reset(seed=3, options=options)[0]
    np.testing.assert_array_equal(one, crawl(2).reset(seed=3, options=options)[0][0])
