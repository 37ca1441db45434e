"""Counts and times what a step does with a core and writes page and data. Minutes.

python -m studies.peak    # docs/peak.md, studies/peak/*.csv
"""

import argparse
import csv
from collections.abc import Sequence
from pathlib import Path

from magworm_gym.atomic_files import write_text
from studies.needs.counts import compiler
from studies.peak.instructions import CLASSES, all_classes
from studies.peak.page import PLACES, Place, Results, page
from studies.peak.program import STEP, core, count, kinds, times
from studies.peak.rates import rates, sets
from studies.stopwatch import Stopwatch

HERE = Path(__file__).parent
PAGE = HERE.parent.parent / "docs" / "peak.md"
RUNS = 31


def main() -> None:
    """Command line."""
    argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    ).parse_args()
    said = Stopwatch().said

    rounds = core(RUNS)
    said("core")
    latency_ns = rates(rounds, sets(rounds)[0]).waits_ns()
    counted = {place: count(preset, latency_ns) for place, preset in PLACES.items()}
    said("operations")
    timed = {place: times(preset, RUNS) for place, preset in PLACES.items()}
    said("times")
    wanted = [
        (f"step-{place}", None if phase == STEP else phase)
        for place in PLACES
        for phase in counted[place].block
    ]
    classes = all_classes(wanted)
    said("instructions")
    places = {
        place: Place(
            counted[place],
            timed[place],
            {phase or STEP: found for (task, phase), found in classes.items() if task == f"step-{place}"},
        )
        for place in PLACES
    }
    results = Results(rounds, places, RUNS)
    write(results)
    write_text(PAGE, page(results))
    said("written")


def write(results: Results) -> None:
    """The data of the page."""
    head = ["median_ns", "least_ns", "most_ns"]
    core_rows: list[Sequence[object]] = [["instruction_set", "kernel", "chains", *head]]
    for (name, kernel, chains), timed in results.rounds.items():
        core_rows.append([name, kernel, chains, *_numbers(timed.ns, timed.least, timed.most)])
    _write("core", core_rows)

    names = kinds()
    time_rows: list[Sequence[object]] = [["place", "instruction_set", "lanes", "phase", *head]]
    count_rows: list[Sequence[object]] = [["place", "lanes", "phase", "rows", *names]]
    class_rows: list[Sequence[object]] = [["place", "phase", *CLASSES, "compiler"]]
    chain_rows: list[Sequence[object]] = [["place", "phase", "ns", *names]]
    for place, found in results.places.items():
        for (name, lanes, phase), timed in found.timed.items():
            time_rows.append([place, name, lanes, phase, *_numbers(timed.ns, timed.least, timed.most)])
        for lanes, of_phases in ((8, found.counted.block), (1, found.counted.alone)):
            for phase, work in of_phases.items():
                numbers = _numbers(work.rows, *(work.operations[kind] for kind in names))
                count_rows.append([place, lanes, phase, *numbers])
        for phase, work in found.counted.block.items():
            chain = _numbers(work.chain_ns, *(work.chain[kind] for kind in names))
            chain_rows.append([place, phase, *chain])
        for phase, classes in found.classes.items():
            class_rows.append([place, phase, *_numbers(*(classes[kind] for kind in CLASSES)), compiler()])
    _write("times", time_rows)
    _write("operations", count_rows)
    _write("chains", chain_rows)
    _write("instructions", class_rows)


def _numbers(*values: float) -> list[str]:
    return [f"{value:.6g}" for value in values]


def _write(name: str, rows: Sequence[Sequence[object]]) -> None:
    with (HERE / f"{name}.csv").open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
