"""The side view of one environment: robot, drive magnets, ground and trail."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.recording import Floats, Moment
from magworm_gym.render import backdrop
from magworm_gym.render.camera import Camera
from magworm_gym.render.canvas import Canvas, Region
from magworm_gym.render.outline import band, half, rectangle, turned
from magworm_gym.render.palette import GOAL, LETTER, MAGNET_EDGE, NORTH, REMOVED_EDGE, SOUTH, TICK
from magworm_gym.render.robot import (
    MAGNET_GEOMETRY,
    TRAIL_POINTS,
    body_length,
    draw_eyes,
    draw_rubber,
    draw_trail,
)
from magworm_gym.render.window import Windowed

if TYPE_CHECKING:
    from magworm_gym.tasks import Goal

SPAN_BODY_LENGTHS = 3.4
HORIZON = 0.32
SMALLEST_LETTER_PX = 8.0
POST_PX = 60.0
UPWARD = np.array([0.0, 1.0])


class SideView(Windowed):
    """Draws frames of one environment seen along -z: x to the right, y up.

    The scale is taken from the first frame (3.4 body lengths fill the width) and kept; the camera
    follows the robot smoothly, so that the ticks of the ground, one a centimetre, show progress.
    Red is a magnetic north pole, blue a south pole; a removed magnet is an empty outline.

    Args:
        geometry: ``Scene.geometry``: ``node_thickness_m`` (K,), ``element_thickness_m`` (K - 1,; may be
            left out), ``magnet_size_m`` (M, 3): length, height and width,
            ``magnet_direction`` (M, 3): from south to north along the body, up and to the side,
            ``magnet_offset_m`` (M, 3): centre from that of its body, ``drive_size_m`` (length, height),
            ``ground``, ``incline_deg``.
        width: Width of a frame [pixels].
        height: Height of a frame [pixels].
        span_m: Width of the visible world [m]; None takes it from the first robot drawn.
        centre_m: World x [m] kept in the middle; None follows the robot.
        horizon: Height of the ground in the frame, as a share measured from the top.

    Raises:
        ImportError: Pillow is missing; the sentence names the extra to install.
    """

    def __init__(
        self,
        geometry: dict[str, Any],
        width: int = 640,
        height: int = 360,
        *,
        span_m: float | None = None,
        centre_m: float | None = None,
        horizon: float = HORIZON,
    ) -> None:
        self.width, self.height = width, height
        self._thickness = np.asarray(geometry.get("element_thickness_m", geometry["node_thickness_m"]))
        self._magnets = [np.reshape(geometry[name], (-1, 3))[:, :2] for name in MAGNET_GEOMETRY]
        self._drive_length, self._drive_height = geometry["drive_size_m"]
        self._ground = bool(geometry["ground"])
        self._incline_deg = float(geometry["incline_deg"])
        self._span_m, self._centre_m, self._horizon = span_m, centre_m, horizon
        self._camera: Camera | None = None

    def draw(
        self,
        robot: Moment,
        text: str | None = None,
        goal: Goal | None = None,
        drive_lengths: Floats | None = None,
    ) -> NDArray[np.uint8]:
        """Draws one frame.

        Args:
            robot: In the plane.
            text: Written in the upper left corner, lines separated by newlines.
            goal: Where the robot is to go: a post at its x; the plane has no headings.
            drive_lengths: Lengths of the drive magnets as seen from the side (D,) [m]; None for the scene's.

        Returns:
            A fresh frame (H, W, 3), uint8, red-green-blue.
        """
        camera = self._following(robot.nodes)
        canvas = Canvas(self._background)
        if self._ground:
            backdrop.draw_ticks(canvas, camera)
        if goal is not None and goal.point_m is not None:
            column = camera.column(goal.point_m[0])
            canvas.box(column - 1.0, camera.ground_px - POST_PX, column + 1.0, camera.ground_px, GOAL)
        drives = robot.drive_positions
        lengths = np.full(len(drives), self._drive_length) if drive_lengths is None else drive_lengths
        self._draw_drives(canvas, camera, drives, lengths)
        if np.all(np.isfinite(robot.nodes)):
            self._draw_robot(canvas, camera, robot)
        if text:
            canvas.caption(text)
        if self._incline_deg:
            canvas.caption(f"incline {self._incline_deg:g}°", TICK, right=True)
        return canvas.frame()

    def _following(self, nodes: Floats) -> Camera:
        if self._camera is None:
            span = self._span_m or SPAN_BODY_LENGTHS * body_length(nodes)
            self._camera = Camera(
                self.width, self.height, span, horizon=self._horizon, centre_m=self._centre_m
            )
            self._background = backdrop.background(self._camera, self.height, ground=self._ground)
        self._camera.follow(float(nodes[:, 0].mean()))
        return self._camera

    def _draw_drives(self, canvas: Canvas, camera: Camera, positions: Floats, lengths: Floats) -> None:
        height = self._drive_height
        for centre, length in zip(positions, lengths, strict=True):
            corners = camera.pixels(rectangle(centre, turned(0.0), (length, height)))
            with canvas.region([corners]) as region:
                _draw_magnet(region, corners, UPWARD)
            pole_px = 0.5 * height * camera.pixels_per_m
            if pole_px >= SMALLEST_LETTER_PX:
                column, row = corners.mean(axis=0).tolist()
                canvas.text((column, row - 0.5 * pole_px), "N", pole_px, LETTER, "mm")
                canvas.text((column, row + 0.5 * pole_px), "S", pole_px, LETTER, "mm")

    def _draw_robot(self, canvas: Canvas, camera: Camera, robot: Moment) -> None:
        line, thickness = camera.pixels(robot.nodes), self._thickness * camera.pixels_per_m
        path = camera.pixels(np.reshape(robot.trail, (-1, 2))[-TRAIL_POINTS:])
        with canvas.region([band(line, thickness), path]) as region:
            draw_trail(region, path)
            draw_rubber(region, line, thickness, light=0.45)
            draw_eyes(region, line, thickness[0], [(0.17, 0.2)], radius=0.065)
            magnets = zip(robot.magnet_poses, robot.present, *self._magnets, strict=True)
            for pose, there, size, direction, offset in magnets:
                axes = turned(pose[2])
                corners = camera.pixels(rectangle(pose[:2] + offset @ axes, axes, size))
                _draw_magnet(region, corners, direction @ axes if there else None)


def _draw_magnet(region: Region, corners: Floats, north: Floats | None) -> None:
    """Draws a magnet, cut into its two poles; None, for one that was removed, leaves an empty outline.

    Args:
        region: Where to draw.
        corners: Of the magnet (4, 2) [pixels].
        north: From south to north in the world (2,), y up.
    """
    if north is None:
        region.polygon(corners, None, REMOVED_EDGE)
        return
    region.polygon(corners, SOUTH)
    region.polygon(half(corners, north * (1.0, -1.0)), NORTH)
    region.polygon(corners, None, MAGNET_EDGE)
