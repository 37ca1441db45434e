"""The axes of the sweeps: what is varied, from where to where.

Two bodies are swept. The *rod* is the preset ``cantilever`` with ten elements, let go from the horizontal.
The *robot* has three magnets that do not act on each other, over a drive magnet that goes by at 100 mm/s, 22
mm beneath the ground. It is that of the tests: ``paper-3`` damps too much for the explicit scheme.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import msgspec

from magworm_gym import Scene, load_scene
from studies.kit.passes import MM, PASS_SPEED_M_S, PLANE_M, steady
from studies.kit.study import ROOT

Changes = dict[str, Any]

ROBOT = load_scene(ROOT / "rust/magworm/tests/data/robot.toml")
DRIVE_HALF_HEIGHT_M = 0.5 * 0.004033
MAGNET_HEIGHT_M = 0.001628
MAGNETS_M3 = 3 * 0.006303 * 0.007455 * MAGNET_HEIGHT_M
"""Of the robot's three magnets, as in its file."""
RUBBER_M3 = (3 * 0.014 * 0.007 + 2 * 0.006 * 0.004) * 0.01131 - MAGNETS_M3
ROBOT_KG = 7500.0 * MAGNETS_M3 + 1070.0 * RUBBER_M3

BASES: Mapping[str, tuple[Scene, Changes]] = {
    "rod": (Scene.preset("cantilever"), {"body.elements": 10, "material.damping_time_s": 1e-3}),
    "robot": (ROBOT, {"drive.motion": steady(-0.010, PLANE_M, PASS_SPEED_M_S), "reset.random_drive": False}),
}
"""Scene and changes of each body that is swept."""


def base_scene(body: str, dimensions: int) -> Scene:
    """The scene that an axis changes, of a key of BASES, in two or three dimensions."""
    scene, changes = BASES[body]
    control = {"control.step_s": 0.05, "control.episode_s": 1.0}
    return scene.with_values(changes | control | {"dimensions": dimensions})


@dataclass(frozen=True, kw_only=True)
class Axis:
    """What is varied."""

    name: str  # in the field's words
    unit: str = ""  # unit of the values; empty for numbers without one
    bodies: tuple[str, ...]  # keys of BASES that it is swept for
    fields: tuple[str, ...]  # the fields of a scene that change
    values: tuple[float, ...]  # from one end of the range to the other
    scale: float = 1.0  # what a value is multiplied by for the fields

    @property
    def title(self) -> str:
        """Name and unit."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    @property
    def ends(self) -> tuple[float, float, float]:
        """The lowest value, one in the middle, the highest."""
        return self.values[0], self.values[len(self.values) // 2], self.values[-1]

    def changes(self, value: float) -> Changes:
        """The fields of a scene for a value."""
        of_its_own = OF_THEIR_OWN.get(self.name)
        results = of_its_own(value) if of_its_own else [self.scale * value] * len(self.fields)
        return dict(zip(self.fields, results, strict=True))


def _nodes(nodes: float) -> list[int]:
    return [int(nodes) - 1]


def _section(thickness_mm: float) -> list[float]:
    """Feet as thick as the value, bridges in the robot's proportion, magnets that fit."""
    foot_m = thickness_mm / MM
    return [foot_m, max(1e-4, 4 / 7 * foot_m), max(1e-4, min(MAGNET_HEIGHT_M, 0.9 * foot_m))]


def _mass_ratio(ratio: float) -> list[float]:
    """Densities that share the robot's mass out."""
    rubber_kg = ROBOT_KG / (1.0 + ratio)
    return [rubber_kg / RUBBER_M3, ratio * rubber_kg / MAGNETS_M3]


def _gap(gap_mm: float) -> list[float]:
    """From the top face of the drive magnet to the ground; negative where it stands in the body."""
    return [-gap_mm / MM - DRIVE_HALF_HEIGHT_M]


OF_THEIR_OWN: Mapping[str, Callable[[float], list[Any]]] = {
    "nodes": _nodes,
    "thickness of the feet": _section,
    "mass of magnets over rubber": _mass_ratio,
    "gap": _gap,
}
"""Fields of a scene that are no multiples of the value."""

_LISTED = msgspec.toml.decode(
    (Path(__file__).parent / "axes.toml").read_bytes(), type=dict[str, list[Axis]], strict=False
)["axes"]
ALONE: Mapping[str, tuple[Axis, ...]] = {
    body: tuple(axis for axis in _LISTED if body in axis.bodies) for body in BASES
}
"""The axes of each body, each swept alone."""
AXES: Mapping[str, Axis] = {axis.title: axis for axis in _LISTED}
"""All axes by their titles."""

STEP, STIFFNESS, DAMPING, INSIDE = (
    AXES[title]
    for title in ("step [ms]", "Young's modulus [Pa]", "retardation time [s]", "depth in the ground [mm]")
)
LONGER = replace(STEP, values=STEP.values[3:])
"""Steps as long as a robot is likely to be given: shorter ones take long and tell little."""
_OF_ROBOTS = (
    ("gap [mm]", "remanence of all magnets [T]"),
    ("speed of the drive [m/s]", "gap [mm]"),
    ("friction", "incline [°]"),
    ("drop [mm]", "angle of the start [°]"),
    ("gravity [g]", "mass of magnets over rubber"),
)
CROSSED: Mapping[str, tuple[tuple[Axis, Axis], ...]] = {
    "rod": ((STEP, STIFFNESS), (STEP, DAMPING)),
    "robot": ((LONGER, STIFFNESS), *((AXES[across], AXES[up]) for across, up in _OF_ROBOTS)),
}
"""Pairs of axes that are swept together and drawn."""
