"""The command ``magworm``."""

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import NoReturn

from magworm_gym import PolicyError, SceneError, __version__

COMMANDS = {"identify": "identify", "example-tracks": "identify", "policies": "", "watch": "render"}
"""Module of this package that adds a command → the extra that it needs."""

MISTAKE = 2
INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Runs the command and exits: 0, 2 for a mistake, which is said in one sentence, 130 for Ctrl-C.

    Args:
        arguments: Without the program's name; None for those of the process.
    """
    words = sys.argv[1:] if arguments is None else list(arguments)
    parsed = _parser().parse_args(_no_flags(words), argparse.Namespace(words=words, mistake=SceneError))
    try:
        parsed.run(parsed)
    except (parsed.mistake, SceneError, PolicyError, ImportError) as mistake:
        if isinstance(mistake, ImportError) and "pip install" not in str(mistake):
            raise
        print(f"magworm {parsed.command}: {mistake}", file=sys.stderr)
        sys.exit(MISTAKE)
    except KeyboardInterrupt:
        print(f"magworm {parsed.command}: stopped", file=sys.stderr)
        sys.exit(INTERRUPTED)
    sys.exit(0)


def _no_flags(words: list[str]) -> list[str]:
    """Words of which negative numbers begin with a blank: argparse takes -5e-2 for a flag."""
    return [f" {word}" if word.startswith("-") and _is_number(word) else word for word in words]


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="magworm", description="Tools of the MagWorm simulator.")
    parser.add_argument("--version", action="version", version=f"magworm-gym {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="command")
    for name, extra in COMMANDS.items():
        try:
            import_module(f"magworm_gym.cli.{name.replace('-', '_')}").add_to(commands)
        except ModuleNotFoundError as error:
            needs = f"needs the library {error.name}: pip install 'magworm-gym[{extra}]'"
            _add_missing(commands.add_parser(name, help=needs, prefix_chars="\0", add_help=False), needs)
    return parser


def _add_missing(parser: argparse.ArgumentParser, needs: str) -> None:
    """Makes a command say what it needs."""

    def run(_: argparse.Namespace) -> NoReturn:
        raise ImportError(needs)

    parser.add_argument("words", nargs="*")
    parser.set_defaults(run=run)
