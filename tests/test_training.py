"""Training and comparison: settings, going on after a kill, reports, command lines."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")
pytest.importorskip("matplotlib")

TRAINING = Path(__file__).parent.parent / "training"

from magworm_gym.learning.command_line import UsageError  # noqa: E402
from magworm_gym.learning.compare import evaluate  # noqa: E402
from magworm_gym.learning.compare.intervals import Interval, interquartile_mean, interval  # noqa: E402
from magworm_gym.learning.compare.report import Result, verdict  # noqa: E402
from magworm_gym.learning.compare.stages import Stages  # noqa: E402
from magworm_gym.learning.damage import removable_sets, robot_name  # noqa: E402

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


def test_broken_settings_are_named(tmp_path: Path) -> None:
    path = tmp_path / "broken.toml"
    for text, sentence in (("[sweep]\nspeed = 3", "'speed'"), ("[final]\nstarts = -1", "starts is -1")):
        path.write_text(text)
        with pytest.raises(UsageError, match=sentence):
            evaluate.main(["--budget", str(path)])


@pytest.mark.parametrize(
    ("program", "flags"),
    [
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
