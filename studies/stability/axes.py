"""The axes of the sweeps: what is varied, from where to where.

Two bodies are swept. The *rod* is the preset ``cantilever`` with ten elements, let go from the horizontal.
The *robot* has three magnets that do not act on each other, over a drive magnet that goes by at 100 mm/s, 22
mm beneath the ground. It is that of the tests: ``paper-3`` damps too much for the explicit scheme.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from magworm_gym import Scene, load_scene

Changes = dict[str, Any]

ROBOT = load_scene(Path(__file__).parent.parent.parent / "rust/magworm/tests/data/robot.toml")
DRIVE_HALF_HEIGHT_M = 0.5 * 0.004033
MAGNET_HEIGHT_M = 0.001628
MAGNETS_M3 = 3 * 0.006303 * 0.007455 * MAGNET_HEIGHT_M
"""Of the robot's three magnets, as in its file."""
RUBBER_M3 = (3 * 0.014 * 0.007 + 2 * 0.006 * 0.004) * 0.01131 - MAGNETS_M3
ROBOT_KG = 7500.0 * MAGNETS_M3 + 1070.0 * RUBBER_M3

PASSING = {"kind": "constant", "x_m": -0.010, "y_m": -0.022, "speed_m_s": 0.1}

BASES: Mapping[str, tuple[Scene, Changes]] = {
    "rod": (Scene.preset("cantilever"), {"body.elements": 10, "material.damping_time_s": 1e-3}),
    "robot": (ROBOT, {"drive.motion": PASSING, "reset.random_drive": False}),
}
"""Scene and changes of each body that is swept."""


@dataclass(frozen=True)
class Axis:
    """What is varied.

    Attributes:
        name: In the field's words.
        unit: Unit of the values; empty for numbers without one.
        keys: The fields of a scene that change, for the page.
        values: From one end of the range to the other.
        changes: The fields of a scene for a value.
    """

    name: str
    unit: str
    keys: str
    values: tuple[float, ...]
    changes: Callable[[float], Changes]

    @property
    def title(self) -> str:
        """Name and unit."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    @property
    def ends(self) -> tuple[float, float, float]:
        """The lowest value, one in the middle, the highest."""
        return self.values[0], self.values[len(self.values) // 2], self.values[-1]


def _same(*keys: str, scale: float = 1.0) -> Callable[[float], Changes]:
    return lambda value: {key: scale * value for key in keys}


def _section(thickness_mm: float) -> Changes:
    """Feet as thick as the value, bridges in the robot's proportion, magnets that fit."""
    foot_m = thickness_mm / 1e3
    return {
        "body.foot_thickness_m": foot_m,
        "body.bridge_thickness_m": max(1e-4, 4 / 7 * foot_m),
        "magnet.height_m": max(1e-4, min(MAGNET_HEIGHT_M, 0.9 * foot_m)),
    }


def _mass_ratio(ratio: float) -> Changes:
    """Densities that share the robot's mass out."""
    rubber_kg = ROBOT_KG / (1.0 + ratio)
    return {
        "material.density_kg_m3": rubber_kg / RUBBER_M3,
        "magnet.density_kg_m3": ratio * rubber_kg / MAGNETS_M3,
    }


def _gap(gap_mm: float) -> Changes:
    """From the top face of the drive magnet to the ground; negative where it stands in the body."""
    return {"drive.motion.y_m": -gap_mm / 1e3 - DRIVE_HALF_HEIGHT_M}


STEP = Axis(
    "step",
    "ms",
    "solver.step_s",
    (0.01, 0.05, 0.2, 0.5, 1, 2, 5, 10, 25, 50),
    _same("solver.step_s", scale=1e-3),
)
STIFFNESS = Axis(
    "Young's modulus",
    "Pa",
    "material.youngs_modulus_pa",
    (1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10),
    _same("material.youngs_modulus_pa"),
)
DAMPING = Axis(
    "retardation time",
    "s",
    "material.damping_time_s",
    (0.0, 1e-4, 1e-3, 0.01, 0.1, 1.0),
    _same("material.damping_time_s"),
)
THICKNESS = Axis(
    "thickness",
    "mm",
    "body.thickness_m",
    (0.1, 0.3, 1, 4, 10, 30),
    _same("body.thickness_m", scale=1e-3),
)
NODES = Axis(
    "nodes", "", "body.elements", (5, 11, 31, 101, 301, 1000), lambda nodes: {"body.elements": int(nodes) - 1}
)
SECTION = Axis(
    "thickness of the feet",
    "mm",
    "body.foot_thickness_m, body.bridge_thickness_m, magnet.height_m",
    (0.1, 0.3, 1, 7, 15, 30),
    _section,
)
MASS_RATIO = Axis(
    "mass of magnets over rubber",
    "",
    "material.density_kg_m3, magnet.density_kg_m3",
    (0.01, 0.1, 1, 10, 100, 1000),
    _mass_ratio,
)
SPEED = Axis(
    "speed of the drive",
    "m/s",
    "drive.motion.speed_m_s",
    (0.01, 0.1, 0.5, 1, 3, 10),
    _same("drive.motion.speed_m_s"),
)
GAP = Axis("gap", "mm", "drive.motion.y_m", (60, 20, 10, 5, 1, 0, -3.5, -7), _gap)
REMANENCE = Axis(
    "remanence of all magnets",
    "T",
    "magnet.remanence_t, drive.remanence_t",
    (0.0, 0.3, 1.22, 3, 6, 10),
    _same("magnet.remanence_t", "drive.remanence_t"),
)
FRICTION = Axis(
    "friction",
    "",
    "ground.static_friction, ground.dynamic_friction",
    (0.0, 0.3, 1, 2, 5, 10),
    _same("ground.dynamic_friction", "ground.static_friction"),
)
GRAVITY = Axis("gravity", "g", "gravity_m_s2", (0, 1, 3, 10, 30, 100), _same("gravity_m_s2", scale=9.81))
DROP = Axis("drop", "mm", "start.height_m", (0, 1, 10, 100, 1000), _same("start.height_m", scale=1e-3))
INSIDE = Axis(
    "depth in the ground", "mm", "start.height_m", (0, 0.1, 1, 10), _same("start.height_m", scale=-1e-3)
)
ANGLE = Axis(
    "angle of the start", "°", "start.angle_deg", (0, 30, 60, 90, 135, 180, 270), _same("start.angle_deg")
)
INCLINE = Axis("incline", "°", "ground.incline_deg", (-90, -45, 0, 30, 60, 90), _same("ground.incline_deg"))

ROD_AXES = (STEP, STIFFNESS, DAMPING, THICKNESS, NODES)
ROBOT_AXES = (
    STEP,
    STIFFNESS,
    DAMPING,
    SECTION,
    MASS_RATIO,
    SPEED,
    GAP,
    REMANENCE,
    FRICTION,
    GRAVITY,
    DROP,
    INSIDE,
    ANGLE,
    INCLINE,
)
ALONE: Mapping[str, tuple[Axis, ...]] = {"rod": ROD_AXES, "robot": ROBOT_AXES}
"""The axes of each body, each swept alone."""

LONGER = replace(STEP, values=STEP.values[3:])
"""Steps as long as a robot is likely to be given: shorter ones take long and tell little."""

CROSSED: Mapping[str, tuple[tuple[Axis, Axis], ...]] = {
    "rod": ((STEP, STIFFNESS), (STEP, DAMPING)),
    "robot": (
        (LONGER, STIFFNESS),
        (GAP, REMANENCE),
        (SPEED, GAP),
        (FRICTION, INCLINE),
        (DROP, ANGLE),
        (GRAVITY, MASS_RATIO),
    ),
}
"""Pairs of axes that are swept together and drawn."""


def base_scene(body: str, dimensions: int) -> Scene:
    """The scene that an axis changes.

    Args:
        body: A key of BASES.
        dimensions: 2 or 3.
    """
    scene, changes = BASES[body]
    control = {"control.step_s": 0.05, "control.episode_s": 1.0}
    return scene.with_values(changes | control | {"dimensions": dimensions})
