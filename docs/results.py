"""Fills Markdown files with what simulator and tasks declare and with what commands have found.

Commands leave reports as JSON in ``docs/results/``. Between markers on a page stands a table or a paragraph
of a report, as between ``<!-- crawl.intact -->`` and ``<!-- /crawl.intact -->``, or a single number of the
list ``docs/results/numbers.toml``, as between ``<!-- =name -->`` and ``<!-- /=name -->``; between
``<!-- spaces -->`` and ``<!-- /spaces -->`` stand the tables of observation and action. Beside a report,
``crawl.json``, lies its page, ``crawl.md``::

    python docs/results.py            # writes all of them
    python docs/results.py --check    # fails where one is out of date
"""

import argparse
import sys
from pathlib import Path
from typing import Any

import msgspec
from blocks import fill, write_or_compare
from spaces import tables

from magworm_gym.learning.results import Report, Table, read_report

DOCS = Path(__file__).parent
RESULTS = DOCS / "results"


class Number(msgspec.Struct, forbid_unknown_fields=True):
    """A single number on a page.

    Attributes:
        report: Name of the report that it is of.
        at: Its place in the JSON of the report: keys and indices.
        form: Its format, as Python's ``format`` takes it.
        factor: What it is multiplied by.
    """

    report: str
    at: list[str | int]
    form: str = ""
    factor: float = 1.0

    def text(self, folder: Path) -> str:
        """The number as it is printed."""
        value: Any = msgspec.json.decode((folder / f"{self.report}.json").read_bytes())
        for key in self.at:
            value = value[key]
        return format(value * self.factor if self.form else value, self.form)


class Results:
    """All that pages may be filled with.

    Args:
        folder: Folder of the reports and of the list of single numbers.

    Raises:
        ValueError: A report or the list is not what it should be.
    """

    def __init__(self, folder: Path) -> None:
        self.reports: dict[str, Report] = {
            path.stem: read_report(path) for path in sorted(folder.glob("*.json"))
        }
        self._folder = folder
        self._numbers = msgspec.toml.decode((folder / "numbers.toml").read_bytes(), type=dict[str, Number])

    def block(self, name: str) -> str | None:
        """The block of a name; None for one that another program writes.

        Raises:
            ValueError: No report and no number has that name.
        """
        report, dot, part = name.partition(".")
        try:
            if name.startswith("="):
                return self._numbers[name[1:]].text(self._folder)
            if not dot:
                return tables() if name == "spaces" else None
            found = self.reports[report].parts[part]
        except (KeyError, IndexError, OSError):
            raise ValueError(f"<!-- {name} --> is in no report and not in the list of numbers") from None
        return found.markdown() if isinstance(found, Table) else found


def main(arguments: list[str] | None = None, docs: Path = DOCS) -> int:
    """Reads the command line; returns the exit status."""
    parser = argparse.ArgumentParser(
        description="Fills README and pages with tables of spaces and the results kept in docs/results/."
    )
    parser.add_argument("--check", action="store_true", help="only compare")
    check = parser.parse_args(arguments).check
    try:
        results = Results(docs / "results")
        status = [
            write_or_compare(docs / "results" / f"{name}.md", report.markdown(), check=check)
            for name, report in results.reports.items()
        ]
        for page in (docs.parent / "README.md", *sorted(docs.glob("*.md"))):
            filled = fill(page.read_text(encoding="utf-8"), results.block)
            status.append(write_or_compare(page, filled, check=check))
    except ValueError as error:
        print(f"docs/results.py: {error}", file=sys.stderr)
        return 1
    return max(status)


if __name__ == "__main__":
    sys.exit(main())
