"""Training of policies with Stable-Baselines3."""

import json
import time
from pathlib import Path
from typing import Any

import torch
from stable_baselines3 import PPO, SAC
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.logger import configure
from stable_baselines3.common.utils import LinearSchedule, set_random_seed
from stable_baselines3.common.vec_env import VecEnv, VecNormalize

from magworm_gym import Scene
from magworm_gym.atomic_files import new_folder, write_json
from magworm_gym.learning.callbacks import Bar, Checkpoints, LearningCurve
from magworm_gym.learning.checkpoints import (
    MODEL,
    NORMALISATION,
    Trainee,
    complete_checkpoints,
    restore_checkpoint,
    save_checkpoint,
    save_normalisation,
)
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.robots_in_batch import VariedRobots
from magworm_gym.learning.settings import UNITS, TrainingSettings

ACTIVATIONS = {"tanh": torch.nn.Tanh, "relu": torch.nn.ReLU}
ALGORITHM_CLASSES: dict[str, type[BaseAlgorithm]] = {"ppo": PPO, "sac": SAC}
POLICY = "policy"
TAUGHT = "taught.json"
FINISHED = "finished.json"
CHECKPOINTS = "checkpoints"
CURVE_POINTS = 100
CURVE_TITLES = {"crawl": "crawl/speed_mm_s", "turn": "turn/deg_s", "reach": "reach/speed_mm_s"}
# Seeds of environments follow each other, so those of two trainings must lie far apart.
SEED_STRIDE = 1_000_003


def train_seed(
    settings: TrainingSettings,
    scene: Scene,
    seed: int,
    folder: Path,
    *,
    row: int = 0,
    threads: int | None = None,
) -> dict[str, Any]:
    """Trains one policy, going on from the last complete checkpoint if there is one.

    Args:
        settings: Settings of the training.
        scene: Scene to train on.
        seed: Seed of policy, exploration and environments.
        folder: Folder of this seed; gets checkpoints, TensorBoard files and, at the end, the policy.
        row: Line of the terminal for the progress bar, counted from the first one.
        threads: Most threads of the simulator; None for all cores. It does not change the results.

    Returns:
        What ``finished.json`` holds: steps, simulated and wall-clock seconds, learning curve. A seed
        that is finished already is not trained again.
    """
    if (folder / FINISHED).exists():
        return read_finished(folder)
    folder.mkdir(parents=True, exist_ok=True)
    # The network is small: a second thread costs more in waiting than it computes.
    torch.set_num_threads(1)
    began = time.monotonic()
    trainee, robots = _trainee(settings, scene, seed, threads)
    checkpoints = complete_checkpoints(folder / CHECKPOINTS)
    if checkpoints:
        trainee = restore_checkpoint(checkpoints[-1], trainee)
    elif "teacher" in settings.policy:
        from magworm_gym.learning.demonstration import teach

        taught_steps = teach(settings, scene, trainee, robots, seed)
        write_json(folder / TAUGHT, {"steps": taught_steps})
    first_step = trainee.model.num_timesteps
    _learn(settings, scene, trainee, folder, row)
    _save_policy(folder / POLICY, trainee)
    summary = {
        "algorithm": settings.algorithm,
        "seed": seed,
        "steps": trainee.model.num_timesteps,
        "resumed_at_step": first_step,
        "simulated_s": trainee.model.num_timesteps * scene.control_step_s,
        "wall_clock_s_since_resume": time.monotonic() - began,
        "curve": trainee.curve,
    }
    write_json(folder / FINISHED, summary)
    return summary


def read_finished(folder: Path) -> dict[str, Any]:
    """Reads what a finished seed has left."""
    summary: dict[str, Any] = json.loads((folder / FINISHED).read_text(encoding="utf-8"))
    return summary


def _trainee(
    settings: TrainingSettings, scene: Scene, seed: int, threads: int | None
) -> tuple[Trainee, VariedRobots]:
    """A training before its first step, and its environments as they are."""
    # Not the argument of the algorithm: that would also seed the environments, close to each other.
    set_random_seed(seed)
    robots = VariedRobots(settings, scene, seed, threads)
    vec_env: VecEnv = robots
    vec_env.seed(seed * SEED_STRIDE)
    normalisation = None
    if settings.policy.get("normalise", False):
        vec_env = normalisation = VecNormalize(vec_env, gamma=settings.options.get("gamma", 0.99))
    # The first observation, and the robots that a restored state relies on.
    vec_env.reset()
    model = _model(settings, vec_env)
    model.action_space.seed(seed)
    return Trainee(model, robots.worms, normalisation, []), robots


def _model(settings: TrainingSettings, vec_env: VecEnv) -> BaseAlgorithm:
    network: dict[str, Any] = {
        "net_arch": list(settings.policy.get("hidden", [64, 64])),
        "activation_fn": ACTIVATIONS[settings.policy.get("activation", "tanh")],
    }
    if "log_std_init" in settings.policy:
        network["log_std_init"] = settings.policy["log_std_init"]
    rate = settings.learning_rate
    schedule = LinearSchedule(rate.get("start", 1e-3), rate.get("end", 1e-4), 1.0)
    options = dict(settings.options)
    if settings.algorithm == "ppo":
        # A batch cannot be larger than what one rollout brings.
        rollout = options.get("n_steps", 32) * settings.num_envs
        options["batch_size"] = min(options.get("batch_size", rollout), rollout)
    try:
        return ALGORITHM_CLASSES[settings.algorithm](
            "MlpPolicy", vec_env, learning_rate=schedule, policy_kwargs=network, device="cpu", **options
        )
    except TypeError as error:
        raise UsageError(f"table [algorithm]: {error}") from None


def _learn(settings: TrainingSettings, scene: Scene, trainee: Trainee, folder: Path, row: int) -> None:
    model = trainee.model
    left = settings.steps - model.num_timesteps
    if left <= 0:
        return
    model.set_logger(configure(str(folder / "tensorboard"), ["tensorboard"]))
    stretch = max(settings.steps // CURVE_POINTS, 1)
    callbacks = [
        LearningCurve(trainee.curve, scene.control_step_s, stretch, CURVE_TITLES[settings.task]),
        Checkpoints(
            lambda: save_checkpoint(folder / CHECKPOINTS, trainee),
            settings.checkpoint_steps,
            model.num_timesteps,
        ),
        Bar(folder.name, settings.steps, trainee.curve, row, UNITS[settings.task]),
    ]
    fresh = model.num_timesteps == 0
    model.learn(left, callbacks, reset_num_timesteps=fresh)
    save_checkpoint(folder / CHECKPOINTS, trainee)


def _save_policy(path: Path, trainee: Trainee) -> None:
    """Writes what acting needs: the model, and the statistics of the observations."""
    with new_folder(path) as part:
        trainee.model.save(part / MODEL)
        if trainee.normalisation is not None:
            save_normalisation(part / NORMALISATION, trainee.normalisation)
