"""Drives that do not learn."""

import sys

import numpy as np
import pytest

from magworm_gym import Batch, Scene
from magworm_gym.baselines import (
    OpenLoop,
    PeriodicStrokes,
    SearchSettings,
    Shuttle,
    Still,
    Stroke,
    Tow,
    Trial,
    UniformlyRandom,
    belt_scene,
    belt_starts,
    crawl_speed_m_s,
    record,
    search_stroke,
    stroke_from_unit,
    sweep_belt,
    sweep_shuttle,
    sweep_tow,
)

SHORT = Trial(settle_s=0.2, measure_s=0.6)
TINY_SEARCH = SearchSettings(control_points=3, scouts=8, population=8, starts=1, trial=Trial(0.1, 0.4))


@pytest.fixture(scope="module")
def scene() -> Scene:
    return Scene.preset("paper-3")


def reset(batch: Batch) -> None:
    number = np.arange(batch.num_envs, dtype=np.uint64)
    batch.reset(np.ones(batch.num_envs, bool), number, np.zeros_like(number))


def test_belt_keeps_the_robot_and_the_limits(scene: Scene) -> None:
    belt = belt_scene(scene, 0.125)
    assert not belt.controlled
    assert belt.magnets == scene.magnets
    batch = Batch(belt, 1)
    reset(batch)
    before = batch.drive_positions()[0]
    assert np.all(before[:, 1] == pytest.approx(scene.stage_limits["highest_m"]))  # type: ignore[index]
    batch.advance(0.1)
    moved = batch.drive_positions()[0, :, 0] - before[:, 0]
    limit = scene.stage_limits["speed_m_s"]  # type: ignore[index]
    assert np.median(moved) == pytest.approx(0.1 * limit, rel=1e-6)
    with pytest.raises(ValueError, match="controlled"):
        belt_scene(belt, 0.125)


def test_belt_starts_spread_over_the_pitch() -> None:
    starts = belt_starts(0.125, 5, seed=3)
    assert starts.shape == (5, 3)
    parts = np.floor((starts[:, 0] / 0.125 + 0.5) * 5)
    np.testing.assert_array_equal(parts, np.arange(5))
    np.testing.assert_array_equal(starts[:, 1:], 0.0)
    np.testing.assert_array_equal(starts, belt_starts(0.125, 5, seed=3))


def test_belt_sweep_gives_the_whole_curve(scene: Scene) -> None:
    curve = sweep_belt(scene, 0.125, [0.05, 0.1, 0.21], SHORT, starts=2)
    assert curve.speed_m_s.shape == (3, 2)
    assert np.all(np.isfinite(curve.speed_m_s))
    assert curve.speed_m_s[curve.best].mean() == curve.speed_m_s.mean(axis=1).max()
    for wrong in ([0.0, 0.1], [0.3]):
        with pytest.raises(ValueError, match="limit"):
            sweep_belt(scene, 0.125, wrong, SHORT)


def test_shuttle_goes_round_its_corners(scene: Scene) -> None:
    limits = scene.stage_limits
    assert limits is not None
    batch = Batch(scene, 2)
    reset(batch)
    shuttle = Shuttle(0.5, 0.4, 0.1, np.array([True, False]))
    shuttle.start(batch)
    seen, works = [], []
    for _ in range(150):
        actions = shuttle.act(batch)
        assert actions.shape == (2, 3)
        assert np.abs(actions).max() <= 1.0
        batch.step(actions)
        seen.append(batch.drive_positions()[:, 0])
        works.append(actions[:, 2] < 1.0)
    path = np.array(seen)
    low, high = limits["lowest_m"], limits["highest_m"]
    assert path[:, 0, 1].min() == pytest.approx(low, abs=2e-3)
    assert path[50:, 1, 1].min() == pytest.approx(high, abs=2e-3)
    steps = np.diff(path[:, 0, 0])[np.array(works)[1:, 0]]
    assert steps.max() == pytest.approx(0.5 * limits["speed_m_s"] * scene.control_step_s, rel=0.05)


def test_shuttle_sweep_gives_the_whole_curve(scene: Scene) -> None:
    curve = sweep_shuttle(scene, [0.1, 0.2], SHORT, starts=1, half_strokes=(0.2, 0.5), offsets=(0.0,))
    assert curve.speed_m_s.shape == (2, 2, 1, 2, 1)
    assert curve.speed_m_s[curve.best].mean() == curve.best_per_drive_speed_m_s.max()
    assert isinstance(curve.best_shuttle(0.21), Shuttle)


def test_stroke_repeats_and_interpolates(scene: Scene) -> None:
    batch = Batch(scene, 2)
    points = np.array([[0.0, -1.0, 1.0], [1.0, 1.0, 1.0]])
    strokes = PeriodicStrokes([Stroke(0.16, points)])
    strokes.start(batch)
    actions = np.array([strokes.act(batch) for _ in range(17)])
    assert actions.shape == (17, 2, 3)
    np.testing.assert_allclose(actions[:8], actions[8:16], atol=1e-12)
    np.testing.assert_allclose(actions[2, 0], [0.5, 0.0, 1.0], atol=1e-12)
    np.testing.assert_allclose(actions[4, 0], points[1], atol=1e-12)
    with pytest.raises(ValueError, match="3 strokes do not fit 2"):
        PeriodicStrokes([Stroke(0.16, points)] * 3).start(batch)


def test_a_speed_measured_in_one_call_is_that_of_stepping(scene: Scene) -> None:
    class Stepped:
        """The same strokes, one action at a time."""

        def __init__(self, strokes: PeriodicStrokes) -> None:
            self.start, self.act = strokes.start, strokes.act

    units = np.random.default_rng(0).uniform(-1.0, 1.0, (11, 13))
    strokes, seeds = [stroke_from_unit(unit) for unit in units], np.arange(11, dtype=np.uint64)
    planned, stepped = PeriodicStrokes(strokes), Stepped(PeriodicStrokes(strokes))
    assert isinstance(planned, OpenLoop) and not isinstance(stepped, OpenLoop)
    speeds = [crawl_speed_m_s(Batch(scene, 11), SHORT, seeds, drive) for drive in (planned, stepped)]
    assert np.count_nonzero(speeds[0]) > 5
    np.testing.assert_array_equal(*speeds)


def test_stroke_from_optimiser_coordinates() -> None:
    stroke = stroke_from_unit(np.array([-1.0, *np.linspace(-2.0, 2.0, 6)]))
    assert stroke.period_s == pytest.approx(0.1)
    assert stroke.points.shape == (2, 3)
    assert np.abs(stroke.points).max() == 1.0
    assert stroke_from_unit(np.array([1.0, 0.0, 0.0, 0.0])).period_s == pytest.approx(1.5)
    with pytest.raises(ValueError, match="1 \\+ 3 K"):
        stroke_from_unit(np.zeros(6))


def test_search_keeps_to_its_budget_and_seed(scene: Scene) -> None:
    pytest.importorskip("cmaes")
    spent: list[float] = []
    budget_s = 3.5 * TINY_SEARCH.generation_s
    first = search_stroke(scene, budget_s, 1, TINY_SEARCH, progress=spent.append)
    again = search_stroke(scene, budget_s, 1, TINY_SEARCH)
    assert len(first.simulated_s) == 3  # scouts, two generations
    assert first.simulated_s[-1] <= budget_s
    assert spent == first.simulated_s[1:].tolist()
    assert np.all(np.diff(first.best_m_s) >= 0.0)
    assert first.speed_m_s == first.best_m_s[-1]
    np.testing.assert_array_equal(first.stroke.points, again.stroke.points)


def test_missing_search_library_is_named(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cmaes", None)
    with pytest.raises(ImportError, match=r"magworm-gym\[train\]"):
        search_stroke(scene, 1.0, 0, TINY_SEARCH)


def test_tow_holds_its_place(scene: Scene) -> None:
    curve = sweep_tow(scene, SHORT, starts=1)
    assert curve.speed_m_s.shape == (33, 4, 1)
    place, height = curve.best
    assert curve.speed_m_s[place, height, 0] == curve.speed_m_s.max()
    np.testing.assert_array_equal(Tow(-0.5, 0.2).act(Batch(scene, 2)), [[-0.5, 0.2, 1.0]] * 2)


def test_parked_drive_leaves_the_robot_in_place(scene: Scene) -> None:
    batch = Batch(scene, 2)
    speed = crawl_speed_m_s(batch, SHORT, np.arange(2, dtype=np.uint64), Still())
    assert np.abs(speed).max() < 2e-3


def test_speed_is_the_progress_that_the_simulator_reports(scene: Scene) -> None:
    batch, controller = Batch(scene, 3), UniformlyRandom(5)
    seeds = np.arange(3, dtype=np.uint64)
    speed = crawl_speed_m_s(batch, Trial(0.0, 0.6), seeds, UniformlyRandom(5))
    reset(batch)
    progress = sum(batch.step(controller.act(batch))[1] for _ in range(30))
    np.testing.assert_allclose(speed * 0.6, progress, atol=2e-3)


def test_trials_ask_for_what_the_scene_needs(scene: Scene) -> None:
    seeds = np.zeros(1, dtype=np.uint64)
    with pytest.raises(ValueError, match="needs a controller"):
        crawl_speed_m_s(Batch(scene, 1), SHORT, seeds)
    with pytest.raises(ValueError, match="takes none"):
        crawl_speed_m_s(Batch(belt_scene(scene, 0.125), 1), SHORT, seeds, Still())


def test_recording_holds_every_control_step(scene: Scene) -> None:
    kept = record(Batch(scene, 2), 0.2, np.arange(2, dtype=np.uint64), Still(), environment=1)
    assert kept.time_s.shape == (11,)
    assert kept.nodes.shape[0] == kept.drive_positions.shape[0] == 11
    assert kept.magnet_poses.shape == (11, scene.magnets, 3)
    assert kept.progress_m[0] == 0.0
    assert kept.centre.shape == (11, 2)
