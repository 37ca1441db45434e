"""A section of the page: what one experiment found."""

from dataclasses import dataclass, field
from typing import Any

from studies.paper.quantity import Quantity


@dataclass(frozen=True)
class Image:
    """A figure of the page.

    Attributes:
        name: File name without ending.
        caption: What it shows.
        figure: The matplotlib figure, not yet saved.
    """

    name: str
    caption: str
    figure: Any


@dataclass(frozen=True)
class Section:
    """What one experiment found.

    Attributes:
        title: Heading.
        text: Markdown: paragraphs and tables.
        images: Its figures, in order.
        quantities: Its figures that are compared with the paper, in order.
        data: What else ``results.json`` keeps, by name.
    """

    title: str
    text: str
    images: list[Image] = field(default_factory=list)
    quantities: list[Quantity] = field(default_factory=list)
    data: dict[str, Any] = field(default_factory=dict)


def table(header: list[str], rows: list[list[str]]) -> str:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
