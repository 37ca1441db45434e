"""Puts into a Markdown file what the long comparisons found: verdict and first table of their reports.

The reports stand in ``docs/results/``, from ``make demo``; nothing is typed by hand::

    python docs/results.py --take crawl runs/demo/report.md   # keeps the report of a run
    python docs/results.py README.md                          # writes the blocks
    python docs/results.py --check README.md                  # fails where they are out of date
"""

import argparse
import sys
from pathlib import Path

from blocks import write_or_check

RESULTS = Path(__file__).parent / "results"
COMPARISONS = ("crawl", "turn")


def block(report: str) -> str:
    """Table and verdict of a report, in the order in which a reader wants them."""
    _, verdict, *rest = report.split("\n\n")
    table = next(part for part in rest if part.startswith("| "))
    return f"{table}\n\n{verdict}"


def kept(report: str) -> str:
    """A report without figures and animations, which are not kept beside it."""
    text, _, _ = report.partition("## Figures")
    parts = text.strip().split("\n\n")
    return "\n\n".join(part for part in parts if not part.startswith(("![", "Animation"))) + "\n"


def main() -> int:
    """Reads the command line; returns the exit status."""
    parser = argparse.ArgumentParser(description="Puts results of the comparisons into a Markdown file.")
    parser.add_argument("file", type=Path, help="Markdown file, or with --take the report of a run")
    parser.add_argument("--check", action="store_true", help="only compare")
    parser.add_argument("--take", choices=COMPARISONS, help="keep the report of a run of this comparison")
    flags = parser.parse_args()
    if flags.take:
        RESULTS.mkdir(exist_ok=True)
        report = flags.file.read_text(encoding="utf-8")
        (RESULTS / f"{flags.take}.md").write_text(kept(report), encoding="utf-8")
        return 0
    text = flags.file.read_text(encoding="utf-8")
    named = [name for name in COMPARISONS if f"<!-- {name} -->" in text]
    reports = {name: (RESULTS / f"{name}.md").read_text(encoding="utf-8") for name in named}
    return write_or_check(
        flags.file, {name: block(report) for name, report in reports.items()}, check=flags.check
    )


if __name__ == "__main__":
    sys.exit(main())
