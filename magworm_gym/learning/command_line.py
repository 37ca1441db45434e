"""Command lines that answer a mistake with one sentence and exit status 2."""

import argparse
import sys
from collections.abc import Callable
from typing import NoReturn

from magworm_gym import PolicyError, SceneError

MISTAKE = 2
INTERRUPTED = 130


class UsageError(Exception):
    """A mistake in flags, settings or files that the user can mend; the message is one sentence."""


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
        main: Takes the arguments without the program's name. Where it raises KeyboardInterrupt with a
            message, that says how to go on.
    """
    status = 0
    try:
        main(sys.argv[1:])
    except KeyboardInterrupt as interruption:
        message, status = f"stopped; {interruption or 'what was complete is kept'}", INTERRUPTED
    except (UsageError, SceneError, PolicyError) as mistake:
        message, status = str(mistake), MISTAKE
    except ImportError as missing:
        if "pip install" not in str(missing):
            raise
        message, status = str(missing), MISTAKE
    except OSError as error:  # a full disk, a folder that may not be written
        message, status = (
            f"{error.filename or 'a file'}: {error.strerror}; what was complete is kept",
            MISTAKE,
        )
    if status:
        print(f"{program}: {message}", file=sys.stderr)
    sys.exit(status)
