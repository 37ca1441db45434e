"""Trains drive-magnet controllers: ``python training/train.py crawl --help``."""

from magworm_gym.learning import train
from magworm_gym.learning.command_line import run

if __name__ == "__main__":
    run("train.py", train.main)
