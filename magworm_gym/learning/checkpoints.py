"""Checkpoints of a training that are complete or absent, and going on from the last one."""

import json
import pickle
import random
import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.off_policy_algorithm import OffPolicyAlgorithm
from stable_baselines3.common.running_mean_std import RunningMeanStd
from stable_baselines3.common.vec_env import VecNormalize

from magworm_gym import MagWormVectorEnv
from magworm_gym.atomic_files import new_folder

KEPT = 2
MODEL = "model.zip"
ENVIRONMENTS = "environments.bin"
RANDOM_STATES = "random_states.pkl"
NORMALISATION = "normalisation.npz"
REPLAY = "replay.pkl"
CURVE = "curve.json"

Curve = list[tuple[int, float]]


@dataclass(frozen=True)
class Trainee:
    """What a training changes.

    Attributes:
        model: Algorithm with policy, optimiser and number of steps.
        environments: The native vector environment.
        normalisation: Running statistics around it, if there are any.
        curve: Learning curve so far: environment steps, speed while exploring [m/s].
    """

    model: BaseAlgorithm
    environments: MagWormVectorEnv
    normalisation: VecNormalize | None
    curve: Curve


def save_checkpoint(folder: Path, trainee: Trainee) -> None:
    """Writes a checkpoint named by the number of steps and drops the oldest.

    Args:
        folder: Folder of all checkpoints of one seed.
        trainee: What to keep.
    """
    with new_folder(folder / f"{trainee.model.num_timesteps:012d}") as part:
        trainee.model.save(part / MODEL)
        (part / ENVIRONMENTS).write_bytes(trainee.environments.get_state())
        (part / RANDOM_STATES).write_bytes(pickle.dumps(_random_states(trainee.model)))
        (part / CURVE).write_text(json.dumps(trainee.curve), encoding="utf-8")
        if trainee.normalisation is not None:
            save_normalisation(part / NORMALISATION, trainee.normalisation)
        if isinstance(trainee.model, OffPolicyAlgorithm):
            trainee.model.save_replay_buffer(part / REPLAY)
    for old in complete_checkpoints(folder)[:-KEPT]:
        shutil.rmtree(old)


def complete_checkpoints(folder: Path) -> list[Path]:
    """Complete checkpoints in a folder, fewest steps first. Unfinished ones have other names."""
    if not folder.is_dir():
        return []
    return sorted(path for path in folder.iterdir() if re.fullmatch(r"\d{12}", path.name))


def restore_checkpoint(path: Path, trainee: Trainee) -> Trainee:
    """Puts a training back to where a checkpoint was written.

    Args:
        path: One of ``complete_checkpoints``.
        trainee: A fresh training with the same settings; its environments and statistics are
            overwritten, its model is replaced.

    Returns:
        The training as it was, random numbers of the process included.
    """
    kind = type(trainee.model)
    model = kind.load(path / MODEL, env=trainee.model.get_env(), force_reset=False, device="cpu")
    if isinstance(model, OffPolicyAlgorithm):
        model.load_replay_buffer(path / REPLAY)
    trainee.environments.set_state((path / ENVIRONMENTS).read_bytes())
    if trainee.normalisation is not None:
        load_normalisation(path / NORMALISATION, trainee.normalisation)
    _set_random_states(model, pickle.loads((path / RANDOM_STATES).read_bytes()))
    curve = [(int(steps), float(speed)) for steps, speed in json.loads((path / CURVE).read_text("utf-8"))]
    return Trainee(model, trainee.environments, trainee.normalisation, curve)


def save_normalisation(path: Path, normalisation: VecNormalize) -> None:
    """Writes running mean, variance and count of observations and returns."""
    observations, returns = statistics(normalisation)
    np.savez(
        path,
        mean=observations.mean,
        var=observations.var,
        count=observations.count,
        clip=normalisation.clip_obs,
        epsilon=normalisation.epsilon,
        return_mean=returns.mean,
        return_var=returns.var,
        return_count=returns.count,
        returns=normalisation.returns,
    )


def load_normalisation(path: Path, normalisation: VecNormalize) -> None:
    """Reads what ``save_normalisation`` wrote."""
    observations, returns = statistics(normalisation)
    with np.load(path) as kept:
        observations.mean, observations.var = kept["mean"], kept["var"]
        observations.count = float(kept["count"])
        returns.mean, returns.var = kept["return_mean"], kept["return_var"]
        returns.count = float(kept["return_count"])
        normalisation.returns = kept["returns"]


def statistics(normalisation: VecNormalize) -> tuple[RunningMeanStd, RunningMeanStd]:
    """Statistics of observations and of returns."""
    observations = normalisation.obs_rms
    assert isinstance(observations, RunningMeanStd), "observations are one array"
    return observations, normalisation.ret_rms


def _random_states(model: BaseAlgorithm) -> dict[str, Any]:
    return {
        "torch": torch.get_rng_state(),
        "numpy": np.random.get_state(),  # noqa: NPY002 - the generator that the library draws from
        "python": random.getstate(),
        "actions": model.action_space.np_random.bit_generator.state,
    }


def _set_random_states(model: BaseAlgorithm, states: dict[str, Any]) -> None:
    torch.set_rng_state(states["torch"])
    np.random.set_state(states["numpy"])  # noqa: NPY002
    random.setstate(states["python"])
    model.action_space.np_random.bit_generator.state = states["actions"]
