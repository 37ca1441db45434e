"""The comparison of learning algorithms."""

from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

from magworm_gym.learning.learner import Round, learner_named
from magworm_gym.learning.settings import checked
from studies.__main__ import MODULES
from studies.kit.data import read_rows
from studies.kit.study import main
from studies.learners import runs, study
from studies.learners.runs import ALGORITHMS, Run, installed, settings_of, train


def test_training_and_measuring_leave_a_row(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.setattr(study, "RUNS", tmp_path / "runs.csv")
    flags = ["--seconds", "1", "--algorithms", "PPO", "--seeds", "3"]
    assert main(MODULES, ["measure", "learners", *flags]) == 0
    (found,) = read_rows(tmp_path / "runs.csv", Run)
    assert (found.algorithm, found.seed, found.seconds, found.environments) == ("PPO", 3, 1.0, 64)
    assert found.steps > 0 and found.steps % (64 * 32) == 0
    assert -90.0 < found.turned_deg < 90.0 and 0.0 <= found.lost <= 1.0
    assert "PPO, seed 3" in capsys.readouterr().out
    assert "not installed: SAC, TQC and CrossQ." in " ".join(study.text([found]).split())


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_settings_are_those_of_a_learner(algorithm) -> None:
    if not installed(algorithm):
        pytest.skip("needs sb3-contrib")
    settings = settings_of(algorithm)
    options = checked(settings.learner, learner_named(settings.algorithm).Options, "learner")
    assert options.gamma == 0.98 and options.learning_rate.start == options.learning_rate.end == 1e-3


def test_a_training_ends_with_its_time_and_tells_the_reward_of_the_last_tenth(monkeypatch) -> None:
    clock = iter(np.arange(100.0))
    monkeypatch.setattr(runs, "time", SimpleNamespace(process_time=lambda: next(clock)))
    rounds = iter([Round(10, float(number)) for number in range(1, 100)])
    learner = SimpleNamespace(begin=lambda: 5, advance=lambda: next(rounds))
    # Twenty rounds of a second; those that end at 19 and 20 s are the last tenth.
    assert train(learner, 20.0) == (205, (19.0 + 20.0) / 20.0)
