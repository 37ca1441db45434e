"""What stands still behind the robot: sky, plate, ground line and ticks."""

import math

import numpy as np
from PIL import Image

from magworm_gym.render.camera import Camera
from magworm_gym.render.canvas import Canvas
from magworm_gym.render.palette import BELOW_PLATE, GROUND_LINE, PLATE, SKY_HORIZON, SKY_TOP, TICK, mix

PLATE_M = 0.004
LABELLED_CM = (1, 2, 5, 10, 20, 50)
LABEL_SPACING_PX = 60.0
TICK_SPACING_PX = 8.0


def background(camera: Camera, height: int, *, ground: bool) -> Image.Image:
    """Draws what no camera movement along x changes.

    Args:
        camera: Gives width and horizon.
        height: Height of the frame [pixels].
        ground: Whether the scene has a ground.

    Returns:
        An image (H, W, 3).
    """
    horizon = camera.ground_px
    plate_end = horizon + max(3.0, PLATE_M * camera.pixels_per_m)
    rows = np.arange(height)
    share = np.clip(rows / max(horizon, 1.0), 0.0, 1.0)[:, None]
    colours = (1.0 - share) * np.array(SKY_TOP) + share * np.array(SKY_HORIZON)
    if ground:
        colours[rows >= horizon] = PLATE
        colours[rows >= plate_end] = BELOW_PLATE
        colours[int(horizon)] = GROUND_LINE
    pixels = np.repeat(colours[:, None], camera.width, axis=1)
    return Image.fromarray(np.round(pixels).astype(np.uint8))


def draw_ticks(canvas: Canvas, camera: Camera) -> None:
    """Marks every centimetre of the ground, and labels some, in world coordinates.

    Args:
        canvas: Frame to draw on.
        camera: Tells which part of the ground is visible.
    """
    per_cm = 0.01 * camera.pixels_per_m
    labelled = next((cm for cm in LABELLED_CM if cm * per_cm >= LABEL_SPACING_PX), LABELLED_CM[-1])
    ticked = next((cm for cm in LABELLED_CM if cm * per_cm >= TICK_SPACING_PX), labelled)
    low_m, high_m = camera.visible_x_m()
    first = math.ceil(100.0 * low_m / ticked) * ticked
    top = camera.ground_px
    for centimetre in range(first, math.floor(100.0 * high_m) + 1, ticked):
        column = camera.column(0.01 * centimetre)
        tall = centimetre % labelled == 0
        _tick(canvas, column, top, 9.0 if tall else 5.0)
        if tall:
            canvas.text((column, top + 11.0), label(centimetre), canvas.text_px, TICK, "mt")


def label(centimetre: int) -> str:
    """What is written at a tick."""
    return f"{centimetre} cm" if centimetre else "0"


def _tick(canvas: Canvas, column: float, top: float, length: float) -> None:
    """Shares a one pixel wide line between two columns, so that it glides with the camera."""
    left = math.floor(column)
    share = column - left
    for offset, weight in ((0, 1.0 - share), (1, share)):
        place = left + offset
        colour = mix(PLATE, GROUND_LINE, 0.85 * weight)
        canvas.box(place, top + 1.0, place, top + length, colour)
