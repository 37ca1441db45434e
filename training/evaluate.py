"""Compares learned policies with other drives: ``python training/evaluate.py --help``."""

from functools import partial
from pathlib import Path

from magworm_gym.learning.command_line import run
from magworm_gym.learning.compare.evaluate import main

if __name__ == "__main__":
    run("evaluate.py", partial(main, configs=Path(__file__).parent / "configs"))
