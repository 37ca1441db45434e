"""From pixels of a film to metres of the scene."""

from typing import Annotated, Literal

import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from magworm_gym.documents import Number, Table
from magworm_gym.recording import Floats

START_SPAN_S = 0.1
"""Time at the beginning of a recording whose frames ``origin = "start"`` looks at [s]."""


class Camera(Table, frozen=True):
    """A camera that looks at the robot's side, its image plane parallel to the robot.

    Attributes:
        metres_per_pixel: Scale in the robot's plane [m/px].
        frames_per_second: Frame rate [1/s].
        head: Side of the image to which the head points: ``"left"`` or ``"right"``.
        y_axis: Direction of growing y of the pixels: ``"down"`` or ``"up"``.
        angle_deg: Angle by which the line of the ground rises to the right in the image [°].
        start_s: Time in the film at which the experiment begins; frame 0 is at 0 [s].
        origin: Where the scene's origin is: a pixel (x, y), or unknown. ``"whole"``: the offset that
            makes model and tracks agree best over all frames; ``"start"``: over the first 0.1 s.
    """

    metres_per_pixel: Annotated[float, Meta(ge=1e-9, le=1.0)]
    frames_per_second: Annotated[float, Meta(ge=1e-3, le=1e6)]
    head: Literal["left", "right"] = "left"
    y_axis: Literal["down", "up"] = "down"
    angle_deg: Annotated[float, Meta(ge=-180.0, le=180.0)] = 0.0
    start_s: Number = 0.0
    origin: Annotated[
        Literal["whole", "start"] | tuple[float, float], Meta(description='"whole", "start" or [x_px, y_px]')
    ] = "whole"

    def time_s(self, frames: NDArray[np.int64]) -> Floats:
        """Times of frames (F,) since the experiment began [s]."""
        return np.asarray(frames / self.frames_per_second - self.start_s)

    def points_m(self, pixels: Floats) -> Floats:
        """Places in the axes of the scene (…, 2) [m]; up to an offset where the origin is unknown.

        Args:
            pixels: Places in the image (…, 2) [px].
        """
        if not isinstance(self.origin, str):
            pixels = pixels - np.array(self.origin)
        x, y = pixels[..., 0], pixels[..., 1] * (-1.0 if self.y_axis == "down" else 1.0)
        angle = np.radians(self.angle_deg)
        along, up = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
        mirror = 1.0 if self.head == "left" else -1.0
        return np.asarray(self.metres_per_pixel * np.stack([mirror * along, up], axis=-1))

    def pixels(self, points_m: Floats, origin_px: tuple[float, float]) -> Floats:
        """The inverse of ``points_m``: pixels (…, 2) of places in the scene (…, 2) [m].

        Args:
            points_m: Places in the scene (…, 2) [m].
            origin_px: Pixel of the scene's origin.
        """
        along = points_m[..., 0] * (1.0 if self.head == "left" else -1.0)
        angle, up = np.radians(self.angle_deg), points_m[..., 1]
        x, y = along * np.cos(angle) - up * np.sin(angle), along * np.sin(angle) + up * np.cos(angle)
        y = -y if self.y_axis == "down" else y
        return np.asarray(np.stack([x, y], axis=-1) / self.metres_per_pixel + np.array(origin_px))

    def offset_m(self, time_s: Floats, deviation_m: Floats) -> Floats:
        """Offset of the tracks (2,) [m], to be added to them; a median, so outliers do not count.

        Args:
            time_s: Times of the points (N,) [s].
            deviation_m: Model minus track (N, 2) [m].
        """
        if not isinstance(self.origin, str):
            return np.zeros(2)
        if self.origin == "start":
            deviation_m = deviation_m[time_s <= time_s.min() + START_SPAN_S]
        return np.asarray(np.median(deviation_m, axis=0))
