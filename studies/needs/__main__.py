"""Counts what each effect of a scene costs and writes the page.

python -m studies.needs    # docs/needs.md
"""

import argparse
from pathlib import Path

from studies.needs.counts import count_all, tasks
from studies.needs.effects import EFFECTS, SIDES, count_phases
from studies.needs.orders import force_errors
from studies.needs.page import HELD, page
from studies.needs.wrenches import pair_of, reach_of, scenes
from studies.stopwatch import Stopwatch

PAGE = Path(__file__).parent.parent.parent / "docs" / "needs.md"


def main() -> None:
    """Command line."""
    argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    ).parse_args()
    said = Stopwatch().said

    counts = count_all(tasks())
    said("counts")
    named = ["step", "air", "no-ground", *(effect.with_it for effect in EFFECTS if effect.phases)]
    both = [f"{name}-{side}" for name in dict.fromkeys(named) for side in SIDES]
    held = [task for _, _, task in HELD]
    of_phases = count_phases((*both, "belt-plane", "belt-16-plane", *held))
    said("phases")
    found = scenes()
    reaches = {name: reach_of(scene) for name, scene in found.items()}
    said("reach")
    errors = {scene.dimensions: force_errors(pair_of(scene), scene.dimensions) for scene in found.values()}
    PAGE.write_text(page(counts, of_phases, reaches, errors), encoding="utf-8")
    said("written")


if __name__ == "__main__":
    main()
