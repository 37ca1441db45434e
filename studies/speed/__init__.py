"""Environment steps per second, and what a longer step of the solver costs in accuracy."""
