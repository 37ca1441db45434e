"""A progress bar where somebody can see it."""

from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn, TimeRemainingColumn


class ProgressBar:
    """Shows how far a search is, a bar for each of its stages, on a terminal.

    Args:
        quiet: Shows nothing.
    """

    def __init__(self, *, quiet: bool) -> None:
        console = Console(stderr=True)
        columns = [TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()]
        loss = TextColumn("loss {task.fields[loss]:.4g}")
        self._bars = Progress(*columns, loss, console=console, disable=quiet or not console.is_terminal)
        self._stages: dict[str, TaskID] = {}

    def __enter__(self) -> "ProgressBar":
        self._bars.start()
        return self

    def __call__(self, stage: str, done: int, most: int, best: float) -> None:
        """Shows a stage, what of it is done, how much it is at most, and the best loss."""
        if stage not in self._stages:
            self._stages[stage] = self._bars.add_task(stage, total=most, loss=best)
        self._bars.update(self._stages[stage], completed=done, loss=best)

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bars.stop()
