"""Why rows of the table may disagree: our best guess for each, from ``hypotheses.toml``."""

import sys
from collections.abc import Sequence
from pathlib import Path

from studies.paper.quantity import Quantity, verdict

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PATH = Path(__file__).with_suffix(".toml")


def hypotheses(quantities: Sequence[Quantity]) -> str:
    """A list of the rows that disagree with the paper, each with our best guess why."""
    guesses = tomllib.loads(PATH.read_text(encoding="utf-8"))
    against = [q for q in quantities if q.listed and verdict(q, True).startswith("**")]
    lines = [f"- *{q.what}.* {guesses.get(q.key, 'No hypothesis yet.')}" for q in against]
    return "\n".join(["\n## What disagrees, and why that may be\n", *lines])
