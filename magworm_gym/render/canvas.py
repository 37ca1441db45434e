"""Anti-aliased drawing on a frame, by supersampling the touched region only."""

import functools
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from magworm_gym.render.palette import Colour

SUPERSAMPLING = 3
MARGIN_PX = 3.0
LINE_SPACING = 1.35


@functools.lru_cache(maxsize=32)
def _font(size_px: int) -> ImageFont.ImageFont | ImageFont.FreeTypeFont:
    return ImageFont.load_default(size_px)


@functools.lru_cache(maxsize=512)
def _writing(text: str, size_px: int, anchor: str) -> tuple[Image.Image, tuple[int, int]]:
    """Coverage of a written line, and where its upper left corner lies from the anchor [pixels]."""
    font = _font(SUPERSAMPLING * size_px)
    left, top, right, bottom = font.getbbox(text, anchor=anchor)
    left, top = math.floor(left / SUPERSAMPLING), math.floor(top / SUPERSAMPLING)
    width = math.ceil(right / SUPERSAMPLING) - left + 1
    height = math.ceil(bottom / SUPERSAMPLING) - top + 1
    mask = Image.new("L", (SUPERSAMPLING * width, SUPERSAMPLING * height))
    origin = (-SUPERSAMPLING * left, -SUPERSAMPLING * top)
    ImageDraw.Draw(mask).text(origin, text, font=font, fill=255, anchor=anchor)
    return mask.reduce(SUPERSAMPLING), (left, top)


class Region:
    """A supersampled piece of the frame. Coordinates stay those of the frame [pixels].

    Args:
        image: The enlarged piece.
        origin: Column and row of its top left corner in the frame [pixels].
    """

    def __init__(self, image: Image.Image, origin: tuple[int, int]) -> None:
        self._draw = ImageDraw.Draw(image)
        self._origin = np.asarray(origin, dtype=np.float64)

    def _points(self, points: NDArray[np.float64]) -> list[tuple[float, float]]:
        enlarged = (points - self._origin) * SUPERSAMPLING
        return list(map(tuple, enlarged.tolist()))

    def polygon(
        self,
        points: NDArray[np.float64],
        fill: Colour | None,
        edge: Colour | None = None,
        edge_px: float = 1.0,
    ) -> None:
        """Fills and outlines a closed polygon (P, 2) [pixels]."""
        corners = self._points(points)
        if fill is not None:
            self._draw.polygon(corners, fill=fill)
        if edge is not None:
            width = max(1, round(edge_px * SUPERSAMPLING))
            self._draw.line([*corners, corners[0]], fill=edge, width=width, joint="curve")

    def line(self, points: NDArray[np.float64], colour: Colour, width_px: float) -> None:
        """Draws an open polyline (P, 2) [pixels]."""
        width = max(1, round(width_px * SUPERSAMPLING))
        self._draw.line(self._points(points), fill=colour, width=width, joint="curve")

    def disc(self, centre: NDArray[np.float64], radius_px: float, colour: Colour) -> None:
        """Draws a filled disc around ``centre`` (2,) [pixels]."""
        corners = self._points(np.stack([centre - radius_px, centre + radius_px]))
        self._draw.ellipse([corners[0], corners[1]], fill=colour)


class Canvas:
    """One frame while it is drawn.

    Args:
        background: Image to draw on; it is copied.
    """

    def __init__(self, background: Image.Image) -> None:
        self._image = background.copy()
        self._draw = ImageDraw.Draw(self._image)

    def text(
        self, place: tuple[float, float], text: str, size_px: float, colour: Colour, anchor: str = "la"
    ) -> None:
        """Writes lines of text.

        Args:
            place: Column and row of the anchor of the first line [pixels].
            text: Lines separated by newlines.
            size_px: Size of the letters [pixels].
            colour: Colour of the letters.
            anchor: As in Pillow: "la" left and ascender, "mm" middle of both, "ra" right.
        """
        for number, line in enumerate(text.split("\n")):
            mask, (left, top) = _writing(line, round(size_px), anchor)
            row = place[1] + number * LINE_SPACING * size_px
            self._image.paste(colour, (round(place[0]) + left, round(row) + top), mask)

    def box(self, left: float, top: float, right: float, bottom: float, colour: Colour) -> None:
        """Fills an axis-aligned box [pixels], not anti-aliased."""
        self._draw.rectangle((left, top, right, bottom), fill=colour)

    def frame(self) -> NDArray[np.uint8]:
        """The frame (H, W, 3)."""
        return np.array(self._image)

    def region(self, around: Sequence[NDArray[np.float64]]) -> "OpenRegion | None":
        """Supersamples the part of the frame around points.

        Args:
            around: Arrays of points (…, 2) [pixels] that the region has to hold.

        Returns:
            A context manager giving a Region, or None if nothing of it is in the frame.
        """
        points = np.concatenate([np.reshape(array, (-1, 2)) for array in around])
        size = np.array(self._image.size)
        low = np.floor(np.clip(points.min(axis=0) - MARGIN_PX, 0, size)).astype(int)
        high = np.ceil(np.clip(points.max(axis=0) + MARGIN_PX, 0, size)).astype(int)
        if not np.all(high > low):
            return None
        return OpenRegion(self._image, (int(low[0]), int(low[1]), int(high[0]), int(high[1])))

    def whole(self) -> "OpenRegion":
        """Supersamples all of the frame."""
        return OpenRegion(self._image, (0, 0, *self._image.size))


class OpenRegion:
    """Enlarges a box of an image on entry and writes it back, reduced, on exit."""

    def __init__(self, image: Image.Image, box: tuple[int, int, int, int]) -> None:
        self._image = image
        self._box = box
        width, height = (box[2] - box[0]) * SUPERSAMPLING, (box[3] - box[1]) * SUPERSAMPLING
        self._enlarged = image.crop(box).resize((width, height), Image.Resampling.NEAREST)

    def __enter__(self) -> Region:
        return Region(self._enlarged, self._box[:2])

    def __exit__(self, *exception: object) -> None:
        self._image.paste(self._enlarged.reduce(SUPERSAMPLING), self._box[:2])
