"""Energy of undamped rods that nothing drives: it must not grow.

Velocities stand half a step before positions, so what is watched is the kinetic energy of the way of a step
and the mean of the stored energies at both its ends.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, SceneError, record_scenes
from studies.stability.axes import Changes
from studies.stability.cases import INTEGRATORS

Floats = NDArray[np.float64]

GRAVITY_M_S2 = 9.81
WIDTH_M, THICKNESS_M, DENSITY_KG_M3 = 0.010, 0.004, 1070.0
"""Of the preset ``cantilever``."""
STEPS_MS = (0.01, 0.05, 0.2, 1, 2, 5, 10, 50)
STIFFNESSES_PA = (1e3, 1e5, 1e7, 1e10)
ELEMENTS = 10
MOST_STEPS = 20_000
DURATION_S = 0.5
FREE: Changes = {"body.clamp": "none", "ground": {"static_friction": 0.8, "dynamic_friction": 0.6}}

CLAMPED = "let go from the horizontal"
MOTIONS: Mapping[str, Changes] = {
    CLAMPED: {"body.clamp": "head"},
    "dropped on its end": FREE | {"start.angle_deg": 60.0, "start.height_m": 0.05},
}
BAND = 0.02
"""Ours: most that kinetic energy and height may exceed the energy at the start, over weight times length."""


@dataclass(frozen=True)
class Swing:
    """An undamped rod. Its energies are not numbers where the scene is refused."""

    motion: str  # a key of MOTIONS
    integrator: str  # which scheme
    stiffness_pa: float  # Young's modulus [Pa]
    step_ms: float  # step [ms]
    gain: float = np.nan  # most that the energy exceeded its start, over weight times length
    visible: float = np.nan  # the same of kinetic energy and height alone, without what springs hold
    lost: float = np.nan  # energy at the start less that at the end, over weight times length
    broken: str | None = None  # why it broke down; none where it did not

    def scene(self) -> Scene:
        """The scene.

        Raises:
            SceneError: A scene that cannot be simulated.
        """
        step_s = self.step_ms / 1e3
        changes = {
            "body.elements": ELEMENTS,
            "material.damping_time_s": 0.0,
            "material.youngs_modulus_pa": self.stiffness_pa,
            "solver.integrator": self.integrator,
            **dict.fromkeys(("solver.step_s", "control.step_s", "control.episode_s"), step_s),
        }
        return Scene.preset("cantilever").with_values(changes | MOTIONS[self.motion])

    @property
    def duration_s(self) -> float:
        """For how long it is watched [s]."""
        step_s = self.step_ms / 1e3
        return step_s * min(MOST_STEPS, round(DURATION_S / step_s))


def swings() -> list[Swing]:
    """All of them, each with what became of its energy.

    Raises:
        RuntimeError: Energy that can be seen grew beyond the band.
    """
    every = product(MOTIONS, INTEGRATORS, STIFFNESSES_PA, STEPS_MS)
    found = [measured(Swing(*each)) for each in every]
    for swing in found:
        if swing.visible > BAND:
            raise RuntimeError(f"energy grew without work done: {swing}")
    return found


def measured(swing: Swing) -> Swing:
    """A swing with what became of its energy; as it is where its scene is refused.

    Raises:
        RuntimeError: An energy that is not finite.
    """
    try:
        scene = swing.scene()
    except SceneError:
        return swing
    record = record_scenes([scene], swing.duration_s, swing.step_ms / 1e3)[0]
    visible_j, elastic_j, unit_j = energies_j(record, swing)
    energy_j = visible_j + elastic_j
    if not np.isfinite(energy_j).all():
        raise RuntimeError(f"an energy that is not finite: {swing}")
    return replace(
        swing,
        gain=float((energy_j - energy_j[0]).max() / unit_j),
        visible=float((visible_j - energy_j[0]).max() / unit_j),
        lost=float((energy_j[0] - energy_j[-1]) / unit_j),
        broken=record.broken,
    )


def energies_j(record: Recording, swing: Swing) -> tuple[Floats, Floats, float]:
    """Energy of motion and height, and of springs, within each step (T − 1,), and weight times length [J].

    The discrete rod's own (Bergou 2008), written down here from the places of the nodes.
    """
    nodes, step_s = record.nodes, swing.step_ms / 1e3
    edges = np.diff(nodes, axis=1)
    lengths = np.linalg.norm(edges, axis=-1)
    rest_m = lengths[0]
    halves = 0.5 * DENSITY_KG_M3 * WIDTH_M * THICKNESS_M * rest_m
    masses = np.append(halves, 0.0) + np.append(0.0, halves)
    if swing.motion == CLAMPED:
        masses[:2] = 0.0
    turns = np.diff(np.unwrap(np.arctan2(edges[..., 1], edges[..., 0]), axis=1), axis=1)
    axial = swing.stiffness_pa * WIDTH_M * THICKNESS_M / rest_m
    bending = swing.stiffness_pa * WIDTH_M * THICKNESS_M**3 / 12.0 / rest_m.mean()
    elastic = 0.5 * ((lengths - rest_m) ** 2 @ axial) + 0.5 * bending * (turns**2).sum(axis=1)
    height = GRAVITY_M_S2 * (nodes[..., 1] @ masses)
    moving = 0.5 * ((np.diff(nodes, axis=0) / step_s) ** 2).sum(axis=-1) @ masses
    unit_j = float(GRAVITY_M_S2 * masses.sum() * rest_m.sum())
    return moving + _between(height), _between(elastic), unit_j


def _between(values: Floats) -> Floats:
    return np.asarray(0.5 * (values[1:] + values[:-1]))
