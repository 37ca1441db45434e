"""A progress bar where somebody can see it."""

import sys
from types import TracebackType
from typing import Any


class ProgressBar:
    """Shows how far a search is, on a terminal; needs tqdm, and shows nothing without it.

    Args:
        quiet: Shows nothing.
    """

    def __init__(self, *, quiet: bool) -> None:
        self._bar: Any = None
        self._stage = ""
        self._make: Any = None
        if not quiet and sys.stderr.isatty():
            try:
                from tqdm import tqdm
            except ImportError:
                return
            self._make = tqdm

    def __enter__(self) -> "ProgressBar":
        return self

    def __call__(self, stage: str, done: int, most: int, best: float) -> None:
        """Shows a stage, what of it is done, how much it is at most, and the best loss."""
        if self._make is None:
            return
        if stage != self._stage:
            self._close()
            self._bar, self._stage = self._make(total=most, desc=stage, file=sys.stderr), stage
        self._bar.set_postfix_str(f"loss {best:.4g}", refresh=False)
        self._bar.update(done - self._bar.n)

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._close()

    def _close(self) -> None:
        if self._bar is not None:
            self._bar.close()
