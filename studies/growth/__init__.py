"""How the cost of a control step grows with what is simulated, and what a learner feels of it."""
