"""Policies that begin as copies of searched cycles."""

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

from magworm_gym import MagWormVectorEnv, load_policy, load_scene
from magworm_gym.baselines import FAMILIES, CycleSearch, Steered
from magworm_gym.learning import demonstration, train
from magworm_gym.learning.command_line import UsageError
from magworm_gym.tasks import Turn

SHORT = CycleSearch(scouts=4, population=4, generations=1, starts=1, duration_s=0.2)
TAUGHT = """
["MagWorm/Turn-v1"]
num_envs = 8
steps = 8
seeds = [0]
["MagWorm/Turn-v1".environment]
max_episode_steps = 60
["MagWorm/Turn-v1".learner]
n_steps = 8
"""


def test_a_policy_begins_as_a_copy_of_its_teacher(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(demonstration, "SEARCH", SHORT)
    monkeypatch.setattr(demonstration, "STEPS", 120)
    monkeypatch.setattr(demonstration, "EPOCHS", 300)
    config, out = tmp_path / "taught.toml", tmp_path / "run"
    rates = "learning_rate = { start = 1e-9, end = 1e-9 }"
    config.write_text(f"{TAUGHT}\nnormalise = true\nlog_std_init = -1.0\nteacher = 'pair'\n{rates}\n")
    train.main(["turn", "--config", str(config), "--out", str(out)])
    summary = json.loads((out / "seed-0" / "finished.json").read_text())
    assert summary["taught_steps"] == 120 * 8 + 8 * 10  # shown, and searched: eight trials of ten steps
    scene, family = load_scene("turn-3-pair"), FAMILIES["pair"]
    found = SHORT.found(scene, Turn(), family, 0)
    teacher = Steered([family.cycle(found.parameters, scene.stage_limits or {})])
    worms = MagWormVectorEnv(8, scene, task="turn")
    observations, _ = worms.reset(seed=5)
    teacher.start(worms)
    copy = load_policy(out / "seed-0" / "policy")
    wrong, size = [], []
    for _ in range(30):
        wanted = teacher.answer(observations)
        wrong.append(np.square(copy(observations) - wanted).mean())
        size.append(np.square(wanted - np.mean(wanted)).mean())
        observations, *_ = worms.step(wanted)
    assert np.mean(wrong) < 0.25 * np.mean(size)


@pytest.mark.parametrize(
    ("extra", "sentence"),
    [
        ("teacher = 'owl'\nnormalise = true", "teacher is 'owl'"),
        ("teacher = 'pair'", "allowed with normalise = true"),
        ("teacher = 'misaligned'\nnormalise = true", "its own drive"),
    ],
)
def test_teachers_that_do_not_fit_are_named(extra: str, sentence: str, tmp_path: Path) -> None:
    config = tmp_path / "taught.toml"
    config.write_text(f"{TAUGHT}\n{extra}\n")
    with pytest.raises(UsageError, match=sentence):
        train.main(["turn", "--config", str(config), "--out", str(tmp_path / "run")])
    assert not (tmp_path / "run").exists()
