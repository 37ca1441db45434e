"""Trains drive-magnet controllers: ``python training/train.py crawl --help``."""

import argparse
import shlex
import sys
from collections.abc import Iterator, Sequence
from importlib import import_module
from itertools import count, takewhile
from pathlib import Path
from typing import Any

from magworm_gym import CRAWL_ID, REACH_ID, TURN_ID
from magworm_gym.atomic_files import write_json, write_text
from magworm_gym.learning.command_line import Parser, UsageError, positive
from magworm_gym.learning.owner import owned
from magworm_gym.learning.settings import TrainingSettings, merged, read_saved_settings, read_settings

ENVIRONMENTS = {"crawl": CRAWL_ID, "turn": TURN_ID, "reach": REACH_ID}
"""Words for the environments of the package."""
SETTINGS = "settings.json"
SCENE = "scene.toml"


def main(arguments: list[str], configs: Path | None = None) -> None:
    """Reads the command line and trains.

    Args:
        arguments: Command line without the program's name.
        configs: Folder with a file of settings for each algorithm, ``ppo.toml`` and so on; None for none.

    Raises:
        UsageError: A flag, a setting or a folder is not usable.
        SceneError: The scene cannot be simulated.
        KeyboardInterrupt: Ctrl-C; the message says how to go on.
    """
    flags = _parser().parse_args(arguments)
    modules = []
    for name in ("environment", "algorithm"):
        module, _, given = (getattr(flags, name) or "").rpartition(":")
        if module:
            setattr(flags, name, given)
            modules.append(_imported(module))
    out = Path(flags.out or f"runs/{flags.environment.rpartition('/')[2]}")
    settings = _resumed_settings(flags, out) if flags.resume else _new_settings(flags, configs)
    if not flags.resume and (out / SETTINGS).exists():
        raise UsageError(
            f"{out} holds a training already: add --resume to go on with it, or choose another --out"
        )
    try:
        summaries = train(settings, out, flags.workers, modules)
    except KeyboardInterrupt:
        if not (out / SETTINGS).exists():
            raise
        words = [Path(sys.executable).name, sys.argv[0], *arguments, *["--resume"] * (not flags.resume)]
        raise KeyboardInterrupt(f"this goes on from the newest checkpoint: {shlex.join(words)}") from None
    for summary in summaries:
        reward = summary["curve"][-1][1] if summary["curve"] else 0.0
        found = f"{summary['steps']} steps, {reward:.1f} {summary['curve_unit']} while exploring"
        print(f"seed {summary['seed']}: {found}")
    print(f"policies are in {out}/seed-*/policy")


def train(
    settings: TrainingSettings, out: Path, workers: int | None = None, modules: Sequence[str] = ()
) -> list[dict[str, Any]]:
    """Trains every seed into a folder, going on where an earlier run stopped.

    Settings are tried, and environments and learner made once, before the folder is touched.

    Args:
        settings: Settings of the training.
        out: Folder of the run; settings and scene are kept in it.
        workers: Seeds trained side by side; None for the number of cores.
        modules: What a process imports first, to register environments and learners.

    Returns:
        One summary for each seed, see :func:`~magworm_gym.learning.training.train_seed`.

    Raises:
        UsageError: A setting is not usable, or another process is at work in the folder.
        SceneError: The scene cannot be simulated.
    """
    from magworm_gym.learning.seeds import default_workers, train_seeds
    from magworm_gym.learning.training import new_learner, place_of

    texts = _kept_scenes(out)
    place = place_of(settings, texts, settings.seeds[0])
    scenes = place.native().scenes
    if not scenes[0].controlled:
        raise UsageError(f"scene {scenes[0].name!r} has no drive that a policy could control")
    new_learner(settings, place, out)
    with owned(out):
        if not texts:
            texts = [scene.to_toml() for scene in scenes]
            for path, text in zip(_scene_files(out), texts, strict=False):
                write_text(path, text)
            write_json(out / SETTINGS, settings.to_json())
        return train_seeds(settings, texts, out, workers or default_workers(), modules)


def _kept_scenes(out: Path) -> list[str]:
    """The scenes that a run has kept, in TOML: a preset may change meanwhile."""
    files = takewhile(Path.exists, _scene_files(out)) if (out / SETTINGS).exists() else ()
    return [path.read_text("utf-8") for path in files]


def _scene_files(out: Path) -> Iterator[Path]:
    """Where a run keeps its first scene, its second, and so on."""
    return (out / (f"scene_{number:03d}.toml" if number else SCENE) for number in count())


def _new_settings(flags: argparse.Namespace, configs: Path | None) -> TrainingSettings:
    """Settings of a file, or of the folder's file for the algorithm, with the flags on top."""
    changes = _changes(flags)
    file = configs / f"{flags.algorithm or 'ppo'}.toml" if configs else None
    path = Path(flags.config) if flags.config else file if file and file.exists() else None
    return read_settings(path, _identifier(flags), changes)


def _resumed_settings(flags: argparse.Namespace, out: Path) -> TrainingSettings:
    """The settings that the run was started with; a flag may repeat them, not change them."""
    settings = read_saved_settings(out / SETTINGS)
    kept = settings.to_json()
    for name, value in {**_changes(flags), "environment_id": _identifier(flags)}.items():
        if merged(kept, {name: value}) != kept:
            raise UsageError(
                f"{out} was started with {name} {kept[name]!r}; --resume cannot change it to {value!r}"
            )
    return settings


def _identifier(flags: argparse.Namespace) -> str:
    return ENVIRONMENTS.get(flags.environment) or str(flags.environment)


def _changes(flags: argparse.Namespace) -> dict[str, Any]:
    """What the flags change in the settings."""
    names = ["algorithm", "num_envs", "steps", "seeds", "checkpoint_steps", "scene", "removed", "parameters"]
    given = {name: getattr(flags, name) for name in names if getattr(flags, name) is not None}
    randomise = {name: given.pop(name) for name in ("removed", "parameters") if name in given}
    environment = {"scene": given.pop("scene")} if "scene" in given else {}
    environment |= {"randomise": randomise} if randomise else {}
    return given | ({"environment": environment} if environment else {})


def _imported(module: str) -> str:
    try:
        return import_module(module).__name__
    except ImportError as error:
        raise UsageError(f"module {module!r} cannot be imported: {error}") from None


def _parser() -> Parser:
    parser = Parser(
        prog="train.py", description="Trains drive-magnet controllers. Flags override the settings file."
    )
    add = parser.add_argument
    add(
        "environment",
        metavar="ENVIRONMENT",
        help="crawl (towards the head as fast as possible), turn (to a heading, and stay there), reach (a "
        "point), or an identifier such as MagWorm/Turn-v1; module:identifier imports what registers it",
    )
    add("--algorithm", metavar="NAME", help="ppo, sac, or module:name of another learner (default: ppo)")
    add("--config", metavar="FILE", help="settings (default: those of the algorithm in training/)")
    add("--scene", help="preset or path of a TOML file (default: the environment's)")
    add("--num-envs", type=int, metavar="N", help="environments in the batch")
    add("--steps", type=int, metavar="N", help="environment steps of each seed")
    add("--seeds", type=int, nargs="+", metavar="SEED", help="one policy for each seed")
    add("--checkpoint-steps", type=int, metavar="N", help="environment steps between checkpoints")
    randomise = parser.add_argument_group("robots that differ, so that a policy survives damage").add_argument
    randomise(
        "--randomise-magnets", dest="removed", type=float, metavar="SHARE",
        help="share of episodes whose robot lacks magnets (three are left at least)",
    )  # fmt: skip
    randomise(
        "--randomise-parameters", dest="parameters", type=float, metavar="WIDTH",
        help="stiffness, friction and so on differ by up to this share",
    )  # fmt: skip
    add("--workers", type=positive, metavar="N", help="seeds trained side by side (default: one per core)")
    add("--out", metavar="FOLDER", help="folder of the run (default: runs/ENVIRONMENT)")
    add("--resume", action="store_true", help="go on from the newest checkpoint of --out")
    return parser
