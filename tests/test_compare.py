"""Comparisons: stages, verdicts, reports, the command."""

import os
import subprocess
import sys
from functools import reduce
from operator import getitem
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

pytest.importorskip("stable_baselines3")
pytest.importorskip("matplotlib")

from magworm_gym import PolicyError, Scene, load_policy, load_scene
from magworm_gym.baselines import FAMILIES, CycleSearch, Runner, Shuttle, Steered
from magworm_gym.learning import demonstration
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.compare import evaluate, rivals
from magworm_gym.learning.compare.crawl import SPEED, removable_sets, robot_name
from magworm_gym.learning.compare.goals import COURSES, goal_table, goal_verdict
from magworm_gym.learning.compare.rows import Row
from magworm_gym.learning.compare.stages import Stages, content_digest
from magworm_gym.learning.compare.statistics import central_mean, interval
from magworm_gym.learning.compare.words import verdict
from magworm_gym.learning.results import Interval, read_report
from magworm_gym.learning.train import ENVIRONMENTS
from magworm_gym.tasks import Turn

TRAINING = Path(__file__).parent.parent / "training"
CONFIGS = TRAINING / "configs"
NUMBERS = TRAINING.parent / "docs" / "results" / "numbers.toml"
CRAWL = """
[ID.training]
num_envs = 8
steps = 256
seeds = [0, 1]
environment.randomise = { removed = 0.5, parameters = 0.1 }
[ID.sweep]
speeds = 3
starts = 2
shuttle_starts = 1
settle_s = 0.1
measure_s = 0.4
[ID.search]
seeds = 2
scouts = 8
population = 6
control_points = 3
settle_s = 0.1
measure_s = 0.2
starts = 1
[ID.final]
starts = 3
settle_s = 0.1
measure_s = 0.4
animation_s = 0.3
"""
GOAL = """
[ID.training]
num_envs = 4
steps = 128
seeds = [0, 1]
[ID.search]
seeds = 2
scouts = 4
population = 4
generations = 1
starts = 1
duration_s = 0.2
[ID.final]
starts = 1
duration_s = 0.4
animation_s = 0.2
"""
SHORT = CycleSearch(scouts=4, population=4, generations=1, starts=1, duration_s=0.2)


def budget_file(folder: Path, task: str, text: str) -> str:
    path = folder / "tiny.toml"
    path.write_text(text.replace("ID", f'"{ENVIRONMENTS[task]}"'))
    return str(path)


def test_intervals() -> None:
    samples = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 80.0]
    assert central_mean(np.array(samples)) == 4.5
    assert central_mean(np.array([1.0, 2.0, 6.0])) == 3.0  # too few to leave a quarter out
    found = interval(samples)
    assert found.value == 4.5 and found.low < 4.5 < found.high and found.count == 8
    assert interval(samples) == found
    assert interval([2.0]) == Interval(2.0, 2.0, 2.0, 1)
    assert interval([3.0, 3.0, 3.0]).high == 3.0


def row(title: str, **samples: list[float]) -> Row:
    rival = rivals.Rival(title, title, lambda *_: {}, lambda _: None, lambda _: "", seeds=(0, 1, 2))  # type: ignore[arg-type, return-value]
    return Row("intact", rival, [{}] * 3, samples, [])


@pytest.mark.parametrize(
    ("learned", "sentence"),
    [
        (0.030, "The learned policy beats the belt: 30.00 against 6.00 mm/s, 5.0 times as fast."),
        (0.002, "The learned policy does not beat the belt: 2.00 against 6.00 mm/s."),
        (
            0.0059,
            "The learned policy cannot be told from the belt: 5.90 against 6.00 mm/s, and the intervals",
        ),
    ],
)
def test_verdict_says_who_won(learned: float, sentence: str) -> None:
    ours, theirs = (row("x", speed_m_s=[speed - 2e-4, speed, speed + 2e-4]) for speed in (learned, 0.006))
    (found,) = verdict(ours, [("the belt", theirs)], SPEED)
    assert found.startswith(sentence)


def goal_rows(**samples: list[float]) -> list[Row]:
    rest = [measure.key for measure in COURSES[Turn].measures]
    return [
        row(
            name,
            **{
                **{key: [0.0] for key in rest},
                "time_to_30_deg_s": times,
                "final_error_deg": [t / 2 for t in times],
            },
        )
        for name, times in samples.items()
    ]


def test_the_verdict_on_goals_goes_by_intervals() -> None:
    made = goal_rows(
        learned=[3.0, 3.1, 3.2], belt=[9.0, 9.1, 9.5], pair=[2.0, 2.1, 2.2], free=[3.0, 3.3, 3.1]
    )
    text = " ".join(goal_verdict(made, COURSES[Turn]))
    assert "beats the rival “belt” in time to 30°: 3.1 against 9.2 s." in text
    assert "does not beat the rival “pair”" in text
    assert "cannot be told from the rival “free”" in text and "the intervals overlap" in text
    assert text.endswith("Best in time to 30°: pair.")
    assert "| belt | 9.2 [9.0, 9.5] |" in goal_table(made, COURSES[Turn]).markdown()


def test_the_verdict_says_where_nobody_gets_there() -> None:
    text = " ".join(goal_verdict(goal_rows(learned=[20.0, 20.0], belt=[20.0, 20.0]), COURSES[Turn]))
    assert text.startswith("Nobody reached a goal in the time given.")
    assert "final heading error" in text


def test_removable_sets_leave_three_magnets() -> None:
    assert [len(removable_sets(magnets)) for magnets in (3, 4, 5)] == [1, 5, 16]
    assert removable_sets(5)[0] == ()
    assert removable_sets(5, (1,)) == [(1,), (0, 1), (1, 2), (1, 3), (1, 4)]
    assert robot_name(()) == robot_name((1,), (1,)) == "intact"
    assert robot_name((0, 3)) == "without 0 and 3"


def test_stages_are_kept_by_settings_sources_and_simulator(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from magworm_gym.learning.compare import stages as module

    calls: list[str] = []

    def ask(size: int, name: str, made_by: Any = Shuttle) -> None:
        Stages(tmp_path, say=lambda _: None).result(
            "sweep", {"size": size}, [made_by], lambda: calls.append(name) or {"size": size}
        )

    ask(1, "first")
    ask(1, "kept")
    ask(2, "other settings")
    ask(1, "other source", Steered)
    monkeypatch.setattr(module, "_magworm", demonstration)  # another build
    ask(1, "other simulator")
    assert calls == ["first", "other settings", "other source", "other simulator"]
    (kept,) = [path for path in tmp_path.iterdir() if '"size": 2' in path.read_text()]
    kept.write_text('{"size"')
    monkeypatch.undo()
    ask(2, "damaged")
    assert calls[-1] == "damaged"
    with pytest.raises(RuntimeError):
        Stages(tmp_path).result("broken", {}, [], lambda: (_ for _ in ()).throw(RuntimeError))
    assert all("broken" not in path.name for path in tmp_path.iterdir())


def test_what_decides_about_a_source_is_its_text(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from magworm_gym.learning.compare import stages

    monkeypatch.syspath_prepend(str(tmp_path))
    path = tmp_path / "own_rival.py"
    digests = []
    for text in ("class Own: ...\n", "class Own:\n    x = 1\n", "class Own: ...\n"):
        path.write_text(text)
        stages._file_digest.cache_clear()
        import own_rival  # type: ignore[import-not-found]

        digests.append(stages.source_digest(own_rival.Own))
    assert digests[0] == digests[2] != digests[1]


def test_what_decides_about_a_policy_is_its_content(tmp_path: Path) -> None:
    for name in ("here", "there"):
        (tmp_path / name / "part").mkdir(parents=True)
        (tmp_path / name / "part" / "weights").write_bytes(b"123")
    assert content_digest(tmp_path / "here") == content_digest(tmp_path / "there")
    before = content_digest(tmp_path / "here")
    (tmp_path / "here" / "part" / "weights").write_bytes(b"124")
    assert content_digest(tmp_path / "here") != before
    (tmp_path / "there" / "part" / "weights").rename(tmp_path / "there" / "part" / "other")
    assert content_digest(tmp_path / "there") != before


def numbers_on_pages(report: str, path: Path) -> list[float]:
    """The single numbers that pages want of a report, as a run has left them."""
    listed = msgspec.toml.decode(NUMBERS.read_bytes()).values()
    kept = msgspec.json.decode(path.read_bytes())
    return [reduce(getitem, number["at"], kept) for number in listed if number["report"] == report]


def test_a_comparison_of_crawling_writes_everything_and_is_not_done_twice(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, kept = tmp_path / "run", tmp_path / "crawl.json"
    flags = ["--budget", budget_file(tmp_path, "crawl", CRAWL), "--scene", "paper-4", "--workers", "1"]
    evaluate.main([*flags, "--out", str(out), "--keep", str(kept)], CONFIGS)
    printed = capsys.readouterr().out
    files = {path.name for path in out.iterdir() if path.is_file() and not path.name.startswith(".")}
    figures = {"speeds.png", "speed_curves.png", "learning_curves.png", "portraits.png"}
    assert files == {"report.md", "results.json", "race.mp4", "race.gif"} | figures
    report = read_report(out / "results.json")
    assert report == read_report(kept)
    assert numbers_on_pages("crawl", kept) == [3]
    assert len(report.data["rivals"]) == 6 * 5
    assert {one["robot"] for one in report.data["rivals"]} == {"intact", *(f"without {i}" for i in range(4))}
    text = (out / "report.md").read_text()
    assert "50 % of the training episodes" in text and "spread by 10 %" in text
    assert text.count("Limits of the stage: speed 210 mm/s, acceleration 5 m/s²") == 2
    assert str(report.parts["verdict"]) in text and str(report.parts["verdict"]) in printed
    assert printed.rstrip().splitlines()[-1].startswith("Limits of the stage")

    # Policies that were moved are the same policies.
    (out / "training").rename(tmp_path / "moved")
    stages = {path.name for path in (out / "stages").iterdir()}
    again = ["--budget", flags[1], "--policies", str(tmp_path / "moved"), "--out", str(out), "--workers", "1"]
    evaluate.main(again, CONFIGS)
    told = capsys.readouterr().out
    assert told.count("kept from an earlier run") == len(stages) == printed.count(" s\n") - 1
    assert {path.name for path in (out / "stages").iterdir()} == stages
    assert read_report(out / "results.json") == report


@pytest.mark.parametrize("task", ["turn", "reach"])
def test_a_comparison_with_goals_leaves_a_report_and_is_not_done_twice(
    task: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(demonstration, "SEARCH", SHORT)
    monkeypatch.setattr(demonstration, "STEPS", 10)
    out = tmp_path / "run"
    flags = [task, "--budget", budget_file(tmp_path, task, GOAL), "--out", str(out), "--workers", "1"]
    evaluate.main(flags, CONFIGS)
    first = capsys.readouterr().out
    files = {path.name for path in out.iterdir() if path.is_file() and not path.name.startswith(".")}
    assert files == {"report.md", "results.json", f"{task}.png", f"{task}.mp4", f"{task}.gif"}
    report = read_report(out / "results.json")
    assert len(numbers_on_pages(task, out / "results.json")) == (1 if task == "turn" else 0)
    titles = [one["rival"] for one in report.data["rivals"]]
    assert titles == ["learned policy", *(family.title for family in FAMILIES.values())]
    text = (out / "report.md").read_text()
    assert str(report.parts["verdict"]) in text and str(report.parts["verdict"]) in first
    assert "censored" in text and all(title in text for title in titles)

    evaluate.main(flags, CONFIGS)
    again = capsys.readouterr().out
    assert again.count("kept from an earlier run") == 2 + 2 * 2 * len(FAMILIES)
    assert read_report(out / "results.json") == report
    with pytest.raises(UsageError, match="other settings"):
        evaluate.main([task, "--budget", "smoke", "--out", str(out)], CONFIGS)


def test_single_drive_of_a_family_is_that_of_the_preset() -> None:
    pair = Scene.preset("turn-3-pair")
    assert FAMILIES["pair"].scene(pair) == pair
    single = FAMILIES["misaligned"].scene(pair).with_values({"name": "turn-3"})
    assert single == Scene.preset("turn-3")


@pytest.mark.parametrize("name", ["smoke", "small", "full"])
@pytest.mark.parametrize("task", ["crawl", "turn", "reach"])
def test_each_environment_has_budgets(task: str, name: str) -> None:
    identifier = ENVIRONMENTS[task]
    kind = evaluate.CONTESTS[type(evaluate.task_of(identifier))].budget_kind
    budget = evaluate.read_budget(CONFIGS / "budgets" / f"{name}.toml", identifier, kind)
    settings = evaluate.settings_of(budget, identifier, CONFIGS)
    assert settings.environment_id == identifier and len(settings.seeds) >= 2


@pytest.mark.parametrize(
    ("task", "text", "sentence"),
    [
        ("crawl", "a = [", "is not TOML"),
        ("crawl", "[other]", "has no table"),
        ("crawl", "[ID.fly]", "fly is not a setting; allowed here: training, sweep"),
        ("crawl", "[ID.sweep]\nspeed = 3", "sweep.speed is not a setting"),
        ("crawl", "[ID.final]\nstarts = -1", "final.starts is -1; allowed: a whole number from 1"),
        ("crawl", "[ID.final]\nmeasure_s = 0", "final.measure_s is 0; allowed: a number above 0"),
        ("crawl", "[ID.search]\neach_robot = 1", "search.each_robot is 1; allowed: true or false"),
        ("crawl", "[ID.search]\npopulation = 1", "search.population is 1"),
        ("crawl", "[ID]\nsearch = 3", "search is 3; allowed: a table"),
        ("crawl", "[ID.training]\nsteps = 0", "steps is 0"),
        ("crawl", "[ID.training]\nenvironment_id = 'x'", "training.environment_id is 'x'"),
        ("crawl", "[ID.training]\nwings = 2", "wings is not a setting"),
        ("crawl", "[ID.training.learner]\ngamma = 2.0", "gamma is 2.0"),
        ("turn", "[ID.final]\nwings = 2", "final.wings is not a setting"),
        ("turn", "[ID.search]\nscouts = 1.5", "search.scouts is 1.5"),
        ("turn", "[ID.search]\nduration_s = nan", "search.duration_s is nan"),
        ("turn", "[ID.final]\nduration_s = inf", "final.duration_s is inf"),
    ],
)
def test_broken_budgets_are_named_before_a_folder_is_touched(
    task: str, text: str, sentence: str, tmp_path: Path
) -> None:
    budget, out = budget_file(tmp_path, task, text), tmp_path / "run"
    with pytest.raises(UsageError) as mistake:
        evaluate.main([task, "--budget", budget, "--out", str(out)], CONFIGS)
    assert sentence in str(mistake.value) and "\n" not in str(mistake.value)
    assert not out.exists()


@pytest.mark.parametrize(
    ("flags", "sentence"),
    [
        (["--bad"], "--bad"),
        (["fly"], "'fly'"),
        (["--budget", "huge"], "no readable file huge"),
        (["--policies", "nowhere"], "no training to go on with"),
        (["--policies", "x", "--scene", "paper-4"], "--scene goes with a new training"),
        (["--workers", "0"], "'0' is not a whole number"),
        (["--scene", "nothing"], "nothing"),
    ],
)
def test_mistakes_exit_with_two_and_one_line(flags: list[str], sentence: str, tmp_path: Path) -> None:
    command = [sys.executable, str(TRAINING / "evaluate.py"), *flags]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    result = subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=tmp_path, env=environment
    )
    assert result.returncode == 2, result.stderr
    assert result.stderr.startswith("evaluate.py: ") and sentence in result.stderr
    assert len(result.stderr.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_ctrl_c_says_how_to_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(*_: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(evaluate, "train", stopped)
    flags = ["crawl", "--budget", "smoke", "--out", str(tmp_path / "run")]
    with pytest.raises(KeyboardInterrupt, match=f"crawl --budget smoke --out {tmp_path}/run"):
        evaluate.main(flags, CONFIGS)


def test_a_policy_drives_no_robot_that_it_was_not_trained_for() -> None:
    pilot = rivals.Pilot(load_policy("crawl-3"))
    for scene, told in (("paper-4", "size of the environment's observation"), ("turn-3", "observation")):
        runner = Runner(load_scene(scene), 1)
        with pytest.raises(PolicyError, match=told):
            runner.begin([0], pilot)
    runner = Runner(load_policy("turn").scene, 1, task=Turn())
    runner.begin([0], rivals.Pilot(load_policy("turn")), goals=np.array([[30.0]]))
    runner.forward(2)
