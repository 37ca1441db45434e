"""What bounds a phase: the least time that each resource of the core allows it."""

from collections.abc import Mapping
from dataclasses import dataclass

from studies.peak.program import STEP, Counted, Timed, Work
from studies.peak.rates import LANES, Rates

SUMS = "+ − ×"
DIVIDER = "÷ √"
FIRST_CACHE = "loads, stores"
SECOND_CACHE = "rows from the second cache"
CHAIN = "longest chain"
BOUNDS = (SUMS, DIVIDER, FIRST_CACHE, SECOND_CACHE, CHAIN)


def least_ns(work: Work, rates: Rates) -> dict[str, float]:
    """Time below which a phase cannot be done, by resource, if it waits for nothing else [ns]."""
    done, best = work.operations, rates.throughput_ns
    add, multiply = done["add"], done["multiply"]
    return {
        SUMS: max(
            add * best["add"],
            multiply * best["multiply"],
            0.5 * (add + multiply) * best["add beside multiply"],
        ),
        DIVIDER: done["divide"] * best["divide"] + done["root"] * best["add, root"],
        FIRST_CACHE: max(
            0.5 * done["load"] * best["load, load, multiply, add"], done["store"] * best["load, add, store"]
        ),
        SECOND_CACHE: work.rows * best["far load, add"],
        CHAIN: work.chain_ns,
    }


@dataclass(frozen=True)
class Account:
    """A phase of a block on the widest instruction set.

    Attributes:
        work: What it does.
        time: How long it takes.
        gflops: Operations a nanosecond, of all lanes.
        share: Part of the peak; least and most of the runs behind it.
        bounds: Least time by resource, as parts of the time.
    """

    work: Work
    time: Timed
    gflops: float
    share: tuple[float, float, float]
    bounds: Mapping[str, float]

    @property
    def tightest(self) -> str:
        """The resource that leaves least room."""
        return max(self.bounds, key=lambda name: self.bounds[name])


def account(work: Work, time: Timed, rates: Rates) -> Account:
    """The account of a phase."""
    operations = LANES * work.flops
    share, least, most = (operations / ns / rates.peak_gflops for ns in (time.ns, time.most, time.least))
    bounds = {name: least / time.ns for name, least in least_ns(work, rates).items()}
    return Account(work, time, operations / time.ns, (share, least, most), bounds)


def useful(counted: Counted, phase: str) -> float:
    """Operations of the eight robots alone over those that their block does in all lanes."""
    if phase == STEP:
        alone = sum(work.flops for work in counted.alone.values())
    else:
        alone = counted.alone[phase].flops
    done = counted.block[phase].flops
    return alone / done if done else 1.0
