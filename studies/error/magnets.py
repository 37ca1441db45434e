"""A cantilever with magnets over a drive magnet that rises: a case for other codes of rods and magnets.

Nothing touches, nothing damps and the magnets of the rod do not act on each other, so that their models agree
with this one but for shear.
"""

from magworm_gym import Scene

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
DURATION_S = 1.0


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
