"""Tables as people save them: commas, semicolons or tabs, decimal commas, empty rows and columns."""

import codecs
import csv
from dataclasses import dataclass
from pathlib import Path

from magworm_gym.identification.mistake import ProblemError

NOTHING = frozenset({"", "nan", "na", "n/a", "#n/a", "none", "null"})
"""Cells that stand for a number that was not found, in small letters."""


@dataclass(frozen=True)
class Sheet:
    """A table of texts.

    Attributes:
        path: Where it comes from.
        rows: Number of the line in the file, and its cells without blanks around them; no empty rows.
        decimal_comma: Whether numbers may be written 0,5: only where commas do not separate cells.
    """

    path: Path
    rows: list[tuple[int, list[str]]]
    decimal_comma: bool

    def number(self, line: int, place: str, text: str, allowed: str = "a number or nothing") -> float:
        """The number in a cell, which a message calls its place; NaN where there is none.

        Raises:
            ProblemError: It is none; says line, place and what is allowed.
        """
        plain = text.replace(",", ".") if self.decimal_comma and "." not in text else text
        try:
            return float("nan") if plain.lower() in NOTHING else float(plain)
        except ValueError:
            raise self.refusal(line, place, text, allowed) from None

    def refusal(self, line: int, place: str, text: str, allowed: str) -> ProblemError:
        """The error for a cell that is not allowed."""
        return ProblemError(f"{self.path}, line {line}, {place} is {text!r}; allowed: {allowed}")


def read_sheet(path: Path, what: str) -> Sheet:
    """Reads a table; what separates its cells is what its first line has most of.

    Args:
        path: The file.
        what: What a message calls it, such as "drive file".

    Raises:
        ProblemError: It is missing or no text.
    """
    lines = read_text(path, what).splitlines()
    skipped = 0
    if lines and lines[0].lower().startswith("sep="):
        skipped, separator = 1, lines[0][4:5]
    else:
        first = next((line for line in lines if line.strip(" \t,;")), "")
        separator = max(",;\t", key=first.count)
    rows = [[cell.strip() for cell in row] for row in csv.reader(lines[skipped:], delimiter=separator or ",")]
    numbered = [(line, row) for line, row in enumerate(rows, start=skipped + 1) if any(row)]
    return Sheet(path, numbered, separator != ",")


def read_text(path: Path, what: str) -> str:
    """Reads a text file in UTF-8, or in UTF-16 where it says so.

    Raises:
        ProblemError: It is missing or no text.
    """
    try:
        raw = path.read_bytes()
        wide = raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
        return raw.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        raise ProblemError(
            f"{what} {path} is no text in UTF-8; allowed: a text file saved as UTF-8"
        ) from error
    except OSError as error:
        raise ProblemError(f"{what} {path} cannot be read: {error.strerror}") from error
