"""Runs the validation tests of the simulator and writes `docs/validation.md` with its figures.

Fails where a test fails, a figure is outside of its band, or a case is missing. What is computed and which
bands hold stands in the Rust tests alone; here they are only run and written down.

    python studies/validation/validate.py
"""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
from pathlib import Path

from cases import Case, read_cases
from contents import NAMES
from page import COMMAND, figure_names, write_page
from plots import draw

ROOT = Path(__file__).resolve().parents[2]
FOLDER_VARIABLE = "MAGWORM_VALIDATION_DIR"


def run_tests(folder: Path) -> int:
    """Runs the tests, which leave their cases in a folder; the exit status."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.toml"):
        old.unlink()
    environment = os.environ | {FOLDER_VARIABLE: str(folder.resolve())}
    # The tests' order of output depends on their threads: it is shown, not kept.
    return subprocess.run([*shlex.split(COMMAND), "--no-fail-fast"], cwd=ROOT, env=environment).returncode


def write_figures(cases: dict[str, Case], folder: Path) -> None:
    """Draws all figures; those of cases that are gone are removed."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.svg"):
        old.unlink()
    for case in cases.values():
        for name, figure in zip(figure_names(case), case.figures, strict=True):
            draw(figure, folder / name)


def complaints(cases: dict[str, Case], status: int) -> list[str]:
    """What is wrong, one sentence each."""
    found = [f"{name}: missing, its test did not come to its end" for name in NAMES if name not in cases]
    found += [f"{name}: not in studies/validation/contents.py" for name in cases if name not in NAMES]
    for case in cases.values():
        found += [f"{case.name}: {quantity} is outside of its band" for quantity in case.failures]
    if status != 0 and not found:
        found.append(f"a test without a case failed: {COMMAND} ended with {status}")
    return found


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    defaults = {
        "cases": ("runs/validation", "folder for what the tests leave"),
        "page": ("docs/validation.md", "Markdown file to write"),
        "images": ("docs/images/validation", "folder for the figures"),
    }
    for name, (place, text) in defaults.items():
        parser.add_argument(f"--{name}", type=Path, default=ROOT / place, help=text)
    arguments = parser.parse_args()
    status = run_tests(arguments.cases)
    cases = read_cases(arguments.cases)
    write_figures(cases, arguments.images)
    seen_from_page = Path(os.path.relpath(arguments.images, arguments.page.parent)).as_posix()
    arguments.page.write_text(write_page(cases, seen_from_page), encoding="utf-8")
    found = complaints(cases, status)
    print(f"{len(cases)} cases, {sum(len(case.rows) for case in cases.values())} rows: {arguments.page}")
    if found:
        sys.exit("\n".join(["validation failed:", *found]))


if __name__ == "__main__":
    main()
