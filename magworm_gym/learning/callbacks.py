"""What happens between rollouts: learning curve, checkpoints, progress bar."""

import multiprocessing
import sys
from collections.abc import Callable

import numpy as np
from stable_baselines3.common.callbacks import BaseCallback
from tqdm import tqdm

from magworm_gym.learning.checkpoints import Curve

MM_PER_M = 1000.0
TENTHS = 10


class LearningCurve(BaseCallback):
    """Notes the mean reward per second of the exploring policy over stretches of steps.

    Args:
        curve: Points are added to it: environment steps, a thousandth of the reward per second, so that
            a task rewarded in millimetres has its speed [m/s]; turning has thousands of degrees per second.
        control_step_s: Duration of a step [s].
        stretch: Environment steps that share one point.
        title: Name of the value in TensorBoard.
    """

    def __init__(
        self, curve: Curve, control_step_s: float, stretch: int, title: str = "crawl/speed_mm_s"
    ) -> None:
        super().__init__()
        self._curve = curve
        self._control_step_s = control_step_s
        self._stretch = stretch
        self._title = title
        self._progress_mm = 0.0
        self._steps = 0

    def _on_step(self) -> bool:
        rewards = self.locals["rewards"]
        if self.training_env is not None and hasattr(self.training_env, "get_original_reward"):
            rewards = self.training_env.get_original_reward()
        self._progress_mm += float(np.sum(rewards))
        self._steps += len(rewards)
        return True

    def _on_rollout_end(self) -> None:
        if self._steps < self._stretch:
            return
        speed_m_s = self._progress_mm / MM_PER_M / self._steps / self._control_step_s
        self._curve.append((self.num_timesteps, speed_m_s))
        self.logger.record(self._title, MM_PER_M * speed_m_s)
        self._progress_mm, self._steps = 0.0, 0


class Checkpoints(BaseCallback):
    """Saves between updates, when policy, environments and statistics fit together.

    Where the training runs in a worker process, it ends with the process that started it: a run that
    goes on later must find nobody else writing into its folder.

    Args:
        save: Writes a checkpoint.
        every: Environment steps between checkpoints.
        done: Environment steps at the last checkpoint.
    """

    def __init__(self, save: Callable[[], None], every: int, done: int) -> None:
        super().__init__()
        self._save = save
        self._every = every
        self._done = done

    def _on_rollout_start(self) -> None:
        parent = multiprocessing.parent_process()
        if parent is not None and not parent.is_alive():
            raise KeyboardInterrupt("the process that wanted this training is gone")
        if self.num_timesteps - self._done >= self._every:
            self._save()
            self._done = self.num_timesteps

    def _on_step(self) -> bool:
        return True


class Bar(BaseCallback):
    """Shows a progress bar with the latest speed; away from a terminal, a line for each tenth.

    Args:
        title: Text in front of the bar.
        total: Environment steps of the whole training.
        curve: Learning curve, for the speed.
        row: Line of the terminal, counted from the first bar.
        unit: Unit of the speed.
    """

    def __init__(self, title: str, total: int, curve: Curve, row: int = 0, unit: str = "mm/s") -> None:
        super().__init__()
        self._title = title
        self._total = total
        self._curve = curve
        self._row = row
        self._unit = unit

    def _on_training_start(self) -> None:
        self._tenth = TENTHS * self.num_timesteps // self._total
        self._bar = tqdm(
            total=self._total,
            initial=self.num_timesteps,
            desc=self._title,
            unit="step",
            unit_scale=True,
            position=self._row,
            disable=not sys.stderr.isatty(),
        )

    def _on_rollout_end(self) -> None:
        speed = f"{MM_PER_M * self._curve[-1][1]:.1f} {self._unit}" if self._curve else ""
        tenth = TENTHS * self.num_timesteps // self._total
        if self._bar.disable and tenth > self._tenth:
            print(f"{self._title}: {self.num_timesteps} of {self._total} steps  {speed}", flush=True)
        self._tenth = tenth
        self._bar.set_postfix_str(speed, refresh=False)
        self._bar.update(self.num_timesteps - self._bar.n)

    def _on_training_end(self) -> None:
        self._bar.close()

    def _on_step(self) -> bool:
        return True
