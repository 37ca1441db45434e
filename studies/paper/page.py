"""The page ``docs/paper.md``, and what the README says of it, from the experiments' data."""

from collections.abc import Sequence
from pathlib import Path

from magworm_gym.learning.results import Column, Interval, Report, Table
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
        summary=summary(found),
        sections=[page(HERE / "sections" / f"{each.name}.md", of=each) for each in experiments],
    )


def paper_report(experiments: Sequence[Experiment]) -> Report:
    """What other pages are filled with: the summary, and the figures in which model and paper disagree."""
    found = quantities(experiments)
    columns = [Column("what", "figure"), Column("paper", "paper"), Column("model", "model")]
    rows: list[dict[str, str | float | Interval]] = [
        {"what": each.row.what, "paper": each.paper_text, "model": each.model_text}
        for each in found
        if each.row.listed and each.disagrees
    ]
    disagreements = Table(columns, rows, "Where they disagree")
    return Report(
        "The paper's figures and the model's", {"summary": summary(found), "disagreements": disagreements}
    )


def summary(found: Sequence[Quantity]) -> str:
    """How many figures agree, in one paragraph."""
    targets, exact = (_of(found, origin) for origin in (Origin.TARGET, Origin.CLOSED_FORM))
    fitted, held = (_of(found, origin) for origin in (Origin.FITTED, Origin.HELD_BACK))
    met, exactly = (sum(each.as_wanted for each in group) for group in (targets, exact))
    missed, against = (sum(each.disagrees for each in group) for group in (fitted, held))
    return (
        f"The model meets {met} of {len(targets)} identification targets and {exactly} of {len(exact)} exact "
        f"results. It disagrees with {missed} of {len(fitted)} fitted trends, and with {against} of "
        f"{len(held)} figures and statements that were held back; with the others it agrees or comes close."
    )


def _of(found: Sequence[Quantity], origin: Origin) -> list[Quantity]:
    return [quantity for quantity in found if quantity.row.origin is origin and quantity.row.listed]
