"""Trains drive-magnet controllers: ``python training/train.py crawl --help``."""

from functools import partial
from pathlib import Path

from magworm_gym.learning.command_line import run
from magworm_gym.learning.train import main

if __name__ == "__main__":
    run("train.py", partial(main, configs=Path(__file__).parent / "configs"))
