"""Figures of the turning map."""

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.ticker import MaxNLocator

from studies.kit.figures import BY_MAGNETS, COLOURS, REFERENCE, STYLE, WIDTH_IN, legend_above, panels
from studies.kit.words import capital, in_words, plain
from studies.turning.findings import MEASURES, of
from studies.turning.passes import TIPPED_DEG, Tipping
from studies.turning.points import Point
from studies.turning.sweeps import HEIGHTS_MM, ROBOTS, TIPPING_OFFSETS_MM

OVER_DEG = 95.0
"""Where a foot is drawn that lies over: how far beyond 90° means nothing."""
LEVELS_DEG = (0.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 180.0)
FEET = {"attracted": "o-", "repelled": "s--"}
"""Feet in turn, from the head on, and how they are drawn."""
HIGH_IN = 3.3
OFFSET = "offset of the drive [mm]"


def per_pass(
    points: Sequence[Point], field: str, label: str, offsets: Sequence[float | None] = (None,)
) -> Any:
    """Yaw, side-step and stride against one property of the drive, in a row for each offset."""
    size = (WIDTH_IN, HIGH_IN + 2.5 * (len(offsets) - 1))
    figure, rows = panels(len(offsets), len(MEASURES), size, sharex=True, squeeze=False)
    for row, offset in zip(rows, offsets, strict=True):
        here = [point for point in points if offset in (None, point.drive.offset_mm)]
        for axis, measure in zip(row, MEASURES, strict=True):
            curves(axis, here, field, measure)
        if offset is not None:
            row[0].set_title(f"offset {offset:g} mm")
    for axis in rows[-1]:
        axis.set_xlabel(label)
        axis.xaxis.set_major_locator(MaxNLocator(8, steps=(1, 1.5, 2, 3, 5), integer=True))
    legend_above(figure, rows[-1, 0])
    return figure


def curves(axis: Any, points: Sequence[Point], field: str, measure: str) -> None:
    """Means and ranges of each robot; white where some neighbours are left out, a cross where all are."""
    for row, count in enumerate(ROBOTS):
        here, colour = of(points, count), BY_MAGNETS[count]
        places = np.array([getattr(point.drive, field) for point in here])
        mean, low, high = np.array([getattr(point, measure) for point in here]).reshape(-1, 3).T
        axis.fill_between(places, low, high, color=colour, alpha=0.18, lw=0)
        axis.plot(places, mean, "o-", color=colour, ms=3.5, lw=1.3, label=f"{in_words(count)} magnets")
        some = np.array([0 < point.kept < point.passes for point in here], bool)
        axis.plot(places[some], mean[some], "o", color=colour, ms=5.0, mfc="white", zorder=5)
        # Height 1 is the upper edge of the axes: there a point without a value has a mark of its own.
        gone = places[[point.kept == 0 for point in here]]
        edge = axis.get_xaxis_transform()
        axis.plot(gone, 0 * gone + 0.97 - 0.05 * row, "x", color=colour, ms=5.0, transform=edge, zorder=5)
    axis.axhline(0.0, color=REFERENCE, lw=0.6)
    axis.margins(y=0.22)
    what, unit = MEASURES[measure]
    axis.set_ylabel(f"{what} per pass [{unit}]")


def roll_against_offset(points: Sequence[Point]) -> Any:
    """Greatest roll of attracted and of repelled feet."""
    figure, axes = panels(1, len(ROBOTS), (WIDTH_IN, HIGH_IN), sharey=True)
    for axis, count in zip(axes, ROBOTS, strict=True):
        here = of(points, count)
        offsets = [point.drive.offset_mm for point in here]
        for foot in sorted(range(count), key=lambda foot: foot % 2):
            kind = list(FEET)[foot % 2]
            rolls = [min(point.roll_deg[foot], OVER_DEG) for point in here]
            style = {"color": COLOURS[foot], "ms": 3.0, "lw": 1.2}
            axis.plot(offsets, rolls, FEET[kind], label=f"foot {foot + 1}, {kind}", **style)
        axis.axhline(TIPPED_DEG, color=REFERENCE, lw=0.8, ls=":")
        axis.set(title=f"{capital(in_words(count))} magnets", xlabel=OFFSET)
        axis.set(xticks=range(0, 16, 3), yticks=range(0, 91, 15), ylim=(-3.0, OVER_DEG + 3.0))
    axes[0].set_ylabel("greatest roll in the pass [°]")
    legend_above(figure, axes[-1], 5)
    return figure


def tipping_map(passes: Sequence[Tipping]) -> Any:
    """Greatest roll of any foot over height and offset of the drive, one panel a robot."""
    figure, axes = panels(1, len(ROBOTS), (WIDTH_IN, HIGH_IN), sharey=True)
    colours = mpl.colormaps["YlOrRd"].resampled(len(LEVELS_DEG) - 1)
    norm = BoundaryNorm(LEVELS_DEG, colours.N)
    for axis, count in zip(axes, ROBOTS, strict=True):
        rolls = [each.rolls for each in passes if each.drive.magnets == count]
        grid = np.array([max(each.roll_deg) for each in rolls]).reshape(len(HEIGHTS_MM), -1)
        image = axis.imshow(grid, cmap=colours, norm=norm, aspect="auto", interpolation="nearest")
        rows, columns = np.nonzero(np.array([each.overturned for each in rolls]).reshape(grid.shape))
        axis.plot(columns, rows, "x", color="white", ms=4.0)
        axis.grid(False)
        axis.set_xticks(range(len(TIPPING_OFFSETS_MM)), map(plain, TIPPING_OFFSETS_MM), fontsize=7)
        axis.set_yticks(range(len(HEIGHTS_MM)), map(plain, HEIGHTS_MM))
        axis.set(title=f"{capital(in_words(count))} magnets", xlabel=OFFSET)
    axes[0].set_ylabel("height of the drive [mm]")
    with mpl.rc_context(STYLE):
        bar = figure.colorbar(image, ax=list(axes), ticks=LEVELS_DEG, spacing="uniform")
        bar.set_label("greatest roll of a foot [°]")
    return figure
