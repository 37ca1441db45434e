"""The program that counts and times: ``rust/magworm-py/examples/peak``."""

import csv
import subprocess
import sys
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from statistics import median

from studies.needs.counts import ROOT

PROGRAM = ROOT / "target" / "release" / "examples" / "peak"
STEP = "step"
"""All phases together."""


@dataclass(frozen=True)
class Timed:
    """A time [ns]: the median of some runs, and their range."""

    ns: float
    least: float
    most: float


@dataclass(frozen=True)
class Work:
    """What a phase does in a solver step of a block.

    Attributes:
        rows: Rows of lanes that are read or written.
        operations: Operations by kind, each of all lanes at once.
        chain_ns: Time of the longest chain of operations that wait for each other [ns].
        chain: Its operations by kind.
    """

    rows: float
    operations: Mapping[str, float]
    chain_ns: float
    chain: Mapping[str, float]

    @property
    def flops(self) -> float:
        """Additions, subtractions, multiplications, divisions and roots of one lane."""
        return sum(self.operations[kind] for kind in ("add", "multiply", "divide", "root"))


@dataclass(frozen=True)
class Counted:
    """What is counted of a scene.

    Attributes:
        block: Phases of a block of eight, the whole step last.
        alone: Phases of a single robot, the mean of the same eight.
        systems: Linear systems with contact a step, of the block and of a single robot.
    """

    block: Mapping[str, Work]
    alone: Mapping[str, Work]
    systems: tuple[float, float]


def kinds() -> list[str]:
    """Names of the kinds of operations."""
    return output("kinds").strip().split(",")


def core(runs: int) -> dict[tuple[str, str, int], Timed]:
    """Time of a round in one chain by instruction set, kernel and number of chains; a cycle under ``all``."""
    found = defaultdict(list)
    for name, kernel, chains, ns in csv.reader(output("core", str(runs)).splitlines()):
        found[name, kernel, int(chains)].append(float(ns))
    return {key: summary(values) for key, values in found.items()}


def count(preset: str, latency_ns: Mapping[str, float]) -> Counted:
    """Operations of a solver step, and its chains at given latencies of the kinds of operations [ns]."""
    names = kinds()
    block: dict[str, Work] = {}
    alone: dict[str, Work] = {}
    systems = {}
    lines = output("count", preset, *(f"{latency_ns[name]:.6g}" for name in names)).splitlines()
    for lanes, phase, first, *rest in csv.reader(lines):
        if phase == "systems":
            systems[lanes] = float(first)
        elif rest:
            chain_ns, *numbers = (float(text) for text in rest)
            counts = dict(zip(names, numbers[: len(names)], strict=True))
            chain = dict(zip(names, numbers[len(names) :], strict=True))
            work = Work(float(first), counts, chain_ns, chain)
            (alone if lanes == "1" else block)[phase] = work
    alone.pop(STEP, None)
    return Counted(block, alone, (systems["8"], systems["1"]))


def times(preset: str, runs: int) -> dict[tuple[str, int, str], Timed]:
    """Time of a solver step and its phases by instruction set and lanes."""
    found = defaultdict(list)
    for name, lanes, phase, ns in csv.reader(output("time", preset, str(runs)).splitlines()):
        found[name, int(lanes), phase].append(float(ns))
    return {key: summary(values) for key, values in found.items()}


def summary(values: list[float]) -> Timed:
    """Median and range."""
    return Timed(median(values), min(values), max(values))


def output(*arguments: str) -> str:
    """What the program prints."""
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM.relative_to(ROOT)} is missing: run make study-peak, which builds it")
    run = subprocess.run([str(PROGRAM), *arguments], capture_output=True, text=True)
    if run.returncode:
        sys.exit(run.stderr.strip())
    return run.stdout
