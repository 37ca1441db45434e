"""The study of the paper's experiments, simulated again from the presets and set beside its figures."""

import argparse
from typing import Any

from studies.kit.study import Study
from studies.kit.timing import Stopwatch
from studies.paper.ablations import Ablations
from studies.paper.bands import PATH, outside, read_bands, written
from studies.paper.belts import Belts
from studies.paper.bouncing import Bouncing
from studies.paper.cantilever import Cantilever
from studies.paper.damaged import Damaged
from studies.paper.displacements import Displacements
from studies.paper.experiment import Experiment
from studies.paper.lift import Lift
from studies.paper.load import Load
from studies.paper.mirror import Mirror
from studies.paper.morphology import Morphology
from studies.paper.other_fits import OtherFits
from studies.paper.page import paper_page, paper_report, quantities
from studies.paper.stride import Stride

EXPERIMENTS: dict[str, type[Experiment]] = {
    each.name: each
    for each in (
        *(Lift, Cantilever, Morphology, Displacements, Ablations, Stride),
        *(OtherFits, Belts, Bouncing, Load, Damaged, Mirror),
    )
}
"""In the order of the page."""


def options(parser: argparse.ArgumentParser) -> None:
    """Which experiments, or none but new bands."""
    names = ", ".join(EXPERIMENTS)
    either = parser.add_mutually_exclusive_group()
    either.add_argument("--only", nargs="+", choices=EXPERIMENTS, metavar="NAME", help=names)
    either.add_argument("--write-bands", action="store_true", help="measure nothing, make new bands")


def measure(arguments: argparse.Namespace) -> None:
    """Runs experiments in order and says how long each took."""
    if arguments.write_bands:
        PATH.write_text(written(quantities(kept())), encoding="utf-8")
        return
    said = Stopwatch().said
    for name in arguments.only or EXPERIMENTS:
        EXPERIMENTS[name].measured().keep()
        said(name)


def kept() -> list[Experiment]:
    """What was measured last."""
    return [experiment.kept() for experiment in EXPERIMENTS.values()]


def pages() -> dict[str, str]:
    """The page, and the report that the README is filled from, as data and as Markdown."""
    experiments = kept()
    report = paper_report(experiments)
    return {
        "paper.md": paper_page(experiments),
        "results/paper.json": report.json(),
        "results/paper.md": report.markdown(),
    }


def figures() -> dict[str, Any]:
    """The figures of all experiments."""
    return {f"paper/{name}.png": figure for each in kept() for name, figure in each.figures().items()}


def complaints() -> list[str]:
    """Figures that leave their bands."""
    return outside(quantities(kept()), read_bands())


STUDY = Study(
    "The paper's experiments beside its figures; minutes.", measure, pages, figures, options, complaints
)
