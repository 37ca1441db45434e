"""Figures of the turning map."""

from collections.abc import Callable, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.ticker import MaxNLocator

from studies.kit.figures import BY_MAGNETS, REFERENCE, STYLE, legend_above, panels
from studies.kit.words import COUNTS, capital
from studies.turning.passes import TIPPED_DEG, Drive, Outcome, Point, Spread
from studies.turning.sweeps import HEIGHTS_MM, OFFSET_MM, ROBOTS, TIPPING_OFFSETS_MM

MEASURES: tuple[tuple[str, Callable[[Point], Spread]], ...] = (
    ("yaw per pass [°]", lambda point: point.yaw_deg),
    ("side-step per pass [mm]", lambda point: point.side_mm),
    ("stride per pass [mm]", lambda point: point.stride_mm),
)
SHADES = ("#1f6f8b", "#c97a1e", "#7a5ca8", "#b03a48", "#3b7d3a")
"""Feet from the head on."""
OVER_DEG = 95.0
"""Where a foot is drawn that lies over: how far beyond 90° means nothing."""
LEVELS_DEG = (0.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 180.0)


def per_pass(points: Sequence[Point], against: Callable[[Drive], float], label: str) -> Any:
    """Yaw, side-step and stride against one property of the drive."""
    figure, axes = panels(1, 3, (10.2, 3.5))
    for axis, (name, measure) in zip(axes, MEASURES, strict=True):
        _curves(axis, points, against, measure)
        axis.set_xlabel(label)
        axis.set_ylabel(name)
        axis.xaxis.set_major_locator(MaxNLocator(8, steps=(1, 2, 3, 5), integer=True))
    legend_above(figure, axes[0], 4)
    return figure


def per_pass_by_offset(points: Sequence[Point]) -> Any:
    """The same against the yaw of the drive: on the line above, beside it below."""
    figure, rows = panels(2, 3, (10.2, 6.2), sharex=True)
    for row, offset in zip(rows, (0.0, OFFSET_MM), strict=True):
        here = [point for point in points if point.drive.offset_mm == offset]
        for axis, (name, measure) in zip(row, MEASURES, strict=True):
            _curves(axis, here, lambda drive: drive.yaw_deg, measure)
            axis.set_ylabel(name)
        row[0].set_title(f"offset {offset:g} mm", fontsize=9)
    for axis in rows[1]:
        axis.set_xlabel("yaw of the drive [°]")
        axis.set_xticks(range(0, 91, 15))
    legend_above(figure, rows[1, 0], 4)
    return figure


def _curves(
    axis: Any,
    points: Sequence[Point],
    against: Callable[[Drive], float],
    measure: Callable[[Point], Spread],
) -> None:
    for count in ROBOTS:
        here = [point for point in points if point.drive.magnets == count]
        places = np.array([against(point.drive) for point in here])
        spreads = [measure(point) for point in here]
        mean = np.array([spread.mean for spread in spreads])
        low, high = (np.array([getattr(spread, side) for spread in spreads]) for side in ("low", "high"))
        colour, name = BY_MAGNETS[count], f"{COUNTS[count]} magnets"
        axis.fill_between(places, low, high, color=colour, alpha=0.18, lw=0)
        axis.plot(places, mean, color=colour, marker="o", ms=3.5, lw=1.3, label=name)
        gone = np.array([point.kept == 0 for point in here])
        some = np.array([0 < point.kept < point.passes for point in here])
        axis.plot(places[some], mean[some], "o", color=colour, ms=5.0, mfc="white", zorder=5)
        # Height 1 is the upper edge of the axes: there a point without a value has a mark of its own.
        level = np.full(int(gone.sum()), 0.97 - 0.05 * ROBOTS.index(count))
        axis.plot(
            places[gone], level, "x", color=colour, ms=5.0, transform=axis.get_xaxis_transform(), zorder=5
        )
    axis.axhline(0.0, color=REFERENCE, lw=0.6)
    axis.margins(y=0.22)


def roll_against_offset(points: Sequence[Point]) -> Any:
    """Greatest roll of attracted and of repelled feet."""
    figure, axes = panels(1, len(ROBOTS), (10.2, 3.5), sharey=True)
    styles = {"attracted": ("-", "o"), "repelled": ("--", "s")}
    for axis, count in zip(axes, ROBOTS, strict=True):
        here = [point for point in points if point.drive.magnets == count]
        offsets = [point.drive.offset_mm for point in here]
        for first, kind in enumerate(styles):
            line, marker = styles[kind]
            for place in range(first, count, 2):
                axis.plot(
                    offsets,
                    [min(point.roll_deg[place], OVER_DEG) for point in here],
                    color=SHADES[place],
                    ls=line,
                    marker=marker,
                    ms=3.0,
                    lw=1.2,
                    label=f"foot {place + 1}, {kind}",
                )
        axis.axhline(TIPPED_DEG, color=REFERENCE, lw=0.8, ls=":")
        axis.set_title(f"{capital(COUNTS[count])} magnets", fontsize=9)
        axis.set_xlabel("offset of the drive [mm]")
        axis.set_xticks(range(0, 16, 3))
        axis.set_ylim(-3.0, OVER_DEG + 3.0)
        axis.set_yticks(range(0, 91, 15))
    axes[0].set_ylabel("greatest roll in the pass [°]")
    legend_above(figure, axes[-1], 5)
    return figure


def tipping_map(drives: Sequence[Drive], found: Sequence[Outcome]) -> Any:
    """Greatest roll of any foot over height and offset of the drive, one panel a robot."""
    figure, axes = panels(1, len(ROBOTS), (10.2, 3.5), sharey=True)
    colours = mpl.colormaps["YlOrRd"].resampled(len(LEVELS_DEG) - 1)
    norm = BoundaryNorm(LEVELS_DEG, colours.N)
    image = None
    for axis, count in zip(axes, ROBOTS, strict=True):
        rolls = [o.roll_deg.max() for d, o in zip(drives, found, strict=True) if d.magnets == count]
        grid = np.array(rolls).reshape(len(HEIGHTS_MM), len(TIPPING_OFFSETS_MM))
        image = axis.imshow(grid, cmap=colours, norm=norm, aspect="auto", interpolation="nearest")
        ends = [o.overturned for d, o in zip(drives, found, strict=True) if d.magnets == count]
        rows, columns = np.nonzero(np.array(ends).reshape(grid.shape))
        axis.plot(columns, rows, "x", color="white", ms=4.0)
        axis.grid(False)
        axis.set_xticks(range(len(TIPPING_OFFSETS_MM)), [f"{o:g}" for o in TIPPING_OFFSETS_MM], fontsize=7)
        axis.set_yticks(range(len(HEIGHTS_MM)), [f"{h:g}".replace("-", "−") for h in HEIGHTS_MM])
        axis.set_title(f"{capital(COUNTS[count])} magnets", fontsize=9)
        axis.set_xlabel("offset of the drive [mm]")
    axes[0].set_ylabel("height of the drive [mm]")
    with mpl.rc_context(STYLE):
        bar = figure.colorbar(image, ax=list(axes), ticks=LEVELS_DEG, spacing="uniform")
        bar.set_label("greatest roll of a foot [°]")
        bar.ax.yaxis.set_major_locator(MaxNLocator(len(LEVELS_DEG)))
        bar.set_ticks(list(LEVELS_DEG))
    return figure
