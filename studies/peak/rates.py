"""What the core does at best, from the times of its rounds."""

from collections.abc import Mapping
from dataclasses import dataclass

from studies.peak.program import Timed

LANES = 8
Rounds = Mapping[tuple[str, str, int], Timed]
"""By instruction set, kernel and number of chains."""


@dataclass(frozen=True)
class Rates:
    """Times of an instruction set for operations of eight lanes [ns].

    Attributes:
        throughput_ns: By kernel, where nothing waits.
        latency_ns: By kernel, where each round waits for the one before.
    """

    throughput_ns: Mapping[str, float]
    latency_ns: Mapping[str, float]

    @property
    def peak_gflops(self) -> float:
        """Additions and multiplications a nanosecond, in equal numbers."""
        return 2 * LANES / self.throughput_ns["add beside multiply"]

    @property
    def fused_gflops(self) -> float | None:
        """The same of fused multiply-adds, each of which counts as two; none where there are none."""
        fused = self.throughput_ns.get("fused")
        return None if fused is None else 2 * LANES / fused

    def waits_ns(self) -> dict[str, float]:
        """Latency of each kind of operation [ns]."""
        alone = self.latency_ns
        add, choice = alone["add"], alone["compare, select"]
        return {
            "add": add,
            "multiply": alone["multiply"],
            "divide": alone["divide"],
            "root": alone["add, root"] - add,
            "compare": choice / 2,
            "select": choice / 2,
            "bits": alone["add, bits"] - add,
            "mask": choice / 2,
            "load": alone["store, load, add"] - add,
            "store": 0.0,
        }


def sets(rounds: Rounds) -> list[str]:
    """The instruction sets that were measured, the widest first."""
    return list(dict.fromkeys(name for name, _, _ in rounds if name != "all"))


def rates(rounds: Rounds, name: str) -> Rates:
    """The rates of an instruction set: the best number of chains, and a single one."""
    kernels = dict.fromkeys(kernel for of, kernel, _ in rounds if of == name)
    best = {
        kernel: min(timed.ns for (of, what, _), timed in rounds.items() if (of, what) == (name, kernel))
        for kernel in kernels
    }
    return Rates(best, {kernel: rounds[name, kernel, 1].ns for kernel in kernels})


def cycle_ns(rounds: Rounds) -> float:
    """A cycle of the clock [ns]."""
    return rounds["all", "cycle", 1].ns
