"""A learner of one's own, in its script of less than sixty lines."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

from magworm_gym import load_policy
from magworm_gym.learning.checkpoints import checkpoints

ROOT = Path(__file__).parent.parent
SCRIPT = ROOT / "examples" / "own_learner.py"


def run(script: Path, *flags: str) -> "subprocess.CompletedProcess[str]":
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([str(ROOT), str(SCRIPT.parent), *filter(None, sys.path)]),
    }
    command = [sys.executable, str(script), "crawl", *flags]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


def test_it_trains_goes_on_and_leaves_a_policy(tmp_path: Path) -> None:
    assert len(SCRIPT.read_text("utf-8").splitlines()) < 60
    flags = ["--num-envs", "4", "--steps", "800", "--seeds", "1", "2", "--checkpoint-steps", "400"]
    outs = [tmp_path / "script", tmp_path / "module"]
    done = run(SCRIPT, "--algorithm", "evolution", *flags, "--workers", "1", "--out", str(outs[0]))
    assert done.returncode == 0, done.stderr
    module = ["--algorithm", "own_learner:evolution", *flags, "--out", str(outs[1])]
    done = run(ROOT / "training" / "train.py", *module, "--workers", "2")
    assert done.returncode == 0, done.stderr
    # Killed after its first checkpoint, the second seed ends as before.
    first, last = checkpoints(outs[1] / "seed-2" / "checkpoints")
    last.unlink()
    (outs[1] / "seed-2" / "finished.json").unlink()
    assert run(ROOT / "training" / "train.py", *module, "--resume").returncode == 0
    assert json.loads((outs[1] / "seed-2" / "finished.json").read_text())["resumed_at_step"] == 400
    kept = [[path.name for path in checkpoints(out / "seed-2" / "checkpoints")] for out in outs]
    assert kept[0] == kept[1] == [first.name, last.name]
    policy = load_policy(outs[0] / "seed-1" / "policy")
    observations, _ = policy.make_vec(num_envs=3).reset(seed=0)
    assert np.isfinite(policy(observations)).all()


def test_its_mistakes_are_sentences(tmp_path: Path) -> None:
    config = tmp_path / "wrong.toml"
    config.write_text("[default.learner]\nnoise = 2\n")
    done = run(SCRIPT, "--algorithm", "evolution", "--config", str(config), "--out", str(tmp_path / "run"))
    assert done.returncode == 2
    assert done.stderr == "own_learner.py: learner.noise is 2; allowed: a number from 0 to 1\n"
