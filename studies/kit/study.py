"""A study: what it measures, and the pages and figures that follow from its data."""

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from studies.kit import figures

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
IMAGES = DOCS / "images"


def _nothing(parser: argparse.ArgumentParser) -> None:
    """For a study whose measurement takes no options."""


@dataclass(frozen=True)
class Study:
    """One study. All that it renders follows from its committed data.

    Attributes:
        about: One line of help.
        measure: Runs the simulator and writes the data; takes the options.
        pages: Its pages, by file below ``docs/``: ``{"paper.md": text}``.
        figures: Its figures, by file below ``docs/images/``: ``{"paper/lift.png": figure}``.
        options: Adds the options of ``measure`` to its parser.
        complaints: One sentence for each result that is not as it must be.
    """

    about: str
    measure: Callable[[argparse.Namespace], None]
    pages: Callable[[], Mapping[str, str]]
    figures: Callable[[], Mapping[str, Any]] = dict
    options: Callable[[argparse.ArgumentParser], None] = _nothing
    complaints: Callable[[], Sequence[str]] = list

    def render(self) -> Iterator[Path]:
        """Writes pages and figures, and names each."""
        for file, text in self.pages().items():
            (DOCS / file).write_text(text, encoding="utf-8")
            yield DOCS / file
        for file, figure in self.figures().items():
            (IMAGES / file).parent.mkdir(parents=True, exist_ok=True)
            figures.save(figure, IMAGES / file)
            yield IMAGES / file


def named(modules: Mapping[str, str], name: str) -> Study:
    """The study of a module that is registered under a name; imported only now."""
    study = import_module(modules[name]).STUDY
    assert isinstance(study, Study)
    return study


def main(modules: Mapping[str, str], arguments: Sequence[str] | None = None) -> int:
    """The command line of studies, which are registered as modules by name. Returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m studies", description="Measures and renders studies.")
    commands = parser.add_subparsers(dest="command", required=True)
    measure = commands.add_parser("measure", help="run the simulator and write a study's data")
    measure.add_argument("name", choices=modules, help="which study")
    measure.add_argument("options", nargs=argparse.REMAINDER, help="its own options; --help lists them")
    render = commands.add_parser("render", help="write pages and figures from the data")
    render.add_argument("names", nargs="*", metavar="name", help=f"of {', '.join(modules)}; all without one")
    asked = parser.parse_args(arguments)
    if asked.command == "measure":
        return _measure(named(modules, asked.name), asked.name, asked.options)
    if unknown := [name for name in asked.names if name not in modules]:
        parser.error(f"no study is named {', '.join(unknown)}; there are {', '.join(modules)}")
    return max([_render(named(modules, name), name) for name in asked.names or modules])


def _measure(study: Study, name: str, options: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog=f"python -m studies measure {name}", description=study.about)
    study.options(parser)
    study.measure(parser.parse_args(options))
    return _complained(study, name)


def _render(study: Study, name: str) -> int:
    for path in study.render():
        print(path.relative_to(ROOT))
    return _complained(study, name)


def _complained(study: Study, name: str) -> int:
    found = study.complaints()
    for sentence in found:
        print(f"{name}: {sentence}", file=sys.stderr)
    return 1 if found else 0
