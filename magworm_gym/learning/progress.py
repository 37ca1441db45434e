"""What is seen of a training while it runs: learning curve, TensorBoard, progress bar."""

from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar
from torch.utils.tensorboard import SummaryWriter

from magworm_gym.learning.checkpoints import Tree
from magworm_gym.learning.learner import Round
from magworm_gym.tasks import Task

TENTHS = 10
POINTS = 100
"""Points of a learning curve."""


class Progress:
    """The learning curve of one seed, drawn as it grows: on a terminal as a bar, else a line for each tenth.

    Args:
        folder: Folder of the seed; its name stands before the bar.
        task: The task.
        steps: Environment steps of the whole training.
        control_step_s: Duration of a step [s].
        alone: Whether no other seed is trained beside it: a terminal holds one bar.

    Attributes:
        steps: Environment steps so far.
        curve: Environment steps, and the mean reward per second of the exploring policy over the steps
            since the point before.
        unit: Unit of that.
    """

    def __init__(self, folder: Path, task: Task, steps: int, control_step_s: float, *, alone: bool) -> None:
        self.steps = 0
        self.curve: list[tuple[int, float]] = []
        self.unit = f"{task.reward_unit}/s"
        self._title, self._total, self._step_s = folder.name, steps, control_step_s
        self._since: list[float] = [0, 0.0]
        self._name, self._writer = f"{task.name}/reward_per_s", SummaryWriter(str(folder / "tensorboard"))
        console = Console(stderr=True)
        columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
        reward = TextColumn("{task.fields[reward]}")
        self._bar = Bar(*columns, reward, console=console, disable=not (alone and console.is_terminal))
        self._row = self._bar.add_task(folder.name, total=steps, reward="")
        self._bar.start()

    def add(self, done: Round) -> None:
        """Counts a round."""
        tenth = TENTHS * self.steps // self._total
        self.steps += done.steps
        self._since = [self._since[0] + done.steps, self._since[1] + done.reward]
        if self._since[0] >= self._total // POINTS:
            self.curve.append((self.steps, self._since[1] / self._since[0] / self._step_s))
            self._writer.add_scalar(self._name, self.curve[-1][1], self.steps)
            self._since = [0, 0.0]
        reward = f"{self.curve[-1][1]:.1f} {self.unit}" if self.curve else ""
        self._bar.update(self._row, completed=self.steps, reward=reward)
        if self._bar.disable and TENTHS * self.steps // self._total > tenth:
            print(f"{self._title}: {self.steps} of {self._total} steps  {reward}", flush=True)

    def state(self) -> Tree:
        """Steps, curve and what has come since its last point."""
        return {"steps": self.steps, "curve": self.curve, "since": self._since}

    def restore(self, state: Tree) -> None:
        """Goes on from such a state."""
        self.steps, self._since = state["steps"], state["since"]
        self.curve = [(steps, reward) for steps, reward in state["curve"]]

    def close(self) -> None:
        """Closes the bar and TensorBoard's file."""
        self._bar.stop()
        self._writer.close()
