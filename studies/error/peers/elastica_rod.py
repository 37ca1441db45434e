"""PyElastica: a Cosserat rod, stepped by position Verlet.

Its own clamp, `FixedConstraint`, holds the first element, both nodes and direction, half of it inside the
wall. Stiffness and inertia are those of the rectangle; in bending the shear that the rod has beside the
Kirchhoff rod is that of the physical modulus, since a stiffer one only shortens the step. It also thins
as it stretches, keeping its volume. No damper.

Source: M. Gazzola, L. H. Dudte, A. G. McCormick, L. Mahadevan, R. Soc. Open Sci. 5 (2018) 171628.
"""

import math
from collections.abc import Callable
from typing import Any

import elastica
import numpy as np

from studies.error.peers.cantilever import (
    AREA_M2,
    DENSITY_KG_M3,
    DURATION_S,
    GRAVITY_M_S2,
    MM,
    SHEAR_FACTOR,
    SHEAR_MODULUS_PA,
    SOUND_M_S,
    STRONG_M4,
    THICKNESS_M,
    WEAK_M4,
    YOUNGS_MODULUS_PA,
    half_cell_length_m,
    tip_only,
)
from studies.error.peers.measure import Series, Track, finest, measured

MESHES = (9, 18, 27, 54)
FINEST = 80
"""With 108 the rod, which has no damper, broke up within the second at every step tried."""


class Rods(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing):  # type: ignore[misc]
    """What the rod, its clamp and its weight are put into."""


def series() -> list[Series]:
    """The one scheme."""
    runs = measured(released, {elements: limit_s(elements) for elements in MESHES})
    return [Series("position Verlet", runs, finest(released, FINEST, limit_s(FINEST)))]


def limit_s(elements: int) -> float:
    """Longest step [s], 2/ω, of an element that turns against the shear of its neighbours."""
    stretching = 2.0 * SOUND_M_S / half_cell_length_m(elements)
    shear_m_s = math.sqrt(SHEAR_FACTOR * SHEAR_MODULUS_PA / DENSITY_KG_M3)
    shearing = math.sqrt(12.0) * shear_m_s / THICKNESS_M
    return 2.0 / math.hypot(stretching, shearing)


def released(elements: int, step_s: float) -> Callable[[], Track]:
    """The rod at rest, and what runs it."""
    rod = rectangular_rod(elements)
    rods = Rods()
    rods.append(rod)
    held = {"constrained_position_idx": (0, 1), "constrained_director_idx": (0,)}
    rods.constrain(rod).using(elastica.FixedConstraint, **held)
    gravity = np.array([0.0, -GRAVITY_M_S2, 0.0])
    rods.add_forcing_to(rod).using(elastica.GravityForces, acc_gravity=gravity)
    rods.finalize()
    stepper, step = elastica.PositionVerlet(), np.float64(step_s)

    def run() -> Track:
        time_s = np.float64(0.0)
        for _ in range(round(DURATION_S / step_s)):
            time_s = stepper.step(rods, time_s, step)
        x, y, _ = MM * rod.position_collection[:, -1]
        return tip_only(x, y)

    return run


def rectangular_rod(elements: int) -> Any:
    """A rod of a circle's area, then given the rectangle's stiffness and inertia."""
    length_m = half_cell_length_m(elements)
    rod = elastica.CosseratRod.straight_rod(
        elements,
        start=np.array([-0.5 * length_m, 0.0, 0.0]),
        direction=np.array([1.0, 0.0, 0.0]),
        normal=np.array([0.0, 0.0, 1.0]),  # the weak axis
        base_length=elements * length_m,
        base_radius=math.sqrt(AREA_M2 / math.pi),
        density=DENSITY_KG_M3,
        youngs_modulus=YOUNGS_MODULUS_PA,
        shear_modulus=SHEAR_MODULUS_PA,
    )
    shear_n = SHEAR_FACTOR * SHEAR_MODULUS_PA * AREA_M2
    polar_m4 = WEAK_M4 + STRONG_M4
    set_diagonals(rod.shear_matrix, (shear_n, shear_n, YOUNGS_MODULUS_PA * AREA_M2))
    bending = (YOUNGS_MODULUS_PA * WEAK_M4, YOUNGS_MODULUS_PA * STRONG_M4, SHEAR_MODULUS_PA * polar_m4)
    set_diagonals(rod.bend_matrix, bending)
    inertia = [DENSITY_KG_M3 * length_m * second_m4 for second_m4 in (WEAK_M4, STRONG_M4, polar_m4)]
    set_diagonals(rod.mass_second_moment_of_inertia, inertia)
    set_diagonals(rod.inv_mass_second_moment_of_inertia, [1.0 / value for value in inertia])
    return rod


def set_diagonals(matrices: Any, values: Any) -> None:
    """Writes the diagonals of matrices (3, 3, N)."""
    for axis, value in enumerate(values):
        matrices[axis, axis] = value
