"""How far drive magnets are from body magnets, and what could be left out there within a bound of the error.

A magnetised body is a distribution of dipoles, and two dipoles m₁, m₂ at a distance r exert at most 3 μ₀ m₁
m₂/(2π r⁴) on each other. Where two bodies are nowhere nearer than d, no pair of their dipoles is, so the
force on the whole is within 3 μ₀ m₁ m₂/(2π d⁴), with m = Br V/μ₀ the moments of the whole magnets; no other
factor is needed.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Batch, Scene
from studies.kit.passes import values_of

MU_0 = 4e-7 * np.pi
LANES = 8
ROBOTS = 64
CONTROL_STEPS = 400
HOLD = 4
"""Control steps for which a random action is held."""
TOLERANCES = (1e-6, 1e-4, 1e-3)
"""Force that may be left out, relative to the robot's weight."""


@dataclass(frozen=True)
class Magnets:
    """Length, width, height [m] and remanence [T] of body and drive magnets; the robot's weight [N]."""

    body_m: tuple[float, ...]
    drive_m: tuple[float, ...]
    remanence_t: tuple[float, float]
    weight_n: float

    @property
    def half_diagonals_m(self) -> float:
        """Sum of both half diagonals."""
        return 0.5 * float(np.linalg.norm(self.body_m) + np.linalg.norm(self.drive_m))

    def force_bound_n(self, nearest_m: float) -> float:
        """Bound of the force where no points of both are nearer than so."""
        volumes = np.prod(self.body_m) * np.prod(self.drive_m)
        moments = self.remanence_t[0] * self.remanence_t[1] * float(volumes) / MU_0**2
        return float(3.0 * MU_0 * moments / (2.0 * np.pi * nearest_m**4))

    def out_of_reach_m(self, tolerance: float) -> float:
        """Distance of centres beyond which the force is below so much of the weight."""
        scale = self.force_bound_n(1.0) / (tolerance * self.weight_n)
        return float(scale**0.25) + self.half_diagonals_m


def magnets(scene: Scene) -> Magnets:
    """Magnets of a scene."""
    values = values_of(scene)
    magnet, drive = values["magnet"], values["drive"]
    body, driving = (
        tuple(part[f"{side}_m"] for side in ("length", "width", "height")) for part in (magnet, drive)
    )
    nodes = Batch(scene, 1).node_positions()[0]
    lengths = np.linalg.norm(np.diff(nodes, axis=0), axis=-1)
    geometry = scene.geometry
    rubber = lengths @ np.multiply(geometry["element_thickness_m"], geometry["element_width_m"])
    mass = values["material"]["density_kg_m3"] * rubber
    mass += scene.magnets * magnet["density_kg_m3"] * np.prod(body)
    return Magnets(body, driving, (magnet["remanence_t"], drive["remanence_t"]), float(mass * 9.81))


def distances_m(scene: Scene) -> NDArray[np.float64]:
    """Distances of centres under random actions (control steps, robots, body magnets, drive magnets) [m]."""
    axes = scene.dimensions
    batch = Batch(scene, ROBOTS)
    batch.reset(np.ones(ROBOTS, bool), np.arange(ROBOTS, dtype=np.uint64), np.zeros(ROBOTS, np.uint64))
    draws = np.random.default_rng(1)
    size = sum(part.size for part in batch.action_specification)
    actions = np.zeros((ROBOTS, size))
    found = []
    for step in range(CONTROL_STEPS):
        if step % HOLD == 0:
            actions = draws.uniform(-1.0, 1.0, (ROBOTS, size))
        batch.step(actions)
        bodies, drives = batch.magnet_poses()[..., :axes], batch.drive_positions()[..., :axes]
        found.append(np.linalg.norm(bodies[:, :, None] - drives[:, None], axis=-1))
    return np.asarray(found)


def shares_beyond(distance_m: NDArray[np.float64], limit_m: float) -> tuple[float, float]:
    """Share of wrenches beyond a distance, and of wrenches of eight lanes that all are."""
    beyond = distance_m > limit_m
    blocks = beyond.reshape(len(beyond), -1, LANES, *beyond.shape[2:]).all(axis=2)
    return float(beyond.mean()), float(blocks.mean())


@dataclass(frozen=True)
class Beyond:
    """Distance of centres beyond which the force is below a tolerance, in weights of the robot.

    And the shares of wrenches, and of blocks of eight lanes, that are beyond it.
    """

    tolerance: float
    limit_m: float
    wrenches: float
    blocks: float


@dataclass(frozen=True)
class Reach:
    """Distances of a scene in use.

    Attributes:
        scene: Its name.
        wrenches: Distances seen.
        nearest_m, farthest_m: The least and the greatest [m].
        beyond: By tolerance.
        order_1_m: Where order 1 has the error that order 2 has at the nearest height [m].
        order_1_blocks: Share of blocks of eight lanes beyond.
    """

    scene: str
    wrenches: int
    nearest_m: float
    farthest_m: float
    beyond: list[Beyond]
    order_1_m: float
    order_1_blocks: float


def reach(name: str, scene: Scene, order_1_m: float) -> Reach:
    """Looks at a scene under random actions."""
    pair, distance_m = magnets(scene), distances_m(scene)
    limits = {tolerance: pair.out_of_reach_m(tolerance) for tolerance in TOLERANCES}
    return Reach(
        scene=name,
        wrenches=distance_m.size,
        nearest_m=float(distance_m.min()),
        farthest_m=float(distance_m.max()),
        beyond=[
            Beyond(tolerance, limit_m, *shares_beyond(distance_m, limit_m))
            for tolerance, limit_m in limits.items()
        ],
        order_1_m=order_1_m,
        order_1_blocks=shares_beyond(distance_m, order_1_m)[1],
    )
