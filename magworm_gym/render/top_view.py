"""The view from above of one environment in space."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from magworm_gym.recording import Floats, Moment
from magworm_gym.render.backdrop import label
from magworm_gym.render.camera import FOLLOWED_SHARE
from magworm_gym.render.canvas import Canvas, Region
from magworm_gym.render.outline import half, rectangle, rotations
from magworm_gym.render.palette import (
    DRIVE_BELOW,
    GOAL,
    GRID,
    GRID_LABELLED,
    MAGNET_EDGE,
    NORTH,
    PLATE_ABOVE,
    REMOVED_EDGE,
    SOUTH,
    TICK,
    mix,
)
from magworm_gym.render.robot import (
    MAGNET_GEOMETRY,
    TRAIL_POINTS,
    body_length,
    draw_eyes,
    draw_rubber,
    draw_trail,
)
from magworm_gym.render.side_view import SPAN_BODY_LENGTHS

if TYPE_CHECKING:
    from magworm_gym.tasks import Goal

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
        self.width, self.height = width, height
        self._width = np.asarray(geometry["element_width_m"])
        self._thickness = float(np.mean(geometry["element_thickness_m"]))
        self._magnets = [np.reshape(geometry[name], (-1, 3)) for name in MAGNET_GEOMETRY]
        self._drive_size = np.array([geometry["drive_size_m"][0], geometry["drive_width_m"]])
        self._background = Image.new("RGB", (width, height), PLATE_ABOVE)
        self._pixels_per_m = 0.0
        self._centre = np.zeros(2)

    def draw(self, robot: Moment, text: str | None = None, goal: Goal | None = None) -> NDArray[np.uint8]:
        """Draws one frame; arguments as of ``SpaceView.draw``."""
        canvas = Canvas(self._background)
        line = robot.nodes[:, [0, 2]]
        if np.all(np.isfinite(line)):
            self._follow(line)
            self._draw_grid(canvas)
            path = self._pixels(np.reshape(robot.trail, (-1, 3))[-TRAIL_POINTS:][:, [0, 2]])
            with canvas.region() as region:
                for x, _, z, yaw in robot.drive_positions.tolist():
                    self._draw_drive(region, np.array([x, z]), yaw)
                if goal is not None:
                    self._draw_goal(region, goal, line)
                draw_trail(region, path)
                self._draw_robot(region, robot)
        if text:
            canvas.caption(text)
        return canvas.frame()

    def _follow(self, line: Floats) -> None:
        centre = line.mean(axis=0)
        if not self._pixels_per_m:
            self._pixels_per_m = max(self.width, self.height) / (SPAN_BODY_LENGTHS * body_length(line))
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
        lines = [(axis, at, centimetre) for axis in (0, 1) for at, centimetre in self._lines(axis)]
        labelled = [line for line in lines if line[2] % LABELLED_CM == 0]
        for several, colour in ((lines, GRID), (labelled, GRID_LABELLED)):
            for axis, at, _ in several:
                canvas.box(*((at, 0.0, at, bottom) if axis == 0 else (0.0, at, right, at)), colour)
        for axis, at, centimetre in labelled:
            if axis == 0 and at < right - 4.5 * size:
                canvas.text((at + 3.0, bottom - 1.3 * size), label(centimetre), size, TICK, "la")
            if axis == 1 and 3.0 * size < at < bottom - 3.0 * size:
                canvas.text((right - 3.0, at + 2.0), label(centimetre), size, TICK, "ra")

    def _lines(self, axis: int) -> list[tuple[float, int]]:
        """Pixel and centimetre of each line across an axis."""
        half = 0.5 * np.array([self.width, self.height]) / self._pixels_per_m
        low, high = 100.0 * (self._centre - half)[axis], 100.0 * (self._centre + half)[axis]
        centimetres = range(math.ceil(low), math.floor(high) + 1)
        return [(round(float(self._pixels(np.full(2, 0.01 * c))[axis])), c) for c in centimetres]

    def _draw_drive(self, region: Region, centre: Floats, yaw: float) -> None:
        axes = _axes(yaw)
        corners = self._pixels(rectangle(centre, axes, self._drive_size))
        region.polygon(corners, DRIVE_BELOW, mix(DRIVE_BELOW, MAGNET_EDGE, 0.5))
        # The way that its length lies, so that a quarter turn is told from none.
        ends = self._pixels(centre + np.outer([-0.5, 0.5], axes[0] * self._drive_size[0]))
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

    def _draw_robot(self, region: Region, robot: Moment) -> None:
        pixels, axes = self._pixels(robot.nodes[:, [0, 2]]), rotations(robot.magnet_poses[:, 3:])
        width = self._seen_width(axes) * self._pixels_per_m
        draw_rubber(region, pixels, width, light=0.6)
        draw_eyes(region, pixels, width[0], [(0.16, -0.26), (0.16, 0.26)], radius=0.05)
        magnets = zip(robot.magnet_poses, robot.present, axes, *self._magnets, strict=True)
        for pose, there, turn, size, direction, offset in magnets:
            centre = (pose[:3] + turn @ offset)[[0, 2]]
            corners = self._pixels(rectangle(centre, turn[[0, 2]][:, [0, 2]].T, size[[0, 2]]))
            _draw_magnet(region, corners, turn @ direction if there else None)

    def _seen_width(self, axes: Floats) -> Floats:
        """Width of each element from above (K - 1,) [m]: less where the body lies on its side."""
        lying = axes[:, 1, 2]
        upright = float(np.sqrt(np.clip(1.0 - lying**2, 0.0, 1.0)).mean()) if len(axes) else 1.0
        return np.asarray(self._width * upright + self._thickness * math.sqrt(1.0 - upright**2))


def _draw_magnet(region: Region, corners: Floats, north: Floats | None) -> None:
    """Draws the pole that points up; both where the magnet points more to a side; None leaves an outline."""
    if north is None:
        region.polygon(corners, None, REMOVED_EDGE)
        return
    x, up, z = north
    region.polygon(corners, NORTH if up > 0.0 else SOUTH, MAGNET_EDGE)
    if math.hypot(x, z) > abs(up):
        for sign, colour in ((1.0, NORTH), (-1.0, SOUTH)):
            region.polygon(half(corners, sign * np.array([x, z])), colour, MAGNET_EDGE)


def _axes(yaw: float) -> Floats:
    """Length and width of what is turned about the vertical: rows x, z."""
    cos, sin = math.cos(yaw), math.sin(yaw)
    return np.array([[cos, -sin], [sin, cos]])
