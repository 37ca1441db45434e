"""What is varied, one thing at a time."""

import os
from collections.abc import Callable
from dataclasses import dataclass

from studies.growth.measure import Setting, setting

ENVIRONMENTS = (1, 4, 16, 64, 256, 1024, 4096, 16384, 65536)
THREADS = tuple(sorted({1, 2, os.cpu_count() or 1}))
NODES = (12, 20, 50, 100, 200, 500, 1000)
"""A body with three magnets has 12 at least."""
MAGNETS = (1, 2, 4, 8, 16, 32)
DRIVES = (1, 2, 4, 8, 16)
PITCH_M = 0.05
"""Of the drive magnets."""
NODES_OF_FEET = 10
"""Nodes of three feet, so that two bridges make up the rest."""
FINE = {"body.pitch_m": 0.022}
"""Feet further apart than the presets', whose bridges are too short for as many elements."""
BEYOND = (
    {**FINE, "body.elements_per_bridge": (max(NODES) - NODES_OF_FEET) // 2 + 1},
    {"body.magnets": max(MAGNETS) + 1},
    {"drive.arrangement": {"kind": "belt", "pitch_m": PITCH_M, "count": max(DRIVES) + 1}},
)
"""The first scene beyond the range of nodes, magnets and drive magnets."""


@dataclass(frozen=True)
class Sweep:
    """One thing that is varied.

    Attributes:
        name: Column of the data.
        title: What it is called on the page.
        held: What is held, for the page.
        settings: The settings in the plane and in space.
    """

    name: str
    title: str
    held: str
    settings: Callable[[bool], list[Setting]]

    def size(self, setting: Setting) -> int:
        """The number that is varied."""
        return int(getattr(setting, self.name))


SWEEPS = (
    Sweep(
        "environments",
        "environments",
        "three magnets, one drive magnet, all cores",
        lambda space: [setting(space, environments=count, threads=None) for count in ENVIRONMENTS],
    ),
    Sweep(
        "threads",
        "threads",
        "4,096 environments, three magnets, one drive magnet",
        lambda space: [setting(space, environments=4096, threads=count) for count in THREADS],
    ),
    Sweep(
        "nodes",
        "nodes of a body",
        "64 environments on one thread, three magnets 22 mm apart, one drive magnet",
        lambda space: [
            setting(space, {**FINE, "body.elements_per_bridge": (count - NODES_OF_FEET) // 2})
            for count in NODES
        ],
    ),
    Sweep(
        "magnets",
        "magnets of a body",
        "64 environments on one thread, seven nodes a magnet, one drive magnet",
        lambda space: [setting(space, {"body.magnets": count}) for count in MAGNETS],
    ),
    Sweep(
        "drives",
        "drive magnets",
        "64 environments on one thread, three magnets, drive magnets in a row 50 mm apart",
        lambda space: [
            setting(
                space,
                {"drive.arrangement": {"kind": "belt", "pitch_m": PITCH_M, "count": count}},
                drives=count,
            )
            for count in DRIVES
        ],
    ),
)
