"""Sweeps stiff and extreme scenes and writes page, figures and data.

python -m studies.stability           # docs/stability.md, docs/images/stability/, studies/stability/*.csv
python -m studies.stability --long    # every value in space as well, and every pair of axes: pairs.csv
"""

import argparse
from pathlib import Path

from studies.kit.figures import save
from studies.kit.timing import Stopwatch
from studies.stability.axes import ALONE, CROSSED
from studies.stability.cases import alone, crossed, every_pair, judge
from studies.stability.data import energy_csv, limits_csv, outcomes_csv, starts_csv
from studies.stability.energy import swings
from studies.stability.limits import limits
from studies.stability.page import IMAGES, page
from studies.stability.pictures import robot_map, rod_map, start_strip
from studies.stability.starts import starts, untyings

HERE = Path(__file__).parent
DOCS = HERE.parent.parent / "docs"
PAIRS = HERE / "pairs.csv"


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--long", action="store_true", help="all values in space, every pair of axes")
    long = parser.parse_args().long
    said = Stopwatch().said

    found = limits()
    said("limits")
    energies = swings()
    said("energies")
    single = []
    for dimensions in (2, 3):
        single += judge(
            [
                case
                for body, axes in ALONE.items()
                for axis in axes
                for case in alone(body, axis, dimensions, long=long)
            ]
        )
        said("plane" if dimensions == 2 else "space")
    maps = {
        body: judge([case for pair in pairs for case in crossed(body, pair)])
        for body, pairs in CROSSED.items()
    }
    said("crossed")
    bent, untied = starts(), untyings()
    said("bent starts")
    if long:
        PAIRS.write_text(outcomes_csv(judge(every_pair(), accuracy=False)), encoding="utf-8")
        said("pairs")
    (DOCS / IMAGES).mkdir(parents=True, exist_ok=True)
    figures = {"rod": rod_map(maps["rod"]), "robot": robot_map(maps["robot"]), "starts": start_strip()}
    for name, figure in figures.items():
        save(figure, DOCS / IMAGES / f"{name}.png")
    texts = {
        HERE / "alone.csv": outcomes_csv(single),
        HERE / "crossed.csv": outcomes_csv(maps["rod"] + maps["robot"]),
        HERE / "starts.csv": starts_csv(bent),
        HERE / "limits.csv": limits_csv(found),
        HERE / "energy.csv": energy_csv(energies),
        DOCS / "stability.md": page(found, energies, single, maps, bent, untied, PAIRS),
    }
    for path, text in texts.items():
        path.write_text(text, encoding="utf-8")
    said("written")


if __name__ == "__main__":
    main()
