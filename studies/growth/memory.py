"""Memory of an environment: how the resident set grows with their number."""

import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from magworm_gym import Batch
from studies.growth.measure import started
from studies.growth.sweeps import Setting

FEW, MANY = 1024, 65536
RESIDENT = Path("/proc/self/statm")


@dataclass(frozen=True)
class Memory:
    """Bytes of an environment: what changes in time and is saved, and growth of the resident set.

    That is none where the system does not tell it in ``/proc``; it holds the workspace of a step as well.
    """

    dimensions: int
    resident: float | None
    state: float


def memory(dimensions: int) -> Memory:
    """Measured in fresh processes, so that no memory is used a second time."""
    few, many = (Batch(Setting().scene(dimensions), count) for count in (1, 2))
    state = len(many.get_state()) - len(few.get_state())
    if not RESIDENT.exists():
        return Memory(dimensions, None, state)
    sizes = []
    for count in (FEW, MANY):
        with ProcessPoolExecutor(1, get_context("spawn")) as process:
            sizes.append(process.submit(_resident_bytes, dimensions, count).result())
    return Memory(dimensions, (sizes[1] - sizes[0]) / (MANY - FEW), state)


def _resident_bytes(dimensions: int, count: int) -> int:
    before = _resident()
    batch = started(Setting(environments=count), dimensions)
    batch.advance(batch.scene.control_step_s)
    return _resident() - before


def _resident() -> int:
    return int(RESIDENT.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
