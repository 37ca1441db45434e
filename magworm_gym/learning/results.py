"""What a command found, as data: the tables and paragraphs of its report, and all that they rest on.

A report is kept as JSON. Its Markdown, and tables and numbers on other pages, are written from that.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec

from magworm_gym.atomic_files import write_text


class Interval(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A value and what it lies between.

    Attributes:
        value: The value.
        low: Lower end.
        high: Upper end.
        count: Number of samples.
    """

    value: float
    low: float
    high: float
    count: int

    def scaled(self, factor: float) -> Interval:
        """The same in another unit."""
        return Interval(self.value * factor, self.low * factor, self.high * factor, self.count)


class Column(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """A column of a table.

    Attributes:
        key: Name of its cells in a row.
        heading: What stands above it, with the unit.
        form: Format of its numbers, as Python's ``format`` takes it.
        factor: What the numbers are multiplied by.
    """

    key: str
    heading: str
    form: str = ""
    factor: float = 1.0

    def text(self, cell: str | float | Interval) -> str:
        """A cell as it is printed."""
        if isinstance(cell, str):
            return cell
        if isinstance(cell, Interval):
            value, low, high = (self.text(number) for number in (cell.value, cell.low, cell.high))
            return f"{value} [{low}, {high}]"
        return format(cell * self.factor, self.form)


class Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """A table.

    Attributes:
        columns: Its columns.
        rows: Cells by the keys of the columns; a row may hold more than is shown.
        heading: What stands above it.
    """

    columns: list[Column]
    rows: list[dict[str, str | float | Interval]]
    heading: str = ""

    def markdown(self) -> str:
        """The table in Markdown, without its heading."""
        lines = [[column.heading for column in self.columns], ["---"] * len(self.columns)]
        lines += [[column.text(row[column.key]) for column in self.columns] for row in self.rows]
        return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


class Report(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a command found.

    Attributes:
        title: Its heading.
        parts: Paragraphs in Markdown and tables by name, in the order of the page.
        data: Whatever they rest on, as plain values with SI units in the names.
    """

    title: str
    parts: dict[str, str | Table]
    data: dict[str, Any] = {}

    def markdown(self, pictures: str = "") -> str:
        """The whole report in Markdown, with its pictures at the end."""
        texts = [f"# {self.title}"]
        for part in self.parts.values():
            if isinstance(part, Table):
                texts += [part.heading and f"## {part.heading}", part.markdown()]
            else:
                texts.append(part)
        return "\n\n".join(text for text in (*texts, pictures) if text) + "\n"

    def json(self) -> str:
        """The report as JSON."""
        return msgspec.json.format(msgspec.json.encode(self), indent=1).decode() + "\n"

    def write(self, path: Path) -> None:
        """Writes the report as JSON."""
        write_text(path, self.json())


def read_report(path: Path) -> Report:
    """Reads a report that :meth:`Report.write` has written.

    Raises:
        ValueError: The file holds no report.
        OSError: It cannot be read.
    """
    try:
        return msgspec.json.decode(path.read_bytes(), type=Report)
    except msgspec.MsgspecError as error:
        raise ValueError(f"{path} holds no report: {error}") from None
