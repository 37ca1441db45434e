"""One look for all figures of the page."""

from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

from matplotlib import pyplot as plt
from PIL import Image

from magworm_gym.render import palette


def colour(red_green_blue: palette.Colour) -> str:
    """A colour of the side view as matplotlib takes it."""
    return "#{:02x}{:02x}{:02x}".format(*red_green_blue)


BLUE, RED, TEAL = colour(palette.SOUTH), colour(palette.NORTH), colour(palette.TRAIL_NEW)
ORANGE, VIOLET = "#c97a1e", "#7a5ca8"
INK, FAINT = colour(palette.TEXT), colour(palette.PLATE)
PAPER = "#111111"
"""The paper's figures: black marks and broken lines."""

BY_MAGNETS = {3: BLUE, 4: ORANGE, 5: TEAL}
"""Robots."""
BY_PLACE = {"head": TEAL, "middle": ORANGE, "tail": BLUE}
"""Magnets of the robot with three."""

DOTS_PER_INCH = 140
SHADES = 128
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
    """A figure and its axes, as ``matplotlib.pyplot.subplots`` gives them.

    Args:
        rows: Rows of axes.
        columns: Columns of axes.
        size: Width and height [inch].
        **options: Handed on.
    """
    with mpl.rc_context(STYLE):
        return plt.subplots(rows, columns, figsize=size, layout="constrained", **options)


def legend_above(figure: Any, axes: Any, columns: int = 4) -> None:
    """Puts the legend of axes over the whole figure, where it covers no data."""
    handles, labels = axes.get_legend_handles_labels()
    with mpl.rc_context(STYLE):
        figure.legend(handles, labels, loc="outside upper left", ncols=columns, borderaxespad=0.0)


def legend_beside(axes: Any, place: str = "best") -> None:
    """Puts a legend inside axes that leave room for it."""
    with mpl.rc_context(STYLE):
        axes.legend(loc=place)


def paper_mark(axes: Any, x: float, y: float, label: str | None) -> None:
    """A number of the paper at a place of the axes."""
    axes.plot([x], [y], "D", color=PAPER, ms=5.5, mfc="white", mew=1.4, zorder=6, label=label, ls="none")


def save(figure: Any, path: Path) -> None:
    """Writes a figure as a small file, in a palette of its own; equal figures give equal files."""
    drawn = BytesIO()
    with mpl.rc_context(STYLE):
        figure.savefig(drawn, dpi=DOTS_PER_INCH, format="png")
    plt.close(figure)
    picture = Image.open(drawn).convert("RGB").quantize(SHADES, dither=Image.Dither.NONE)
    picture.save(path, optimize=True)
