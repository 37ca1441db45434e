"""The paper's experiments, simulated again from the presets and set beside its figures.

Source: "MagWorm", Soft Robotics, doi 10.1089/soro.2019.0167. One file holds one experiment; each gives a
:class:`studies.paper.section.Section` of the page ``docs/paper.md``.
"""
