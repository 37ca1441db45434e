"""Colours of the views, red-green-blue from 0 to 255."""

from typing import TypeAlias

Colour: TypeAlias = tuple[int, int, int]

SKY_TOP: Colour = (255, 255, 255)
SKY_HORIZON: Colour = (243, 246, 250)
PLATE: Colour = (206, 217, 230)
BELOW_PLATE: Colour = (228, 233, 240)
GROUND_LINE: Colour = (70, 84, 104)
TICK: Colour = (112, 126, 146)
PLATE_ABOVE: Colour = (240, 244, 248)
GRID: Colour = (226, 232, 239)
GRID_LABELLED: Colour = (204, 213, 224)
DRIVE_BELOW: Colour = (232, 190, 192)
GOAL: Colour = (222, 140, 20)
TEXT: Colour = (38, 48, 64)

RUBBER_EDGE: Colour = (176, 122, 96)
RUBBER: Colour = (236, 190, 160)
RUBBER_LIGHT: Colour = (250, 222, 202)
EYE: Colour = (60, 40, 32)

NORTH: Colour = (208, 52, 56)
SOUTH: Colour = (46, 92, 184)
MAGNET_EDGE: Colour = (40, 42, 54)
REMOVED_EDGE: Colour = (128, 92, 76)
LETTER: Colour = (255, 255, 255)

TRAIL_OLD: Colour = (200, 220, 222)
TRAIL_NEW: Colour = (28, 140, 122)


def mix(first: Colour, second: Colour, share: float) -> Colour:
    """Blends two colours.

    Args:
        first: Colour at ``share`` 0.
        second: Colour at ``share`` 1.
        share: Part of the second colour, 0 to 1.

    Returns:
        The blended colour.
    """
    red, green, blue = (
        int(one * (1.0 - share) + other * share + 0.5) for one, other in zip(first, second, strict=True)
    )
    return red, green, blue
