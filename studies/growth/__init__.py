"""How the cost of a control step grows with what is simulated, and what a learner feels of it.

Page: ``docs/growth.md``; figure: ``docs/images/growth.png``; data: the tables beside this file.
"""
