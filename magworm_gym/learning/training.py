"""One seed of a training: rounds, checkpoints between them, and the policy at the end."""

import json
import time
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

from magworm_gym import MagWormVectorEnv, Scene
from magworm_gym.atomic_files import write_json
from magworm_gym.learning.checkpoints import newest_checkpoint, save_checkpoint
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.learner import Learner, learner_named
from magworm_gym.learning.place import Place
from magworm_gym.learning.progress import Progress
from magworm_gym.learning.random_states import random_states, seed_all, set_random_states
from magworm_gym.learning.settings import TrainingSettings, checked
from magworm_gym.policy import Policy, save_policy

POLICY = "policy"
FINISHED = "finished.json"
CHECKPOINTS = "checkpoints"
TENSORBOARD = "tensorboard"


def place_of(
    settings: TrainingSettings, scenes: Sequence[str], seed: int, threads: int | None = None
) -> Place:
    """Where a seed is trained: in scenes given as TOML, or in those of the settings."""
    kept = [Scene.from_toml(text) for text in scenes]
    arguments = {**settings.environment, "scene": kept} if kept else settings.environment
    return Place(settings.environment_id, settings.num_envs, seed, arguments, threads)


def new_learner(settings: TrainingSettings, place: Place, folder: Path) -> Learner:
    """A learner before its first step, random numbers of the process included; writes nothing.

    Raises:
        UsageError: A setting is not usable.
        SceneError: The scene cannot be simulated.
    """
    kind = learner_named(settings.algorithm)
    options = checked(settings.learner, kind.Options, "learner")
    seed_all(place.seed)
    return kind(place, options, settings.steps, folder / TENSORBOARD)


def train_seed(
    settings: TrainingSettings,
    scenes: Sequence[str],
    seed: int,
    folder: Path,
    *,
    alone: bool = True,
    threads: int | None = None,
) -> dict[str, Any]:
    """Trains one policy, going on from the newest checkpoint that is whole if there is one.

    Args:
        settings: Settings of the training.
        scenes: Scenes to train in, in TOML.
        seed: Seed of policy, exploration and environments.
        folder: Folder of this seed; gets checkpoints, TensorBoard files and, at the end, the policy.
        alone: Whether no other seed is trained beside it.
        threads: Most threads of the simulator; None for all cores. It does not change the results.

    Returns:
        What ``finished.json`` holds: steps, simulated and wall-clock seconds, learning curve. A seed
        that is finished already is not trained again.
    """
    if (finished := _finished(folder)) is not None:
        return finished
    began, place = time.monotonic(), place_of(settings, scenes, seed, threads)
    worms = place.native()
    learner = new_learner(settings, place, folder)
    step_s = worms.scene.control_step_s
    with closing(Progress(folder, worms.task, settings.steps, step_s, alone=alone)) as progress:
        taught = _start(learner, progress, folder)
        first = progress.steps
        _learn(learner, progress, settings, folder, taught)
    summary = {
        "algorithm": settings.algorithm,
        "seed": seed,
        "steps": progress.steps,
        "taught_steps": taught,
        "resumed_at_step": first,
        "simulated_s": progress.steps * step_s,
        "wall_clock_s_since_resume": time.monotonic() - began,
        "curve": progress.curve,
        "curve_unit": progress.unit,
    }
    _save_policy(folder / POLICY, learner, settings, worms, seed)
    write_json(folder / FINISHED, summary)
    return summary


def _finished(folder: Path) -> dict[str, Any] | None:
    """What a finished seed has left; where it is damaged, the last checkpoint gives it again."""
    try:
        summary: dict[str, Any] = json.loads((folder / FINISHED).read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError):
        return None
    return summary


def _start(learner: Learner, progress: Progress, folder: Path) -> int:
    """Goes back to the newest checkpoint, or begins. Returns the steps that came before the first round."""
    kept = newest_checkpoint(folder / CHECKPOINTS)
    if kept is None:
        return learner.begin()
    try:
        learner.restore(kept["learner"])
        progress.restore(kept["progress"])
        set_random_states(kept["random"])
    except (KeyError, TypeError, ValueError, RuntimeError) as error:
        raise UsageError(
            f"the newest checkpoint in {folder / CHECKPOINTS} does not fit, as one of other settings or of "
            f"another version of a library: {' '.join(str(error).split())}"
        ) from None
    taught: int = kept["taught"]
    return taught


def _learn(
    learner: Learner, progress: Progress, settings: TrainingSettings, folder: Path, taught: int
) -> None:
    """Rounds until the training is long enough, with checkpoints between them."""
    kept_at = progress.steps
    while progress.steps < settings.steps:
        progress.add(learner.advance())
        if progress.steps - kept_at >= settings.checkpoint_steps or progress.steps >= settings.steps:
            kept_at = progress.steps
            state = {"learner": learner.state(), "progress": progress.state(), "random": random_states()}
            save_checkpoint(folder / CHECKPOINTS, kept_at, {**state, "taught": taught})


def _save_policy(
    path: Path, learner: Learner, settings: TrainingSettings, worms: MagWormVectorEnv, seed: int
) -> None:
    """Writes what acting needs, and where it comes from."""
    policy = Policy.trained_in(
        worms,
        *learner.actor(),
        environment_id=settings.environment_id,
        arguments={name: value for name, value in settings.environment.items() if name != "scene"},
        sentence=f"Trained by {settings.algorithm} in {settings.environment_id}.",
        provenance={"settings": settings.to_json(), "seed": seed},
    )
    save_policy(path, policy)
