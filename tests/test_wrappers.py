"""Gymnasium's vector wrappers on the native environment, in each mode that they allow."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium.vector import AutoresetMode
from gymnasium.wrappers.vector import (
    DictInfoToList,
    NormalizeObservation,
    NormalizeReward,
    RecordEpisodeStatistics,
    RecordVideo,
)

from magworm_gym import MagWormVectorEnv

MODES = list(AutoresetMode)


def crawl(mode: AutoresetMode, **kwargs: Any) -> MagWormVectorEnv:
    return MagWormVectorEnv(2, **{"max_episode_steps": 4, "threads": 1, "autoreset_mode": mode, **kwargs})


def play(env: Any, steps: int) -> list[Any]:
    """Plays, resetting where the caller has to."""
    returns = []
    env.reset(seed=0)
    for actions in np.random.default_rng(0).uniform(-1, 1, (steps, 2, 3)):
        returns.append(env.step(actions))
        done = returns[-1][2] | returns[-1][3]
        if env.metadata["autoreset_mode"] is AutoresetMode.DISABLED and done.any():
            env.reset(options={"reset_mask": done})
    return returns


@pytest.mark.parametrize("mode", MODES)
def test_record_episode_statistics(mode: AutoresetMode) -> None:
    env = RecordEpisodeStatistics(crawl(mode))
    returns = play(env, 9)
    rewards = np.stack([step[1] for step in returns])
    np.testing.assert_allclose(env.return_queue[0], rewards[:4, 0].sum())
    assert list(env.length_queue) == [4, 4] * (len(env.length_queue) // 2)
    assert env.episode_count == 4
    np.testing.assert_array_equal(returns[3][4]["episode"]["l"], [4, 4])


def test_statistics_survive_a_partial_reset() -> None:
    env = RecordEpisodeStatistics(crawl(AutoresetMode.DISABLED))
    env.reset(seed=0)
    env.step(np.zeros((2, 3)))
    env.reset(options={"reset_mask": np.array([True, False])})
    for _ in range(3):
        *_, infos = env.step(np.zeros((2, 3)))
    np.testing.assert_array_equal(infos["episode"]["l"], [0, 4])


def test_normalize_observation() -> None:
    env = NormalizeObservation(crawl(AutoresetMode.NEXT_STEP))
    observations = np.stack([step[0] for step in play(env, 40)])
    assert np.isfinite(observations).all()
    assert observations.dtype == np.float32


@pytest.mark.parametrize("mode", MODES)
def test_normalize_reward(mode: AutoresetMode) -> None:
    rewards = np.stack([step[1] for step in play(NormalizeReward(crawl(mode)), 12)])
    assert np.isfinite(rewards).all()


@pytest.mark.parametrize("mode", MODES)
def test_infos_as_lists(mode: AutoresetMode) -> None:
    for *_, truncated, infos in play(DictInfoToList(crawl(mode)), 9):
        for ended, info in zip(truncated, infos, strict=True):
            last = info.get("final_info", info)
            assert ("time_limit" in last) == ended


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.filterwarnings("ignore:.*autoreset mode is same-step.*")
def test_record_video(mode: AutoresetMode, tmp_path: Path) -> None:
    pytest.importorskip("moviepy")
    pytest.importorskip("PIL")
    env = RecordVideo(
        crawl(mode, render_mode="rgb_array", render_envs=(0, 1)),
        str(tmp_path / "videos"),
        episode_trigger=lambda episode: episode == 0,
        video_aspect_ratio=(1, 1),
    )
    play(env, 6)
    env.close()
    videos = list((tmp_path / "videos").glob("*.mp4"))
    assert len(videos) == 1
    assert videos[0].stat().st_size > 1000


def test_frames_of_chosen_environments() -> None:
    pytest.importorskip("PIL")
    env = MagWormVectorEnv(3, render_mode="rgb_array", render_envs=(2,), threads=1)
    env.reset(seed=0)
    frames = env.render()
    assert frames is not None and len(frames) == 3
    assert [bool(frame.any()) for frame in frames] == [False, False, True]
    again = env.render()
    assert again is not None and not np.shares_memory(frames[2], again[2])
    env.close()
    env.close()


@pytest.mark.usefixtures("windowless")
def test_a_window() -> None:
    env = MagWormVectorEnv(2, render_mode="human", threads=1)
    env.reset(seed=0)
    env.step(np.zeros((2, 3)))
    assert env.render() is None
    env.close()
