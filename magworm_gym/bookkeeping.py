"""Ctrl-C and what is kept beside a simulation: after a call, or one that was stopped, both fit together."""

import signal
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from copy import deepcopy
from importlib import import_module
from types import FrameType, TracebackType
from typing import Any

from magworm_gym._magworm import _stops_cleanly

# What `signal` is made of: its conversions to and from enumerations would be a twentieth of a short step.
_signal: Any = import_module("_signal")
SIGINT = int(signal.SIGINT)


class Bookkeeping:
    """Within it Ctrl-C waits for the end, but for a call of the simulator that stops and changes nothing.

    >>> with Bookkeeping() as books:
    ...     batch.step(actions)  # Ctrl-C stops it
    ...     books.begin()  # from here on Ctrl-C waits
    ...     count += 1
    """

    def __enter__(self) -> "Bookkeeping":
        self._begun = False
        self._waiting: tuple[int, FrameType | None] | None = None
        handler = _signal.getsignal(SIGINT)
        # Signals reach the main thread alone, and only it may change who handles them.
        here = threading.get_ident() == threading.main_thread().ident
        self._handler: Any = handler if here and callable(handler) else None
        if self._handler is not None:
            _signal.signal(SIGINT, self._hold)
        return self

    def begin(self) -> None:
        """What the simulator did stands: what is kept beside it follows."""
        self._begun = True

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._handler is None:
            return
        _signal.signal(SIGINT, self._handler)
        if self._waiting is not None:
            self._handler(*self._waiting)

    def _hold(self, number: int, frame: FrameType | None) -> None:
        if _stops_cleanly() and not self._begun:
            self._handler(number, frame)
        else:
            self._waiting = number, frame


@contextmanager
def put_back(owner: object, names: Iterable[str]) -> Iterator[None]:
    """Where the block is stopped or raises, attributes are put back as they were before it."""
    before = {name: deepcopy(getattr(owner, name)) for name in names}
    try:
        yield
    except BaseException:
        for name, value in before.items():
            setattr(owner, name, value)
        raise
