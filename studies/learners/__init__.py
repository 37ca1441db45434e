"""Learning algorithms on turning, each for the same processor time."""
