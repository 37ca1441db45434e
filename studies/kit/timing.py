"""How long something takes, and what a long command is doing."""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass


class Stopwatch:
    """Says on the terminal what has been done, and when. Started when it is made."""

    def __init__(self) -> None:
        self.start = time.perf_counter()

    def said(self, name: str) -> None:
        """Prints the name of a part that has just ended, and the time since the start [s]."""
        print(f"{name:<22}{time.perf_counter() - self.start:6.1f} s", flush=True)


@dataclass(frozen=True)
class Times:
    """Times of runs of the same work.

    Attributes:
        wall_s: On the clock, of each run [s].
        processor_s: Of all threads of this process together, of each run [s].
    """

    wall_s: tuple[float, ...]
    processor_s: tuple[float, ...]

    @property
    def best_s(self) -> float:
        """The least wall time, which other programs disturb least [s]."""
        return min(self.wall_s)

    @property
    def median_s(self) -> float:
        """The median wall time [s]."""
        return statistics.median(self.wall_s)


def timed(
    work: Callable[[], object],
    repetitions: int,
    *,
    prepare: Callable[[], object] = lambda: None,
    enough_s: float = 0.0,
    most: int = 0,
) -> Times:
    """Runs the same work several times.

    Args:
        work: What is timed.
        repetitions: How often at least.
        prepare: Called before each run, untimed.
        enough_s: Goes on beyond ``repetitions`` until the runs last this long together [s],
        most: but no more often than this.
    """
    walls: list[float] = []
    processors: list[float] = []
    while len(walls) < repetitions or (sum(walls) < enough_s and len(walls) < most):
        prepare()
        wall, processor = time.perf_counter(), time.process_time()
        work()
        walls.append(time.perf_counter() - wall)
        processors.append(time.process_time() - processor)
    return Times(tuple(walls), tuple(processors))
