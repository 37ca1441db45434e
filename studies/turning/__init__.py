"""How far a single pass of a drive magnet beside the robot turns it, and when it tips over."""
