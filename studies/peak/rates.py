"""What the core does at best, from the times of its rounds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from studies.peak.program import CYCLE, CoreTime, Operations

LANES = 8


@dataclass(frozen=True)
class Rates:
    """Times for operations of eight lanes, by kernel [ns].

    Throughput is where nothing waits, latency where each round waits for the one before.
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

    def waits_ns(self) -> Operations:
        """Latency of each kind of operation [ns]."""
        alone = self.latency_ns
        add, choice = alone["add"], alone["compare, select"]
        return Operations(
            add=add,
            multiply=alone["multiply"],
            divide=alone["divide"],
            root=alone["add, root"] - add,
            compare=choice / 2,
            select=choice / 2,
            bits=alone["add, bits"] - add,
            mask=choice / 2,
            load=alone["store, load, add"] - add,
            store=0.0,
        )


def all_rates(core: Sequence[CoreTime]) -> dict[str, Rates]:
    """The rates of each instruction set, the widest first: the best number of chains, and a single one."""
    names = dict.fromkeys(one.instruction_set for one in core if one.instruction_set != CYCLE[0])
    return {name: rates([one for one in core if one.instruction_set == name]) for name in names}


def rates(core: Sequence[CoreTime]) -> Rates:
    """The rates of an instruction set."""
    best: dict[str, float] = {}
    for one in core:
        best[one.kernel] = min(one.time.median_ns, best.get(one.kernel, float("inf")))
    return Rates(best, {one.kernel: one.time.median_ns for one in core if one.chains == 1})


def cycle_ns(core: Sequence[CoreTime]) -> float:
    """A cycle of the clock [ns]."""
    return next(one.time.median_ns for one in core if (one.instruction_set, one.kernel) == CYCLE)
