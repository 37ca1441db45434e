"""PyElastica with magpylib: a Cosserat rod with magnets, stepped by position Verlet.

Clamped as the rod without magnets is, and without a damper. With wrenches at every step almost all time is
magpylib's, so they are also computed more seldom, with a line through the last two between.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import elastica
import numpy as np

from studies.error.case import SAMPLE_S
from studies.error.magnets import DURATION_S, HIGH_M, LOW_M, PLACES_M, RISE_S
from studies.error.peers.elastica_rod import clamped, cosserat_rod
from studies.error.peers.magnet_rod import AS_IT_IS, HARDLY_SHEARS, Stiffening, magnet_rod, mesh
from studies.error.peers.magpylib_wrench import DriveMagnet, Extrapolated
from studies.error.peers.measure import Measured, Series, Track, finest, longest_step_s, timed
from studies.kit.passes import MM

INSTANTS = round(DURATION_S / SAMPLE_S)
SEARCHED = 10
"""Steps from one computation of the wrenches to the next while the longest step, the rod's, is looked for."""
SAME = 0.002
"""Part of the length that halving the step may change: where hardly stable, a rod still shivers visibly."""


@dataclass(frozen=True)
class Plan:
    """What is run of a rod.

    For each mesh a step hardly longer than it allows [s]; a finer mesh with such a step; and by steps from
    one computation of the wrenches to the next, on which meshes.
    """

    stiffening: Stiffening
    limits_s: Mapping[int, float]
    finest: tuple[int, float]
    every: Mapping[int, Sequence[int]]


PLANS = (
    Plan(
        AS_IT_IS,
        limits_s={18: 1.8e-4, 27: 1.8e-4, 54: 1.1e-4},
        finest=(81, 6e-5),
        every={1: (18,), 10: (18, 27, 54), 40: (18, 27, 54)},
    ),
    Plan(HARDLY_SHEARS, limits_s={18: 1.3e-4, 27: 1e-4}, finest=(54, 6e-5), every={20: (18, 27)}),
)


class Magnets(elastica.NoForces):  # type: ignore[misc]
    """The drive's wrenches: forces on the nodes at the middles of magnets, torques on their elements."""

    def __init__(self, middles: Any, every: int) -> None:
        super().__init__()
        self.middles = middles
        self.wrenches = Extrapolated(every, self.computed)
        self.drive_magnet = DriveMagnet()
        self.now = np.zeros((len(middles), 3))

    def computed(self, rod: Any, time_s: float) -> Any:
        """Wrenches (M, 3) at this moment."""
        down = (
            rod.director_collection[1, :, self.middles - 1] + rod.director_collection[1, :, self.middles]
        ).T
        angles = np.arctan2(down[0], -down[1])
        return self.drive_magnet.wrenches(drive_m(time_s), rod.position_collection[:, self.middles].T, angles)

    def apply_forces(self, system: Any, time: float = 0.0) -> None:
        """PyElastica calls this first."""
        self.now = self.wrenches(system, time)
        system.external_forces[:2, self.middles] += self.now[:, :2].T

    def apply_torques(self, system: Any, time: float = 0.0) -> None:
        """And this next; torques are about the elements' own axes, the first of which is z."""
        halves = 0.5 * self.now[:, 2]
        system.external_torques[0, self.middles - 1] += halves
        system.external_torques[0, self.middles] += halves


def series() -> list[Series]:
    """One for each rod and each number of steps between wrenches."""
    return [one for plan in PLANS for one in planned(plan)]


def planned(plan: Plan) -> list[Series]:
    """Those of one rod. The search for the longest step warms up."""
    searched = partial(released, plan.stiffening, SEARCHED)
    steps_s = {
        elements: longest_step_s(searched, elements, limit_s, INSTANTS, SAME)
        for elements, limit_s in plan.limits_s.items()
    }
    finest_mm = finest(searched, *plan.finest, INSTANTS)
    return [
        Series(
            words(plan.stiffening, every),
            [run_of(plan.stiffening, every, elements, steps_s[elements]) for elements in meshes],
            finest_mm,
        )
        for every, meshes in plan.every.items()
    ]


def run_of(stiffening: Stiffening, every: int, elements: int, step_s: float) -> Measured:
    """A run, with the number of elements that it has with magnets."""
    track_mm, wall_s = timed(partial(released, stiffening, every), elements, step_s)
    return Measured(len(mesh(elements)[0]), step_s, track_mm, wall_s)


def words(stiffening: Stiffening, every: int) -> str:
    """What is varied."""
    shear = f"shear × {stiffening.shear:g}, " if stiffening.shear != 1.0 else ""
    return f"{shear}wrench every {f'{every} steps' if every > 1 else 'step'}"


def drive_m(time_s: float) -> Any:
    """Place of the drive (3,) [m]."""
    risen = min(time_s / RISE_S, 1.0)
    return np.array([PLACES_M[-1], LOW_M + risen * (HIGH_M - LOW_M), 0.0])


def released(stiffening: Stiffening, every: int, elements: int, step_s: float) -> Callable[[], Track]:
    """The rod at rest, and what runs it."""
    shape = magnet_rod(elements, stiffening)
    rod = cosserat_rod(shape.nodes_m, shape.shear_n, shape.bend_n_m2, shape.inertias_kg_m2)
    rod.mass[:] = shape.masses_kg
    advance = clamped(rod, Magnets, shape.middles, every)
    steps = round(SAMPLE_S / step_s)

    def places_mm() -> Track:
        return np.asarray(MM * rod.position_collection[:2, shape.middles].T)

    def run() -> Track:
        time_s = 0.0
        track_mm = np.full((INSTANTS + 1, len(shape.middles), 2), np.nan)
        track_mm[0] = places_mm()
        for instant in range(INSTANTS):
            time_s = advance(time_s, step_s, steps)
            track_mm[instant + 1] = places_mm()
            if not np.isfinite(track_mm[instant + 1]).all():
                break
        return track_mm

    return run
