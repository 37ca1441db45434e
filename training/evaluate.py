"""Compares a learned controller with tuned drives: ``python training/evaluate.py --help``."""

from magworm_gym.learning.command_line import run
from magworm_gym.learning.compare import evaluate

if __name__ == "__main__":
    run("evaluate.py", evaluate.main)
