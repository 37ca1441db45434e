"""Learning algorithms on turning, each for the same processor time: ``python studies/learners.py``.

PPO and SAC are those of Stable-Baselines3; TQC and CrossQ join where ``sb3-contrib`` is installed, which the
project does not need otherwise. Writes a Markdown page with what it measured.
"""

import argparse
import time
from pathlib import Path
from typing import Any

import numpy as np
import stable_baselines3
import torch
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.utils import set_random_seed
from stable_baselines3.common.vec_env import VecEnv, VecNormalize

from magworm_gym import load_scene
from magworm_gym.baselines import Runner, fly
from magworm_gym.learning.compare.contest import FIRST_SEED
from magworm_gym.sb3 import MagWormSB3VecEnv
from magworm_gym.tasks import TaskName, task_of

TASK: TaskName = "turn"
SCENE = "turn-3-pair"
GOALS_DEG = np.array([30.0, -30.0, 90.0, -90.0])
STARTS = 4
MEASURE_S = 10.0
EPISODE_STEPS = 300
SEED_STRIDE = 1_000_003
GAMMA = 0.98
OFF_POLICY = {
    "learning_rate": 1e-3,
    "buffer_size": 300_000,
    "learning_starts": 5_000,
    "batch_size": 512,
    "train_freq": 1,
    "gradient_steps": 16,
}
SETTINGS: dict[str, tuple[int, dict[str, Any]]] = {
    "PPO": (
        64,
        {
            "learning_rate": 1e-3,
            "n_steps": 32,
            "batch_size": 512,
            "n_epochs": 5,
            "policy_kwargs": {"log_std_init": 0.0},
        },
    ),
    "SAC": (64, {**OFF_POLICY, "tau": 0.01, "policy_kwargs": {"net_arch": [128, 128]}}),
    "TQC": (64, {**OFF_POLICY, "tau": 0.01, "policy_kwargs": {"net_arch": [128, 128]}}),
    "CrossQ": (64, {**OFF_POLICY, "policy_kwargs": {"net_arch": {"pi": [128, 128], "qf": [256, 256]}}}),
}
"""Environments and settings of each algorithm; what is not named is the library's default."""


class Clock(BaseCallback):
    """Ends a training after a time, and notes the mean reward per second on the way."""

    def __init__(self, seconds: float, step_s: float) -> None:
        super().__init__()
        self.curve: list[tuple[float, int, float]] = []
        self._seconds, self._step_s = seconds, step_s
        self._reward, self._steps = 0.0, 0

    def _on_training_start(self) -> None:
        self._began = time.process_time()

    def _on_step(self) -> bool:
        elapsed = time.process_time() - self._began
        self._reward += float(np.sum(self.training_env.env_method("last_rewards")[0]))
        self._steps += self.training_env.num_envs
        if elapsed > self._seconds * (len(self.curve) + 1) / 10:
            self.curve.append((elapsed, self.num_timesteps, self._reward / self._steps / self._step_s))
            self._reward, self._steps = 0.0, 0
        return elapsed < self._seconds


class Rewarded(MagWormSB3VecEnv):
    """Keeps the rewards of the last step, whatever wraps it."""

    def step_wait(self) -> Any:
        """See the base class."""
        answer = super().step_wait()
        self._last = answer[1]
        return answer

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        """See the base class."""
        if method_name == "last_rewards":
            return [self._last]
        return super().env_method(method_name, *args, indices=indices, **kwargs)


class Predicted:
    """A model as a pilot, with its mean action."""

    def __init__(self, model: BaseAlgorithm, environments: VecEnv) -> None:
        self._model, self._environments = model, environments

    def start(self, worms: Any) -> None:
        """Nothing to prepare."""

    def act(self, worms: Any) -> Any:
        """Actions for what they observe."""
        observations = worms.observations
        if isinstance(self._environments, VecNormalize):
            observations = self._environments.normalize_obs(observations)
        return np.asarray(self._model.predict(observations, deterministic=True)[0], np.float64)


def classes() -> dict[str, type[BaseAlgorithm]]:
    """The algorithms that are installed, by name."""
    found: dict[str, type[BaseAlgorithm]] = {"PPO": stable_baselines3.PPO, "SAC": stable_baselines3.SAC}
    try:
        import sb3_contrib
    except ImportError:
        return found
    return {**found, "TQC": sb3_contrib.TQC, "CrossQ": sb3_contrib.CrossQ}


def measured(name: str, kind: type[BaseAlgorithm], seed: int, seconds: float) -> dict[str, Any]:
    """Trains one policy for a time and measures its mean action."""
    torch.set_num_threads(1)
    set_random_seed(seed)
    num_envs, options = SETTINGS[name]
    environments: VecEnv = Rewarded(num_envs, SCENE, EPISODE_STEPS, task=TASK, threads=1)
    environments.seed(seed * SEED_STRIDE)
    if name == "PPO":
        environments = VecNormalize(environments, gamma=GAMMA)
    model = kind("MlpPolicy", environments, gamma=GAMMA, device="cpu", **options)  # type: ignore[call-arg]
    scene = load_scene(SCENE)
    clock = Clock(seconds, scene.control_step_s)
    model.learn(2**31, callback=clock)
    goals = np.repeat(GOALS_DEG, STARTS)
    seeds = range(FIRST_SEED, FIRST_SEED + len(goals))
    worms = Runner(scene, len(goals), task=task_of(TASK))
    flight = fly(worms, Predicted(model, environments), goals, seeds, MEASURE_S)
    turned = np.abs(goals) - np.abs(flight.left[-1])
    return {
        "steps": model.num_timesteps,
        "exploring_deg_s": clock.curve[-1][2] if clock.curve else float("nan"),
        "turned_deg": float(turned.mean()),
        "turned_share": float((turned / np.abs(goals)).mean()),
        "lost": float(flight.lost.mean()),
    }


def main() -> None:
    """Trains and measures, prints each line as it comes, writes the page."""
    parser = argparse.ArgumentParser(description="Learning algorithms on turning at equal processor time.")
    parser.add_argument(
        "--seconds", type=float, default=120.0, help="training time of each (default: %(default)s)"
    )
    parser.add_argument("--seeds", type=int, nargs="+", default=[0], help="seeds of each (default: 0)")
    parser.add_argument(
        "--algorithms", nargs="+", default=list(SETTINGS), help="default: all that are installed"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("docs/learners.md"), help="page (default: %(default)s)"
    )
    flags = parser.parse_args()
    columns = ["algorithm", "seed", "environments", "steps", "°/s while exploring at the end"]
    columns += ["° turned in 10 s", "share of the goal", "lost"]
    lines = ["| " + " | ".join(columns) + " |", "| --- |" + " --- |" * (len(columns) - 1)]
    installed = classes()
    missing = [name for name in flags.algorithms if name not in installed]
    for name in flags.algorithms:
        for seed in flags.seeds if name in installed else []:
            row = measured(name, installed[name], seed, flags.seconds)
            lines.append(
                f"| {name} | {seed} | {SETTINGS[name][0]} | {row['steps']} | {row['exploring_deg_s']:.2f} "
                f"| {row['turned_deg']:.1f} | {row['turned_share']:.0%} | {row['lost']:.0%} |"
            )
            print(lines[-1], flush=True)
    text = (
        "# Learning algorithms on turning\n\n"
        "`MagWorm/Turn-v1`, each algorithm for "
        f"{flags.seconds:.0f} s of processor time, network updates included, in one process with "
        "one thread: wall-clock time on an idle core, and fair on a busy one. Written by "
        "`studies/learners.py`. Then the mean action over goals of ±30° and ±90° from "
        f"{STARTS} starts each, {MEASURE_S:.0f} s. Settings stand in the script; none was tuned at length, "
        "and none begins as a copy. A few tenths of °/s while exploring are the reward of "
        "standing near a goal that was drawn near.\n\n" + "\n".join(lines) + "\n"
    )
    if missing:
        text += f"\nNot installed, so not compared: {', '.join(missing)} (pip install sb3-contrib).\n"
    flags.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
