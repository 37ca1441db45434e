"""What part of a core's arithmetic peak a solver step reaches, and what bounds it: ``docs/peak.md``."""

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

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
    """All that was measured."""

    core: Sequence[CoreTime]
    times: Sequence[StepTime]
    works: Sequence[Work]
    chains: Sequence[Chain]
    systems: Sequence[Systems]
    classes: Sequence[PhaseClasses]


FILES: dict[str, tuple[str, type[Any]]] = {
    "core": ("core.csv", CoreTime),
    "times": ("times.csv", StepTime),
    "works": ("operations.csv", Work),
    "chains": ("chains.csv", Chain),
    "systems": ("systems.csv", Systems),
    "classes": ("instructions.csv", PhaseClasses),
}
"""Where each of them is kept."""


def measure(_: argparse.Namespace) -> None:
    """Times the core, counts and times a step. Minutes."""
    said = Stopwatch().said
    found: dict[str, list[Any]] = {name: [] for name in FILES}
    found["core"] = core(RUNS)
    said("core")
    latency_ns = next(iter(all_rates(found["core"]).values())).waits_ns()
    for place, preset in PLACES.items():
        works, chains, systems = count(place, preset, latency_ns)
        found["works"] += works
        found["chains"] += chains
        found["systems"] += systems
    said("operations")
    for place, preset in PLACES.items():
        found["times"] += times(place, preset, RUNS)
    said("times")
    found["classes"] = count_classes([(chain.place, chain.phase) for chain in found["chains"]])
    said("instructions")
    for name, (file, kind) in FILES.items():
        write_rows(DATA / file, kind, found[name])


def pages() -> dict[str, str]:
    """The page from the data."""
    return {
        "peak.md": text(Results(**{name: read_rows(DATA / file, of) for name, (file, of) in FILES.items()}))
    }


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
        compiler=results.classes[0].compiler,
    )


def step_of(results: Results, place: str, widest: str) -> Step:
    """What was found of a step in the plane or in space."""
    chains = {chain.phase: chain for chain in results.chains if chain.place == place}
    classes = {found.phase: found.classes for found in results.classes if found.place == place}
    timed = {(t.instruction_set, t.lanes, t.phase): t.time for t in results.times if t.place == place}
    wanted = wanted_shares([work for work in results.works if work.place == place])
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
        for work in results.works
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
