"""Runs every experiment of the paper and writes page, figures and results.

Exits with 1 and a sentence for each figure that leaves its band in ``studies/paper/bands.toml``:

    python -m studies.paper                 # docs/paper.md, docs/images/paper/, runs/paper/results.json
    python -m studies.paper --write-bands   # and makes the bands anew, but those required by hand
    python -m studies.paper --only stride   # one experiment: its text and figures to runs/paper/
"""

import argparse
import json
import math
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

from studies.paper.ablations import ablations_section
from studies.paper.bands import PATH, Band, outside, read_bands, rewritten
from studies.paper.belts import belts_section
from studies.paper.bouncing import bouncing_section
from studies.paper.cantilever import cantilever_section
from studies.paper.damaged import damaged_section
from studies.paper.displacements import displacements_section
from studies.paper.figures import save
from studies.paper.lift import lift_section
from studies.paper.load import load_section
from studies.paper.mirror import mirror_section
from studies.paper.morphology import morphology_section
from studies.paper.other_fits import other_fits_section
from studies.paper.page import IMAGES, overview, page
from studies.paper.quantity import Quantity
from studies.paper.section import Section
from studies.paper.stride import stride_section

ROOT = Path(__file__).parent.parent.parent
DOCS, RUNS = ROOT / "docs", ROOT / "runs" / "paper"
EXPERIMENTS: dict[str, Callable[[], Section]] = {
    "lift": lift_section,
    "cantilever": cantilever_section,
    "morphology": morphology_section,
    "displacements": displacements_section,
    "ablations": ablations_section,
    "stride": stride_section,
    "other-fits": other_fits_section,
    "belts": belts_section,
    "bouncing": bouncing_section,
    "load": load_section,
    "damaged": damaged_section,
    "mirror": mirror_section,
}


def run(names: Sequence[str]) -> dict[str, Section]:
    """Runs experiments in order and says how long each took."""
    sections = {}
    for name in names:
        start = time.perf_counter()
        sections[name] = EXPERIMENTS[name]()
        print(f"{name:<14}{time.perf_counter() - start:6.1f} s", flush=True)
    return sections


def write(sections: Mapping[str, Section], bands: Mapping[str, Band], folder: Path, name: str) -> None:
    """Writes page and figures into a folder."""
    (folder / IMAGES).mkdir(parents=True, exist_ok=True)
    for section in sections.values():
        for image in section.images:
            save(image.figure, folder / IMAGES / f"{image.name}.png")
    (folder / name).write_text(page(list(sections.values()), bands), encoding="utf-8")


def write_results(sections: Mapping[str, Section], failures: Sequence[str]) -> None:
    """Writes ``runs/paper/results.json``."""
    experiments = {
        name: {"quantities": [_record(q) for q in section.quantities], "data": section.data}
        for name, section in sections.items()
    }
    RUNS.mkdir(parents=True, exist_ok=True)
    text = json.dumps({"experiments": experiments, "outside": list(failures)}, indent=1, allow_nan=False)
    (RUNS / "results.json").write_text(text + "\n", encoding="utf-8")


def _record(quantity: Quantity) -> dict[str, object]:
    """A quantity as JSON takes it: an open side of a range, and what was never reached, are null."""
    holds = quantity.holds and [_finite(side) for side in quantity.holds]
    numbers = {"model": _finite(quantity.model), "holds": holds}
    return {**asdict(quantity), "origin": quantity.origin.value, **numbers}


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def main() -> int:
    """Command line. Returns the exit status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--write-bands", action="store_true", help="make the bands anew from these results")
    parser.add_argument("--only", nargs="+", choices=EXPERIMENTS, metavar="NAME", help=", ".join(EXPERIMENTS))
    arguments = parser.parse_args()
    if arguments.write_bands and arguments.only:
        parser.error("--write-bands needs all experiments")
    sections = run(arguments.only or list(EXPERIMENTS))
    quantities = [quantity for section in sections.values() for quantity in section.quantities]
    if arguments.write_bands:
        PATH.write_text(rewritten(PATH.read_text(encoding="utf-8"), quantities), encoding="utf-8")
    bands = read_bands(PATH.read_text(encoding="utf-8"))
    if arguments.only:
        known = {quantity.key for quantity in quantities}
        bands = {key: band for key, band in bands.items() if key in known}
    failures = outside(quantities, bands)
    write(sections, bands, RUNS if arguments.only else DOCS, "paper.md")
    write_results(sections, failures)
    print(overview(quantities, bands))
    for sentence in failures:
        print(f"paper: {sentence}", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
