"""What bounds a phase: the least time that each resource of the core allows it."""

from collections.abc import Mapping
from dataclasses import dataclass

from studies.peak.instructions import Classes
from studies.peak.program import STEP, Chain, Timed, Work
from studies.peak.rates import LANES, Rates

SUMS = "+ − ×"
DIVIDER = "÷ √"
FIRST_CACHE = "loads, stores"
SECOND_CACHE = "rows from the second cache"
CHAIN = "longest chain"


def least_ns(work: Work, chain: Chain, rates: Rates) -> dict[str, float]:
    """Time below which a phase cannot be done, by resource, if it waits for nothing else [ns]."""
    done, best = work.operations, rates.throughput_ns
    return {
        SUMS: max(
            done.add * best["add"],
            done.multiply * best["multiply"],
            0.5 * (done.add + done.multiply) * best["add beside multiply"],
        ),
        DIVIDER: done.divide * best["divide"] + done.root * best["add, root"],
        FIRST_CACHE: max(
            0.5 * done.load * best["load, load, multiply, add"], done.store * best["load, add, store"]
        ),
        SECOND_CACHE: work.rows * best["far load, add"],
        CHAIN: chain.ns,
    }


@dataclass(frozen=True)
class Account:
    """A phase of a block on the widest instruction set.

    Attributes:
        work: What it does.
        chain: Its longest chain.
        time: How long it takes.
        rates: Of the core.
        wanted: Operations of the eight robots alone over those that their block does in all lanes.
        classes: Instructions on AVX2.
        per_cycle: How many of those a cycle runs.
    """

    work: Work
    chain: Chain
    time: Timed
    rates: Rates
    wanted: float
    classes: Classes
    per_cycle: float

    @property
    def phase(self) -> str:
        """Its name."""
        return self.work.phase

    @property
    def operations(self) -> float:
        """Of all lanes."""
        return LANES * self.work.operations.flops

    @property
    def gflops(self) -> float:
        """Operations a nanosecond."""
        return self.operations / self.time.median_ns

    @property
    def shares(self) -> tuple[float, float, float]:
        """Part of the peak; least and most of the runs."""
        reached = self.operations / self.rates.peak_gflops
        return reached / self.time.median_ns, reached / self.time.most_ns, reached / self.time.least_ns

    @property
    def bounds(self) -> Mapping[str, float]:
        """Least time by resource, as parts of the time."""
        least = least_ns(self.work, self.chain, self.rates)
        return {name: ns / self.time.median_ns for name, ns in least.items()}

    @property
    def tightest(self) -> str:
        """The resource that leaves least room."""
        return max(self.bounds, key=lambda name: self.bounds[name])

    @property
    def executed(self) -> float:
        """Arithmetic that AVX2 runs, two instructions for one operation, over that which was counted."""
        return self.classes.arithmetic / 2.0 / self.work.operations.flops


@dataclass(frozen=True)
class Step:
    """A step in the plane or in space: its phases, the whole step last.

    And its linear systems with contact by lanes, and its times by instruction set and lanes.
    """

    phases: list[Account]
    systems: Mapping[int, float]
    times: Mapping[tuple[str, int], Timed]

    @property
    def whole(self) -> Account:
        """The whole step."""
        return self.phases[-1]

    @property
    def one_by_one(self) -> float:
        """Times of the phases together over that of the step."""
        alone = sum(account.time.median_ns for account in self.phases if account.phase != STEP)
        return alone / self.whole.time.median_ns

    @property
    def busiest(self) -> Account:
        """The phase that runs most instructions a cycle."""
        return max(self.phases, key=lambda account: account.per_cycle)

    def worst(self, resource: str) -> Account:
        """The phase that uses a resource for the greatest part of its time."""
        return max(self.phases[:-1], key=lambda account: account.bounds[resource])
