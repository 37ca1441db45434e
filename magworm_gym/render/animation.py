"""Animations: frames into mp4 and gif files, several robots stacked on one time axis."""

import itertools
from collections.abc import Iterable, Iterator, Sequence
from os import PathLike
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from magworm_gym.arguments import path_of
from magworm_gym.atomic_files import replace_file

Frame = NDArray[np.uint8]

SEPARATOR_PX = 2
SEPARATOR_GREY = 120
GIF_COLOURS = 64


def joined(panels: Sequence[Frame], axis: Literal[0, 1]) -> Frame:
    """Puts frames (H_i, W_i, 3) under (axis 0) or beside (1) each other, with a line between them."""
    shape = list(panels[0].shape)
    shape[axis] = SEPARATOR_PX
    line = np.full(shape, SEPARATOR_GREY, dtype=np.uint8)
    return np.concatenate([part for panel in panels for part in (panel, line)][:-1], axis)


def stacked(panels: Sequence[Frame]) -> Frame:
    """Stacks frames of equal width on top of each other, with a line between them.

    Args:
        panels: Frames (H_i, W, 3).

    Returns:
        One frame; its sides are even, as video codecs ask.
    """
    whole = joined(panels, 0)
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
    try:
        import imageio_ffmpeg
    except ImportError as error:
        raise ImportError("mp4 needs imageio-ffmpeg: pip install 'magworm-gym[render]'.") from error
    first, frames = _begun(frames)
    size = (first.shape[1], first.shape[0])
    with replace_file(path_of("path", path)) as part:
        writer = imageio_ffmpeg.write_frames(str(part), size, fps=fps, quality=7, macro_block_size=2)
        writer.send(None)
        try:
            for frame in frames:
                writer.send(np.ascontiguousarray(frame))
        finally:
            writer.close()


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
    first, frames = _begun(frames)
    size = (round(first.shape[1] * scale), round(first.shape[0] * scale))
    palette = Image.fromarray(first).quantize(GIF_COLOURS)
    images = [
        Image.fromarray(frame)
        .resize(size, Image.Resampling.BOX)
        .quantize(palette=palette, dither=Image.Dither.NONE)
        for frame in frames
    ]
    with replace_file(path_of("path", path)) as part:
        images[0].save(
            part,
            format="GIF",
            save_all=True,
            append_images=images[1:],
            duration=round(1000.0 / fps),
            loop=0,
            optimize=False,
        )


def _begun(frames: Iterable[Frame]) -> tuple[Frame, Iterator[Frame]]:
    """The first frame, and all of them."""
    rest = iter(frames)
    first = next(rest, None)
    if first is None:
        raise ValueError("an animation needs at least one frame")
    return first, itertools.chain([first], rest)
