"""Animations: frames into mp4 and gif files, several robots stacked on one time axis."""

import itertools
import os
from collections.abc import Iterable, Iterator, Sequence
from os import PathLike

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from magworm_gym.arguments import path_of

Frame = NDArray[np.uint8]

SEPARATOR_PX = 2
SEPARATOR_GREY = 120
GIF_COLOURS = 64


def stacked(panels: Sequence[Frame]) -> Frame:
    """Stacks frames of equal width on top of each other, with a line between them.

    Args:
        panels: Frames (H_i, W, 3).

    Returns:
        One frame; its sides are even, as video codecs ask.
    """
    line = np.full((SEPARATOR_PX, panels[0].shape[1], 3), SEPARATOR_GREY, dtype=np.uint8)
    parts = [part for panel in panels for part in (panel, line)][:-1]
    whole = np.concatenate(parts)
    height, width = whole.shape[0] // 2 * 2, whole.shape[1] // 2 * 2
    return np.ascontiguousarray(whole[:height, :width])


def write_mp4(path: str | PathLike[str], frames: Iterable[Frame], fps: float) -> None:
    """Writes an H.264 video that browsers play.

    A file appears under its name only when it is complete.

    Args:
        path: Target; its folder must exist.
        frames: Frames (H, W, 3) of one size with even sides, at least one.
        fps: Frames per second.

    Raises:
        ImportError: imageio-ffmpeg is missing; the sentence names the extra to install.
        ValueError: There is no frame.
    """
    path = path_of("path", path)
    try:
        import imageio_ffmpeg
    except ImportError as error:
        raise ImportError("mp4 needs imageio-ffmpeg: pip install 'magworm-gym[render]'.") from error
    first, frames = _begun(frames)
    part = path.with_name(f".part-{path.name}")
    writer = imageio_ffmpeg.write_frames(
        str(part), (first.shape[1], first.shape[0]), fps=fps, quality=7, macro_block_size=2
    )
    writer.send(None)
    try:
        for frame in frames:
            writer.send(np.ascontiguousarray(frame))
    finally:
        writer.close()
    os.replace(part, path)


def write_gif(path: str | PathLike[str], frames: Iterable[Frame], fps: float, scale: float = 1.0) -> None:
    """Writes an endlessly repeating gif with one palette for all frames.

    Args:
        path: Target; its folder must exist. It appears only when it is complete.
        frames: Frames (H, W, 3) of one size, at least one.
        fps: Frames per second; the format rounds a frame to hundredths of a second.
        scale: Factor on both sides of a frame.

    Raises:
        ValueError: There is no frame.
    """
    path = path_of("path", path)
    first, frames = _begun(frames)
    size = (round(first.shape[1] * scale), round(first.shape[0] * scale))
    palette = Image.fromarray(first).quantize(GIF_COLOURS)
    images = [
        Image.fromarray(frame)
        .resize(size, Image.Resampling.BOX)
        .quantize(palette=palette, dither=Image.Dither.NONE)
        for frame in frames
    ]
    part = path.with_name(f".part-{path.name}")
    images[0].save(
        part,
        format="GIF",
        save_all=True,
        append_images=images[1:],
        duration=round(1000.0 / fps),
        loop=0,
        optimize=False,
    )
    os.replace(part, path)


def _begun(frames: Iterable[Frame]) -> tuple[Frame, Iterator[Frame]]:
    """The first frame, and all of them."""
    rest = iter(frames)
    first = next(rest, None)
    if first is None:
        raise ValueError("an animation needs at least one frame")
    return first, itertools.chain([first], rest)
