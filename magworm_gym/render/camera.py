"""The camera: from metres in the world to pixels of a frame."""

import math

import numpy as np

from magworm_gym.recording import Floats

# Time does not reach the camera, so smoothing is a share of the way per frame.
FOLLOWED_SHARE = 0.12


class Camera:
    """Looks along -z, x to the right and y up, and follows the robot along x.

    Args:
        width: Width of the frame [pixels].
        height: Height of the frame [pixels].
        span_m: Width of the visible world [m].
        horizon: Height of y = 0 in the frame, as a share measured from the top.
        centre_m: World x [m] kept in the middle; None follows the robot.
    """

    def __init__(
        self, width: int, height: int, span_m: float, *, horizon: float, centre_m: float | None = None
    ) -> None:
        self.pixels_per_m = width / span_m
        self.width = width
        self.ground_px = horizon * height
        """Row of y = 0."""
        self.centre_m = math.nan if centre_m is None else centre_m
        """World x in the middle of the frame."""
        self._fixed = centre_m is not None

    def follow(self, x_m: float) -> None:
        """Moves a part of the way towards the robot.

        A robot that is out of sight (first frame, new episode) is centred at once.

        Args:
            x_m: World x of the robot [m]; ignored when it is not finite.
        """
        if self._fixed or not math.isfinite(x_m):
            return
        distance = x_m - self.centre_m
        seen = abs(distance) * self.pixels_per_m < 0.5 * self.width
        self.centre_m = self.centre_m + FOLLOWED_SHARE * distance if seen else x_m

    def column(self, x_m: float) -> float:
        """Column [pixels] of world x [m]."""
        return (x_m - self.centre_m) * self.pixels_per_m + 0.5 * self.width

    def pixels(self, points_m: Floats) -> Floats:
        """Pixels (…, 2), column and row from the top left, of world points (…, 2) [m]."""
        scale, middle = (self.pixels_per_m, -self.pixels_per_m), (0.5 * self.width, self.ground_px)
        return np.asarray((points_m - np.array([self.centre_m, 0.0])) * scale + middle)

    def visible_x_m(self) -> tuple[float, float]:
        """World x [m] of the left and the right edge."""
        half = 0.5 * self.width / self.pixels_per_m
        return self.centre_m - half, self.centre_m + half
