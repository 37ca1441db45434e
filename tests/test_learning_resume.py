"""Trainings that were killed, and checkpoints that are damaged."""

import json
import os
import pickle
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

from killed_trainings import CASES, kill_at_random

from magworm_gym.learning import train, training
from magworm_gym.learning.checkpoints import checkpoints, newest_checkpoint, save_checkpoint
from magworm_gym.learning.command_line import UsageError

SMALL = """
[default]
algorithm = "{algorithm}"
num_envs = 4
steps = 96
seeds = [3]
checkpoint_steps = 32
[default.environment]
max_episode_steps = 9
scene = "{scene}"
randomise = {{ removed = 0.5, parameters = 0.1 }}
[default.learner]
hidden = [8]
normalise = true
use_sde = true
sde_sample_freq = 4
batch_size = 16
"""
PPO = SMALL + "n_steps = 8\nn_epochs = 2\n"
SAC = SMALL + "learning_starts = 40\nbuffer_size = 64\ngradient_steps = 2\n"


def settings_of(task: str, text: str, tmp_path: Path) -> list[str]:
    algorithm, scene = "sac" if text is SAC else "ppo", "paper-4" if task == "crawl" else "turn-3-pair"
    config = tmp_path / "small.toml"
    config.write_text(text.format(algorithm=algorithm, scene=scene))
    return [task, "--config", str(config)]


def last(out: Path) -> str:
    """The last checkpoint's name, with the checksum of all that changes in a training."""
    return checkpoints(out / "seed-3" / "checkpoints")[-1].name


@pytest.mark.parametrize("task", ["crawl", "turn"])
@pytest.mark.parametrize("text", [PPO, SAC], ids=["ppo", "sac"])
def test_a_training_stopped_at_any_checkpoint_ends_as_another(
    task: str, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    flags = settings_of(task, text, tmp_path)
    train.main([*flags, "--out", str(tmp_path / "whole")])
    saved: list[int] = []

    def save_and_stop(folder: Path, steps: int, state: Any) -> None:
        save_checkpoint(folder, steps, state)
        saved.append(steps)
        raise KeyboardInterrupt

    monkeypatch.setattr(training, "save_checkpoint", save_and_stop)
    for resume in ([], ["--resume"], ["--resume"]):
        with pytest.raises(KeyboardInterrupt):
            train.main([*flags, *resume, "--out", str(tmp_path / "parts")])
    monkeypatch.undo()
    train.main([task, "--resume", "--out", str(tmp_path / "parts")])
    assert saved == [32, 64, 96]
    assert last(tmp_path / "parts") == last(tmp_path / "whole")
    finished = [
        json.loads((tmp_path / name / "seed-3" / "finished.json").read_text()) for name in ("whole", "parts")
    ]
    assert finished[0]["curve"] == finished[1]["curve"] and finished[1]["resumed_at_step"] == 96


@pytest.mark.skipif(os.name == "nt", reason="forks")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")  # of a process with idle threads
@pytest.mark.parametrize("case", ["ppo"])
def test_a_killed_training_with_the_shipped_settings_ends_as_another(case: str, tmp_path: Path) -> None:
    assert case in CASES
    kill_at_random(case, kills=2, folder=tmp_path)


def damages() -> dict[str, Callable[[bytes], bytes]]:
    """Ways in which a file may be damaged."""
    found: dict[str, Callable[[bytes], bytes]] = {
        "empty": lambda content: b"",
        "zeros": lambda content: bytes(len(content)),
        "zeros at the end": lambda content: content[:-100] + bytes(100),
        "a page of zeros": lambda content: content[:4096] + bytes(4096) + content[8192:],
        "longer": lambda content: content + b"\0",
        "twice": lambda content: content * 2,
        "another file": lambda content: b"PK\x03\x04" + content[4:],
        "a pickle": lambda content: pickle.dumps(content),
        "text": lambda content: b"{}",
        "halves exchanged": lambda content: content[len(content) // 2 :] + content[: len(content) // 2],
    }
    for share in (0.001, 0.3, 0.6, 0.9, 0.999):
        found[f"cut at {share}"] = lambda content, share=share: content[: int(share * len(content))]
        found[f"a bit at {share}"] = lambda content, share=share: _flipped(content, int(share * len(content)))
    return found


def _flipped(content: bytes, at: int) -> bytes:
    return content[:at] + bytes([content[at] ^ 1]) + content[at + 1 :]


@pytest.fixture(scope="module")
def through(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A training that came to its end, though nothing says so."""
    folder = tmp_path_factory.mktemp("through")
    train.main([*settings_of("crawl", PPO, folder), "--out", str(folder / "run")])
    (folder / "run" / "seed-3" / "finished.json").unlink()
    return folder / "run"


@pytest.mark.parametrize("damage", damages())
def test_a_damaged_checkpoint_falls_back_to_the_one_before(
    damage: str, through: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = Path(shutil.copytree(through, tmp_path / "run"))
    newest = checkpoints(out / "seed-3" / "checkpoints")[-1]
    newest.write_bytes(damages()[damage](newest.read_bytes()))
    train.main(["crawl", "--resume", "--out", str(out)])
    said = capsys.readouterr().err
    assert len(said.splitlines()) == 1 and str(newest) in said
    assert json.loads((out / "seed-3" / "finished.json").read_text())["resumed_at_step"] == 64
    assert last(out) == last(through)


def test_twenty_kinds_of_damage_are_tried() -> None:
    assert len(damages()) == 20


def test_where_every_checkpoint_is_damaged_a_training_begins_anew(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    flags, out = settings_of("crawl", PPO, tmp_path), tmp_path / "run"
    train.main([*flags, "--out", str(out)])
    whole = last(out)
    (out / "seed-3" / "finished.json").write_text("{")
    for path in checkpoints(out / "seed-3" / "checkpoints"):
        path.write_bytes(path.read_bytes()[:-1])
    train.main(["crawl", "--resume", "--out", str(out)])
    assert capsys.readouterr().err.count("is damaged") == 2
    assert last(out) == whole


def test_a_checkpoint_of_another_network_is_named(tmp_path: Path) -> None:
    flags, out = settings_of("crawl", PPO, tmp_path), tmp_path / "run"
    train.main([*flags, "--out", str(out)])
    (out / "seed-3" / "finished.json").unlink()
    settings = json.loads((out / "settings.json").read_text())
    settings["learner"]["hidden"] = [9]
    (out / "settings.json").write_text(json.dumps(settings))
    with pytest.raises(UsageError, match="does not fit") as mistake:
        train.main(["crawl", "--resume", "--out", str(out)])
    assert "\n" not in str(mistake.value)
    assert checkpoints(out / "seed-3" / "checkpoints")


def test_unfinished_checkpoints_are_no_checkpoints(tmp_path: Path) -> None:
    save_checkpoint(
        tmp_path, 7, {"numbers": np.arange(3), "text": "x", "inner": [{"none": None, "big": 2**100}]}
    )
    (tmp_path / f".part-{checkpoints(tmp_path)[0].name}").write_bytes(b"")
    (tmp_path / "000000000009.safetensors").write_bytes(b"")
    found = newest_checkpoint(tmp_path)
    assert found is not None and found["numbers"].tolist() == [0, 1, 2]
    assert found["inner"] == [{"none": None, "big": 2**100}]


class Trap:
    """Writes a file where it is unpickled."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> tuple[Any, ...]:
        return Path.touch, (self.path,)


def test_a_crafted_run_runs_no_code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    flags, out, sprung = settings_of("crawl", PPO, tmp_path), tmp_path / "run", tmp_path / "sprung"
    train.main([*flags, "--out", str(out)])
    (out / "seed-3" / "finished.json").unlink()
    monkeypatch.setattr(pickle, "loads", lambda *_: pytest.fail("something was unpickled"))
    monkeypatch.setattr(pickle, "load", lambda *_: pytest.fail("something was unpickled"))
    trap = pickle.dumps(Trap(sprung))
    for path in checkpoints(out / "seed-3" / "checkpoints"):
        path.write_bytes(trap)
    train.main(["crawl", "--resume", "--out", str(out)])
    for name in ("algorithm", "environment_id"):
        settings = json.loads((out / "settings.json").read_text())
        settings[name] = "antigravity:fly"
        (out / "settings.json").write_text(json.dumps(settings))
        (out / "seed-3" / "finished.json").unlink(missing_ok=True)
        with pytest.raises(UsageError):
            train.main(["crawl", "--resume", "--out", str(out)])
    assert not sprung.exists()
