"""Compares learned turning or reaching with its baselines: ``python training/evaluate_goals.py --help``."""

from magworm_gym.learning.command_line import run
from magworm_gym.learning.compare import evaluate_goals

if __name__ == "__main__":
    run("evaluate_goals.py", evaluate_goals.main)
