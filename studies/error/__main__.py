"""Error against run time: docs/performance.md, its figures and studies/error/errors.csv.

Five minutes on two cores. `--cases` runs some of the cases and leaves the rows of the others as they are.

    python -m studies.error
"""

import argparse
import csv
from pathlib import Path

from studies.error.cases import CASES
from studies.error.distance import distances
from studies.error.levels import TASKS, levels
from studies.error.measured import Row, measure, read, write
from studies.error.page import IMAGES, page
from studies.error.pictures import draw_case

HERE = Path(__file__).parent
DOCS = HERE.parent.parent / "docs"
DATA, PEERS = HERE / "errors.csv", HERE / "peers.csv"


def measured(names: list[str], repetitions: int) -> list[Row]:
    """Rows of all cases, measured anew for some."""
    kept = read(DATA) if DATA.exists() and len(names) < len(CASES) else []
    rows = []
    for name, case in CASES.items():
        if name in names:
            print(f"{name} ...", flush=True)
            rows += measure(case, repetitions)
        else:
            rows += [row for row in kept if row.case == name]
    return rows


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--cases", nargs="+", choices=[*CASES], default=[*CASES], help="which to run")
    parser.add_argument("--repetitions", type=int, default=3, help="runs whose median time is taken")
    arguments = parser.parse_args()
    rows = measured(arguments.cases, arguments.repetitions)
    write(rows, DATA)
    rows = read(DATA)  # rounded alike, whatever was measured just now
    (DOCS / IMAGES).mkdir(parents=True, exist_ok=True)
    shown = [case for name, case in CASES.items() if any(row.case == name for row in rows)]
    for case in shown:
        draw_case(case, [row for row in rows if row.case == case.name], DOCS / IMAGES / f"{case.name}.png")
    words = {name: levels(CASES[name], arguments.repetitions) for name in TASKS}
    with PEERS.open(newline="", encoding="utf-8") as file:
        peers = list(csv.DictReader(file))
    (DOCS / "performance.md").write_text(page(shown, rows, words, peers, distances()), encoding="utf-8")
    print(f"{DOCS / 'performance.md'}")


if __name__ == "__main__":
    main()
