"""Memory of an environment: how the resident set grows with their number."""

import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from magworm_gym import Batch
from studies.growth.measure import setting, started

FEW, MANY = 1024, 65536
RESIDENT = Path("/proc/self/statm")


@dataclass(frozen=True)
class Memory:
    """Bytes of an environment.

    Attributes:
        resident: Growth of the resident set; None where the system does not tell it in ``/proc``.
        state: What changes in time and is saved; the rest is the workspace of a step.
    """

    resident: float | None
    state: float


def memory(space: bool) -> Memory:
    """Measured in fresh processes, so that no memory is used a second time."""
    few, many = (Batch(setting(space).scene, count) for count in (1, 2))
    state = len(many.get_state()) - len(few.get_state())
    if not RESIDENT.exists():
        return Memory(None, state)
    sizes = []
    for count in (FEW, MANY):
        with ProcessPoolExecutor(1, get_context("spawn")) as process:
            sizes.append(process.submit(_resident_bytes, space, count).result())
    return Memory((sizes[1] - sizes[0]) / (MANY - FEW), state)


def _resident_bytes(space: bool, count: int) -> int:
    before = _resident()
    batch = started(setting(space, environments=count))
    batch.advance(batch.scene.control_step_s)
    return _resident() - before


def _resident() -> int:
    return int(RESIDENT.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
