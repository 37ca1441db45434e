"""The view from above of one environment in space."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from magworm_gym.render.camera import FOLLOWED_SHARE
from magworm_gym.render.canvas import Canvas, Region
from magworm_gym.render.outline import band, half
from magworm_gym.render.palette import (
    DRIVE_BELOW,
    EYE,
    GOAL,
    GRID,
    GRID_LABELLED,
    MAGNET_EDGE,
    NORTH,
    PLATE_ABOVE,
    REMOVED_EDGE,
    RUBBER,
    RUBBER_EDGE,
    RUBBER_LIGHT,
    SOUTH,
    TEXT,
    TICK,
    mix,
)
from magworm_gym.render.side_view import SPAN_BODY_LENGTHS, TRAIL_POINTS, draw_trail

if TYPE_CHECKING:
    from magworm_gym.tasks import Goal

Floats = NDArray[np.float64]

LABELLED_CM = 5


class TopView:
    """Draws frames of one environment seen along -y: x to the right, z down.

    The scale is taken from the first frame, 3.4 body lengths along the longer side; the camera follows the
    robot smoothly over a grid of centimetres. A magnet has the colour of the pole that points up: red
    north, blue south; a removed one is an empty outline. The drive, below the ground, is pale.

    Args:
        geometry: ``Scene.geometry`` of a scene in space.
        width: Width of a frame [pixels].
        height: Height of a frame [pixels].
    """

    def __init__(self, geometry: dict[str, Any], width: int, height: int) -> None:
        self.width = width
        self.height = height
        self._width = np.asarray(geometry["element_width_m"], dtype=np.float64)
        self._thickness = float(np.mean(geometry["element_thickness_m"]))
        self._magnet_size = np.asarray(geometry["magnet_size_m"], dtype=np.float64)[:, [0, 2]]
        self._magnet_direction = np.asarray(geometry["magnet_direction"], dtype=np.float64)
        self._magnet_offset = np.asarray(geometry["magnet_offset_m"], dtype=np.float64)
        self._drive_size = np.array([geometry["drive_size_m"][0], geometry["drive_width_m"]])
        self._background = Image.new("RGB", (width, height), PLATE_ABOVE)
        self._pixels_per_m = 0.0
        self._centre = np.zeros(2)

    def draw(
        self,
        nodes: Floats,
        magnet_poses: Floats,
        present: NDArray[np.bool_],
        drive_positions: Floats,
        trail: Floats,
        text: str | None = None,
        goal: Goal | None = None,
    ) -> NDArray[np.uint8]:
        """Draws one frame; arguments as of ``SpaceView.draw``."""
        canvas = Canvas(self._background)
        line = nodes[:, [0, 2]]
        if np.all(np.isfinite(line)):
            self._follow(line)
            self._draw_grid(canvas)
            path = self._pixels(np.reshape(trail, (-1, 3))[-TRAIL_POINTS:][:, [0, 2]])
            with canvas.region() as region:
                for x, _, z, yaw in drive_positions.tolist():
                    self._draw_drive(region, np.array([x, z]), yaw)
                if goal is not None:
                    self._draw_goal(region, goal, line)
                draw_trail(region, path)
                self._draw_robot(region, line, magnet_poses, present)
        size = float(np.clip(0.04 * self.height, 13.0, 20.0))
        if text:
            canvas.text((0.8 * size, 0.7 * size), text, size, TEXT, "la")
        return canvas.frame()

    def _follow(self, line: Floats) -> None:
        centre = line.mean(axis=0)
        if not self._pixels_per_m:
            length = float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
            self._pixels_per_m = max(self.width, self.height) / (SPAN_BODY_LENGTHS * length)
            self._centre = centre
        step = centre - self._centre
        seen = np.all(np.abs(step) * self._pixels_per_m < 0.5 * min(self.width, self.height))
        self._centre = self._centre + FOLLOWED_SHARE * step if seen else centre

    def _pixels(self, places_m: Floats) -> Floats:
        """Pixels (…, 2) of places x, z (…, 2) [m]."""
        middle = (0.5 * self.width, 0.5 * self.height)
        return np.asarray((places_m - self._centre) * self._pixels_per_m + middle)

    def _draw_grid(self, canvas: Canvas) -> None:
        """Lines at every centimetre of x and z; some have their number, at the lower and the right edge."""
        right, bottom, size = float(self.width), float(self.height), 0.034 * self.height
        columns, rows = self._lines(0), self._lines(1)
        for labelled, colour in ((False, GRID), (True, GRID_LABELLED)):
            for at in (at for at, centimetre in columns if (centimetre % LABELLED_CM == 0) is labelled):
                canvas.box(at, 0.0, at, bottom, colour)
            for at in (at for at, centimetre in rows if (centimetre % LABELLED_CM == 0) is labelled):
                canvas.box(0.0, at, right, at, colour)
        for at, centimetre in columns:
            if centimetre % LABELLED_CM == 0 and at < right - 4.5 * size:
                canvas.text((at + 3.0, bottom - 1.3 * size), _label(centimetre), size, TICK, "la")
        for at, centimetre in rows:
            if centimetre % LABELLED_CM == 0 and 3.0 * size < at < bottom - 3.0 * size:
                canvas.text((right - 3.0, at + 2.0), _label(centimetre), size, TICK, "ra")

    def _lines(self, axis: int) -> list[tuple[float, int]]:
        """Pixel and centimetre of each line across an axis."""
        half = 0.5 * np.array([self.width, self.height]) / self._pixels_per_m
        low, high = 100.0 * (self._centre - half)[axis], 100.0 * (self._centre + half)[axis]
        centimetres = range(math.ceil(low), math.floor(high) + 1)
        return [(round(float(self._pixels(np.full(2, 0.01 * c))[axis])), c) for c in centimetres]

    def _draw_drive(self, region: Region, centre: Floats, yaw: float) -> None:
        along, across = _axes(yaw)
        corners = self._pixels(_corners(centre, along, across, self._drive_size))
        region.polygon(corners, DRIVE_BELOW, mix(DRIVE_BELOW, MAGNET_EDGE, 0.5), edge_px=1.0)
        # The way that its length lies, so that a quarter turn is told from none.
        ends = self._pixels(centre + np.outer([-0.5, 0.5], along * self._drive_size[0]))
        region.line(ends, mix(DRIVE_BELOW, NORTH, 0.6), 1.5)

    def _draw_goal(self, region: Region, goal: Goal, line: Floats) -> None:
        if goal.point_m is not None:
            centre = self._pixels(np.array(goal.point_m))
            radius = goal.radius_m * self._pixels_per_m
            region.disc(centre, radius, GOAL)
            region.disc(centre, max(radius - 2.0, 0.0), PLATE_ABOVE)
            region.disc(centre, 2.5, GOAL)
        if goal.heading_rad is not None:
            ahead = -_axes(goal.heading_rad)[0]
            aside = np.array([ahead[1], -ahead[0]])
            reach = 0.45 * min(self.width, self.height)
            start = self._pixels(line.mean(axis=0))
            tip = start + reach * ahead
            region.line(np.stack([start, tip - 10.0 * ahead]), GOAL, 2.5)
            head = np.stack([tip, tip - 14.0 * ahead + 6.0 * aside, tip - 14.0 * ahead - 6.0 * aside])
            region.polygon(head, GOAL)

    def _draw_robot(self, region: Region, line: Floats, poses: Floats, present: NDArray[np.bool_]) -> None:
        pixels = self._pixels(line)
        width = self._seen_width(poses) * self._pixels_per_m
        outline = band(pixels, width)
        region.polygon(outline, RUBBER)
        region.polygon(band(pixels, width, share=0.6), RUBBER_LIGHT)
        region.polygon(outline, None, RUBBER_EDGE, edge_px=1.3)
        inward = (pixels[1] - pixels[0]) / max(float(np.linalg.norm(pixels[1] - pixels[0])), 1e-9)
        aside = np.array([inward[1], -inward[0]])
        for sign in (-1.0, 1.0):
            eye = pixels[0] + width[0] * (0.16 * inward + sign * 0.26 * aside)
            region.disc(eye, max(1.2, 0.05 * width[0]), EYE)
        for magnet, (pose, there) in enumerate(zip(poses, present, strict=True)):
            self._draw_magnet(region, magnet, pose, there)

    def _seen_width(self, poses: Floats) -> Floats:
        """Width of each element from above (K - 1,) [m]: less where the body lies on its side."""
        w, x, y, z = poses[:, 3:].T
        lying = np.abs(2.0 * (y * z - w * x))
        upright = float(np.sqrt(np.clip(1.0 - lying**2, 0.0, 1.0)).mean()) if len(poses) else 1.0
        return np.asarray(self._width * upright + self._thickness * math.sqrt(1.0 - upright**2))

    def _draw_magnet(self, region: Region, magnet: int, pose: Floats, there: np.bool_) -> None:
        """Draws the pole that points up; both where the magnet points more to a side."""
        axes = _rotation(pose[3:])
        centre = pose[[0, 2]] + (axes @ self._magnet_offset[magnet])[[0, 2]]
        along, across = axes[[0, 2], 0], axes[[0, 2], 2]
        corners = self._pixels(_corners(centre, along, across, self._magnet_size[magnet]))
        if not there:
            region.polygon(corners, None, REMOVED_EDGE, edge_px=1.0)
            return
        x, up, z = axes @ self._magnet_direction[magnet]
        region.polygon(corners, NORTH if up > 0.0 else SOUTH, MAGNET_EDGE, edge_px=1.0)
        if math.hypot(x, z) > abs(up):
            for sign, colour in ((1.0, NORTH), (-1.0, SOUTH)):
                region.polygon(half(corners, sign * np.array([x, z])), colour, MAGNET_EDGE, edge_px=1.0)


def _label(centimetre: int) -> str:
    return f"{centimetre} cm" if centimetre else "0"


def _rotation(quaternion: Floats) -> Floats:
    """Axes of a body (3, 3) in its columns: along it, up, to its side."""
    w, x, y, z = quaternion
    return np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )


def _axes(yaw: float) -> tuple[Floats, Floats]:
    """Length and width of what is turned about the vertical, in x, z."""
    cos, sin = math.cos(yaw), math.sin(yaw)
    return np.array([cos, -sin]), np.array([sin, cos])


def _corners(centre: Floats, along: Floats, across: Floats, size: Floats) -> Floats:
    """Corners (4, 2) of a rectangle, or of the shadow of one in space."""
    half = 0.5 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * size
    return np.asarray(centre + half @ np.stack([along, across]))
