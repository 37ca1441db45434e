"""Compares a learned controller with tuned drives: ``python training/evaluate.py --help``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from magworm_gym import Scene
from magworm_gym.atomic_files import write_json, write_text
from magworm_gym.learning.command_line import Parser, UsageError, positive
from magworm_gym.learning.compare.evaluation_settings import Budget, read_budget
from magworm_gym.learning.settings import TrainingSettings, read_saved_settings
from magworm_gym.learning.train import SCENE, SETTINGS, train

if TYPE_CHECKING:
    from magworm_gym.learning.compare.comparison import Comparison
    from magworm_gym.learning.compare.report import Result

ANIMATION_PANELS = ("learned policy", "belt, 125 mm pitch", "shuttle", "CMA-ES stroke")
GIF_EVERY = 3
GIF_SCALE = 0.5


def main(arguments: list[str]) -> None:
    """Reads the command line, compares, writes the report and prints its tables last.

    Args:
        arguments: Command line without the program's name.

    Raises:
        UsageError: A flag, a setting or a folder is not usable.
        SceneError: The scene cannot be simulated.
    """
    flags = _parser().parse_args(arguments)
    if flags.policies is not None and flags.scene is not None:
        raise UsageError(
            "--scene goes with a new training; policies are compared on the scene they were trained on"
        )
    out = Path(flags.out)
    budget = read_budget(flags.budget, flags.scene)
    folder = Path(flags.policies) if flags.policies is not None else out / "training"
    settings = _settings(folder, budget, given=flags.policies is not None)
    out.mkdir(parents=True, exist_ok=True)
    print(evaluate(budget, settings, folder, out, flags.workers))


def evaluate(
    budget: Budget, settings: TrainingSettings, folder: Path, out: Path, workers: int | None = None
) -> str:
    """Runs all stages; those that an earlier run has finished are kept.

    Args:
        budget: Sizes of sweeps, searches and measurements.
        settings: Settings of the training.
        folder: Folder of the training; what is missing of it is trained.
        out: Folder of the report.
        workers: Seeds trained side by side; None for the number of cores.

    Returns:
        Verdict and tables, to print.
    """
    from magworm_gym.learning.compare import report
    from magworm_gym.learning.compare.comparison import Comparison, Policies
    from magworm_gym.learning.compare.stages import Stages

    summaries = train(settings, folder, workers)
    scene = Scene.from_toml((folder / SCENE).read_text(encoding="utf-8"))
    policies = Policies(folder, settings.algorithm, summaries)
    comparison = Comparison(scene, policies, budget, Stages(out / "stages"))
    by_robot = {
        comparison.name(robot): report.results_of(comparison.rows(robot)) for robot in comparison.robots
    }
    _draw(comparison, by_robot, out)
    write_json(out / "results.json", report.results_json(comparison, by_robot))
    write_text(out / "report.md", report.report(comparison, by_robot, _training_text(settings, summaries)))
    whole = next(iter(by_robot.values()))
    parts = [report.verdict(whole), report.table(comparison, whole)]
    if len(by_robot) > 1:
        parts.insert(1, report.robots_table(comparison, by_robot))
    return "\n\n".join(["", f"report: {out / 'report.md'}", *parts])


def _draw(comparison: Comparison, by_robot: dict[str, list[Result]], out: Path) -> None:
    """Draws figures and animation of the whole robot."""
    from magworm_gym.learning.compare import figures
    from magworm_gym.render.animation import write_gif, write_mp4
    from magworm_gym.render.race import race_frames

    whole = next(iter(by_robot.values()))
    rows = [result.row for result in whole]
    figures.draw_speeds(out / "speeds.png", by_robot)
    figures.draw_speed_curves(out / "speed_curves.png", comparison, whole)
    figures.draw_learning_curves(out / "learning_curves.png", comparison, whole)
    recordings = comparison.recordings(comparison.whole, rows, comparison.budget.final.animation_s)
    figures.draw_portraits(out / "portraits.png", recordings, comparison.scene.stage_limits or {})
    panels = {title: recordings[title] for title in ANIMATION_PANELS}
    geometry = {title: comparison.scene.geometry for title in panels}
    fps = 1.0 / comparison.scene.control_step_s
    frames = list(race_frames(panels, geometry))
    write_mp4(out / "race.mp4", frames, fps)
    write_gif(out / "race.gif", frames[::GIF_EVERY], fps / GIF_EVERY, GIF_SCALE)


def _settings(folder: Path, budget: Budget, *, given: bool) -> TrainingSettings:
    """Settings of the training in a folder, or of the one that the budget asks for."""
    if given or (folder / SETTINGS).exists():
        kept = read_saved_settings(folder / SETTINGS)
        if not given and kept != budget.training:
            raise UsageError(f"{folder} holds a training with other settings: choose another --out")
        return kept
    return budget.training


def _training_text(settings: TrainingSettings, summaries: list[dict[str, Any]]) -> str:
    steps, simulated_s = summaries[0]["steps"], summaries[0]["simulated_s"]
    randomise = settings.environment.get("randomise", {})
    removed, parameters = randomise.get("removed", 0.0), randomise.get("parameters", 0.0)
    return (
        f"Learned policy: {settings.algorithm.upper()} (Stable-Baselines3), seeds "
        f"{', '.join(str(seed) for seed in settings.seeds)}, {steps} environment steps = {simulated_s:.0f} "
        f"simulated seconds for each, {settings.num_envs} environments, evaluated with its mean action. "
        f"{removed:.0%} of the training robots lack magnets where three are left, parameters "
        f"spread by {parameters:.0%}."
    )


def _parser() -> Parser:
    parser = Parser(
        prog="evaluate.py",
        description="Compares a learned policy with belts, a shuttle and a CMA-ES stroke on the same robot "
        "and limits. A run that was stopped goes on when the same command is given again.",
    )
    parser.add_argument(
        "--budget", default="small", metavar="NAME",
        help="small (a quarter of an hour on two cores), full, or a TOML file (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--policies",
        metavar="FOLDER",
        help="--out of a train.py run (default: trains into the folder training of --out)",
    )
    parser.add_argument(
        "--workers", type=positive, metavar="N", help="seeds trained side by side (default: one per core)"
    )
    parser.add_argument("--scene", help="preset or path of a TOML file to train and compare on")
    parser.add_argument(
        "--out",
        default="runs/crawl-comparison",
        metavar="FOLDER",
        help="folder of the report (default: %(default)s)",
    )
    return parser
