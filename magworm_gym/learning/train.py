"""Trains drive-magnet controllers: ``python training/train.py crawl --help``."""

import argparse
from pathlib import Path
from typing import Any

from magworm_gym import Scene, load_scene
from magworm_gym.atomic_files import write_json, write_text
from magworm_gym.learning.command_line import Parser, UsageError, positive
from magworm_gym.learning.settings import (
    ALGORITHMS,
    CONFIGS,
    UNITS,
    TrainingSettings,
    read_saved_settings,
    read_settings,
)
from magworm_gym.tasks import task_of

PURPOSES = {
    "crawl": "crawl towards the head as fast as possible",
    "turn": "turn to a heading and stay there",
    "reach": "crawl to a point",
}

SETTINGS = "settings.json"
SCENE = "scene.toml"


def main(arguments: list[str]) -> None:
    """Reads the command line and trains.

    Args:
        arguments: Command line without the program's name.

    Raises:
        UsageError: A flag, a setting or a folder is not usable.
        SceneError: The scene cannot be simulated.
    """
    flags = _parser().parse_args(arguments)
    out = Path(flags.out or f"runs/{flags.task}")
    settings = _resumed_settings(flags, out) if flags.resume else _new_settings(flags)
    if not flags.resume and (out / SETTINGS).exists():
        raise UsageError(
            f"{out} holds a training already: add --resume to go on with it, or choose another --out"
        )
    summaries = train(settings, out, flags.workers)
    for summary in summaries:
        speed = 1000.0 * summary["curve"][-1][1] if summary["curve"] else 0.0
        print(
            f"seed {summary['seed']}: {summary['steps']} steps, {speed:.1f} {UNITS[settings.task]} "
            "while exploring"
        )
    print(f"policies are in {out}/seed-*/policy")


def train(settings: TrainingSettings, out: Path, workers: int | None = None) -> list[dict[str, Any]]:
    """Trains every seed into a folder, going on where an earlier run stopped.

    Args:
        settings: Settings of the training.
        out: Folder of the run; settings and scene are kept in it.
        workers: Seeds trained side by side; None for the number of cores.

    Returns:
        One summary for each seed, see ``crawl_training.train_seed``.
    """
    from magworm_gym.learning.seeds import default_workers, train_seeds

    kept_scene = out / SCENE
    scene = (
        Scene.from_toml(kept_scene.read_text("utf-8")) if kept_scene.exists() else load_scene(settings.scene)
    )
    if not scene.controlled:
        raise UsageError(f"scene {settings.scene!r} has no drive that a policy could control")
    out.mkdir(parents=True, exist_ok=True)
    write_text(kept_scene, scene.to_toml())
    write_json(out / SETTINGS, settings.to_json())
    return train_seeds(settings, scene, out, workers or default_workers())


def _new_settings(flags: argparse.Namespace) -> TrainingSettings:
    """Settings of a file, of the task's own if it has one, with the flags on top."""
    overrides = _overrides(flags)
    if flags.config:
        return read_settings(Path(flags.config), overrides)
    algorithm = flags.algorithm or "ppo"
    own = CONFIGS / f"{flags.task}-{algorithm}.toml"
    if own.exists():
        return read_settings(own, overrides)
    scene = {"scene": str(task_of(flags.task).default_scene)}
    return read_settings(CONFIGS / f"{algorithm}.toml", scene | overrides)


def _resumed_settings(flags: argparse.Namespace, out: Path) -> TrainingSettings:
    """The settings that the run was started with; a flag may repeat them, not change them."""
    settings = read_saved_settings(out / SETTINGS)
    kept = settings.to_json()
    for name, value in _overrides(flags).items():
        if kept[name] != value:
            raise UsageError(
                f"{out} was started with {name} {kept[name]!r}; --resume cannot change it to {value!r}"
            )
    return settings


def _overrides(flags: argparse.Namespace) -> dict[str, Any]:
    names = ["task", "algorithm", "scene", "num_envs", "steps", "seeds"]
    names += ["checkpoint_steps", "removed_share", "parameter_spread"]
    return {name: getattr(flags, name) for name in names if getattr(flags, name) is not None}


def _parser() -> Parser:
    parser = Parser(prog="train.py", description="Trains drive-magnet controllers.")
    tasks = parser.add_subparsers(dest="task", required=True, metavar="TASK", parser_class=Parser)
    for name, purpose in PURPOSES.items():
        task = tasks.add_parser(
            name,
            help=purpose,
            description=f"Trains policies that {purpose}. Flags override the table [run] of the settings "
            "file.",
        )
        _add_flags(task, str(task_of(name).default_scene))
    return parser


def _add_flags(parser: Parser, scene: str) -> None:
    add = parser.add_argument
    add("--algorithm", choices=ALGORITHMS, help="learning algorithm (default: ppo)")
    add(
        "--config",
        metavar="FILE",
        help="settings (default: those of task and algorithm in training/configs/)",
    )
    add("--scene", help=f"preset or path of a TOML file (default: {scene})")
    add("--num-envs", type=int, metavar="N", help="environments in the batch")
    add("--steps", type=int, metavar="N", help="environment steps of each seed")
    add("--seeds", type=int, nargs="+", metavar="SEED", help="one policy for each seed")
    add("--checkpoint-steps", type=int, metavar="N", help="environment steps between checkpoints")
    randomise = parser.add_argument_group("robots that differ, so that a policy survives damage")
    randomise.add_argument(
        "--randomise-magnets", dest="removed_share", type=float, metavar="SHARE",
        help="share of environments whose robot lacks magnets (three are left at least)",
    )  # fmt: skip
    randomise.add_argument(
        "--randomise-parameters", dest="parameter_spread", type=float, metavar="SPREAD",
        help="stiffness, friction and so on differ by up to this share",
    )  # fmt: skip
    add("--workers", type=positive, metavar="N", help="seeds trained side by side (default: one per core)")
    add("--out", metavar="FOLDER", help="folder of the run (default: runs/TASK)")
    add("--resume", action="store_true", help="go on from the last complete checkpoint of --out")
