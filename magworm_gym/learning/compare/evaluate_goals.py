"""Compares learned turning or reaching with its baselines: ``python training/evaluate_goals.py --help``."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from magworm_gym import Scene
from magworm_gym.atomic_files import write_json, write_text
from magworm_gym.learning.command_line import Parser, UsageError, positive
from magworm_gym.learning.settings import (
    CONFIGS,
    TrainingSettings,
    read_saved_settings,
    read_settings,
    read_toml,
)
from magworm_gym.learning.train import ENVIRONMENTS, SCENE, SETTINGS, train

if TYPE_CHECKING:
    from magworm_gym.learning.compare.goal_comparison import GoalComparison

GOAL_TASKS = ("turn", "reach")
TABLES = ("training", "search", "final")


@dataclass(frozen=True)
class FinalSize:
    """Final measurement, with the same goals and starts for all.

    Attributes:
        starts: Starts of each goal.
        duration_s: Longest time of an episode [s].
        animation_s: Longest time of the animation [s].
    """

    starts: int = 4
    duration_s: float = 20.0
    animation_s: float = 10.0


@dataclass(frozen=True)
class GoalBudget:
    """Everything that decides an evaluation, beside the policies.

    Attributes:
        task: "turn" or "reach".
        training: Training of the policies.
        search: Table [search], see ``goal_search.SearchSize``.
        final: Final measurement.
    """

    task: str
    training: TrainingSettings
    search: dict[str, Any] = field(default_factory=dict)
    final: FinalSize = field(default_factory=FinalSize)


def main(arguments: list[str]) -> None:
    """Reads the command line, compares, writes the report and prints its table last.

    Args:
        arguments: Command line without the program's name.

    Raises:
        UsageError: A flag, a setting or a folder is not usable.
        SceneError: The scene cannot be simulated.
    """
    flags = _parser().parse_args(arguments)
    budget = read_goal_budget(flags.task, flags.budget)
    print(evaluate(budget, Path(flags.out or f"runs/{flags.task}-comparison"), flags.workers))


def evaluate(budget: GoalBudget, out: Path, workers: int | None = None) -> str:
    """Runs all stages; those that an earlier run has finished are kept.

    Args:
        budget: Task and sizes.
        out: Folder of the report.
        workers: Seeds trained side by side; None for the number of cores.

    Returns:
        Verdict and table, to print.
    """
    from magworm_gym.learning.compare import goal_report
    from magworm_gym.learning.compare.goal_comparison import GoalComparison
    from magworm_gym.learning.compare.stages import Stages

    began = time.monotonic()
    folder = out / "training"
    kept = read_saved_settings(folder / SETTINGS) if (folder / SETTINGS).exists() else budget.training
    if kept != budget.training:
        raise UsageError(f"{folder} holds a training with other settings: choose another --out")
    out.mkdir(parents=True, exist_ok=True)
    summaries = train(budget.training, folder, workers)
    scene = Scene.from_toml((folder / SCENE).read_text(encoding="utf-8"))
    comparison = GoalComparison(scene, budget, folder, summaries, Stages(out / "stages"))
    rows = comparison.rows()
    _film(comparison, out)
    goal_report.draw(out / f"{budget.task}.png", comparison, rows)
    text = goal_report.report(comparison, rows)
    write_json(out / "results.json", goal_report.results(comparison, rows))
    write_text(out / "report.md", text)
    took = f"report: {out / 'report.md'}, {time.monotonic() - began:.0f} s"
    return "\n\n".join([took, goal_report.verdict(rows), goal_report.table(rows)])


def read_goal_budget(task: str, name: str) -> GoalBudget:
    """Reads a budget.

    Args:
        task: "turn" or "reach".
        name: "smoke", "small", "full", or the path of a TOML file with the tables [training], [search]
            and [final].

    Raises:
        UsageError: The file cannot be read, or a setting is unknown or out of range.
    """
    path = CONFIGS / f"goal-{name}.toml"
    tables = read_toml(path if path.exists() else Path(name))
    unknown = sorted(tables.keys() - set(TABLES))
    if unknown:
        raise UsageError(f"budget {name!r} has the unknown table [{unknown[0]}]")
    training = dict(tables.get("training", {}))
    config = CONFIGS / training.pop("config", "ppo.toml")
    final = tables.get("final", {})
    search = tables.get("search", {})
    whole = {"seeds", "scouts", "population", "generations", "starts"}
    for title, values, known in (
        ("final", final, {"starts", "duration_s", "animation_s"}),
        ("search", search, whole | {"duration_s"}),
    ):
        for key, value in values.items():
            if key not in known:
                raise UsageError(
                    f"[{title}] has the unknown setting {key!r}; known: {', '.join(sorted(known))}"
                )
            number = isinstance(value, int if key in whole else int | float) and not isinstance(value, bool)
            if not number or value <= 0:
                raise UsageError(f"[{title}] {key} is {value!r}; it must be a number above 0")
    return GoalBudget(task, read_settings(config, ENVIRONMENTS[task], training), search, FinalSize(**final))


def _film(comparison: GoalComparison, out: Path) -> None:
    """Draws the best policy towards one goal, from above and from the side."""
    from magworm_gym.learning.compare.goal_film import frames
    from magworm_gym.render.animation import write_gif, write_mp4

    step_s = comparison.scene.control_step_s
    drawn = list(frames(*comparison.film(), comparison.scene))
    write_mp4(out / f"{comparison.task}.mp4", drawn, 1.0 / step_s)
    write_gif(out / f"{comparison.task}.gif", drawn[::5], 0.2 / step_s, 0.75)


def _parser() -> Parser:
    parser = Parser(
        prog="evaluate_goals.py",
        description="Trains policies to turn or to reach and compares them with steered belts, two drive "
        "magnets and open-loop strokes. A run that was stopped goes on when the same command is given again.",
    )
    parser.add_argument("task", choices=GOAL_TASKS, help="what is asked of the robot")
    parser.add_argument(
        "--budget", default="small", metavar="NAME",
        help="smoke, small (half an hour on two cores), full, or a TOML file (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--workers", type=positive, metavar="N", help="seeds trained side by side (default: one per core)"
    )
    parser.add_argument(
        "--out", metavar="FOLDER", help="folder of the report (default: runs/TASK-comparison)"
    )
    return parser
