"""Drives that do not learn."""

import sys
from typing import Any

import numpy as np
import pytest

from magworm_gym import Batch, MagWormVectorEnv, Scene
from magworm_gym.baselines import (
    TOW_AXES,
    OpenLoop,
    PeriodicStrokes,
    Runner,
    Shuttle,
    Still,
    Stroke,
    StrokeSearch,
    Tow,
    Trial,
    UniformlyRandom,
    belt_scene,
    belt_starts,
    record,
    search,
    stroke_from_unit,
    sweep,
    sweep_belt,
)
from magworm_gym.tasks import Turn

SHORT = Trial(settle_s=0.2, measure_s=0.6)
TINY_SEARCH = StrokeSearch(control_points=3, scouts=8, population=8, starts=1, trial=Trial(0.1, 0.4))


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
    swept = sweep_belt(scene, 0.125, [0.05, 0.1, 0.21], SHORT, starts=2)
    assert swept.speed_m_s.shape == (3, 2)
    assert np.all(np.isfinite(swept.speed_m_s))
    curve = swept.along("drive_speed_m_s")
    assert swept.best["drive_speed_m_s"] == curve[curve[:, 1].argmax(), 0]
    np.testing.assert_array_equal(curve[:, 1], swept.speed_m_s.mean(axis=1))
    for wrong in ([0.0, 0.1], [0.3]):
        with pytest.raises(ValueError, match="limit"):
            sweep_belt(scene, 0.125, wrong, SHORT)


def test_shuttle_goes_round_its_corners(scene: Scene) -> None:
    limits = scene.stage_limits
    assert limits is not None
    worms, shuttle = Runner(scene, 2), Shuttle(0.5, 0.4, 0.1, np.array([1.0, 0.0]))
    worms.begin([0, 1], shuttle)
    seen, works = [], []
    for _ in range(150):
        actions = shuttle.act(worms)
        assert actions.shape == (2, 3)
        assert np.abs(actions).max() <= 1.0
        worms.batch.step(actions)
        seen.append(worms.batch.drive_positions()[:, 0])
        works.append(actions[:, 2] < 1.0)
    path = np.array(seen)
    low, high = limits["lowest_m"], limits["highest_m"]
    assert path[:, 0, 1].min() == pytest.approx(low, abs=2e-3)
    assert path[50:, 1, 1].min() == pytest.approx(high, abs=2e-3)
    steps = np.diff(path[:, 0, 0])[np.array(works)[1:, 0]]
    assert steps.max() == pytest.approx(0.5 * limits["speed_m_s"] * scene.control_step_s, rel=0.05)


def test_shuttle_sweep_gives_the_whole_curve(scene: Scene) -> None:
    axes = {"work_speed": [0.5, 1.0], "half_stroke": [0.2, 0.5], "offset": [0.0], "low_return": [0.0, 1.0]}
    swept = sweep(scene, Shuttle, axes, SHORT, starts=1)
    assert swept.speed_m_s.shape == (2, 2, 1, 2, 1)
    alone = SHORT.speed_m_s(Runner(scene, 1), [0], Shuttle(**swept.best))
    assert alone[0] == swept.speed_m_s.max() == swept.along("half_stroke")[:, 1].max()


def test_stroke_repeats_and_interpolates(scene: Scene) -> None:
    worms = Runner(scene, 2)
    points = np.array([[0.0, -1.0, 1.0], [1.0, 1.0, 1.0]])
    strokes = PeriodicStrokes([Stroke(0.16, points)])
    worms.begin([0, 1], strokes)
    actions = np.array([strokes.act(worms) for _ in range(17)])
    assert actions.shape == (17, 2, 3)
    np.testing.assert_allclose(actions[:8], actions[8:16], atol=1e-12)
    np.testing.assert_allclose(actions[2, 0], [0.5, 0.0, 1.0], atol=1e-12)
    np.testing.assert_allclose(actions[4, 0], points[1], atol=1e-12)
    with pytest.raises(ValueError, match="3 strokes do not fit 2"):
        PeriodicStrokes([Stroke(0.16, points)] * 3).start(worms)


def test_a_speed_measured_in_one_call_is_that_of_stepping(scene: Scene) -> None:
    class Stepped:
        """The same strokes, one action at a time."""

        def __init__(self, strokes: PeriodicStrokes) -> None:
            self.start, self.act = strokes.start, strokes.act

    units = np.random.default_rng(0).uniform(-1.0, 1.0, (11, 13))
    strokes, seeds = [stroke_from_unit(unit) for unit in units], np.arange(11, dtype=np.uint64)
    planned, stepped = PeriodicStrokes(strokes), Stepped(PeriodicStrokes(strokes))
    assert isinstance(planned, OpenLoop) and not isinstance(stepped, OpenLoop)
    speeds = [SHORT.speed_m_s(Runner(scene, 11), seeds, drive) for drive in (planned, stepped)]
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
    done: list[int] = []
    budget_s = 3.5 * TINY_SEARCH.generation_s
    first = TINY_SEARCH.found(scene, budget_s, 1, progress=done.append)
    again = TINY_SEARCH.found(scene, budget_s, 1)
    assert done == [1, 2]
    assert len(first.bests) == 3  # scouts, two generations
    assert TINY_SEARCH.times_s(first)[-1] == pytest.approx(3.0 * TINY_SEARCH.generation_s)
    assert np.all(np.diff(first.bests) >= 0.0)
    assert first.score == first.bests[-1]
    np.testing.assert_array_equal(first.parameters, again.parameters)


def test_a_search_without_progress_begins_again_from_the_next_scout() -> None:
    pytest.importorskip("cmaes")
    centres: list[np.ndarray] = []

    def flat(candidates: np.ndarray) -> np.ndarray:
        centres.append(candidates.mean(axis=0))
        return np.where(np.abs(candidates - 0.5).max(axis=1) == 0.0, 2.0, 1.0)

    scouts = np.array([[-0.5, -0.5], [0.5, 0.5]])
    sizes: Any = {"population": 200, "generations": 5, "sigma": 0.01, "patience": 1}
    found = search(flat, scouts, np.random.default_rng(0), **sizes)
    assert found.score == 2.0 and found.parameters.tolist() == [0.5, 0.5]
    about = [round(float(centre[0]), 1) for centre in centres[1:]]
    assert about == [0.5, -0.5, 0.5, -0.5, 0.5]


def test_a_search_finds_the_top_of_a_hill() -> None:
    pytest.importorskip("cmaes")
    generator = np.random.default_rng(0)
    found = search(
        lambda candidates: -np.square(candidates - 0.3).sum(axis=1),
        generator.uniform(-1.0, 1.0, (8, 3)),
        generator,
        population=12,
        generations=40,
    )
    np.testing.assert_allclose(found.parameters, 0.3, atol=1e-3)


def test_missing_search_library_is_named(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cmaes", None)
    with pytest.raises(ImportError, match=r"magworm-gym\[train\]"):
        TINY_SEARCH.found(scene, 1.0, 0)


def test_tow_holds_its_place(scene: Scene) -> None:
    swept = sweep(scene, Tow, TOW_AXES, SHORT, starts=1)
    assert swept.speed_m_s.shape == (33, 4, 1)
    assert SHORT.speed_m_s(Runner(scene, 1), [0], Tow(**swept.best))[0] == swept.speed_m_s.max()
    np.testing.assert_array_equal(Tow(-0.5, 0.2).act(Runner(scene, 2)), [[-0.5, 0.2, 1.0]] * 2)


def test_parked_drive_leaves_the_robot_in_place(scene: Scene) -> None:
    speed = SHORT.speed_m_s(Runner(scene, 2), [0, 1], Still())
    assert np.abs(speed).max() < 2e-3


def test_speed_is_the_progress_that_the_simulator_reports(scene: Scene) -> None:
    worms, controller = Runner(scene, 3), UniformlyRandom(5)
    speed = Trial(0.0, 0.6).speed_m_s(worms, [0, 1, 2], UniformlyRandom(5))
    reset(worms.batch)
    progress = sum(worms.batch.step(controller.act(worms))[1] for _ in range(30))
    np.testing.assert_allclose(speed * 0.6, progress, atol=2e-3)


def test_trials_ask_for_what_the_scene_needs(scene: Scene) -> None:
    with pytest.raises(ValueError, match="needs a controller"):
        SHORT.speed_m_s(Runner(scene, 1), [0])
    with pytest.raises(ValueError, match="takes none"):
        SHORT.speed_m_s(Runner(belt_scene(scene, 0.125), 1), [0], Still())


def test_recording_holds_every_control_step(scene: Scene) -> None:
    worms = Runner(scene, 2)
    worms.begin([0, 1], Still())
    kept = record(worms, 0.2, environment=1)
    assert kept.time_s.shape == (11,)
    assert kept.nodes.shape[0] == kept.drive_positions.shape[0] == 11
    assert kept.magnet_poses.shape == (11, scene.magnets, 3)
    assert kept.progress_m[0] == 0.0
    assert kept.centre.shape == (11, 2)


def test_a_runner_goes_the_way_of_the_environment() -> None:
    goals, generator = np.array([30.0, -90.0, 60.0]), np.random.default_rng(2)
    plan = generator.uniform(-1.0, 1.0, (40, 3, 5))

    class Planned:
        def start(self, worms: Runner) -> None:
            self.step = 0

        def act(self, worms: Runner) -> np.ndarray:
            self.step += 1
            return plan[self.step - 1]

    worms, env = Runner(Scene.preset("turn-3"), 3, task=Turn()), MagWormVectorEnv(3, "turn-3", task="turn")
    worms.begin([4, 5, 6], Planned(), goals=goals)
    observations, _ = env.reset(seed=[4, 5, 6], options={"goal_deg": goals})
    for actions in plan:
        np.testing.assert_array_equal(worms.observations, observations)
        worms.forward(1)
        observations, *_ = env.step(actions)
    np.testing.assert_array_equal(worms.observations, observations)
    assert worms.going.all() and not worms.lost.any()
