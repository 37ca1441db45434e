"""Runs the turning map and writes page, figures and data.

python -m studies.turning    # docs/turning.md, docs/images/turning/, studies/turning/*.csv
"""

import argparse
from pathlib import Path

from studies.kit.figures import save
from studies.kit.timing import Stopwatch
from studies.turning.data import plane_csv, points_csv, tipping_csv
from studies.turning.page import IMAGES, page
from studies.turning.passes import outcomes, points
from studies.turning.pictures import per_pass, per_pass_by_offset, roll_against_offset, tipping_map
from studies.turning.plane import comparisons
from studies.turning.sweeps import SWEEPS, TIPPING

HERE = Path(__file__).parent
DOCS = HERE.parent.parent / "docs"


def main() -> None:
    """Command line."""
    argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    ).parse_args()
    said = Stopwatch().said

    plane = comparisons()
    said("plane")
    sweeps = {}
    for name, drives in SWEEPS.items():
        sweeps[name] = points(drives)
        said(name)
    tipping = outcomes(TIPPING)
    said("tipping")
    figures = {
        "offset": per_pass(sweeps["offset"], lambda drive: drive.offset_mm, "offset of the drive [mm]"),
        "yaw": per_pass_by_offset(sweeps["yaw"]),
        "height": per_pass(sweeps["height"], lambda drive: drive.height_mm, "height of the drive [mm]"),
        "speed": per_pass(sweeps["speed"], lambda drive: drive.speed_mm_s, "speed of the drive [mm/s]"),
        "roll": roll_against_offset(sweeps["offset"]),
        "tipping": tipping_map(TIPPING, tipping),
    }
    (DOCS / IMAGES).mkdir(parents=True, exist_ok=True)
    for name, figure in figures.items():
        save(figure, DOCS / IMAGES / f"{name}.png")
    texts = {
        HERE / "points.csv": points_csv(sweeps),
        HERE / "tipping.csv": tipping_csv(TIPPING, tipping),
        HERE / "plane.csv": plane_csv(plane),
        DOCS / "turning.md": page(sweeps, TIPPING, tipping, plane),
    }
    for path, text in texts.items():
        path.write_text(text, encoding="utf-8")
    said("written")


if __name__ == "__main__":
    main()
