"""A cantilever with magnets over a drive magnet that rises: a case for other codes of rods and magnets.

Nothing touches, nothing damps and the magnets of the rod do not act on each other, so that their models agree
with this one but for shear.
"""

from collections.abc import Sequence

import numpy as np

from magworm_gym import Recording, Scene
from studies.error.case import Axis, Case, Outcome
from studies.error.settings import Settings
from studies.kit.passes import MM

REMANENCE_T = 1.22
ROBOT = {
    "magnet": {
        "length_m": 0.006303,
        "width_m": 0.007455,
        "height_m": 0.001628,
        "remanence_t": REMANENCE_T,
        "density_kg_m3": 7500.0,
    },
    "drive": {"length_m": 0.0149, "width_m": 0.02618, "height_m": 0.004033, "remanence_t": REMANENCE_T},
}
"""Body and drive magnets much like the robot's; ours, as other codes have them, whatever a preset's are."""
PLACES_M = (0.027, 0.047)
"""Of the magnets along the rod: the robot's pitch apart, the last as far from the end as in its foot."""
POLARITIES = (1, -1)
"""Alternating, as in the robot; the tip is repelled, and so kept from snapping to the drive."""
LOW_M, HIGH_M, RISE_S = -0.062, -0.032, 0.5
"""Heights of the drive's centre [m] and for how long it rises [s]; then it stands."""
DURATION_S, SAMPLE_S = 1.0, 0.02

STEPS_MS = (4.0, 2.0, 1.0, 0.5, 0.2, 0.1)
MESHES = (9, 18, 27, 54)
ORDERS = (0, 1, 2, 3)
REFERENCE = Settings(0.02, 216, 4)


def scene() -> Scene:
    """The preset `cantilever` without gravity and damping, with two of the robot's magnets over its drive."""
    under_tip = [PLACES_M[-1]] * 2
    rise = {"kind": "waypoints", "time_s": [0.0, RISE_S], "x_m": under_tip, "y_m": [LOW_M, HIGH_M]}
    magnets = [
        {"position_m": place_m, "polarity": polarity}
        for place_m, polarity in zip(PLACES_M, POLARITIES, strict=True)
    ]
    return Scene.preset("cantilever").with_values(
        {
            "gravity_m_s2": 0.0,
            "material.damping_time_s": 0.0,
            "body.magnets": magnets,
            "magnet": ROBOT["magnet"],
            "drive": {**ROBOT["drive"], "motion": rise},
            "magnetic_terms.mutual": False,
        }
    )


def magnets() -> Case:
    """The case."""
    return Case(
        name="magnets",
        title="An undamped cantilever with magnets",
        body="rod",
        scenes=[scene()],
        duration_s=DURATION_S,
        sample_s=SAMPLE_S,
        read=read_magnets,
        axes=(
            Axis("step", [Settings(step, 54) for step in STEPS_MS], Settings(0.02, 54)),
            Axis("step", [Settings(step, 54, integrator="euler") for step in STEPS_MS], Settings(0.02, 54)),
            Axis("elements", [Settings(0.05, mesh) for mesh in (*MESHES, 108)], Settings(0.05, 216)),
            Axis("order", [Settings(1.0, 54, order) for order in ORDERS], Settings(1.0, 54, 6)),
        ),
        ranked="pose",
        front=[Settings(step, mesh) for mesh in MESHES for step in STEPS_MS],
        reference=REFERENCE,
        check=Settings(0.04, 108, 3),
    )


def read_magnets(records: Sequence[Recording]) -> Outcome:
    """Height of the tip's magnet at the end [mm], and places of both."""
    places = np.stack([record.magnet_poses[..., :2] for record in records])
    return Outcome({"height": MM * places[:, -1, -1, 1]}, places)
