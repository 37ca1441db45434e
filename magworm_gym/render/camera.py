"""The camera: from metres in the world to pixels of a frame."""

import math

import numpy as np
from numpy.typing import NDArray

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
        self.height = height
        self._fixed = centre_m is not None
        self._centre_m = math.nan if centre_m is None else centre_m
        self._horizon_px = horizon * height

    @property
    def centre_m(self) -> float:
        """World x [m] in the middle of the frame."""
        return self._centre_m

    @property
    def ground_px(self) -> float:
        """Row of y = 0 [pixels]."""
        return self._horizon_px

    def follow(self, x_m: float) -> None:
        """Moves a part of the way towards the robot.

        A robot that is out of sight (first frame, new episode) is centred at once.

        Args:
            x_m: World x of the robot [m]; ignored when it is not finite.
        """
        if self._fixed or not math.isfinite(x_m):
            return
        distance = x_m - self._centre_m
        seen = abs(distance) * self.pixels_per_m < 0.5 * self.width
        self._centre_m = self._centre_m + FOLLOWED_SHARE * distance if seen else x_m

    def columns(self, x_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Columns [pixels] of world x [m], same shape."""
        return (x_m - self._centre_m) * self.pixels_per_m + 0.5 * self.width

    def pixels(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Pixels (…, 2), column and row from the top left, of world points (…, 2) [m]."""
        pixels = np.array(points_m, dtype=np.float64)
        pixels -= (self._centre_m, 0.0)
        pixels *= (self.pixels_per_m, -self.pixels_per_m)
        pixels += (0.5 * self.width, self._horizon_px)
        return pixels

    def visible_x_m(self) -> tuple[float, float]:
        """World x [m] of the left and the right edge."""
        half = 0.5 * self.width / self.pixels_per_m
        return self._centre_m - half, self._centre_m + half
