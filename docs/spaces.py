"""Writes the tables of observation and action into a Markdown file, as the simulator declares them.

They stand between the lines ``<!-- spaces -->`` and ``<!-- /spaces -->``::

    python docs/spaces.py README.md           # writes them
    python docs/spaces.py --check README.md   # fails where they are out of date
"""

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path

from magworm_gym import Batch, Scene
from magworm_gym._magworm import Specification

PRESET = "paper-3"
BEGIN, END = "<!-- spaces -->", "<!-- /spaces -->"


def tables() -> str:
    """Both tables as Markdown."""
    scene = Scene.preset(PRESET)
    batch = Batch(scene, 1)
    observation, action = batch.observation_specification, batch.action_specification
    limits = scene.stage_limits or {}
    return "\n".join(
        [
            f"Action, `float32`, shape ({_size(action)},); values beyond the bounds are clipped:",
            "",
            *_table(action),
            "",
            f"Limits of the stage in `{PRESET}`: "
            + ", ".join(f"`{name}` {value:g}" for name, value in limits.items())
            + f"; a control step lasts {1000.0 * scene.control_step_s:g} ms.",
            "",
            f"Observation, `float32`, shape ({_size(observation)},) for `{PRESET}` "
            f"(M = {scene.magnets} body magnets):",
            "",
            *_table(observation),
        ]
    )


def _size(parts: Iterable[Specification]) -> int:
    return sum(part.size for part in parts)


def _table(parts: Iterable[Specification]) -> list[str]:
    rows = ["| at | name | unit | bounds | what |", "|---|---|---|---|---|"]
    start = 0
    for part in parts:
        place = f"{start}" if part.size == 1 else f"{start}–{start + part.size - 1}"
        bounds = f"{part.low:g} to {part.high:g}" if abs(part.low) < float("inf") else "–"
        rows.append(f"| {place} | `{part.name}` | {part.unit} | {bounds} | {part.description} |")
        start += part.size
    return rows


def main() -> int:
    """Reads the command line; returns the exit status."""
    parser = argparse.ArgumentParser(description="Writes the tables of observation and action.")
    parser.add_argument("file", type=Path)
    parser.add_argument("--check", action="store_true", help="only compare")
    flags = parser.parse_args()
    text = flags.file.read_text(encoding="utf-8")
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        print(f"{flags.file} lacks the lines {BEGIN} and {END}", file=sys.stderr)
        return 1
    fresh = f"{before}{BEGIN}\n{tables()}\n{END}{after}"
    if flags.check and fresh != text:
        print(f"the tables in {flags.file} are out of date: run 'make docs'", file=sys.stderr)
        return 1
    if not flags.check:
        flags.file.write_text(fresh, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
