"""The page ``docs/paper.md``: everything on it follows from the experiments' data."""

from collections.abc import Sequence
from pathlib import Path

from studies.kit.page import page
from studies.paper.experiment import Experiment
from studies.paper.quantity import Origin, Quantity, quantities_of, read_rows

HERE = Path(__file__).parent


def quantities(experiments: Sequence[Experiment]) -> list[Quantity]:
    """All figures that are compared with the paper, in the order of the page."""
    rows = read_rows()
    return [quantity for each in experiments for quantity in quantities_of(each.numbers(), rows)]


def paper_page(experiments: Sequence[Experiment]) -> str:
    """The page as Markdown."""
    found = quantities(experiments)
    return page(
        HERE / "page.md",
        quantities=found,
        targets=_of(found, Origin.TARGET),
        exact=_of(found, Origin.CLOSED_FORM),
        fitted=_of(found, Origin.FITTED),
        held=_of(found, Origin.HELD_BACK),
        sections=[page(HERE / "sections" / f"{each.name}.md", of=each) for each in experiments],
    )


def _of(found: Sequence[Quantity], origin: Origin) -> list[Quantity]:
    return [quantity for quantity in found if quantity.row.origin is origin and quantity.row.listed]
