"""Mesh, masses and stiffness of the rod with magnets, for a Cosserat rod, all elements of which give.

In MagWorm a magnet is rigid. Here it is two elements: a single one would have half of its mass at either end,
thrice its moment of inertia. They have its mass and moment of inertia, the rubber around it included, and are
stiffer than rubber; where a magnet meets rubber, the rubber's half of the bend gives.
"""

from dataclasses import dataclass

import numpy as np

from studies.error.magnets import PLACES_M, ROBOT
from studies.error.peers import cantilever
from studies.kit.passes import Floats

Indices = np.ndarray[tuple[int, ...], np.dtype[np.int64]]

END_SHARE = 1.0 / 48.0
"""Part of a magnet's mass at either of its ends. The rest is at its middle, and what the moment of inertia
then lacks is that of the elements: slow to turn, they allow a longer step than a bar's share, 1/6, would."""
SOFT = -1
"""In place of a magnet."""


@dataclass(frozen=True)
class Stiffening:
    """How much stiffer than the rubber the rod is made.

    Attributes:
        shear: All of it, against shear.
        magnet_bending: Magnets, at their middle.
        magnet_shear: Magnets, in addition to that of the rod.
        magnet_stretching: Magnets.
    """

    shear: float
    magnet_bending: float
    magnet_shear: float
    magnet_stretching: float


AS_IT_IS = Stiffening(shear=1.0, magnet_bending=50.0, magnet_shear=5.0, magnet_stretching=5.0)
"""Stiffer magnets would shorten the step, and the rod, which has no damper, then shivers on some meshes."""
HARDLY_SHEARS = Stiffening(shear=10.0, magnet_bending=100.0, magnet_shear=2.0, magnet_stretching=5.0)
"""Close to MagWorm's rod, which does not shear, for a step half as long."""


@dataclass(frozen=True)
class MagnetRod:
    """The rod along x, bending about its weak axis, z. Axes of tensors: z, −y, x.

    Attributes:
        nodes_m: Places of the nodes (N + 1,) [m]; the clamp, x = 0, is the middle of the first element.
        middles: Nodes at the middles of the magnets (M,).
        masses_kg: Of the nodes (N + 1,).
        inertias_kg_m2: Moments of inertia of the elements (3, N).
        shear_n: Stiffness against shear, twice, and stretching (3, N).
        bend_n_m2: Stiffness against bending, twice, and twist where two elements meet (3, N − 1).
    """

    nodes_m: Floats
    middles: Indices
    masses_kg: Floats
    inertias_kg_m2: Floats
    shear_n: Floats
    bend_n_m2: Floats


def magnet_rod(elements: int, stiffening: Stiffening) -> MagnetRod:
    """The rod with as many elements, about, as a rod without magnets."""
    lengths_m, magnets = mesh(elements)
    nodes_m = np.concatenate([[0.0], np.cumsum(lengths_m)]) - 0.5 * lengths_m[0]
    middles = np.array([np.flatnonzero(magnets == magnet)[1] for magnet in range(len(PLACES_M))])
    masses_kg, inertias_kg_m2 = inertia(lengths_m, magnets, middles)
    return MagnetRod(
        nodes_m, middles, masses_kg, inertias_kg_m2, *stiffness(lengths_m, magnets, middles, stiffening)
    )


def mesh(elements: int) -> tuple[Floats, Indices]:
    """Lengths of the elements [m], and which magnet each belongs to. Magnets end where elements do."""
    size_m, magnet_m = cantilever.half_cell_length_m(elements), ROBOT["magnet"]["length_m"]
    lengths_m: list[float] = []
    magnets: list[int] = []
    reached_m = 0.0
    for magnet, place_m in enumerate(PLACES_M):
        soft_m = place_m - 0.5 * magnet_m - reached_m
        if magnet == 0:
            # Half of the first element is inside the wall, as the peers hold its middle.
            count = round(soft_m / size_m + 0.5)
            lengths_m += [soft_m / (count - 0.5)] * count
        else:
            count = max(1, round(soft_m / size_m))
            lengths_m += [soft_m / count] * count
        magnets += [SOFT] * count
        lengths_m += [0.5 * magnet_m] * 2
        magnets += [magnet] * 2
        reached_m = place_m + 0.5 * magnet_m
    count = max(1, round((cantilever.LENGTH_M - reached_m) / size_m))
    lengths_m += [(cantilever.LENGTH_M - reached_m) / count] * count
    magnets += [SOFT] * count
    return np.array(lengths_m), np.array(magnets)


def magnet_inertia() -> tuple[float, Floats]:
    """Mass [kg] of a magnet with the rubber around it, and moments of inertia about z, y and x [kg·m²]."""
    magnet = ROBOT["magnet"]
    box_m = np.array([magnet["length_m"], magnet["height_m"], magnet["width_m"]])
    cell_m = np.array([magnet["length_m"], cantilever.THICKNESS_M, cantilever.WIDTH_M])
    magnet_kg = magnet["density_kg_m3"] * box_m.prod()
    around_kg = cantilever.DENSITY_KG_M3 * (cell_m.prod() - box_m.prod())

    def squares(size_m: Floats) -> Floats:
        return np.array(
            [size_m[[0, 1]] @ size_m[[0, 1]], size_m[[0, 2]] @ size_m[[0, 2]], size_m[1:] @ size_m[1:]]
        )

    # The rubber as a box of the same mass, as MagWorm has it.
    return magnet_kg + around_kg, (magnet_kg * squares(box_m) + around_kg * squares(cell_m)) / 12.0


def inertia(lengths_m: Floats, magnets: Indices, middles: Indices) -> tuple[Floats, Floats]:
    """Masses of the nodes [kg] and moments of inertia of the elements about z, y and x [kg·m²]."""
    rubber_kg = np.where(magnets == SOFT, cantilever.DENSITY_KG_M3 * cantilever.AREA_M2 * lengths_m, 0.0)
    masses_kg = 0.5 * (np.append(rubber_kg, 0.0) + np.append(0.0, rubber_kg))
    inertias_kg_m2 = cantilever.DENSITY_KG_M3 * cantilever.SECONDS_M4[:, None] * lengths_m
    magnet_kg, magnet_kg_m2 = magnet_inertia()
    arm_m = 0.5 * ROBOT["magnet"]["length_m"]
    in_ends_kg_m2 = 2.0 * END_SHARE * magnet_kg * arm_m**2 * np.array([1.0, 1.0, 0.0])
    for middle in middles:
        masses_kg[[middle - 1, middle + 1]] += END_SHARE * magnet_kg
        masses_kg[middle] += (1.0 - 2.0 * END_SHARE) * magnet_kg
        inertias_kg_m2[:, [middle - 1, middle]] = 0.5 * (magnet_kg_m2 - in_ends_kg_m2)[:, None]
    return masses_kg, inertias_kg_m2


def stiffness(
    lengths_m: Floats, magnets: Indices, middles: Indices, stiffening: Stiffening
) -> tuple[Floats, Floats]:
    """Against shear and stretching [N], and against bending and twist [N·m²]."""
    soft = magnets == SOFT
    sheared_n = cantilever.SHEAR_N * stiffening.shear * np.where(soft, 1.0, stiffening.magnet_shear)
    stretched_n = cantilever.STRETCH_N * np.where(soft, 1.0, stiffening.magnet_stretching)
    # A bend is over half of either element: as long as it is of rubber, that is how much it gives.
    halves_m = 0.5 * lengths_m
    gives_m = np.where(soft, halves_m, 0.0)
    bends_m = gives_m[1:] + gives_m[:-1]
    bends_m[middles - 1] = 0.5 * ROBOT["magnet"]["length_m"] / stiffening.magnet_bending
    factor = (halves_m[1:] + halves_m[:-1]) / bends_m
    return np.stack([sheared_n, sheared_n, stretched_n]), cantilever.RIGIDITIES_N_M2[:, None] * factor
