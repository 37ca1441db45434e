"""What the simulator is compared with, and how fast it is."""
