"""The study of validation: the Rust tests measure, and their bands decide; here they are run and shown."""

import argparse
import os
import shlex
import subprocess
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from studies.kit.study import ROOT, Study
from studies.validation.cases import DATA, Case, Section, read_cases, read_sections
from studies.validation.page import COMMAND, validation_page
from studies.validation.plots import drawn

FOLDER_VARIABLE = "MAGWORM_VALIDATION_DIR"


def measure(arguments: argparse.Namespace) -> None:
    """Runs the tests, each of which leaves its case; exits where one fails."""
    DATA.mkdir(exist_ok=True)
    for old in DATA.glob("*.toml"):
        old.unlink()
    environment = os.environ | {FOLDER_VARIABLE: str(DATA)}
    status = subprocess.run([*shlex.split(COMMAND), "--no-fail-fast"], cwd=ROOT, env=environment).returncode
    if status:
        sys.exit(f"validation: a test failed, {COMMAND} ended with {status}; what it left says which")


def pages() -> dict[str, str]:
    """The page."""
    return {"validation.md": validation_page(read_cases(), read_sections())}


def figures() -> dict[str, Any]:
    """The figures of all cases."""
    return {
        case.image(index): drawn(figure)
        for case in read_cases().values()
        for index, figure in enumerate(case.figures)
    }


def complaints() -> list[str]:
    """What is wrong, one sentence each."""
    return complaints_of(read_cases(), read_sections())


def complaints_of(cases: Mapping[str, Case], sections: Sequence[Section]) -> list[str]:
    """Cases that are missing or not on the page, and numbers outside of their bands."""
    names = [name for section in sections for name in section.cases]
    found = [f"{name} is missing, its test did not come to its end" for name in names if name not in cases]
    found += [f"{name} is not in studies/validation/contents.toml" for name in cases if name not in names]
    for case in cases.values():
        found += [f"{case.name}: {quantity} is outside of its band" for quantity in case.failures]
    return found


STUDY = Study(
    "The simulator against exact solutions; minutes.", measure, pages, figures, complaints=complaints
)
