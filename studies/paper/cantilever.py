"""The paper's second case: a soft cantilever with a magnet at its tip in a uniform field.

Closed form: a moment at the tip bends the rod to an arc, θ = (m B L/EI) sin(φ − θ), with m the magnet's
moment, B the flux density, L the length and EI the stiffness of the soft part, φ the angle from the
moment at rest to the field and θ the angle of the tip.
"""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.figures import BLUE, INK, ORANGE, RED, REFERENCE, TEAL, VIOLET, legend_above, panels
from studies.kit.passes import MM, Floats
from studies.paper.experiment import Experiment, Numbers

SOFT_M, MAGNET_M = 0.050, 0.004
WIDTH_M, THICKNESS_M, MODULUS_PA = 0.010, 0.004, 100e3
MAGNET_WIDTH_M, MAGNET_HEIGHT_M, REMANENCE_T = 0.003, 0.001, 1.22
FIELDS_T = (0.003, 0.006, 0.010, 0.020, 0.030)
"""Paper: 3 mT is its weak field; the others are ours."""
DIRECTIONS_DEG = np.arange(10.0, 171.0, 10.0)
SHAPES = 8
"""Index of the direction whose shapes are drawn, 90°."""
SETTLED_S, SAMPLE_S = 6.0, 0.01
COLOURS = (VIOLET, BLUE, TEAL, ORANGE, RED)
VACUUM_PERMEABILITY = 4e-7 * math.pi


@dataclass(frozen=True)
class Cantilever(Experiment):
    """A sweep over fields and directions.

    Attributes:
        angle_rad: Angle of the tip at rest (fields, directions) [rad].
        off_arc_um: Greatest distance of a node at rest from the closed form's arc [µm].
        shapes_mm: Every third node at rest in each field at :data:`SHAPES` (fields, nodes, 2) [mm].
    """

    name: ClassVar[str] = "cantilever"
    digits: ClassVar[int] = 9  # what the angles are compared with is exact
    angle_rad: Floats
    off_arc_um: float
    shapes_mm: Floats

    @classmethod
    def measured(cls) -> "Cantilever":
        """Lets every rod come to rest."""
        scenes = [cantilever(field, direction) for field in FIELDS_T for direction in DIRECTIONS_DEG]
        runs = record_scenes(scenes, SETTLED_S, SAMPLE_S)
        angles = np.array([run.magnet_poses[-1, 0, 2] for run in runs])
        off_arc = [_off_arc_m(run, theta) for run, theta in zip(runs, exact_angles().flat, strict=True)]
        shapes = [MM * _at_rest(run)[1][::3] for run in runs[SHAPES :: len(DIRECTIONS_DEG)]]
        grid = angles.reshape(len(FIELDS_T), len(DIRECTIONS_DEG))
        return cls(grid, 1e6 * max(off_arc), np.array(shapes))

    @property
    def worst_percent(self) -> float:
        """Greatest relative error of an angle [%]."""
        return 100.0 * float(np.abs(self.angle_rad / exact_angles() - 1.0).max())

    @property
    def weak_deg(self) -> Floats:
        """Angles in the weakest field (directions,) [°]."""
        return np.asarray(np.degrees(self.angle_rad[0]))

    def numbers(self) -> Numbers:
        """Errors against the closed form, and the decline that the paper sees."""
        return {
            "cantilever.angle": self.worst_percent,
            "cantilever.arc": 1e-4 * self.off_arc_um / SOFT_M,
            "cantilever.decline": float(self.weak_deg.max() - self.weak_deg[-1]),
        }

    @property
    def words(self) -> dict[str, Any]:
        """What else the section says."""
        top = int(self.weak_deg.argmax())
        return {
            "loads": [load_factor(field) for field in FIELDS_T],
            "fields_mt": [MM * field for field in FIELDS_T],
            "directions": DIRECTIONS_DEG,
            "top": top,
            "after": "falls" if top < len(DIRECTIONS_DEG) - 1 else "does not fall",
        }

    def figures(self) -> dict[str, Any]:
        """Shapes, and angles against the direction of the field."""
        figure, (left, right) = panels(1, 2, (9.2, 3.7))
        smooth, directions = np.linspace(0.0, SOFT_M + MAGNET_M, 100), np.linspace(1.0, 179.0, 179)
        exact = exact_angles()
        for row, (field_t, shade) in enumerate(zip(FIELDS_T, COLOURS, strict=True)):
            left.plot(*(MM * arc(exact[row, SHAPES], smooth)).T, color=shade, lw=1.2)
            left.plot(*self.shapes_mm[row].T, "o", color=shade, ms=3.5)
            load = load_factor(field_t)
            closed = [math.degrees(exact_angle(load, math.radians(d))) for d in directions]
            right.plot(directions, closed, color=shade, lw=1.2)
            label = f"{MM * field_t:g} mT, mBL/EI = {load:.2f}"
            right.plot(DIRECTIONS_DEG, np.degrees(self.angle_rad[row]), "o", color=shade, ms=3.5, label=label)
        left.plot([0.0, 0.0], [-4.0, 4.0], color=INK, lw=3.0)
        left.set_aspect("equal")
        left.set(xlabel="x [mm]", ylabel="y [mm]")
        right.plot(directions, directions, color=REFERENCE, lw=0.8, ls=":", label="along the field, θ = φ")
        right.set(xlabel="direction of the field φ [°]", ylabel="angle of the tip θ [°]")
        right.set_xticks(range(0, 181, 30))
        legend_above(figure, right, 3)
        return {"cantilever": figure}


def load_factor(field_t: float) -> float:
    """M B L/EI of the rod in a field."""
    moment = REMANENCE_T * MAGNET_M * MAGNET_WIDTH_M * MAGNET_HEIGHT_M / VACUUM_PERMEABILITY
    rigidity = MODULUS_PA * WIDTH_M * THICKNESS_M**3 / 12.0
    return moment * field_t * SOFT_M / rigidity


def exact_angles() -> Floats:
    """Closed form of all angles of the tip (fields, directions) [rad]."""
    return np.array(
        [[exact_angle(load_factor(f), math.radians(d)) for d in DIRECTIONS_DEG] for f in FIELDS_T]
    )


def exact_angle(load: float, direction: float) -> float:
    """Root θ in [0, φ] of θ = load · sin(φ − θ), by bisection [rad].

    Args:
        load: m B L/EI.
        direction: φ, between 0 and π [rad].
    """
    low, high = 0.0, direction
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if load * math.sin(direction - middle) > middle else (low, middle)
    return 0.5 * (low + high)


def arc(angle: float, along: Floats) -> Floats:
    """Points of an arc of length L that turns by an angle, then of its tangent.

    Args:
        angle: θ at the end of the arc [rad].
        along: Places along the rod (P,) [m].

    Returns:
        Points (P, 2) [m]; the clamp is the origin.
    """
    curvature = angle / SOFT_M
    bent, straight = np.minimum(along, SOFT_M), np.maximum(along - SOFT_M, 0.0)
    x = np.sin(curvature * bent) / curvature + straight * math.cos(angle)
    y = (1.0 - np.cos(curvature * bent)) / curvature + straight * math.sin(angle)
    return np.stack([x, y], axis=-1)


def cantilever(field_t: float, direction_deg: float) -> Scene:
    """The cantilever in a field whose direction counts from the magnet's moment, anticlockwise."""
    direction = math.radians(direction_deg)
    changes: dict[str, Any] = {
        "gravity_m_s2": 0.0,
        "body.length_m": SOFT_M + MAGNET_M,
        "body.width_m": WIDTH_M,
        "body.thickness_m": THICKNESS_M,
        "body.elements": 54,
        "body.magnets": [{"position_m": SOFT_M + 0.5 * MAGNET_M, "polarity": 1}],
        "material.youngs_modulus_pa": MODULUS_PA,
        "material.damping_time_s": 0.02,
        "magnet": {
            "length_m": MAGNET_M,
            "width_m": MAGNET_WIDTH_M,
            "height_m": MAGNET_HEIGHT_M,
            "remanence_t": REMANENCE_T,
            "density_kg_m3": 7500.0,
        },
        "field": {"x_t": -field_t * math.sin(direction), "y_t": field_t * math.cos(direction)},
        # A long step: a relaxation, not a motion.
        "solver.step_s": 0.01,
    }
    return Scene.preset("cantilever").with_values(changes)


def _off_arc_m(run: Recording, theta: float) -> float:
    """Greatest distance of the nodes at rest from the arc [m]."""
    along, points = _at_rest(run)
    return float(np.linalg.norm(points - arc(theta, along), axis=-1).max())


def _at_rest(run: Recording) -> tuple[Floats, Floats]:
    """Places along the rod (P,) and at rest (P, 2) of the nodes outside the wall [m]."""
    along = run.nodes[0, :, 0]
    free = along >= 0.0
    return along[free], run.nodes[-1, free] - (0.0, run.nodes[0, 0, 1])
