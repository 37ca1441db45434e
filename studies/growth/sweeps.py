"""What is varied, one thing at a time, and the exponents of growth along it."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from magworm_gym import Scene, SceneError

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
PRESETS = {2: "paper-3", 3: "turn-3"}
"""By dimensions."""
FEWEST_POINTS = 4
"""Of a fit; with two unknowns two are left to judge it by."""


@dataclass(frozen=True)
class Setting:
    """What is simulated: a preset with fields of its scene replaced, on threads; none for all cores."""

    edits: Mapping[str, Any] = field(default_factory=dict)
    environments: int = 64
    threads: int | None = 1

    def scene(self, dimensions: int) -> Scene:
        """In the plane or in space.

        Raises:
            SceneError: The scene cannot be simulated.
        """
        return Scene.preset(PRESETS[dimensions]).with_values(dict(self.edits))


@dataclass(frozen=True)
class Sweep:
    """One thing that is varied.

    Attributes:
        name: Column of the data.
        title: What it is called on the page.
        sizes: Rising.
        setting: What a size stands for.
    """

    name: str
    title: str
    sizes: Sequence[int]
    setting: Callable[[int], Setting]


def nodes(count: int) -> Setting:
    """A body with so many nodes."""
    return Setting({**FINE, "body.elements_per_bridge": (count - NODES_OF_FEET) // 2})


def magnets(count: int) -> Setting:
    """A body with so many magnets."""
    return Setting({"body.magnets": count})


def drives(count: int) -> Setting:
    """So many drive magnets in a row."""
    return Setting({"drive.arrangement": {"kind": "belt", "pitch_m": PITCH_M, "count": count}})


SWEEPS = (
    Sweep("environments", "environments", ENVIRONMENTS, lambda count: Setting({}, count, None)),
    Sweep("threads", "threads", THREADS, lambda count: Setting({}, 4096, count)),
    Sweep("nodes", "nodes of a body", NODES, nodes),
    Sweep("magnets", "magnets of a body", MAGNETS, magnets),
    Sweep("drive_magnets", "drive magnets", DRIVES, drives),
)
BEYOND = (nodes(max(NODES) + 2), magnets(max(MAGNETS) + 1), drives(max(DRIVES) + 1))
"""The first setting beyond the range of nodes, magnets and drive magnets."""


def refusals() -> list[str]:
    """What the simulator says to the first scene beyond each range."""
    sentences = []
    for setting in BEYOND:
        try:
            setting.scene(2)
        except SceneError as refusal:
            sentences.append(str(refusal))
    return sentences


@dataclass(frozen=True)
class Exponent:
    """Cost ∝ size to this power, over the upper part of a sweep.

    Attributes:
        value: The power.
        error: Its standard error.
        least: Smallest size in the fit.
    """

    value: float
    error: float
    least: int


def exponent(sizes: Sequence[int], costs: Sequence[float]) -> Exponent | None:
    """Least squares on logarithms over the upper half of the sizes; None where there are too few.

    Args:
        sizes: Rising.
        costs: Above zero.
    """
    points = max(FEWEST_POINTS, (len(sizes) + 1) // 2)
    if len(sizes) < points:
        return None
    x, y = np.log(sizes[-points:]), np.log(costs[-points:])
    away = x - x.mean()
    slope = float(away @ y / (away @ away))
    residual = y - y.mean() - slope * away
    error = float(np.sqrt(residual @ residual / (points - 2) / (away @ away)))
    return Exponent(slope, error, sizes[-points])
