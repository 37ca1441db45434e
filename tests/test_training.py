"""Training and comparison: settings, going on after a kill, reports, command lines."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")
pytest.importorskip("matplotlib")

TRAINING = Path(__file__).parent.parent / "training"

from magworm_gym.learning import train  # noqa: E402
from magworm_gym.learning.checkpoints import complete_checkpoints  # noqa: E402
from magworm_gym.learning.command_line import UsageError  # noqa: E402
from magworm_gym.learning.compare import evaluate  # noqa: E402
from magworm_gym.learning.compare.intervals import Interval, interquartile_mean, interval  # noqa: E402
from magworm_gym.learning.compare.report import Result, verdict  # noqa: E402
from magworm_gym.learning.compare.stages import Stages  # noqa: E402
from magworm_gym.learning.damage import factors_for_each, removable_sets, removed_for_each, robot_name  # noqa: E402
from magworm_gym.learning.settings import read_saved_settings, settings_from  # noqa: E402

SMALL_TRAINING = """
[run]
num_envs = 8
steps = 1024
seeds = [3]
episode_steps = 50
checkpoint_steps = 256
removed_share = 0.5
parameter_spread = 0.1
[policy]
hidden = [16]
normalise = true
[algorithm]
n_steps = 16
batch_size = 64
n_epochs = 2
gamma = 0.98
"""
TINY_BUDGET = """
[training]
num_envs = 8
steps = 256
seeds = [0, 1]
[sweep]
speeds = 3
starts = 2
shuttle_starts = 1
settle_s = 0.1
measure_s = 0.4
[search]
seeds = 2
scouts = 8
population = 6
control_points = 3
settle_s = 0.1
measure_s = 0.2
starts = 1
[final]
starts = 3
settle_s = 0.1
measure_s = 0.4
animation_s = 0.3
"""


@pytest.fixture
def config(tmp_path: Path) -> Path:
    path = tmp_path / "small.toml"
    path.write_text(SMALL_TRAINING)
    return path


def weights(folder: Path) -> list[np.ndarray]:
    from stable_baselines3 import PPO

    model = PPO.load(folder / "seed-3" / "policy" / "model.zip", device="cpu")
    return [value.numpy() for value in model.policy.state_dict().values()]


def finished(folder: Path) -> dict[str, Any]:
    summary: dict[str, Any] = json.loads((folder / "seed-3" / "finished.json").read_text())
    return summary


def killed_training(config: Path, out: Path) -> int:
    """Kills a training after its first checkpoint; returns the steps of the last complete one."""
    command = [
        sys.executable,
        str(TRAINING / "train.py"),
        "crawl",
        "--config",
        str(config),
        "--out",
        str(out),
    ]
    process = subprocess.Popen([*command, "--steps", "1000000"], stderr=subprocess.PIPE)
    checkpoints = out / "seed-3" / "checkpoints"
    deadline = time.monotonic() + 300.0
    while not complete_checkpoints(checkpoints) and process.poll() is None:
        assert time.monotonic() < deadline, "no checkpoint within five minutes"
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    return int(complete_checkpoints(checkpoints)[-1].name)


def test_killed_training_goes_on_from_its_last_checkpoint(config: Path, tmp_path: Path) -> None:
    out = tmp_path / "killed"
    kept = killed_training(config, out)
    (out / "seed-3" / "checkpoints" / ".part-999999999999").mkdir()
    settings = json.loads((out / "settings.json").read_text())
    settings["steps"] = kept + 512
    (out / "settings.json").write_text(json.dumps(settings))
    train.main(["crawl", "--resume", "--out", str(out)])
    assert finished(out)["resumed_at_step"] == kept
    assert finished(out)["steps"] == kept + 512
    steps = [point[0] for point in finished(out)["curve"]]
    assert steps == sorted(set(steps))


def test_interrupted_training_ends_as_an_uninterrupted_one(
    config: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from magworm_gym.learning import training as crawl_training

    flags = ["crawl", "--config", str(config), "--out"]
    train.main([*flags, str(tmp_path / "whole")])

    save = crawl_training.save_checkpoint

    def interrupt_after_the_second(folder: Path, trainee: Any) -> None:
        save(folder, trainee)
        if trainee.model.num_timesteps >= 512:
            raise KeyboardInterrupt

    monkeypatch.setattr(crawl_training, "save_checkpoint", interrupt_after_the_second)
    with pytest.raises(KeyboardInterrupt):
        train.main([*flags, str(tmp_path / "halves")])
    monkeypatch.undo()
    train.main(["crawl", "--resume", "--out", str(tmp_path / "halves")])

    assert finished(tmp_path / "whole")["steps"] == finished(tmp_path / "halves")["steps"] == 1024
    assert finished(tmp_path / "halves")["resumed_at_step"] == 512
    assert finished(tmp_path / "whole")["curve"] == finished(tmp_path / "halves")["curve"]
    for one, other in zip(weights(tmp_path / "whole"), weights(tmp_path / "halves"), strict=True):
        np.testing.assert_array_equal(one, other)
    assert list((tmp_path / "whole" / "seed-3" / "tensorboard").iterdir())


def test_seeds_side_by_side_end_as_one_after_the_other(config: Path, tmp_path: Path) -> None:
    flags = ["crawl", "--config", str(config), "--steps", "256", "--seeds", "3", "4"]
    for workers in ("1", "2"):
        train.main([*flags, "--workers", workers, "--out", str(tmp_path / workers)])
    for one, other in zip(weights(tmp_path / "1"), weights(tmp_path / "2"), strict=True):
        np.testing.assert_array_equal(one, other)


def test_soft_actor_critic_trains_and_goes_on(tmp_path: Path) -> None:
    config = tmp_path / "sac.toml"
    config.write_text(
        '[run]\nalgorithm = "sac"\nnum_envs = 4\nsteps = 80\nseeds = [0]\ncheckpoint_steps = 40\n'
        "[policy]\nhidden = [8]\n[algorithm]\nbuffer_size = 200\nlearning_starts = 16\nbatch_size = 16\n"
    )
    out = tmp_path / "sac"
    train.main(["crawl", "--config", str(config), "--out", str(out)])
    assert json.loads((out / "seed-0" / "finished.json").read_text())["steps"] == 80
    assert all(
        (path / "replay.pkl").exists() for path in complete_checkpoints(out / "seed-0" / "checkpoints")
    )


def test_comparison_writes_everything_and_keeps_its_stages(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    budget, out = tmp_path / "tiny.toml", tmp_path / "run"
    budget.write_text(TINY_BUDGET)
    flags = ["--budget", str(budget), "--scene", "paper-4", "--out", str(out), "--workers", "1"]
    evaluate.main(flags)
    printed = capsys.readouterr().out
    files = {path.name for path in out.iterdir() if path.is_file()}
    figures = {"speeds.png", "speed_curves.png", "learning_curves.png", "portraits.png"}
    assert files == {"report.md", "results.json", "race.mp4", "race.gif"} | figures
    results = json.loads((out / "results.json").read_text())
    assert len(results["speeds"]) == 6 * 5
    assert {row["robot"] for row in results["speeds"]} == {"intact", *(f"without {i}" for i in range(4))}
    text = (out / "report.md").read_text()
    assert text.count("Limits of the stage: speed 210 mm/s, acceleration 5 m/s²") == 2
    assert results["verdict"] in text and results["verdict"] in printed
    assert printed.rstrip().splitlines()[-1].startswith("Limits of the stage")

    evaluate.main(flags)
    again = capsys.readouterr().out
    assert again.count("kept from an earlier run") == printed.count(" s\n")
    assert json.loads((out / "results.json").read_text()) == results

    with pytest.raises(UsageError, match="other settings"):
        evaluate.main(["--budget", "small", "--out", str(out)])


@pytest.mark.parametrize(
    ("flags", "sentence"),
    [
        (["crawl", "--bad"], "--bad"),
        (["crawl", "--algorithm", "dqn"], "'dqn'"),
        (["crawl", "--num-envs", "0"], "num_envs is 0"),
        (["crawl", "--seeds", "1", "1"], "seeds are"),
        (["crawl", "--randomise-magnets", "2"], "between 0 and 1"),
        (["crawl", "--randomise-parameters", "1"], "between 0 and 0.9"),
        (["crawl", "--config", "nowhere.toml"], "no readable file nowhere.toml"),
        (["crawl", "--resume", "--out", "nowhere"], "no training to go on with"),
        (["crawl", "--workers", "0"], "'0' is not a whole number"),
        (["fly"], "'fly'"),
    ],
)
def test_training_names_the_mistake(flags: list[str], sentence: str) -> None:
    with pytest.raises(UsageError) as mistake:
        train.main(flags)
    assert sentence in str(mistake.value)
    assert "\n" not in str(mistake.value)


def test_training_refuses_to_mix_runs(config: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    out.mkdir()
    (out / "settings.json").write_text(json.dumps(settings_from({}).to_json()))
    with pytest.raises(UsageError, match="holds a training already"):
        train.main(["crawl", "--config", str(config), "--out", str(out)])
    with pytest.raises(UsageError, match="started with num_envs 256"):
        train.main(["crawl", "--resume", "--num-envs", "8", "--out", str(out)])
    assert read_saved_settings(out / "settings.json") == settings_from({})


def test_broken_settings_are_named(tmp_path: Path) -> None:
    path = tmp_path / "broken.toml"
    for text, sentence in (
        ("a = [", "is not TOML"),
        ("[fly]", r"unknown table \[fly\]"),
        ("[run]\nwings = 2", "unknown setting 'wings'"),
    ):
        path.write_text(text)
        with pytest.raises(UsageError, match=sentence):
            train.main(["crawl", "--config", str(path)])
    for text, sentence in (("[sweep]\nspeed = 3", "'speed'"), ("[final]\nstarts = -1", "starts is -1")):
        path.write_text(text)
        with pytest.raises(UsageError, match=sentence):
            evaluate.main(["--budget", str(path)])


@pytest.mark.parametrize(
    ("program", "flags"),
    [
        ("train.py", ["crawl", "--scene", "nothing", "--out", "nowhere"]),
        ("evaluate.py", ["--budget", "huge"]),
    ],
)
def test_mistakes_exit_with_two_and_one_line(program: str, flags: list[str], tmp_path: Path) -> None:
    command = [sys.executable, str(TRAINING / program), *flags]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    result = subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=tmp_path, env=environment
    )
    assert result.returncode == 2
    assert result.stderr.startswith(f"{program}: ")
    assert len(result.stderr.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_removable_sets_leave_three_magnets() -> None:
    assert [len(removable_sets(magnets)) for magnets in (3, 4, 5)] == [1, 5, 16]
    assert removable_sets(5)[0] == ()
    assert removable_sets(5, (1,)) == [(1,), (0, 1), (1, 2), (1, 3), (1, 4)]
    assert robot_name(()) == robot_name((1,), (1,)) == "intact"
    assert robot_name((0, 3)) == "without 0 and 3"


def test_damage_is_spread_over_the_batch() -> None:
    removed = removed_for_each(4, (), 64, 0.5)
    assert sum(map(bool, removed)) == 32
    assert {taken: removed.count(taken) for taken in removable_sets(4)[1:]} == dict.fromkeys(
        removable_sets(4)[1:], 8
    )
    assert removed_for_each(3, (), 8, 1.0) == [()] * 8
    factors = factors_for_each(("mass",), 1000, 0.2, seed=1)["mass"]
    assert 0.8 <= factors.min() < 0.82 and 1.22 < factors.max() <= 1.25


def test_intervals() -> None:
    samples = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 80.0]
    assert interquartile_mean(np.array(samples)) == 4.5
    found = interval(samples)
    assert found.value == 4.5 and found.low < 4.5 < found.high and found.count == 8
    assert interval(samples) == found
    assert interval([2.0]) == Interval(2.0, 2.0, 2.0, 1)
    assert interval([3.0, 3.0, 3.0]).high == 3.0


@pytest.mark.parametrize(
    ("learned", "sentence"),
    [
        (0.030, "beats the best constant-speed belt: 30.00 against 6.00 mm/s, 5.0 times as fast"),
        (0.002, "does not beat the best constant-speed belt: 2.00 against 6.00 mm/s"),
        (0.0059, "cannot be told from the best constant-speed belt"),
    ],
)
def test_verdict_says_who_won(learned: float, sentence: str) -> None:
    speeds = {"learned policy": learned, "belt, 125 mm pitch": 0.006, "belt, 170 mm pitch": 0.005}
    speeds |= {"shuttle": 0.01, "CMA-ES stroke": 0.02, "tow": 0.0001}
    results = [
        Result({"drive": drive}, Interval(speed, speed - 2e-4, speed + 2e-4, 3))
        for drive, speed in speeds.items()
    ]
    assert sentence in verdict(results)
    assert "Beware" not in verdict(results)
    results[-1] = Result({"drive": "tow"}, Interval(0.2, 0.2, 0.2, 3))
    assert "tows it at 200.00 mm/s" in verdict(results)


def test_stages_are_kept_by_their_settings(tmp_path: Path) -> None:
    calls: list[int] = []
    stages = Stages(tmp_path, say=lambda _: None)
    for size in (1, 1, 2):
        stages.result("sweep", {"size": size}, lambda size=size: calls.append(size) or {"size": size})
    assert calls == [1, 2]
    with pytest.raises(RuntimeError):
        stages.result("broken", {}, lambda: (_ for _ in ()).throw(RuntimeError))
    assert all("broken" not in path.name for path in tmp_path.iterdir())
