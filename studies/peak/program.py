"""The program that counts and times: ``rust/magworm-py/examples/peak``, and what it says as rows of data."""

import csv
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import astuple, dataclass
from statistics import median
from typing import Any

from studies.needs.counts import ROOT

PROGRAM = ROOT / "target" / "release" / "examples" / "peak"
STEP = "step"
"""All phases together."""
CYCLE = ("all", "cycle")
"""Instruction set and kernel of the time of a cycle."""


@dataclass(frozen=True)
class Timed:
    """A time [ns]: the median of some runs, and their range."""

    median_ns: float
    least_ns: float
    most_ns: float


@dataclass(frozen=True)
class CoreTime:
    """A round of a kernel, in so many chains that wait for nothing in each other; time of one chain."""

    instruction_set: str
    kernel: str
    chains: int
    time: Timed


@dataclass(frozen=True)
class StepTime:
    """A solver step, or a phase of it."""

    place: str
    instruction_set: str
    lanes: int
    phase: str
    time: Timed


@dataclass(frozen=True)
class Operations:
    """Operations by kind, each of all lanes at once."""

    add: float
    multiply: float
    divide: float
    root: float
    compare: float
    select: float
    bits: float
    mask: float
    load: float
    store: float

    @property
    def flops(self) -> float:
        """Additions, subtractions, multiplications, divisions and roots of one lane."""
        return self.add + self.multiply + self.divide + self.root


@dataclass(frozen=True)
class Work:
    """What a phase does in a solver step of eight lanes, or of one: the mean of the same eight.

    `rows`: Rows of lanes that are read or written.
    """

    place: str
    lanes: int
    phase: str
    rows: float
    operations: Operations


@dataclass(frozen=True)
class Chain:
    """The longest chain of operations in a phase that wait for each other, and its time [ns]."""

    place: str
    phase: str
    ns: float
    operations: Operations


@dataclass(frozen=True)
class Systems:
    """Linear systems with contact a step, of a block of eight or of one lane."""

    place: str
    lanes: int
    systems: float


def core(runs: int) -> list[CoreTime]:
    """Times of all kernels, and of a cycle."""
    lines = ((name, kernel, int(chains), ns) for name, kernel, chains, ns in said("core", str(runs)))
    return [CoreTime(name, kernel, chains, time) for (name, kernel, chains), time in summaries(lines).items()]


def times(place: str, preset: str, runs: int) -> list[StepTime]:
    """Times of a solver step and its phases by instruction set and lanes."""
    lines = ((name, int(lanes), phase, ns) for name, lanes, phase, ns in said("time", preset, str(runs)))
    return [
        StepTime(place, name, lanes, phase, time) for (name, lanes, phase), time in summaries(lines).items()
    ]


def count(place: str, preset: str, latency_ns: Operations) -> tuple[list[Work], list[Chain], list[Systems]]:
    """What a solver step does, and its chains at given latencies of the kinds of operations [ns]."""
    works, chains, systems = [], [], []
    for lanes, phase, first, *rest in said("count", preset, *(f"{ns:.6g}" for ns in astuple(latency_ns))):
        if phase == "systems":
            systems.append(Systems(place, int(lanes), float(first)))
        elif rest:
            chain_ns, *numbers = map(float, rest)
            half = len(numbers) // 2
            works.append(Work(place, int(lanes), phase, float(first), Operations(*numbers[:half])))
            if lanes != "1":
                chains.append(Chain(place, phase, chain_ns, Operations(*numbers[half:])))
    return [work for work in works if (work.lanes, work.phase) != (1, STEP)], chains, systems


def summaries(lines: Iterator[tuple[Any, ...]]) -> Mapping[Any, Timed]:
    """Median and range of the times that stand last in lines, by what stands before."""
    found: dict[Any, list[float]] = defaultdict(list)
    for *key, ns in lines:
        found[tuple(key)].append(float(ns))
    return {key: Timed(median(values), min(values), max(values)) for key, values in found.items()}


def said(*arguments: str) -> Iterator[list[str]]:
    """What the program prints, line by line."""
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM.relative_to(ROOT)} is missing: run make study-peak, which builds it")
    run = subprocess.run([str(PROGRAM), *arguments], capture_output=True, text=True)
    if run.returncode:
        sys.exit(run.stderr.strip())
    return csv.reader(run.stdout.splitlines())
