"""Anti-aliased drawing on a frame, by supersampling the touched region only."""

import functools
import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from magworm_gym.recording import Floats
from magworm_gym.render.palette import TEXT, Colour

SUPERSAMPLING = 3
MARGIN_PX = 3.0
Anchor: TypeAlias = Literal["la", "ra", "mm", "mt"]
"""Of a written line, as in Pillow: left, middle or right, then ascender, middle or top."""
LINE_SPACING = 1.35


@functools.lru_cache(maxsize=32)
def _font(size_px: int) -> ImageFont.ImageFont | ImageFont.FreeTypeFont:
    return ImageFont.load_default(size_px)


@functools.lru_cache(maxsize=512)
def _writing(text: str, size_px: int, anchor: Anchor) -> tuple[Image.Image, tuple[int, int]]:
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

    def _points(self, points: Floats) -> list[tuple[float, float]]:
        enlarged = (points - self._origin) * SUPERSAMPLING
        return list(map(tuple, enlarged.tolist()))

    def polygon(
        self,
        points: Floats,
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

    def line(self, points: Floats, colour: Colour, width_px: float) -> None:
        """Draws an open polyline (P, 2) [pixels]."""
        width = max(1, round(width_px * SUPERSAMPLING))
        self._draw.line(self._points(points), fill=colour, width=width, joint="curve")

    def disc(self, centre: Floats, radius_px: float, colour: Colour) -> None:
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
        self.text_px = min(max(0.04 * background.height, 13.0), 20.0)
        """Size of letters of ordinary text."""

    def caption(self, text: str, colour: Colour = TEXT, *, right: bool = False) -> None:
        """Writes lines of ordinary text into the upper left corner, or into the right one."""
        margin, top = 0.8 * self.text_px, 0.7 * self.text_px
        left = self._image.width - margin if right else margin
        self.text((left, top), text, self.text_px, colour, "ra" if right else "la")

    def text(
        self, place: tuple[float, float], text: str, size_px: float, colour: Colour, anchor: Anchor = "la"
    ) -> None:
        """Writes lines of text.

        Args:
            place: Column and row of the anchor of the first line [pixels].
            text: Lines separated by newlines.
            size_px: Size of the letters [pixels].
            colour: Colour of the letters.
            anchor: Which point of a line that is.
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

    @contextmanager
    def region(self, around: Sequence[Floats] | None = None) -> Iterator[Region]:
        """Supersamples a part of the frame, to be drawn on within the block.

        Args:
            around: Arrays of points (…, 2) [pixels] that the region has to hold; None for all of the frame.
        """
        left, top, right, bottom = (0, 0, *self._image.size) if around is None else self._box(around)
        size = (SUPERSAMPLING * (right - left), SUPERSAMPLING * (bottom - top))
        enlarged = self._image.crop((left, top, right, bottom)).resize(size, Image.Resampling.NEAREST)
        yield Region(enlarged, (left, top))
        self._image.paste(enlarged.reduce(SUPERSAMPLING), (left, top))

    def _box(self, around: Sequence[Floats]) -> list[int]:
        """Left, top, right, bottom of the pixels around points; one pixel where all lie outside the frame."""
        points = np.concatenate([np.reshape(array, (-1, 2)) for array in around])
        size = np.array(self._image.size)
        low = np.clip(np.floor(points.min(axis=0) - MARGIN_PX), 0, size - 1).astype(int)
        high = np.clip(np.ceil(points.max(axis=0) + MARGIN_PX), low + 1, size).astype(int)
        return [*low.tolist(), *high.tolist()]
