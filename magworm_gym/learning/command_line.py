"""Command lines that answer a mistake with one sentence and exit status 2."""

import argparse
import sys
from collections.abc import Callable
from typing import NoReturn

from magworm_gym import SceneError

MISTAKE = 2
INTERRUPTED = 130


class UsageError(Exception):
    """A mistake in flags or files that the user can mend; the message is one sentence."""


def positive(text: str) -> int:
    """Reads a whole number of at least 1."""
    number = int(text) if text.isdecimal() else 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of at least 1")
    return number


class Parser(argparse.ArgumentParser):
    """Parser that reports a bad flag in one line."""

    def error(self, message: str) -> NoReturn:
        """Raises UsageError in place of printing the usage."""
        raise UsageError(f"{message}; --help lists what is allowed")


def run(program: str, main: Callable[[list[str]], None]) -> NoReturn:
    """Runs a main function on the arguments of the process and exits.

    Args:
        program: Name in front of a message.
        main: Takes the arguments without the program's name.
    """
    try:
        main(sys.argv[1:])
    except (UsageError, SceneError, ImportError) as mistake:
        if isinstance(mistake, ImportError) and "pip install" not in str(mistake):
            raise
        print(f"{program}: {mistake}", file=sys.stderr)
        sys.exit(MISTAKE)
    except KeyboardInterrupt:
        print(f"{program}: stopped; what was complete is kept", file=sys.stderr)
        sys.exit(INTERRUPTED)
    sys.exit(0)
