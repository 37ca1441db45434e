"""The study of the joint identification: blind starts, cross-validation, ensemble, judging."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent.parent))

from magworm_gym import Scene
from magworm_gym.identification import read_problem
from magworm_gym.identification.evaluation import Evaluator
from studies.identification import joint, judge, settle_presets

PROBLEM = """
scene = "paper-3"
sample_s = 0.01
[search]
restarts = 2
population = 5
generations = 3
scatter = 8
rounds = 1
fits_within = 3.0
[values]
"drive.motion" = { kind = "constant", x_m = -0.05, y_m = -0.022, speed_m_s = 0.1 }
[parameters]
"material.youngs_modulus_pa" = { low = 45e3, high = 60e3 }
"ground.adhesion_n" = { low = 0.0, high = 9e-3 }
"drive.motion.y_m" = { low = -0.023, high = -0.021 }
[[sweep]]
name = "three"
speeds_m_s = [0.2, 0.4]
[[claim]]
name = "three: stride"
kind = "value"
curve = "three.stride_m"
at_m_s = 0.4
value = 3e-3
within = 3e-3
scale = 1e-3
group = "stride"
[[claim]]
name = "three: peak"
kind = "value"
curve = "three.peak_m.1"
over_m_s = [0.2, 0.4]
value = 8e-3
within = 6e-3
scale = 1e-3
"""


@pytest.fixture
def problem_file(tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(PROBLEM)
    return path


def test_blind_starts_are_run_once_and_give_a_page_and_an_ensemble(tmp_path, monkeypatch, problem_file):
    runs, page, robots = tmp_path / "runs", tmp_path / "joint.md", tmp_path / "robots"
    words = ["--problems", problem_file, "--out", runs, "--page", page, "--ensemble", robots]
    words += ["--conditions", tmp_path / "ensemble.json"]
    sizes = {"seeds": 2, "crossed": 1, "restarts": 2, "generations": 3, "rounds": 1}
    sizes |= {"draft-restarts": 2, "draft-generations": 2, "draft-scatter": 9}
    words += [word for name, size in sizes.items() for word in (f"--{name}", size)]
    monkeypatch.setattr(sys, "argv", ["joint.py", *map(str, words)])
    joint.main()
    assert sorted(folder.name for folder in runs.iterdir()) == [
        f"small-{run}{part}" for run in ("0", "0-without-stride", "1") for part in ("", "-draft")
    ]
    text = page.read_text()
    assert "| stride | small-0-without-stride |" in text and "`ground.adhesion_n`" in text
    problem = read_problem(problem_file)
    scenes = [Scene.from_toml(path.read_text()) for path in sorted(robots.iterdir())]
    assert len(scenes) in (1, 2)
    kept, drafted = (np.load(runs / f"small-0{part}/candidates.npz")["units"] for part in ("", "-draft"))
    assert (np.linalg.norm(kept[0] - drafted, axis=1) < 1e-9).any(), "the second part begins with the first's"
    row = next(line for line in text.splitlines() if line.startswith("| small-0 |"))
    assert f"| {len(kept) + len(drafted)} |" in row
    monkeypatch.setattr(joint, "identify", None)
    page.unlink()
    joint.main()
    assert page.read_text() == text
    assert np.array_equal(np.load(runs / "small-0/candidates.npz")["units"], kept)
    assert len(problem.fitted) == 2


def test_a_scene_is_judged_by_its_own_values(tmp_path, problem_file):
    problem = read_problem(problem_file)
    unit = np.array([0.25, 0.5, 0.75])
    (tmp_path / "robot.toml").write_text(
        problem.base.with_values(problem.space.scene_values(unit)).to_toml(), encoding="utf-8"
    )
    told = "\n".join(judge.table(problem, str(tmp_path / "robot.toml")))
    outcomes = Evaluator(problem).outcomes(unit)
    assert f"loss {sum(outcome.loss for outcome in outcomes):.4g}" in told
    assert all(f"| {outcome.model:.4g} |" in told for outcome in outcomes)


def test_small_losses_fit_whatever_the_least_is(problem_file):
    problem = read_problem(problem_file, {"fits_below": 0.5})
    assert problem.limit(0.01) == 0.5
    assert problem.limit(1.0) == 3.0


def test_presets_are_settled_among_robots_that_fit_and_lie_apart(problem_file):
    problem = read_problem(problem_file, {"fits_below": 0.5})
    units = np.array([[0.5, 0.5, 0.5], [0.5, 0.5, 0.6], [0.1, 0.9, 0.5], [0.9, 0.1, 0.5]])
    chosen = settle_presets.spread(problem, units, np.array([0.2, 0.3, 0.4, 0.9]), 3)
    assert chosen.tolist() == [units[0].tolist(), units[2].tolist(), units[1].tolist()]
    kept = settle_presets.others(problem, units, np.array([0.2, 0.3, 0.4, 0.9]), 1)
    assert [each["loss"] for each in kept] == [0.2, 0.4, 0.9]
    line = settle_presets.marked(
        "damping_time_s", 0.0465, "damping_time_s = 0.002 # effective: why", "identified"
    )
    assert line.split() == ["damping_time_s", "=", "0.0465", "#", "effective:", "why"]
