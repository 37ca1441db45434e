"""The page ``docs/peak.md``: everything on it follows from what was counted and timed."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from textwrap import fill

from studies.needs.counts import compiler
from studies.paper.section import table
from studies.paper.wording import listed
from studies.peak.account import BOUNDS, CHAIN, DIVIDER, FIRST_CACHE, SUMS, Account, account, useful
from studies.peak.instructions import ARITHMETIC, CLASSES, SCALAR, SPILLS
from studies.peak.program import STEP, Counted, Timed
from studies.peak.rates import LANES, Rates, Rounds, cycle_ns, rates, sets

PLACES = {"plane": "paper-3", "space": "turn-3"}
AIM = 0.25
"""Part of the peak that a step should reach."""
LINE_BYTES = 64
COLUMNS = {
    "add": "+ −",
    "multiply": "×",
    "divide": "÷",
    "root": "√",
    "compare": "compare",
    "select": "select",
    "bits": "bits",
    "load": "load",
    "store": "store",
}


@dataclass(frozen=True)
class Place:
    """What was found in the plane or in space.

    Attributes:
        counted: Operations.
        timed: Times by instruction set, lanes and phase.
        classes: Instructions on AVX2 by phase and class.
    """

    counted: Counted
    timed: Mapping[tuple[str, int, str], Timed]
    classes: Mapping[str, Mapping[str, float]]


@dataclass(frozen=True)
class Results:
    """All that the page is made of.

    Attributes:
        rounds: Times of the core.
        places: The plane and space.
        runs: How often each time was taken.
    """

    rounds: Rounds
    places: Mapping[str, Place]
    runs: int

    @cached_property
    def sets(self) -> list[str]:
        """Instruction sets, the widest first."""
        return sets(self.rounds)

    @cached_property
    def widest(self) -> Rates:
        """Rates of the widest."""
        return rates(self.rounds, self.sets[0])

    def accounts(self, place: str) -> dict[str, Account]:
        """The phases of a step on the widest set, the whole step last."""
        found = self.places[place]
        return {
            phase: account(work, found.timed[self.sets[0], LANES, phase], self.widest)
            for phase, work in found.counted.block.items()
        }


def page(results: Results) -> str:
    """The whole page."""
    parts = [_introduction(results), _core(results), _operations(results)]
    parts += [_bounds(results), _trials(results), _instructions(results)]
    return "\n".join(parts) + "\n"


def _introduction(results: Results) -> str:
    lines, met = [], []
    for place, preset in PLACES.items():
        step = results.accounts(place)[STEP]
        met.append(step.share[0] >= AIM)
        lines.append(
            f"- {place} (`{preset}`): {step.gflops:.1f} Gflop/s, {_range(step.share)} of the peak;\n"
            f"  {LANES * step.work.flops / 1e3:,.0f} thousand operations in {_time(step.time)} µs."
        )
    reached = {2: "in both", 0: "in neither"}.get(sum(met)) or f"only in {_where(met)}"
    return f"""# Arithmetic of a step against the core's peak

Written by `make study-peak`; do not edit. What part of the arithmetic peak of one core a solver step of a
block of eight robots reaches, and what bounds it. An operation is an addition, subtraction, multiplication,
division or root of one lane, counted by running the kernels on an instruction set that counts
(`rust/magworm-py/examples/peak/counting.rs`); comparisons, selections and signs are none. The peak is
measured: additions and multiplications in equal numbers, none of which waits for another. Robots act at
random, as in [needs.md](needs.md). Times are medians of {results.runs} runs with their range in brackets,
on {results.sets[0]} at {1.0 / cycle_ns(results.rounds):.2f} GHz as measured (shifts that wait for each
other, one a cycle).

{chr(10).join(lines)}

The aim is {AIM:.0%}; it is reached {reached}. What keeps a step from the rest stands
[below](#what-bounds-it).

Data: `studies/peak/*.csv`."""


def _where(met: list[bool]) -> str:
    return "the plane" if met[0] else "space"


def _core(results: Results) -> str:
    cycle = cycle_ns(results.rounds)
    kernels = list(results.widest.throughput_ns)
    rows = []
    for kernel in kernels:
        cells = [kernel]
        for name in results.sets:
            of = rates(results.rounds, name)
            if kernel not in of.throughput_ns:
                cells.append("–")
                continue
            cells.append(f"{of.throughput_ns[kernel] / cycle:.2f} ({of.latency_ns[kernel] / cycle:.1f})")
        rows.append(cells)
    of_sets = {name: rates(results.rounds, name) for name in results.sets}
    peaks = ["peak, Gflop/s", *(f"{of.peak_gflops:.1f}" for of in of_sets.values())]
    fused = ["with fused multiply-adds", *(_or_none(of.fused_gflops) for of in of_sets.values())]
    gain = (results.widest.fused_gflops or 0.0) / results.widest.peak_gflops
    return f"""
## What the core does

Cycles for eight lanes, where nothing waits, and in brackets where each round waits for the one before; the
least of several numbers of chains side by side. *Far* rows stand beyond the first cache. Numbers of a
processor with vectors of four or two lanes are those of two or four instructions.

{table(["", *results.sets], [*rows, peaks, fused])}

Kernels use no fused multiply-adds, since results would then hang on the instruction set. A core that did
nothing else would reach {gain:.2f} times the peak with them, in half as many instructions."""


def _or_none(value: float | None) -> str:
    return "–" if value is None else f"{value:.1f}"


def _operations(results: Results) -> str:
    parts = []
    for place in PLACES:
        counted = results.places[place].counted
        rows = []
        for phase, work in counted.block.items():
            cells = [f"{work.operations[kind]:,.0f}" for kind in COLUMNS]
            size = f"{work.rows * LINE_BYTES / 1e3:,.0f}"
            rows.append([phase, *cells, size, f"{useful(counted, phase):.0%}"])
        parts.append(
            f"In {_in(place)}:\n\n{table(['phase', *COLUMNS.values(), 'kB touched', 'wanted'], rows)}\n"
        )
    systems = listed(
        [
            f"{of.counted.systems[0]:.2f} beside {of.counted.systems[1]:.2f} in {_in(place)}"
            for place, of in results.places.items()
        ]
    )
    return f"""
## Operations of a step

Of a block, each of eight lanes at once; exact, and equal on all processors. *Wanted* is what the eight
robots would do if each went on alone: a block goes through as many iterations of contact as its slowest
lane needs, and the lanes that are done stand still meanwhile. Systems a step, beside those of a robot
alone: {systems}. Operations on lanes that stand still count as operations.

{chr(10).join(parts).rstrip()}"""


def _in(place: str) -> str:
    return "the plane" if place == "plane" else place


def _bounds(results: Results) -> str:
    parts = []
    for place in PLACES:
        found, rows = results.places[place], []
        accounts = results.accounts(place)
        for phase, of in accounts.items():
            bounds = [f"{of.bounds[name]:.0%}" for name in BOUNDS]
            marked = [
                f"**{cell}**" if name == of.tightest else cell
                for name, cell in zip(BOUNDS, bounds, strict=True)
            ]
            rows.append(
                [
                    phase,
                    f"{_time(of.time)}",
                    f"{of.gflops:.1f}",
                    f"{of.share[0]:.0%}",
                    *marked,
                    f"{_per_cycle(results, found, phase):.1f}",
                ]
            )
        parts.append(
            f"In {_in(place)}:\n\n"
            + table(["phase", "µs", "Gflop/s", "of the peak", *BOUNDS, "instructions a cycle, AVX2"], rows)
            + f"\n\n{_sum(accounts)}\n"
        )
    return f"""
## What bounds it

Of each phase the least time that a resource of the core allows, as a part of the time that it takes: a
phase at 100 % could not be faster without doing less of that. *{SUMS}*: at the peak. *{DIVIDER}*: the
divider, which does one after the other. *Loads, stores*: those that the kernels name, from the first cache.
*Rows from the second cache*: each row touched is fetched once; a block is larger than most first caches.
*Longest chain*: operations that wait for each other, through memory too, by the latencies above; branches
count as foreseen. Beside them the instructions that it runs a cycle on AVX2, where they can be counted.

{chr(10).join(parts)}
{_verdict(results)}"""


def _sum(accounts: Mapping[str, Account]) -> str:
    alone = sum(of.time.ns for phase, of in accounts.items() if phase != STEP)
    share = alone / accounts[STEP].time.ns
    return f"Phases are timed one by one, the step as a whole; they sum to {share:.0%} of it."


def _per_cycle(results: Results, found: Place, phase: str) -> float:
    """Instructions a cycle on AVX2."""
    cycles = found.timed["AVX2", LANES, phase].ns / cycle_ns(results.rounds)
    return sum(found.classes[phase].values()) / cycles


def _verdict(results: Results) -> str:
    return "\n".join(_verdict_of(results, place) for place in PLACES)


def _verdict_of(results: Results, place: str) -> str:
    accounts, found = results.accounts(place), results.places[place]
    step, wanted = accounts[STEP], useful(found.counted, STEP)
    waits = listed([f"{step.work.chain[kind]:,.0f} {words}" for kind, words in CHAINED.items()])
    classes = found.classes[STEP]
    share = {name: count / sum(classes.values()) for name, count in classes.items()}
    rates_of = {phase: _per_cycle(results, found, phase) for phase in found.classes}
    busiest = max(rates_of, key=lambda phase: rates_of[phase])
    (slow, slow_share), (waiting, waiting_share) = _worst(accounts, DIVIDER), _worst(accounts, CHAIN)
    sentences = (
        f"In {_in(place)} additions and multiplications take {step.bounds[SUMS]:.0%} of a step's time.",
        f"Waiting for operations is {_bounded(step.bounds[CHAIN])}: the longest chain has {waits} and takes",
        f"{step.bounds[CHAIN]:.0%} of the time, most in *{waiting}* ({waiting_share:.0%} of that phase).",
        f"Divisions and roots take {step.bounds[DIVIDER]:.0%}, most in *{slow}* ({slow_share:.0%}),",
        f"loads and stores {step.bounds[FIRST_CACHE]:.0%}.",
        f"Of the instructions on AVX2 {share[ARITHMETIC]:.0%} are arithmetic, {share[SCALAR]:.0%} integers,",
        f"addresses and branches, {share[SPILLS]:.0%} put numbers aside that find no register.",
        f"The core runs {rates_of[STEP]:.1f} of them a cycle; at the {rates_of[busiest]:.1f} of *{busiest}*,",
        f"where it runs most, they would take {rates_of[STEP] / rates_of[busiest]:.0%} of the time.",
        f"{1.0 - wanted:.0%} of the operations are done for lanes that stand still; without them the step is",
        f"at {wanted * step.share[0]:.0%} of the peak.",
    )
    return fill(" ".join(sentences), 105, initial_indent="- ", subsequent_indent="  ")


def _bounded(share: float) -> str:
    return "no bound of the step as a whole" if share < 0.5 else "much of what bounds the step"


CHAINED = {
    "add": "additions",
    "multiply": "multiplications",
    "divide": "divisions",
    "load": "passages through memory",
}


def _worst(accounts: Mapping[str, Account], resource: str) -> tuple[str, float]:
    """The phase that uses a resource for the greatest part of its time."""
    shares = {phase: of.bounds[resource] for phase, of in accounts.items() if phase != STEP}
    worst = max(shares, key=lambda phase: shares[phase])
    return worst, shares[worst]


def _trials(results: Results) -> str:
    first = results.sets[0]
    rows = []
    keys = [(name, LANES) for name in results.sets] + [(first, 2 * LANES), ("one lane", 1)]
    for name, lanes in keys:
        cells = []
        for place in PLACES:
            timed = results.places[place].timed
            time, whole = timed[name, lanes, STEP], timed[first, LANES, STEP]
            cells += [_time(time), f"{time.ns / lanes / (whole.ns / LANES):.2f}"]
        rows.append([name, str(lanes), *cells])
    header = ["", "lanes", *(text for place in PLACES for text in (f"{place}: µs a step", "a robot"))]
    twin = {place: _twin(results, place) for place in PLACES}
    narrow = _narrow(results)
    return f"""
## The same step with more and with fewer instructions

*A robot*: time for each lane, beside that of eight lanes on {first}. Sixteen lanes are two blocks in one,
operation by operation: what waits in one has work of the other beside it, and addresses and branches serve
both. A second block would cost nothing if those were all that took time, and as much as the first if vector
instructions were, or more where registers run out; it costs {twin["plane"]:.0%} of the first in the plane and
{twin["space"]:.0%} in space. One lane has the chains of eight, with plain numbers.

{table(header, rows)}{narrow}"""


def _twin(results: Results, place: str) -> float:
    """What a second block costs beside the first."""
    timed, first = results.places[place].timed, results.sets[0]
    return timed[first, 2 * LANES, STEP].ns / timed[first, LANES, STEP].ns - 1.0


def _narrow(results: Results) -> str:
    """What half as long vectors cost; nothing where the widest are not twice as long as AVX2's."""
    if results.sets[0] != "AVX-512":
        return ""
    peak = rates(results.rounds, "AVX2").peak_gflops / results.widest.peak_gflops
    longer = {
        place: found.timed["AVX2", LANES, STEP].ns / found.timed["AVX-512", LANES, STEP].ns
        for place, found in results.places.items()
    }
    return f"""

AVX2 needs two instructions for what AVX-512 does in one. Its peak is {peak:.0%} of that of AVX-512 here, and
its step takes {longer["plane"]:.2f} times as long in the plane, {longer["space"]:.2f} times in space."""


def _instructions(results: Results) -> str:
    parts = []
    for place in PLACES:
        rows = []
        for phase, classes in results.places[place].classes.items():
            total = sum(classes.values())
            rows.append([phase, f"{total:,.0f}", *(f"{classes[name] / total:.0%}" for name in CLASSES)])
        parts.append(f"In {_in(place)}:\n\n{table(['phase', 'instructions', *CLASSES], rows)}\n")
    counts = {place: _executed(results.places[place]) for place in PLACES}
    return f"""
## Instructions that are no arithmetic

Of a step on AVX2 by callgrind, by what they do ({compiler()}). Two
arithmetic instructions are one operation of eight lanes; of those counted above {counts["plane"]:.0%} are
run in the plane and {counts["space"]:.0%} in space, since a compiler leaves out what it knows already.
*{SPILLS.capitalize()}*: more numbers are in use than there are registers, 16 of AVX2; AVX-512 has
twice as many, twice as long. *{SCALAR.capitalize()}*: where rows stand, whether they are there, and loops.

{chr(10).join(parts).rstrip()}"""


def _executed(found: Place) -> float:
    """Arithmetic that was run over that which was counted."""
    return found.classes[STEP][ARITHMETIC] / 2.0 / found.counted.block[STEP].flops


def _time(time: Timed) -> str:
    """Median and range [µs]."""
    return f"{time.ns / 1e3:.3g} ({time.least / 1e3:.3g} to {time.most / 1e3:.3g})"


def _range(share: tuple[float, float, float]) -> str:
    return f"{share[0]:.1%} ({share[1]:.1%} to {share[2]:.1%})"
