"""What part of a core's arithmetic peak a solver step reaches, and what bounds it: ``docs/peak.md``."""

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args, get_type_hints

from studies.kit.data import read_rows, write_rows
from studies.kit.page import page
from studies.kit.study import Study
from studies.kit.timing import Stopwatch
from studies.peak import account
from studies.peak.account import Account, Step
from studies.peak.instructions import CLASSES, PhaseClasses, count_classes
from studies.peak.program import STEP, Chain, CoreTime, StepTime, Systems, Work, core, count, times
from studies.peak.rates import LANES, all_rates, cycle_ns

HERE = Path(__file__).parent
DATA = HERE / "data"
PLACES = {"plane": "paper-3", "space": "turn-3"}
RUNS = 31
AIM = 0.25
"""Part of the peak that a step should reach."""
LINE_BYTES = 64
KINDS = {
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
"""Kinds of operations that the page shows, and how it calls them."""


@dataclass(frozen=True)
class Results:
    """All that was measured; each is a file of that name."""

    core: list[CoreTime]
    times: list[StepTime]
    operations: list[Work]
    chains: list[Chain]
    systems: list[Systems]
    instructions: list[PhaseClasses]


ROWS: dict[str, type[Any]] = {name: get_args(of)[0] for name, of in get_type_hints(Results).items()}


def measure(_: argparse.Namespace) -> None:
    """Times the core, counts and times a step. Minutes."""
    said = Stopwatch().said
    rounds = core(RUNS)
    said("core")
    found = Results(rounds, [], [], [], [], [])
    latency_ns = next(iter(all_rates(rounds).values())).waits_ns()
    for place, preset in PLACES.items():
        operations, chains, systems = count(place, preset, latency_ns)
        found.operations.extend(operations)
        found.chains.extend(chains)
        found.systems.extend(systems)
    said("operations")
    for place, preset in PLACES.items():
        found.times.extend(times(place, preset, RUNS))
    said("times")
    found.instructions.extend(count_classes((chain.place, chain.phase) for chain in found.chains))
    said("instructions")
    for name, kind in ROWS.items():
        write_rows(DATA / f"{name}.csv", kind, getattr(found, name))


def pages() -> dict[str, str]:
    """The page from the data."""
    rows = {name: read_rows(DATA / f"{name}.csv", kind) for name, kind in ROWS.items()}
    return {"peak.md": text(Results(**rows))}


def text(results: Results) -> str:
    """The page."""
    rates = all_rates(results.core)
    widest = next(iter(rates))
    return page(
        HERE / "page.md",
        runs=RUNS,
        aim=AIM,
        presets=PLACES,
        lanes=LANES,
        rates=rates,
        widest=widest,
        cycle_ns=cycle_ns(results.core),
        steps={place: step_of(results, place, widest) for place in PLACES},
        kinds=KINDS,
        line_bytes=LINE_BYTES,
        resources=account,
        classes=CLASSES,
        compiler=results.instructions[0].compiler,
    )


def step_of(results: Results, place: str, widest: str) -> Step:
    """What was found of a step in the plane or in space."""
    chains = {chain.phase: chain for chain in results.chains if chain.place == place}
    classes = {found.phase: found.classes for found in results.instructions if found.place == place}
    timed = {(t.instruction_set, t.lanes, t.phase): t.time for t in results.times if t.place == place}
    wanted = wanted_shares([work for work in results.operations if work.place == place])
    cycle = cycle_ns(results.core)
    phases = [
        Account(
            work=work,
            chain=chains[work.phase],
            time=timed[widest, LANES, work.phase],
            rates=all_rates(results.core)[widest],
            wanted=wanted[work.phase],
            classes=classes[work.phase],
            per_cycle=classes[work.phase].total * cycle / timed["AVX2", LANES, work.phase].median_ns,
        )
        for work in results.operations
        if (work.place, work.lanes) == (place, LANES)
    ]
    return Step(
        phases,
        {found.lanes: found.systems for found in results.systems if found.place == place},
        {(name, lanes): time for (name, lanes, phase), time in timed.items() if phase == STEP},
    )


def wanted_shares(works: Sequence[Work]) -> Mapping[str, float]:
    """By phase, operations of the eight robots alone over those that their block does in all lanes."""
    alone = {work.phase: work.operations.flops for work in works if work.lanes == 1}
    alone[STEP] = sum(alone.values())
    blocks = {work.phase: work.operations.flops for work in works if work.lanes == LANES}
    return {phase: alone[phase] / done if done else 1.0 for phase, done in blocks.items()}


STUDY = Study(
    about="what part of a core's arithmetic peak a solver step reaches", measure=measure, pages=pages
)
