"""Side view, race and files of animations."""

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from magworm_gym import MagWormVectorEnv
from magworm_gym.recording import Moment, Recording
from magworm_gym.render import SideView
from magworm_gym.render.animation import stacked, write_gif, write_mp4
from magworm_gym.render.camera import Camera
from magworm_gym.render.outline import band, rectangle, refinement_matrix, turned
from magworm_gym.render.palette import GOAL, NORTH, RUBBER, RUBBER_LIGHT, SOUTH
from magworm_gym.render.race import race_frames
from magworm_gym.tasks import Crawl, Goal

WIDTH, HEIGHT, SPAN_M, HORIZON = 640, 360, 0.16, 0.4
GEOMETRY: dict[str, Any] = {
    "node_thickness_m": np.full(28, 0.007),
    "magnet_size_m": np.full((3, 3), (0.010, 0.003, 0.010)),
    "magnet_direction": np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]]),
    "magnet_offset_m": np.zeros((3, 3)),
    "drive_size_m": (0.040, 0.005),
    "ground": True,
    "incline_deg": 0.0,
}
MAGNET_X_M = np.array([-0.020, 0.0, 0.020])
DRIVE = np.array([[0.01, -0.03]])
NO_TRAIL = np.zeros((0, 2))


def nodes(x_m: float = 0.0) -> np.ndarray:
    x = np.linspace(-0.027, 0.027, 28) + x_m
    return np.stack([x, np.full_like(x, 0.0035)], axis=1)


def poses(angle: float = 0.0) -> np.ndarray:
    return np.stack([MAGNET_X_M, np.full(3, 0.0035), np.full(3, angle)], axis=1)


def view(**changes: Any) -> SideView:
    geometry = {**GEOMETRY, **changes}
    return SideView(geometry, WIDTH, HEIGHT, span_m=SPAN_M, centre_m=0.0, horizon=HORIZON)


def draw(side_view: SideView, angle: float = 0.0, present: Any = (True, True, True)) -> np.ndarray:
    return side_view.draw(Moment(nodes(), poses(angle), np.array(present), DRIVE, NO_TRAIL))


def pixel(frame: np.ndarray, x_m: float, y_m: float) -> tuple[int, ...]:
    scale = WIDTH / SPAN_M
    column, row = 0.5 * WIDTH + scale * x_m, HORIZON * HEIGHT - scale * y_m
    return tuple(int(value) for value in frame[int(row), int(column)])


def test_frame_is_a_fresh_picture() -> None:
    side_view = view()
    first, second = draw(side_view), draw(side_view)
    assert first.shape == (HEIGHT, WIDTH, 3)
    assert first.dtype == np.uint8
    assert first.flags.writeable and first is not second
    np.testing.assert_array_equal(first, second)
    assert len(np.unique(first.reshape(-1, 3), axis=0)) > 20


@pytest.mark.parametrize(("angle", "turned"), [(0.0, 1.0), (np.pi, -1.0)])
def test_poles_have_their_colours(angle: float, turned: float) -> None:
    frame = draw(view(), angle)
    for x, polarity in zip(MAGNET_X_M, GEOMETRY["magnet_direction"][:, 1], strict=True):
        upper, lower = (NORTH, SOUTH) if polarity * turned > 0 else (SOUTH, NORTH)
        assert pixel(frame, x, 0.0035 + 0.0008) == upper
        assert pixel(frame, x, 0.0035 - 0.0008) == lower


def test_magnets_have_their_own_size_direction_and_place() -> None:
    """The second is longer and points towards the tail, the third lies higher."""
    size, offset = np.array(GEOMETRY["magnet_size_m"]), np.array(GEOMETRY["magnet_offset_m"])
    direction = np.array(GEOMETRY["magnet_direction"])
    size[1, 0], direction[1], offset[2, 1] = 0.014, (1.0, 0.0, 0.0), 0.0015
    frame = draw(view(magnet_size_m=size, magnet_direction=direction, magnet_offset_m=offset))
    assert pixel(frame, 0.006, 0.0035) == NORTH and pixel(frame, -0.006, 0.0035) == SOUTH
    assert pixel(frame, 0.020, 0.0042) == SOUTH and pixel(frame, 0.020, 0.0058) == NORTH


def test_drive_has_its_north_pole_up() -> None:
    frame = draw(view())
    assert pixel(frame, 0.0, -0.03 + 0.0012) == NORTH
    assert pixel(frame, 0.0, -0.03 - 0.0012) == SOUTH


def test_removed_magnet_is_an_outline() -> None:
    frame = draw(view(), present=(True, False, True))
    assert pixel(frame, 0.0, 0.0035 + 0.0008) in (RUBBER, RUBBER_LIGHT)
    assert pixel(frame, 0.020, 0.0035 + 0.0008) == NORTH
    edge = frame[int(HORIZON * HEIGHT - 0.0035 * WIDTH / SPAN_M), int(0.5 * WIDTH - 0.005 * WIDTH / SPAN_M)]
    assert tuple(edge) not in (RUBBER, RUBBER_LIGHT)


def test_body_has_its_thickness() -> None:
    frame = draw(view())
    assert pixel(frame, 0.011, 0.0066) == RUBBER
    assert pixel(frame, 0.011, 0.0080) != RUBBER
    assert pixel(frame, 0.011, 0.0035) == RUBBER_LIGHT


def test_broken_robot_and_scenes_without_ground_are_drawn() -> None:
    side_view = view(ground=False, incline_deg=12.0)
    broken = Moment(np.full((28, 2), np.nan), poses(), np.ones(3, bool), DRIVE, NO_TRAIL)
    frame = side_view.draw(broken, "broken")
    assert frame.shape == (HEIGHT, WIDTH, 3)


def test_trail_and_text_leave_marks() -> None:
    plain = draw(view())
    trail = np.stack([np.linspace(0.06, 0.03, 200), np.full(200, 0.02)], axis=1)
    moment = Moment(nodes(), poses(), np.ones(3, bool), DRIVE, trail)
    marked = view().draw(moment, "1.24 s\n12.3 mm")
    changed = np.any(plain != marked, axis=2)
    assert changed[:60, :120].any(), "text"
    row = int(HORIZON * HEIGHT - 0.02 * WIDTH / SPAN_M)
    assert changed[row - 2 : row + 3, int(0.5 * WIDTH + 0.03 * WIDTH / SPAN_M) :].any(), "trail"


def test_camera_follows_smoothly_and_jumps_to_a_new_episode() -> None:
    camera = Camera(WIDTH, HEIGHT, SPAN_M, horizon=HORIZON)
    camera.follow(0.5)
    assert camera.centre_m == 0.5
    camera.follow(0.49)
    assert 0.49 < camera.centre_m < 0.5
    for _ in range(200):
        camera.follow(0.49)
    assert camera.centre_m == pytest.approx(0.49, abs=1e-6)
    camera.follow(-0.3)
    assert camera.centre_m == -0.3
    camera.follow(float("nan"))
    assert camera.centre_m == -0.3


def test_refined_line_passes_through_its_nodes() -> None:
    matrix = refinement_matrix(7, 4)
    values = np.random.default_rng(0).normal(size=7)
    np.testing.assert_allclose((matrix @ values)[::4], values, atol=1e-12)
    np.testing.assert_allclose(matrix.sum(axis=1), 1.0, atol=1e-12)
    np.testing.assert_allclose(matrix @ np.arange(7.0), np.linspace(0, 6, 25), atol=1e-12)


def test_outlines_have_their_sizes() -> None:
    outline = band(nodes(), np.full(28, 0.007))
    assert np.ptp(outline[:, 1]) == pytest.approx(0.007)
    corners = rectangle((1.0, 2.0), turned(np.pi / 2), (0.4, 0.3))
    assert corners.mean(axis=0) == pytest.approx((1.0, 2.0))
    assert np.ptp(corners[:, 0]) == pytest.approx(0.3)
    assert np.ptp(corners[:, 1]) == pytest.approx(0.4)


@dataclass
class There(Crawl):
    """Crawls to a point."""

    def goal(self, i: int) -> Goal:
        return Goal(point_m=(-0.02, 0.0))


def test_a_goal_in_the_plane_is_a_post() -> None:
    env = MagWormVectorEnv(1, task=There(), threads=1, render_mode="rgb_array")
    env.reset(seed=0)
    frames = env.render()
    assert frames is not None
    rows, columns = np.nonzero((frames[0] == GOAL).all(axis=2))
    assert np.ptp(columns) <= 2 and np.ptp(rows) >= 20 and columns.mean() < 320


@pytest.mark.usefixtures("windowless")
def test_window_shows_a_frame_without_a_screen() -> None:
    side_view = view()
    side_view.show(draw(side_view))
    side_view.close()
    side_view.close()


@pytest.mark.usefixtures("windowless")
def test_windows_live_side_by_side() -> None:
    first, second = (MagWormVectorEnv(1, threads=1, render_mode="human") for _ in range(2))
    for env in (first, second):
        env.reset(seed=0)
    first.close()
    second.step(np.zeros((1, 3)))
    first.reset(seed=0)  # opens another
    second.close()
    first.step(np.zeros((1, 3)))
    first.close()


def test_missing_pygame_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pygame", None)
    side_view = view()
    with pytest.raises(ImportError, match=r"pygame.*magworm-gym\[render\]"):
        side_view.show(draw(side_view))


def test_missing_pillow_is_named_and_only_drawing_needs_it() -> None:
    code = "import sys; sys.modules['PIL'] = None; import magworm_gym.baselines; import magworm_gym.render"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert "Pillow: pip install 'magworm-gym[render]'" in result.stderr.splitlines()[-1]


def recording(speed_m_s: float) -> Recording:
    time_s = np.arange(6) * 0.02
    shift = -speed_m_s * time_s[:, None]
    body, magnets = np.repeat(nodes()[None], 6, axis=0), np.repeat(poses()[None], 6, axis=0)
    body[..., 0] += shift
    magnets[..., 0] += shift
    return Recording(time_s, body, magnets, np.ones(3, bool), np.repeat(DRIVE[None], 6, axis=0))


def test_race_stacks_robots_on_one_axis() -> None:
    recordings = {"fast": recording(0.05), "slow": recording(0.01)}
    frames = list(race_frames(recordings, dict.fromkeys(recordings, GEOMETRY), 320, 90))
    assert len(frames) == 6
    assert frames[0].shape == (182, 320, 3)
    assert recordings["fast"].progress_m[-1] == pytest.approx(0.005)
    assert np.any(frames[0] != frames[-1])


def test_animations_are_written_whole(tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    recordings = {"fast": recording(0.05)}
    frames = list(race_frames(recordings, {"fast": GEOMETRY}, 320, 90))
    write_mp4(tmp_path / "race.mp4", frames, 50.0)
    write_gif(tmp_path / "race.gif", frames, 25.0, 0.5)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["race.gif", "race.mp4"]
    assert (tmp_path / "race.gif").read_bytes().startswith(b"GIF89a")
    assert (tmp_path / "race.mp4").stat().st_size > 1000


def test_animation_without_frames_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="at least one frame"):
        write_gif(tmp_path / "race.gif", [], 25.0)
    assert stacked([np.zeros((11, 21, 3), np.uint8)]).shape == (10, 20, 3)
