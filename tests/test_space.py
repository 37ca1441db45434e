"""Scenes in space as Python sees them: shapes, frames, options, crawling, drawing."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest

from magworm_gym import CRAWL_ID, Batch, MagWormVectorEnv, Scene, record_scenes
from magworm_gym.baselines import Runner, Still, UniformlyRandom
from magworm_gym.testing import check_vector_env


@pytest.fixture(scope="module")
def scene() -> Scene:
    return Scene.preset("turn-3")


def space(num_envs: int = 2, **kwargs: Any) -> MagWormVectorEnv:
    return MagWormVectorEnv(num_envs, "turn-3", **{"max_episode_steps": 5, "threads": 1, **kwargs})


@pytest.mark.parametrize(
    ("preset", "pose", "velocity", "node", "drive", "drive_velocity", "action"),
    [("paper-3", 3, 3, 2, 2, 2, 3), ("turn-3", 7, 6, 3, 4, 4, 5)],
)
def test_rows_are_as_long_as_dimensions_ask(
    preset: str, pose: int, velocity: int, node: int, drive: int, drive_velocity: int, action: int
) -> None:
    chosen = Scene.preset(preset)
    batch = Batch(chosen, 2)
    assert batch.magnet_poses().shape == (2, 3, pose)
    assert batch.magnet_velocities().shape == (2, 3, velocity)
    assert batch.node_positions().shape[::2] == (2, node)
    assert batch.drive_positions().shape == (2, 1, drive)
    assert batch.drive_velocities().shape == (2, drive_velocity)
    assert batch.robot_poses().shape == (2, 3)
    assert sum(part.size for part in batch.action_specification) == action
    record = record_scenes([chosen], 0.02)[0]
    assert record.magnet_poses.shape[1:] == (3, pose)
    assert record.nodes.shape[2] == node
    assert record.drive_positions.shape[1:] == (1, drive)
    assert record.centre.shape[1] == node


def test_a_scene_in_space_names_its_limits(scene: Scene) -> None:
    assert scene.dimensions == 3 and Scene.preset("paper-3").dimensions == 2
    limits = scene.stage_limits
    assert limits is not None
    assert (limits["lateral_reach_m"], limits["yaw_reach_deg"]) == (0.030, 90.0)
    assert (limits["yaw_speed_deg_s"], limits["yaw_acceleration_deg_s2"]) == (180.0, 3600.0)
    assert "yaw_reach_deg" not in (Scene.preset("paper-3").stage_limits or {})


def test_a_start_beside_and_turned() -> None:
    env = space()
    env.reset(seed=0)
    centre = env.batch.robot_poses()[0]
    env.reset(seed=0, options={"start": {"x_m": 0.01, "z_m": [0.02, -0.02], "yaw_deg": 90.0}})
    poses = env.batch.robot_poses()
    # The head end stays; the tail, once ahead in x, is where x turns to anticlockwise from above: -z.
    np.testing.assert_allclose(poses[:, 0], 0.01, atol=1e-12)
    np.testing.assert_allclose(poses[:, 1], np.array([0.02, -0.02]) - centre[0], atol=1e-12)
    np.testing.assert_allclose(poses[:, 2], 0.5 * np.pi, atol=1e-12)
    nodes = env.batch.node_positions()
    assert (np.diff(nodes[..., 2], axis=1) < 0.0).all()
    half = np.sqrt(0.5)
    np.testing.assert_allclose(env.batch.magnet_poses()[0, :, 3:], [[half, 0.0, half, 0.0]] * 3, atol=1e-12)


def test_what_the_robot_sees_does_not_depend_on_where_it_lies() -> None:
    env = space(1)
    options = {"start": {"x_m": 0.5, "z_m": -0.3, "yaw_deg": 70.0}}
    straight, turned = env.reset(seed=3)[0], env.reset(seed=3, options=options)[0]
    np.testing.assert_allclose(straight, turned, atol=1e-5)


def test_the_plane_knows_no_side() -> None:
    env = MagWormVectorEnv(1, threads=1)
    with pytest.raises(ValueError, match="'yaw_deg'; allowed: x_m, height_m, angle_deg"):
        env.reset(options={"start": {"yaw_deg": 3.0}})
    env.reset(seed=0)
    assert env.batch.robot_poses()[0, 1:].tolist() == [0.0, 0.0]


def test_bad_starts_are_named(scene: Scene) -> None:
    batch = Batch(scene, 1)
    start = np.array([[0.0, 0.0, 0.0, 0.0, np.nan]])
    keys = np.ones(1, np.bool_), np.zeros(1, np.uint64), np.zeros(1, np.uint64)
    with pytest.raises(ValueError, match="start yaw of environment 0 is NaN rad"):
        batch.reset(*keys, start=start)
    with pytest.raises(ValueError, match=r"start has shape \[1, 3\]; expected \[1, 5\]"):
        batch.reset(*keys, start=start[:, :3])


def test_crawling_in_space_passes_strictly() -> None:
    pytest.importorskip("PIL")

    def make(num_envs: int) -> Any:
        return gymnasium.make_vec(
            CRAWL_ID, num_envs, scene="turn-3", max_episode_steps=6, threads=1, render_mode="rgb_array"
        )

    assert not check_vector_env(make, strict=True).with_outcome("skipped")


def test_the_simplest_controllers_act_in_space(scene: Scene) -> None:
    worms = Runner(scene, 2)
    assert Still().act(worms).tolist() == [[0.0, 0.0, -1.0, 1.0, 0.0]] * 2
    assert UniformlyRandom(0).act(worms).shape == (2, 5)


def drawn(task: str, options: dict[str, Any]) -> np.ndarray:
    env = MagWormVectorEnv(1, task=task, render_mode="rgb_array", threads=1)
    env.reset(seed=0, options=options)
    frames = env.render()
    assert frames is not None
    return frames[0]


def test_a_frame_shows_both_sides_and_the_goal() -> None:
    palette = pytest.importorskip("magworm_gym.render.palette")
    head_left = {"start": {"yaw_deg": 0.0}}
    turn = drawn("turn", {**head_left, "goal_deg": -90.0})
    assert turn.shape == (360, 640, 3) and turn.dtype == np.uint8
    above, beside = turn[:, :320], turn[:, 322:]
    for panel in (above, beside):
        for pole in (palette.NORTH, palette.SOUTH):
            assert (panel == pole).all(axis=2).any()
    # The head looks towards -x; a quarter turn clockwise from above it looks up in the picture.
    rows = np.flatnonzero((above == palette.GOAL).all(axis=2).any(axis=1))
    assert rows.max() < 180 and rows.min() < 60
    reach = drawn("reach", {**head_left, "goal_m": [-0.06, 0.03]})[:, :320]
    row, column = np.argwhere((reach == palette.GOAL).all(axis=2)).mean(axis=0)
    assert row > 200 and column < 100


def test_a_lying_robot_shows_its_other_poles(scene: Scene) -> None:
    render = pytest.importorskip("magworm_gym.render")
    palette = pytest.importorskip("magworm_gym.render.palette")
    record = record_scenes([scene], 0.02)[0]
    over = record.magnet_poses[0].copy()
    over[:, 3:] = [0.0, 1.0, 0.0, 0.0]
    counts = []
    for poses in (record.magnet_poses[0], over):
        frame = render.view_of(scene).draw(replace(record.at(0), magnet_poses=poses))
        counts.append([(frame[:, :320] == pole).all(axis=2).sum() for pole in (palette.NORTH, palette.SOUTH)])
    # Two outer magnets and one between: seen from below their numbers change places.
    (north, south), (south_over, north_over) = counts
    assert north > 1.5 * south and north_over > 1.5 * south_over


def test_a_recording_becomes_a_film(scene: Scene, tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    from magworm_gym.render.animation import write_gif
    from magworm_gym.render.film import film_frames

    # A cantilever has no magnets.
    for each in (scene, Scene.preset("paper-3"), Scene.preset("cantilever")):
        record = record_scenes([each], 0.06)[0]
        frames = list(film_frames(record, each, 320, 180, every=3))
        assert [frame.shape for frame in frames] == [(180, 320, 3)] * 3
        write_gif(tmp_path / "worm.gif", frames, 10.0)
    assert (tmp_path / "worm.gif").read_bytes().startswith(b"GIF89a")
