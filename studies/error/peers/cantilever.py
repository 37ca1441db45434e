"""The case: an undamped heavy cantilever, released from the horizontal and watched for a second.

That of the preset `cantilever` without its damping. It bends about its weak axis; x points along it, y up.
"""

import math

import numpy as np

from studies.kit.passes import Floats

LENGTH_M = 0.054
WIDTH_M = 0.010
THICKNESS_M = 0.004
YOUNGS_MODULUS_PA = 100e3
SHEAR_MODULUS_PA = YOUNGS_MODULUS_PA / 3.0
"""Of rubber, which keeps its volume."""
DENSITY_KG_M3 = 1070.0
GRAVITY_M_S2 = 9.81
DURATION_S = 1.0

TIP_MM = (52.708, -11.759)
"""Tip after a second: an extensible Kirchhoff rod, by an independent discretisation."""

AREA_M2 = WIDTH_M * THICKNESS_M
WEAK_M4 = WIDTH_M * THICKNESS_M**3 / 12.0
STRONG_M4 = THICKNESS_M * WIDTH_M**3 / 12.0
SECONDS_M4 = np.array([WEAK_M4, STRONG_M4, WEAK_M4 + STRONG_M4])
"""Second moments of the section about z, y and x."""
RIGIDITIES_N_M2 = SECONDS_M4 * np.array([YOUNGS_MODULUS_PA, YOUNGS_MODULUS_PA, SHEAR_MODULUS_PA])
"""Stiffness against bending about z and y, and twist."""
SHEAR_FACTOR = 5.0 / 6.0
"""Of a rectangle."""
SHEAR_N, STRETCH_N = SHEAR_FACTOR * SHEAR_MODULUS_PA * AREA_M2, YOUNGS_MODULUS_PA * AREA_M2
"""Stiffness against shear and stretching."""
SOUND_M_S = math.sqrt(YOUNGS_MODULUS_PA / DENSITY_KG_M3)
"""Speed of a wave along the rod."""


def half_cell_length_m(elements: int) -> float:
    """Length of an element where the first is centred on the clamp, half of it inside the wall [m].

    Both peers hold the direction of a whole element, which is right at its centre. Were its end at the wall,
    the rod would be half an element too short to bend.
    """
    return LENGTH_M / (elements - 0.5)


def tip_only(x_mm: float, y_mm: float) -> Floats:
    """A tip after a second as a track of one instant and one point (1, 1, 2) [mm]."""
    return np.array([[[x_mm, y_mm]]])
