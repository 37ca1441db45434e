"""Training and comparison of turning and reaching: pilots, searches, reports, command lines."""

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")
pytest.importorskip("matplotlib")


from magworm_gym import MagWormVectorEnv, Scene, load_scene
from magworm_gym.learning import (
    demonstration,
)
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.compare import evaluate_goals
from magworm_gym.learning.compare.goal_report import table, verdict
from magworm_gym.learning.compare.goal_search import SearchSize, score_of
from magworm_gym.learning.compare.goal_trials import Flight, fly
from magworm_gym.learning.compare.pilots import FAMILIES, PARK, Cycle, Steered
from magworm_gym.learning.settings import CONFIGS, read_settings
from magworm_gym.learning.train import ENVIRONMENTS

TINY = """
[training]
num_envs = 4
steps = 128
seeds = [0, 1]
[search]
seeds = 2
scouts = 4
population = 4
generations = 1
starts = 1
duration_s = 0.2
[final]
starts = 1
duration_s = 0.4
animation_s = 0.2
"""
SHORT = SearchSize(seeds=1, scouts=4, population=4, generations=1, starts=1, duration_s=0.2)
HOLD = Cycle(np.array([0.04, 0.02]), np.array([[0.1, 0.2, 0.3, 0.4, 0.5], [-0.1, -0.2, -0.3, -0.4, -0.5]]))


def acted(goals: list[float], steps: int, cycle: Cycle = HOLD) -> np.ndarray:
    """Actions (T, N, 5) of a steered cycle towards goals [°], the robots held as they begin."""
    worms = MagWormVectorEnv(len(goals), "turn-3", task="turn")
    observations, _ = worms.reset(seed=0, options={"goal_deg": np.array(goals)})
    pilot = Steered([cycle])
    pilot.start(worms)
    return np.array([pilot.act(observations) for _ in range(steps)])


def test_a_cycle_is_mirrored_to_the_side_of_the_goal_and_parks_at_it() -> None:
    left, right, there = np.moveaxis(acted([45.0, -45.0, 0.5], 4), 1, 0)
    assert np.array_equal(left, HOLD.points[[0, 0, 1, 0]])
    assert np.array_equal(right, left * [1.0, -1.0, 1.0, 1.0, -1.0])
    assert np.array_equal(there, np.tile(PARK, (4, 1)))


def test_a_smooth_cycle_goes_over_linearly() -> None:
    smooth = Cycle(HOLD.durations_s, HOLD.points, smooth=True)
    assert np.allclose(acted([45.0], 3, smooth)[:, 0, 0], [0.1, 0.0, -0.1])


def test_a_cycle_towards_a_point_keeps_straight_where_it_is_ahead() -> None:
    worms = MagWormVectorEnv(3, "turn-3", task="reach")
    goals = np.array([[-0.05, 0.0], [-0.03, 0.03], [-0.03, -0.03]])
    observations, _ = worms.reset(seed=0, options={"goal_m": goals})
    pilot = Steered([HOLD])
    pilot.start(worms)
    ahead, left, right = pilot.act(observations)
    assert ahead[[1, 4]].tolist() == [0.0, 0.0]
    assert np.array_equal(left, HOLD.points[0]) and np.array_equal(right[[1, 4]], -left[[1, 4]])


@pytest.mark.parametrize("name", list(FAMILIES))
def test_families_make_cycles_that_the_stage_can_follow(name: str) -> None:
    family, scene = FAMILIES[name], Scene.preset("turn-3")
    generator = np.random.default_rng(0)
    assert family.scene(scene).controlled
    for unit in generator.uniform(-1.0, 1.0, (20, family.size)):
        cycle = family.cycle(unit, scene.stage_limits or {})
        assert len(cycle.durations_s) == len(cycle.points) and (cycle.durations_s > 0.0).all()
        assert np.abs(cycle.points).max() <= 1.0


def test_a_flight_holds_what_was_left_and_counts_times_to_the_end() -> None:
    left = np.array([[30.0, -90.0], [10.0, -90.0], [2.0, -60.0], [5.0, -45.0]])
    flight = Flight(left, np.array([False, False]), 0.5)
    assert flight.time_until_s(3.0).tolist() == [1.0, 1.5]
    first, second = score_of(flight, "turn")
    assert first == pytest.approx(
        np.mean([0, 20 / 30, 28 / 30, 25 / 30]) / 2 + np.mean([0, 20, 28, 25]) / 180
    )
    assert second == pytest.approx(np.mean([0, 0, 1, 1]) / 2 + np.mean([0, 0, 30, 45]) / 180)


def test_a_still_robot_reaches_nothing_and_is_not_lost() -> None:
    parked = Cycle(np.array([1.0]), PARK[None])
    flight = fly(Scene.preset("turn-3"), "turn", Steered([parked]), np.array([30.0, -90.0]), [0, 1], 0.3)
    assert flight.left.shape == (16, 2) and not flight.lost.any()
    assert np.allclose(np.abs(flight.left[-1]), [30.0, 90.0], atol=1.0)


@pytest.mark.parametrize("task", ["turn", "reach"])
def test_a_comparison_leaves_a_report_and_is_not_done_twice(
    task: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(demonstration, "SEARCH", SHORT)
    monkeypatch.setattr(demonstration, "STEPS", 10)
    budget, out = tmp_path / "tiny.toml", tmp_path / "run"
    budget.write_text(TINY)
    flags = [task, "--budget", str(budget), "--out", str(out), "--workers", "1"]
    evaluate_goals.main(flags)
    first = capsys.readouterr().out
    files = {path.name for path in out.iterdir() if path.is_file()}
    assert files == {"report.md", "results.json", f"{task}.png", f"{task}.mp4", f"{task}.gif"}
    results = json.loads((out / "results.json").read_text())
    titles = [row["rival"] for row in results["rivals"]]
    assert titles == ["learned policy", *(family.title for family in FAMILIES.values())]
    text = (out / "report.md").read_text()
    assert results["verdict"] in text and results["verdict"] in first
    assert "censored" in text and all(title in text for title in titles)

    evaluate_goals.main(flags)
    again = capsys.readouterr().out
    assert again.count("kept from an earlier run") == 2 + 2 * 2 * len(FAMILIES)
    assert json.loads((out / "results.json").read_text()) == results
    with pytest.raises(UsageError, match="other settings"):
        evaluate_goals.main([task, "--budget", "smoke", "--out", str(out)])


def rows(**samples: list[float]) -> list[dict[str, object]]:
    return [
        {
            "rival": name,
            "samples": {"time_to_30_deg_s": values, "final_error_deg": [value / 2.0 for value in values]},
            "curves": [],
        }
        for name, values in samples.items()
    ]


def test_the_verdict_goes_by_intervals() -> None:
    made = rows(learned=[3.0, 3.1, 3.2], belt=[9.0, 9.1, 9.5], pair=[2.0, 2.1, 2.2], free=[3.0, 3.3, 3.1])
    text = verdict(made)
    assert "beats the rival “belt” in time to 30°: 3.1 against 9.2 s" in text
    assert "does not beat the rival “pair”" in text
    assert "cannot be told, their intervals overlap, from the rival “free”" in text
    assert text.endswith("Best in time to 30°: pair.")
    assert "| belt | 9.2 [9.0, 9.5] |" in table(made)


def test_the_verdict_says_where_nobody_gets_there() -> None:
    made = rows(learned=[20.0, 20.0], belt=[20.0, 20.0])
    assert verdict(made).startswith("Nobody reached a goal in the time given.")
    assert "final heading error" in verdict(made)


def test_each_task_has_its_settings_and_scene() -> None:
    for task in ("turn", "reach"):
        settings = read_settings(CONFIGS / "ppo.toml", ENVIRONMENTS[task], {})
        assert len(settings.seeds) >= 5
        single = load_scene("turn-3-pair").with_values(
            {"name": "turn-3", **dict(FAMILIES["misaligned"].edits)}
        )
        assert single == Scene.preset("turn-3")
        for budget in ("smoke", "small", "full"):
            trained = evaluate_goals.read_goal_budget(task, budget).training
            assert trained.environment_id == ENVIRONMENTS[task]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("[fly]", "unknown table"),
        ("[final]\nwings = 2", "'wings'"),
        ("[search]\nseeds = 0", "seeds is 0"),
        ("[search]\nscouts = 1.5", "scouts is 1.5"),
    ],
)
def test_broken_budgets_are_named(text: str, sentence: str, tmp_path: Path) -> None:
    path = tmp_path / "broken.toml"
    path.write_text(text)
    with pytest.raises(UsageError, match=sentence):
        evaluate_goals.read_goal_budget("turn", str(path))
