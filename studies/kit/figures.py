"""One look for all figures, small files, and what a figure draws as a fingerprint.

The pixels of a figure differ from one version of matplotlib to the next; what it draws does not. Its
fingerprint is kept in the file, so that a test can tell whether the committed figure is that of the data.
"""

import hashlib
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from cycler import cycler
from matplotlib.figure import Figure
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from magworm_gym.render import palette


def colour(red_green_blue: palette.Colour) -> str:
    """A colour of the side view as matplotlib takes it."""
    return "#{:02x}{:02x}{:02x}".format(*red_green_blue)


BLUE, RED, TEAL = colour(palette.SOUTH), colour(palette.NORTH), colour(palette.TRAIL_NEW)
ORANGE, VIOLET = "#c97a1e", "#7a5ca8"
INK, FAINT = colour(palette.TEXT), colour(palette.PLATE)
REFERENCE = "#111111"
"""What the simulator is compared with: black marks and broken lines."""
COLOURS = (BLUE, ORANGE, TEAL, RED, VIOLET, INK)
"""Of lines that are told apart by colour alone, in this order."""
BY_MAGNETS = {3: BLUE, 4: ORANGE, 5: TEAL}
"""Robots."""
BY_PLACE = {"head": TEAL, "middle": ORANGE, "tail": BLUE}
"""Magnets of the robot with three."""

WIDTH_IN = 9.2
"""Of a figure as wide as a page."""
DOTS_PER_INCH = 140
SHADES = 128
FINGERPRINT = "Fingerprint"
STYLE: dict[Any, Any] = {
    "font.size": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.prop_cycle": cycler(color=COLOURS),
    "grid.color": "#e6eaf0",
    "grid.linewidth": 0.7,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "lines.linewidth": 1.6,
    "lines.markersize": 4.0,
}


def panels(rows: int = 1, columns: int = 1, size: tuple[float, float] = (6.8, 3.6), **options: Any) -> Any:
    """A figure and its axes, as ``matplotlib.pyplot.subplots`` gives them, but owned by nobody else.

    Args:
        rows: Rows of axes.
        columns: Columns of axes.
        size: Width, at most :data:`WIDTH_IN`, and height [inch].
        **options: Handed on.
    """
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=size, layout="constrained")
        return figure, figure.subplots(rows, columns, **options)


def legend_above(figure: Any, axes: Any, columns: int = 4) -> None:
    """Puts the legend of axes over the whole figure, where it covers no data."""
    handles, labels = axes.get_legend_handles_labels()
    with mpl.rc_context(STYLE):
        figure.legend(handles, labels, loc="outside upper left", ncols=columns, borderaxespad=0.0)


def legend_beside(axes: Any, place: str = "best") -> None:
    """Puts a legend inside axes that leave room for it."""
    with mpl.rc_context(STYLE):
        axes.legend(loc=place)


def save(figure: Any, path: Path) -> None:
    """Writes a figure as a small PNG file, in a palette of its own, with its fingerprint."""
    drawn, told = BytesIO(), PngInfo()
    told.add_text(FINGERPRINT, fingerprint(figure))
    with mpl.rc_context(STYLE):
        figure.savefig(drawn, dpi=DOTS_PER_INCH, format="png")
    picture = Image.open(drawn).convert("RGB").quantize(SHADES, dither=Image.Dither.NONE)
    picture.save(path, optimize=True, pnginfo=told)


def kept_fingerprint(path: Path) -> str:
    """The fingerprint in the file of a figure; empty where there is none."""
    with Image.open(path) as picture:
        return str(picture.info.get(FINGERPRINT, ""))


def fingerprint(figure: Any) -> str:
    """A hash of all that a figure draws: lines, areas, points, words, limits and scales of its axes.

    Numbers count with five digits, so that it is the same on all machines.
    """
    return hashlib.sha256("\n".join(_drawn(figure)).encode()).hexdigest()[:16]


def _drawn(figure: Any) -> Iterator[str]:
    for axes in figure.axes:
        yield f"axes {_digits([*axes.get_xlim(), *axes.get_ylim()])} {axes.get_xscale()} {axes.get_yscale()}"
        for line in axes.lines:
            yield f"line {line.get_label()} {line.get_color()} {_digits(line.get_xydata())}"
        for patch in axes.patches:
            outline = patch.get_patch_transform().transform(patch.get_path().vertices)
            yield f"area {_digits(patch.get_facecolor())} {_digits(outline)}"
        for group in axes.collections:
            yield f"group {_digits(group.get_offsets())}"
            yield from (f"path {_digits(path.vertices)}" for path in group.get_paths())
        for picture in axes.images:
            yield f"picture {_digits(picture.get_array())}"
        legend = axes.get_legend()
        texts = [*axes.texts, axes.title, axes.xaxis.label, axes.yaxis.label]
        yield from (text.get_text() for text in [*texts, *(legend.get_texts() if legend else [])])
    yield from (text.get_text() for legend in figure.legends for text in legend.get_texts())


def _digits(values: Any) -> str:
    """Numbers with five digits; beside the greatest of them, what is only rounding is zero."""
    numbers = np.ravel(np.ma.filled(np.asarray(values, np.float64), np.nan))
    rounding = 1e-9 * np.nanmax(np.abs(numbers), initial=0.0)
    return " ".join(f"{number:.5g}" for number in np.where(np.abs(numbers) < rounding, 0.0, numbers) + 0.0)
