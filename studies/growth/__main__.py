"""Measures how the cost of a control step grows and writes page, figure and data. Minutes.

python -m studies.growth    # docs/growth.md, docs/images/growth.png, studies/growth/*.csv
"""

import argparse
import csv
from collections.abc import Sequence
from pathlib import Path

from magworm_gym.atomic_files import write_text
from studies.growth.measure import cost
from studies.growth.memory import memory
from studies.growth.page import PLACES, Results, page
from studies.growth.picture import picture
from studies.growth.sweeps import SWEEPS
from studies.kit.figures import save
from studies.kit.timing import Stopwatch
from studies.ppo_share import CASES, rows, share

HERE = Path(__file__).parent
DOCS = HERE.parent.parent / "docs"


def main() -> None:
    """Command line."""
    argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    ).parse_args()
    said = Stopwatch().said

    # First, while this process holds little.
    memories = {space: memory(space) for space in PLACES}
    said("memory")
    results = {}
    for sweep in SWEEPS:
        for space, place in PLACES.items():
            results[sweep.name, space] = [(setting, cost(setting)) for setting in sweep.settings(space)]
            said(f"{sweep.name}, {place}")
    shares = [share(case) for case in CASES]
    said("share of a training")
    save(picture(results), DOCS / "images" / "growth.png")
    write(HERE / "sweeps.csv", sweep_rows(results))
    write(HERE / "ppo.csv", rows(shares))
    write_text(DOCS / "growth.md", page(SWEEPS, results, memories, shares))
    said("written")


def sweep_rows(results: Results) -> list[list[object]]:
    """One row a point."""
    names = ["sweep", "dimensions", "environments", "threads", "nodes", "magnets", "drive_magnets"]
    table: list[list[object]] = [[*names, "wall_s", "processor_s", "systems", "wrenches", "broken"]]
    for (name, space), points in results.items():
        for of, found in points:
            sizes = [of.environments, of.threads or "all", of.nodes, of.magnets, of.drives]
            times = [f"{found.seconds:.4g}", f"{found.processor_s:.4g}"]
            numbers = [*times, f"{found.systems:.1f}", f"{found.wrenches:.1f}", found.broken]
            table.append([name, 3 if space else 2, *sizes, *numbers])
    return table


def write(path: Path, table: Sequence[Sequence[object]]) -> None:
    """Comma-separated values."""
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(table)


if __name__ == "__main__":
    main()
