"""One process owns a folder."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from filelock import FileLock, Timeout

from magworm_gym.learning.command_line import UsageError

LOCK = ".lock"


@contextmanager
def owned(folder: Path) -> Iterator[None]:
    """Makes a folder and owns it until the block ends, or the process does.

    Raises:
        UsageError: Another process owns it.
    """
    folder.mkdir(parents=True, exist_ok=True)
    lock = FileLock(folder / LOCK, blocking=False)
    try:
        lock.acquire()
    except Timeout:
        owner = (folder / LOCK).read_text()
        raise UsageError(
            f"process {owner} is at work in {folder}: wait for it, or choose another --out"
        ) from None
    try:
        (folder / LOCK).write_text(str(os.getpid()))
        yield
    finally:
        lock.release()
