"""The command that compares learned policies with other drives: ``python training/evaluate.py --help``."""

from __future__ import annotations

import shlex
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import gymnasium

from magworm_gym import arguments_of
from magworm_gym.atomic_files import write_text
from magworm_gym.learning.command_line import Parser, UsageError, positive
from magworm_gym.learning.compare.budget import Budget, read_budget
from magworm_gym.learning.compare.contest import Contest
from magworm_gym.learning.compare.crawl import CrawlContest
from magworm_gym.learning.compare.goals import GoalContest
from magworm_gym.learning.compare.rows import Training
from magworm_gym.learning.compare.stages import Stages
from magworm_gym.learning.owner import owned
from magworm_gym.learning.results import Report, Table
from magworm_gym.learning.settings import TrainingSettings, merged, read_saved_settings, read_settings
from magworm_gym.learning.train import ENVIRONMENTS, SETTINGS, train
from magworm_gym.policy import load_policy
from magworm_gym.tasks import Crawl, Reach, Task, Turn

BUDGETS = "budgets"
CONTESTS: dict[type[Task], type[Contest]] = {Crawl: CrawlContest, Turn: GoalContest, Reach: GoalContest}
"""Comparisons by the task."""


def main(arguments: list[str], configs: Path | None = None) -> None:
    """Reads the command line, compares, writes the report and prints verdict and tables last.

    Args:
        arguments: Command line without the program's name.
        configs: Folder with settings of trainings, and with budgets in a folder of that name.

    Raises:
        UsageError: A flag, a setting or a folder is not usable.
        SceneError: The scene cannot be simulated.
        KeyboardInterrupt: Ctrl-C; the message says how to go on.
    """
    flags = _parser().parse_args(arguments)
    identifier = ENVIRONMENTS.get(flags.environment, flags.environment)
    if flags.policies is not None and flags.scene is not None:
        raise UsageError(
            "--scene goes with a new training; policies are compared on the scene they were trained on"
        )
    named = (configs or Path()) / BUDGETS / f"{flags.budget}.toml"
    path = named if named.exists() else Path(flags.budget)
    out = Path(flags.out or f"runs/{flags.environment.rpartition('/')[2]}-comparison")
    folder = Path(flags.policies) if flags.policies else out / "training"
    budget = read_budget(path, identifier, CONTESTS[type(task_of(identifier))].budget_kind)
    wanted = settings_of(budget, identifier, configs, flags.scene)
    settings = _kept(folder, wanted, given=bool(flags.policies))
    try:
        began = time.monotonic()
        report = evaluate(budget, settings, folder, out, flags.workers)
        if flags.keep:
            Path(flags.keep).parent.mkdir(parents=True, exist_ok=True)
            report.write(Path(flags.keep))
        print(f"report: {out / 'report.md'}, {time.monotonic() - began:.0f} s\n\n{_summary(report)}")
    except KeyboardInterrupt:
        words = shlex.join([Path(sys.executable).name, sys.argv[0], *arguments])
        raise KeyboardInterrupt(f"this goes on with what is complete: {words}") from None


def evaluate(
    budget: Budget, settings: TrainingSettings, folder: Path, out: Path, workers: int | None = None
) -> Report:
    """Runs all stages; those that an earlier run has finished are kept.

    Args:
        budget: Sizes of searches and measurements.
        settings: Settings of the training.
        folder: Folder of the training; what is missing of it is trained.
        out: Folder of the report.
        workers: Seeds trained side by side; None for the number of cores.

    Returns:
        The report, which also stands in ``results.json`` and, with figures, in ``report.md``.
    """
    from magworm_gym.learning.compare import figures

    task = task_of(settings.environment_id, settings.environment)
    training = Training(folder, settings, train(settings, folder, workers))
    scene = load_policy(next(iter(training.folders.values()))).scene
    with owned(out):
        contest = CONTESTS[type(task)](task, scene, budget, training)
        found = contest.compared(Stages(out / "stages"))
        report = contest.report(found)
        report.data.update(contest.plain(found))
        report.write(out / "results.json")
        write_text(out / "report.md", report.markdown(figures.DRAWN[type(contest)](contest, found, out)))
    return report


def task_of(environment_id: str, arguments: Mapping[str, Any] | None = None) -> Task:
    """The task of an environment that there is a comparison for.

    Raises:
        UsageError: There is none.
    """
    try:
        task: Task = arguments_of(environment_id, **(arguments or {}))["task"]
    except (ValueError, gymnasium.error.Error) as error:
        raise UsageError(f"environment is {environment_id!r}: {error}") from None
    if type(task) not in CONTESTS:
        raise UsageError(f"environment is {environment_id!r}; allowed: one of crawling, turning or reaching")
    return task


def settings_of(
    budget: Budget, environment_id: str, configs: Path | None, scene: str | None = None
) -> TrainingSettings:
    """Settings of the training that a budget asks for.

    Raises:
        UsageError: A setting is unknown or out of range.
    """
    file = configs / f"{budget.training.get('algorithm', 'ppo')}.toml" if configs else None
    changes = {"environment": {"scene": scene}} if scene else {}
    own = file if file is not None and file.exists() else None
    settings = read_settings(own, environment_id, merged(budget.training, changes))
    if settings.environment_id != environment_id:
        raise UsageError(
            f"training.environment_id is {settings.environment_id!r}; allowed: {environment_id!r}"
        )
    return settings


def _kept(folder: Path, wanted: TrainingSettings, *, given: bool) -> TrainingSettings:
    """Settings of the training in a folder, or those that are wanted where there is none yet."""
    if not given and not (folder / SETTINGS).exists():
        return wanted
    kept = read_saved_settings(folder / SETTINGS)
    if given and kept.environment_id != wanted.environment_id:
        raise UsageError(f"{folder} holds policies for {kept.environment_id}, not {wanted.environment_id}")
    if not given and kept != wanted:
        raise UsageError(f"{folder} holds a training with other settings: choose another --out")
    return kept


def _summary(report: Report) -> str:
    """Verdict and tables, that of the whole robot last."""
    names = ("verdict", "robots", "intact", "limits")
    parts = [report.parts[name] for name in names if name in report.parts]
    return "\n\n".join(part.markdown() if isinstance(part, Table) else part for part in parts)


def _parser() -> Parser:
    parser = Parser(
        prog="evaluate.py",
        description="Compares learned policies with tuned and searched drives on the same robot and limits. "
        "A run that was stopped goes on when the same command is given again.",
    )
    add = parser.add_argument
    add("environment", nargs="?", default="crawl", help="crawl (the default), turn, reach, or an identifier")
    add("--budget", default="small", metavar="NAME", help="smoke, small (the default), full, or a TOML file")
    add("--policies", metavar="FOLDER", help="--out of train.py; left out, trains into the folder of --out")
    add("--workers", type=positive, metavar="N", help="seeds trained side by side (default: one per core)")
    add("--scene", help="preset or path of a TOML file to train and compare on")
    add("--out", metavar="FOLDER", help="folder of the report (default: runs/ENVIRONMENT-comparison)")
    add("--keep", metavar="FILE", help="also keeps the report as data here, such as docs/results/crawl.json")
    return parser
