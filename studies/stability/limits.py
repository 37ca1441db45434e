"""The largest stable step of the explicit scheme: predicted, and found by bisection.

A scene with a longer step is refused. So the rods here are written a thousand times too soft, and stiffened
by the environment's own factor, which no rule looks at.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import msgspec
import numpy as np

from magworm_gym import Scene, SceneError
from magworm_gym._magworm import Batch
from studies.kit.passes import values_of
from studies.stability.axes import Changes

SOFTER = 1e3
STEPS = 4000
"""Steps of a run: a step longer by 1 % makes a motion grow by 2 % or more at each."""
GRAVITY_M_S2 = 1e-3
"""Ours: sets rods in motion, and bends none visibly."""
STRAYED = 0.02
"""Ours: a node further from its place at rest, over the length, tells an unstable step; no weight moves one
as far."""
CLOSE = 1e-3
"""Relative width of the bracket at which bisection ends."""

RODS = msgspec.toml.decode((Path(__file__).parent / "rods.toml").read_bytes(), type=dict[str, Changes])


@dataclass(frozen=True)
class Limit:
    """A rod's largest stable step."""

    name: str  # which rod
    dimensions: int  # 2 or 3
    predicted_s: float  # what the simulator says [s]
    found_s: float  # what bisection found [s]
    reason: str  # what limits it, in the simulator's words


def limits(names: Sequence[str] = tuple(RODS)) -> list[Limit]:
    """Bisects the largest stable step of rods in the plane and in space."""
    found = []
    for name, dimensions in product(names, (2, 3)):
        scene = rod(name, dimensions)
        predicted_s, reason = scene.explicit_limit()
        found.append(Limit(name, dimensions, predicted_s, _bisected(scene, predicted_s), reason))
    return found


def rod(name: str, dimensions: int) -> Scene:
    """One of RODS."""
    plain = {"body.elements": 10, "material.damping_time_s": 0.0, "gravity_m_s2": GRAVITY_M_S2}
    turned = {"start.yaw_deg": 30.0} if dimensions == 3 else {}
    return Scene.preset("cantilever").with_values(plain | turned | RODS[name] | {"dimensions": dimensions})


def _bisected(scene: Scene, predicted_s: float) -> float:
    low_s, high_s = 0.5 * predicted_s, 2.0 * predicted_s
    if not stays(scene, low_s) or stays(scene, high_s):
        raise RuntimeError(f"no limit between {low_s} s and {high_s} s")
    while high_s - low_s > CLOSE * low_s:
        middle_s = 0.5 * (low_s + high_s)
        low_s, high_s = (middle_s, high_s) if stays(scene, middle_s) else (low_s, middle_s)
    return low_s


def stays(scene: Scene, step_s: float) -> bool:
    """Whether a rod stays near its rest with a step of the explicit scheme.

    Args:
        scene: A clamped rod.
        step_s: The step [s], longer than the limit if need be.
    """
    changes = {
        "solver.integrator": "explicit",
        **dict.fromkeys(("solver.step_s", "control.step_s", "control.episode_s"), step_s),
        "material.youngs_modulus_pa": values_of(scene)["material"]["youngs_modulus_pa"] / SOFTER,
    }
    batch = Batch(scene.with_values(changes), 1, lanes="scalar", threads=1)
    batch.set_parameter("stiffness", np.array([SOFTER]))
    batch.reset(np.array([True]), np.array([0], np.uint64), np.array([0], np.uint64))
    rest = batch.node_positions()
    batch.advance(STEPS * step_s)
    strayed_m = np.linalg.norm(batch.node_positions() - rest, axis=-1).max()
    return bool(batch.status()[0] == 0 and strayed_m < STRAYED * scene.body_length_m)


def refusal() -> str:
    """What a scene whose step is too long is told."""
    try:
        rod("τ = 0.1 s", 2).with_values({"solver.integrator": "explicit"})
    except SceneError as error:
        return str(error)
    raise RuntimeError("a step beyond the limit was not refused")
