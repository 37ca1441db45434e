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

from studies.error.peers import cantilever
from studies.error.peers.measure import Series, Track, finest, measured
from studies.kit.passes import MM, Floats

MESHES = (9, 18, 27, 54)
FINEST = 80
"""With 108 the rod, which has no damper, broke up within the second at every step tried."""


class Rods(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing):  # type: ignore[misc]
    """What a rod, its clamp and its loads are put into."""


def series() -> list[Series]:
    """The one scheme."""
    runs = measured(released, {elements: limit_s(elements) for elements in MESHES})
    return [Series("position Verlet", runs, finest(released, FINEST, limit_s(FINEST)))]


def limit_s(elements: int) -> float:
    """Longest step [s], 2/ω, of an element that turns against the shear of its neighbours."""
    stretching = 2.0 * cantilever.SOUND_M_S / cantilever.half_cell_length_m(elements)
    shear_m_s = math.sqrt(cantilever.SHEAR_FACTOR * cantilever.SHEAR_MODULUS_PA / cantilever.DENSITY_KG_M3)
    shearing = math.sqrt(12.0) * shear_m_s / cantilever.THICKNESS_M
    return 2.0 / math.hypot(stretching, shearing)


def released(elements: int, step_s: float) -> Callable[[], Track]:
    """The rod at rest, and what runs it."""
    length_m = cantilever.half_cell_length_m(elements)
    rod = cosserat_rod(
        length_m * (np.arange(elements + 1, dtype=np.float64) - 0.5),
        shear_n=np.array([cantilever.SHEAR_N, cantilever.SHEAR_N, cantilever.STRETCH_N]),
        bend_n_m2=cantilever.RIGIDITIES_N_M2,
        inertias_kg_m2=cantilever.DENSITY_KG_M3 * length_m * cantilever.SECONDS_M4,
    )
    advance = clamped(rod, elastica.GravityForces, acc_gravity=np.array([0.0, -cantilever.GRAVITY_M_S2, 0.0]))

    def run() -> Track:
        advance(0.0, step_s, round(cantilever.DURATION_S / step_s))
        x, y, _ = MM * rod.position_collection[:, -1]
        return cantilever.tip_only(x, y)

    return run


def clamped(rod: Any, force: Any, *of_force: Any, **by_name: Any) -> Callable[[float, float, int], float]:
    """Clamps and loads a rod; what is returned advances it from a time by steps, and gives the time [s]."""
    rods = Rods()
    rods.append(rod)
    held = {"constrained_position_idx": (0, 1), "constrained_director_idx": (0,)}
    rods.constrain(rod).using(elastica.FixedConstraint, **held)
    rods.add_forcing_to(rod).using(force, *of_force, **by_name)
    rods.finalize()
    stepper = elastica.PositionVerlet()

    def advance(time_s: float, step_s: float, steps: int) -> float:
        now, step = np.float64(time_s), np.float64(step_s)
        for _ in range(steps):
            now = stepper.step(rods, now, step)
        return float(now)

    return advance


def cosserat_rod(nodes_m: Floats, shear_n: Floats, bend_n_m2: Floats, inertias_kg_m2: Floats) -> Any:
    """A straight rod of a circle's area, then given the rectangle's stiffness and inertia.

    Args:
        nodes_m: Places of the nodes along x (N + 1,) [m].
        shear_n: Stiffness against shear, twice, and stretching (3,) or (3, N) [N].
        bend_n_m2: Stiffness against bending, twice, and twist (3,) or (3, N − 1) [N·m²].
        inertias_kg_m2: Moments of inertia of the elements about z, −y and x (3,) or (3, N) [kg·m²].
    """
    places_m = np.zeros((3, len(nodes_m)))
    places_m[0] = nodes_m
    rod = elastica.CosseratRod.straight_rod(
        len(nodes_m) - 1,
        start=places_m[:, 0].copy(),
        direction=np.array([1.0, 0.0, 0.0]),
        normal=np.array([0.0, 0.0, 1.0]),  # the weak axis
        base_length=float(np.ptp(nodes_m)),
        base_radius=math.sqrt(cantilever.AREA_M2 / math.pi),
        density=cantilever.DENSITY_KG_M3,
        youngs_modulus=cantilever.YOUNGS_MODULUS_PA,
        shear_modulus=cantilever.SHEAR_MODULUS_PA,
        position=places_m,
    )
    set_diagonals(rod.shear_matrix, shear_n)
    set_diagonals(rod.bend_matrix, bend_n_m2)
    set_diagonals(rod.mass_second_moment_of_inertia, inertias_kg_m2)
    set_diagonals(rod.inv_mass_second_moment_of_inertia, 1.0 / inertias_kg_m2)
    return rod


def set_diagonals(matrices: Any, values: Floats) -> None:
    """Writes the diagonals of matrices (3, 3, N)."""
    for axis, value in enumerate(values):
        matrices[axis, axis] = value
