"""The side view of one environment: robot, drive magnets, ground and trail."""

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.render import backdrop
from magworm_gym.render.camera import Camera
from magworm_gym.render.canvas import Canvas, Region
from magworm_gym.render.outline import band, half, rectangle, turned
from magworm_gym.render.palette import (
    EYE,
    LETTER,
    MAGNET_EDGE,
    NORTH,
    REMOVED_EDGE,
    RUBBER,
    RUBBER_EDGE,
    RUBBER_LIGHT,
    SOUTH,
    TEXT,
    TICK,
    TRAIL_NEW,
    TRAIL_OLD,
    mix,
)
from magworm_gym.render.window import Windowed

Floats = NDArray[np.float64]

SPAN_BODY_LENGTHS = 3.4
HORIZON = 0.32
TRAIL_PIECES = 12
TRAIL_POINTS = 480
SMALLEST_LETTER_PX = 8.0
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
        self.width = width
        self.height = height
        sections = geometry.get("element_thickness_m", geometry["node_thickness_m"])
        self._thickness = np.asarray(sections, dtype=np.float64)
        self._magnet_size = np.asarray(geometry["magnet_size_m"], dtype=np.float64)[:, :2]
        self._magnet_direction = np.asarray(geometry["magnet_direction"], dtype=np.float64)[:, :2]
        self._magnet_offset = np.asarray(geometry["magnet_offset_m"], dtype=np.float64)[:, :2]
        self._drive_size = tuple(geometry["drive_size_m"])
        self._ground = bool(geometry["ground"])
        self._incline_deg = float(geometry["incline_deg"])
        self._span_m = span_m
        self._centre_m = centre_m
        self._horizon = horizon
        self._camera: Camera | None = None

    def draw(
        self,
        nodes: Floats,
        magnet_poses: Floats,
        present: NDArray[np.bool_],
        drive_positions: Floats,
        trail: Floats,
        text: str | None = None,
        drive_lengths: Floats | None = None,
    ) -> NDArray[np.uint8]:
        """Draws one frame.

        Args:
            nodes: Centre line (K, 2) [m], head first.
            magnet_poses: Body magnets (M, 3): x [m], y [m], angle [rad].
            present: Which body magnets are in place (M,).
            drive_positions: Centres of the drive magnets (D, 2) [m].
            trail: Past places of the body centre (T, 2) [m], oldest first; may be empty.
            text: Written in the upper left corner, lines separated by newlines.
            drive_lengths: Lengths of the drive magnets as seen from the side (D,) [m]; None for the scene's.

        Returns:
            A fresh frame (H, W, 3), uint8, red-green-blue.
        """
        nodes = np.asarray(nodes, dtype=np.float64)
        camera = self._following(nodes)
        canvas = Canvas(self._background)
        if self._ground:
            backdrop.draw_ticks(canvas, camera, self._text_px)
        drives = np.asarray(drive_positions, dtype=np.float64)
        lengths = np.full(len(drives), self._drive_size[0]) if drive_lengths is None else drive_lengths
        self._draw_drives(canvas, camera, drives, lengths)
        if np.all(np.isfinite(nodes)):
            self._draw_robot(canvas, camera, nodes, magnet_poses, present, trail)
        self._draw_text(canvas, text)
        return canvas.frame()

    @property
    def _text_px(self) -> float:
        return float(np.clip(0.04 * self.height, 13.0, 20.0))

    def _following(self, nodes: Floats) -> Camera:
        if self._camera is None:
            length = float(np.linalg.norm(np.diff(nodes, axis=0), axis=1).sum())
            span = self._span_m or SPAN_BODY_LENGTHS * length
            self._camera = Camera(
                self.width, self.height, span, horizon=self._horizon, centre_m=self._centre_m
            )
            self._background = backdrop.background(self._camera, self.height, ground=self._ground)
        self._camera.follow(float(nodes[:, 0].mean()))
        return self._camera

    def _draw_drives(self, canvas: Canvas, camera: Camera, positions: Floats, lengths: Floats) -> None:
        height = self._drive_size[1]
        for (x, y), length in zip(positions.tolist(), lengths.tolist(), strict=True):
            corners = camera.pixels(rectangle(x, y, 0.0, length, -0.5 * height, 0.5 * height))
            with canvas.region([corners]) as region:
                _draw_magnet(region, camera, (x, y, 0.0), (length, height), UPWARD)
            pole_px = 0.5 * height * camera.pixels_per_m
            if pole_px >= SMALLEST_LETTER_PX:
                column, row = corners.mean(axis=0).tolist()
                canvas.text((column, row - 0.5 * pole_px), "N", pole_px, LETTER, "mm")
                canvas.text((column, row + 0.5 * pole_px), "S", pole_px, LETTER, "mm")

    def _draw_robot(
        self,
        canvas: Canvas,
        camera: Camera,
        nodes: Floats,
        poses: Floats,
        present: NDArray[np.bool_],
        trail: Floats,
    ) -> None:
        body = band(camera.pixels(nodes), self._thickness * camera.pixels_per_m)
        line = camera.pixels(np.reshape(trail, (-1, 2))[-TRAIL_POINTS:])
        with canvas.region([body, line]) as region:
            draw_trail(region, line)
            self._draw_rubber(region, camera, nodes, body)
            magnets = zip(poses, self._magnet_offset, self._magnet_size, self._magnet_direction, strict=True)
            for (pose, offset, size, direction), there in zip(magnets, present, strict=True):
                place = (*(pose[:2] + offset @ turned(pose[2])), pose[2])
                _draw_magnet(region, camera, place, size, direction if there else None)

    def _draw_rubber(self, region: Region, camera: Camera, nodes: Floats, body: Floats) -> None:
        centre_line = camera.pixels(nodes)
        thickness = self._thickness * camera.pixels_per_m
        region.polygon(body, RUBBER)
        region.polygon(band(centre_line, thickness, share=0.45), RUBBER_LIGHT)
        region.polygon(body, None, RUBBER_EDGE, edge_px=1.3)
        _draw_eye(region, centre_line, thickness[0])

    def _draw_text(self, canvas: Canvas, text: str | None) -> None:
        size = self._text_px
        if text:
            canvas.text((0.8 * size, 0.7 * size), text, size, TEXT, "la")
        if self._incline_deg:
            corner = (self.width - 0.8 * size, 0.7 * size)
            canvas.text(corner, f"incline {self._incline_deg:g}°", size, TICK, "ra")


def _draw_eye(region: Region, centre_line: Floats, thickness: float) -> None:
    """Marks the head, so that a picture alone tells which way the robot crawls."""
    edge = centre_line[1] - centre_line[0]
    inward = edge / max(float(np.linalg.norm(edge)), 1e-9)
    upward = np.array([inward[1], -inward[0]])
    region.disc(centre_line[0] + thickness * (0.17 * inward + 0.2 * upward), max(1.2, 0.065 * thickness), EYE)


def draw_trail(region: Region, line: Floats) -> None:
    """Draws the trail in pieces that fade towards the past."""
    if len(line) < 2:
        return
    cuts = np.unique(np.linspace(0, len(line) - 1, TRAIL_PIECES + 1).astype(int))
    for start, stop in itertools.pairwise(cuts.tolist()):
        share = stop / (len(line) - 1)
        region.line(line[start : stop + 1], mix(TRAIL_OLD, TRAIL_NEW, share), 1.0 + share)


def _draw_magnet(
    region: Region,
    camera: Camera,
    pose: tuple[float, float, float],
    size_m: Sequence[float] | Floats,
    direction: Floats | None,
) -> None:
    """Draws a magnet, cut across its direction into its two poles; None leaves an empty outline."""
    length, height = size_m
    whole = rectangle(*pose, length, -0.5 * height, 0.5 * height)
    if direction is None:
        region.polygon(camera.pixels(whole), None, REMOVED_EDGE, edge_px=1.0)
        return
    north = direction @ turned(pose[2])
    region.polygon(camera.pixels(whole), SOUTH)
    region.polygon(camera.pixels(half(whole, north)), NORTH)
    region.polygon(camera.pixels(whole), None, MAGNET_EDGE, edge_px=1.0)
