"""Training: settings and their mistakes, folders and their owners, learners."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

from magworm_gym import load_policy
from magworm_gym.learning import seeds, train
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.learner import learner_named
from magworm_gym.learning.owner import owned
from magworm_gym.learning.settings import TrainingSettings, checked, read_saved_settings, read_settings
from magworm_gym.learning.training import new_learner, place_of

ROOT = Path(__file__).parent.parent
CONFIGS = ROOT / "training" / "configs"
HERE = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *filter(None, sys.path)])}
"""Environment variables of a process that finds the package."""
SMALL = """
[default]
num_envs = 8
steps = 1024
seeds = [3]
checkpoint_steps = 256
[default.environment]
max_episode_steps = 50
[default.learner]
hidden = [16]
normalise = true
n_steps = 16
batch_size = 64
n_epochs = 2
gamma = 0.98
"""


@pytest.fixture
def config(tmp_path: Path) -> Path:
    path = tmp_path / "small.toml"
    path.write_text(SMALL)
    return path


def prepared(table: dict[str, Any], folder: Path) -> None:
    """Goes as far as a training does before it touches its folder."""
    settings = checked({"environment_id": "MagWorm/Crawl-v0", **table}, TrainingSettings)
    new_learner(settings, place_of(settings, (), settings.seeds[0]), folder)


WRONG: tuple[Any, ...] = (True, False, -1, 0, 1.5, 10**30, float("nan"), float("inf"), -1e300)
WRONG += ("", "x", "ä" * 200, [], [0], [[1]], [1, "x"], {}, {"x": 1})


def fields() -> list[tuple[str, str, str]]:
    """Algorithm, table and name of every setting."""
    found = [("ppo", "", name) for name in TrainingSettings.__struct_fields__ if name != "environment_id"]
    found += [("ppo", "environment", name) for name in ("scene", "max_episode_steps", "lanes", "near_reward")]
    for algorithm in ("ppo", "sac"):
        found += [(algorithm, "learner", name) for name in learner_named(algorithm).Options.__struct_fields__]
    return [*found, ("ppo", "learner.learning_rate", "start"), ("ppo", "learner.learning_rate", "end")]


@pytest.mark.parametrize(("algorithm", "table", "name"), fields())
def test_a_wrong_value_is_named_in_a_sentence(algorithm: str, table: str, name: str, tmp_path: Path) -> None:
    refused = 0
    for value in WRONG:
        values: dict[str, Any] = {"algorithm": algorithm, "num_envs": 2}
        inner = values
        for part in table.split(".") if table else []:
            inner = inner.setdefault(part, {})
        inner[name] = value
        try:
            prepared(values, tmp_path / "run")
        except UsageError as mistake:
            refused += 1
            assert name in str(mistake) and "\n" not in str(mistake), mistake
            assert len(str(mistake)) < 500
    assert refused >= len(WRONG) / 2
    assert not list(tmp_path.iterdir())


def test_as_many_wrong_values_are_tried() -> None:
    assert len(fields()) * len(WRONG) >= 540


@pytest.mark.parametrize("table", ["", "environment", "learner", "learner.learning_rate"])
def test_an_unknown_setting_is_named(table: str, tmp_path: Path) -> None:
    values: dict[str, Any] = {"num_envs": 2}
    inner = values
    for part in table.split(".") if table else []:
        inner = inner.setdefault(part, {})
    inner["wings"] = 2
    with pytest.raises(UsageError, match="wings") as mistake:
        prepared(values, tmp_path)
    assert "allowed" in str(mistake.value) and "\n" not in str(mistake.value)


@pytest.mark.parametrize(
    ("flags", "sentence"),
    [
        (["crawl", "--bad"], "--bad"),
        (["crawl", "--algorithm", "dqn"], "'dqn'"),
        (["crawl", "--num-envs", "0"], "num_envs is 0"),
        (["crawl", "--seeds", "1", "1"], "seeds is"),
        (["crawl", "--randomise-magnets", "2"], "removed"),
        (["crawl", "--randomise-parameters", "1"], "parameters"),
        (["crawl", "--config", "nowhere.toml"], "no readable file nowhere.toml"),
        (["crawl", "--resume"], "no training to go on with"),
        (["crawl", "--workers", "0"], "'0' is not a whole number"),
        (["crawl", "--scene", "nothing"], "nothing"),
        (["fly"], "'fly'"),
        (["nowhere:Own/Fly-v0"], "'nowhere'"),
        (["crawl", "--algorithm", "nowhere:fly"], "'nowhere'"),
    ],
)
def test_training_names_the_mistake(
    flags: list[str], sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(seeds, "train_seeds", lambda *_: pytest.fail("the training began"))
    out = tmp_path / "run"
    with pytest.raises((UsageError, ValueError)) as mistake:
        train.main([*flags, "--out", str(out)], CONFIGS)
    assert sentence in str(mistake.value)
    assert "\n" not in str(mistake.value)
    assert not out.exists()


@pytest.mark.parametrize(
    ("text", "sentence"),
    [("a = [", "is not TOML"), ("[fly]", "'default'"), ("default = 3", "'default'"), ("\0", "is not TOML")],
)
def test_a_broken_file_of_settings_is_named(text: str, sentence: str, tmp_path: Path) -> None:
    path = tmp_path / "broken.toml"
    path.write_text(text)
    with pytest.raises(UsageError, match=sentence):
        train.main(["crawl", "--config", str(path), "--out", str(tmp_path / "run")])
    assert list(tmp_path.iterdir()) == [path]


def test_every_shipped_table_is_one_that_a_learner_takes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    for path in (CONFIGS / "ppo.toml", CONFIGS / "sac.toml"):
        for environment_id in train.ENVIRONMENTS.values():
            settings = read_settings(path, environment_id, {"num_envs": 2})
            new_learner(settings, place_of(settings, (), 0), tmp_path)
    assert not list(tmp_path.iterdir())


def test_training_refuses_to_mix_runs(config: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    out.mkdir()
    settings = TrainingSettings(environment_id=train.ENVIRONMENTS["crawl"])
    (out / "settings.json").write_bytes(msgspec.json.encode(settings))
    with pytest.raises(UsageError, match="holds a training already"):
        train.main(["crawl", "--config", str(config), "--out", str(out)])
    for flags, sentence in (
        (["crawl", "--num-envs", "8"], "started with num_envs 256"),
        (["crawl", "--scene", "paper-4"], "started with environment"),
        (["turn"], "started with environment_id"),
    ):
        with pytest.raises(UsageError, match=sentence):
            train.main([*flags, "--resume", "--out", str(out)])
    assert read_saved_settings(out / "settings.json") == settings


@pytest.mark.parametrize("content", [b"", b"\0" * 100, b"[1]", b'{"steps": "x"}', b"{" * 10_000])
def test_damaged_settings_of_a_run_are_named(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "settings.json").write_bytes(content)
    with pytest.raises(UsageError) as mistake:
        train.main(["crawl", "--resume", "--out", str(tmp_path)])
    assert "\n" not in str(mistake.value)


def test_one_process_owns_a_folder(config: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    with (
        owned(out),
        pytest.raises(UsageError, match=f"process {os.getpid()} is at work"),
    ):
        train.main(["crawl", "--config", str(config), "--out", str(out)])
    assert not (out / "settings.json").exists()


def test_seeds_side_by_side_end_as_one_after_the_other(config: Path, tmp_path: Path) -> None:
    flags = ["crawl", "--config", str(config), "--steps", "256", "--seeds", "3", "4"]
    weights = []
    for workers in ("1", "2"):
        train.main([*flags, "--workers", workers, "--out", str(tmp_path / workers)])
        weights.append((tmp_path / workers / "seed-3" / "policy" / "weights.safetensors").read_bytes())
    assert weights[0] == weights[1]


def program(config: Path, out: Path) -> list[str]:
    """The command that trains."""
    command = [sys.executable, str(ROOT / "training" / "train.py"), "crawl", "--config", str(config)]
    return [*command, "--out", str(out)]


def failed(command: list[str]) -> str:
    """What a command says that ends with a mistake."""
    done = subprocess.run(command, env=HERE, capture_output=True, text=True, check=False)
    assert done.returncode == 2, done.stderr
    assert len(done.stderr.splitlines()) == 1 and done.stderr.startswith("train.py: "), done.stderr
    return done.stderr


@contextmanager
def long_training(config: Path, out: Path) -> "Iterator[subprocess.Popen[str]]":
    """A training of two seeds in processes of their own, once it has begun."""
    command = [*program(config, out), "--steps", "100000000", "--seeds", "3", "4", "--workers", "2"]
    process = subprocess.Popen(
        command,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env=HERE,
        start_new_session=True,
    )
    try:
        deadline = time.monotonic() + 300.0
        while len(list(out.glob("seed-*/checkpoints/*.safetensors"))) < 2:
            assert process.poll() is None and time.monotonic() < deadline
            time.sleep(0.05)
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


@pytest.mark.skipif(os.name == "nt", reason="looks at a group of processes")
def test_workers_end_with_a_process_that_is_killed(config: Path, tmp_path: Path) -> None:
    with long_training(config, tmp_path / "run") as process:
        process.kill()
        process.communicate(timeout=60.0)  # until the last worker has closed its end
        deadline = time.monotonic() + 60.0
        with pytest.raises(ProcessLookupError):
            while time.monotonic() < deadline:
                os.killpg(process.pid, 0)
                time.sleep(0.05)


@pytest.mark.skipif(os.name == "nt", reason="sends SIGINT")
def test_ctrl_c_says_how_to_go_on(config: Path, tmp_path: Path) -> None:
    with long_training(config, tmp_path / "run") as process:
        os.killpg(process.pid, signal.SIGINT)
        said = process.communicate(timeout=60.0)[1]
    assert process.returncode == 130
    assert said.splitlines()[-1].startswith("train.py: stopped; this goes on from the newest checkpoint: ")
    assert said.rstrip().endswith("--resume") and "Traceback" not in said


@pytest.mark.skipif(os.name == "nt", reason="limits the size of files")
def test_a_full_disk_is_one_sentence(config: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    failed(["bash", "-c", 'ulimit -f 8; exec "$@"', "bash", *program(config, out)])
    assert not list(out.glob("seed-3/checkpoints/*.safetensors"))


def test_a_folder_that_cannot_be_made_is_one_sentence(config: Path, tmp_path: Path) -> None:
    assert "Not a directory" in failed(program(config, config / "run"))


def test_a_mistake_is_one_line(config: Path, tmp_path: Path) -> None:
    assert "nothing" in failed([*program(config, tmp_path / "run"), "--scene", "nothing"])
    assert list(tmp_path.iterdir()) == [config]


def test_a_training_that_diverges_is_one_sentence(config: Path, tmp_path: Path) -> None:
    table = (
        "learning_rate = { start = 1.0, end = 1.0 }\nmax_grad_norm = 1e6\nlog_std_init = 2.0\nvf_coef = 1e6\n"
    )
    config.write_text(
        SMALL.replace("gamma = 0.98\n", f"gamma = 0.98\n{table}").replace("n_epochs = 2", "n_epochs = 200")
    )
    with pytest.raises(UsageError, match="diverged"):
        train.main(["crawl", "--config", str(config), "--out", str(tmp_path / "run")])


def test_a_policy_says_where_it_comes_from(config: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    train.main(["crawl", "--config", str(config), "--steps", "128", "--out", str(out)])
    policy = load_policy(out / "seed-3" / "policy")
    assert policy.environment_id == "MagWorm/Crawl-v0"
    assert policy.provenance["settings"]["steps"] == 128 and policy.provenance["seed"] == 3
    worms = policy.make_vec(num_envs=2)
    observations, _ = worms.reset(seed=0)
    assert np.isfinite(policy(observations)).all() and worms.max_episode_steps == 50
    summary = json.loads((out / "seed-3" / "finished.json").read_text())
    assert summary["steps"] == 128 and summary["curve"][-1][0] == 128
    assert list((out / "seed-3" / "tensorboard").iterdir())


def test_a_training_goes_on_where_another_scene_has_its_presets_name(config: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    train.main(["crawl", "--config", str(config), "--steps", "128", "--out", str(out)])
    kept = (out / "scene.toml").read_text("utf-8")
    (out / "scene.toml").write_text(kept.replace('name = "paper-3"', 'name = "mine"'), "utf-8")
    (out / "seed-3" / "finished.json").unlink()
    train.main(["crawl", "--resume", "--out", str(out)])
    assert load_policy(out / "seed-3" / "policy").scene.name == "mine"
