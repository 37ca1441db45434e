"""How far a single pass of a drive magnet beside the robot's way turns it, and when it tips over.

The paper's model is planar; all of this is of the model in space, and nothing here was compared with a robot.
"""
