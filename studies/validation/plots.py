"""Figures of the cases, equal byte for byte from run to run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

STYLE: Any = {
    "svg.hashsalt": "magworm",
    "font.size": 9,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "0.9",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
}
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
MARKERS = ("o", "s", "^", "D")
# More points than this are drawn as a line.
MANY_POINTS = 120


def draw(figure: dict[str, Any], path: Path) -> None:
    """Writes a figure as SVG."""
    with plt.rc_context(STYLE):
        canvas, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
        points = [curve for curve in figure["curves"] if not curve["exact"]]
        for curve in figure["curves"]:
            if curve["exact"]:
                label = curve["label"] or None
                axes.plot(curve["x"], curve["y"], color="0.25", linewidth=1, label=label, zorder=2)
        for curve, look in zip(points, _looks(points, figure["axes"]), strict=True):
            axes.plot(curve["x"], curve["y"], label=curve["label"], zorder=3, **look)
        _set_scales(axes, figure, points)
        axes.set(xlabel=figure["x"], ylabel=figure["y"], title=figure["title"])
        _place_legend(axes, points)
        canvas.savefig(path, format="svg", metadata={"Date": None, "Creator": None})
        plt.close(canvas)


def _looks(curves: list[dict[str, Any]], scales: str) -> list[dict[str, Any]]:
    """One colour for what stands before the first comma of a label, one marker for the rest."""
    firsts, rests = [], []
    looks = []
    for curve in curves:
        first, _, rest = curve["label"].partition(", ")
        firsts += [first] if first not in firsts else []
        rests += [rest] if rest not in rests else []
        colour, kind = COLOURS[firsts.index(first) % len(COLOURS)], rests.index(rest) % len(MARKERS)
        look: dict[str, Any] = {"color": colour, "markersize": 4}
        if len(curve["x"]) > MANY_POINTS:
            look |= {"linewidth": 0.6}
        elif scales == "log-log":
            look |= {"marker": MARKERS[kind], "linestyle": ("-", ":")[kind % 2], "linewidth": 1}
            look |= {"markerfacecolor": (colour, "white")[kind % 2]}
        else:
            look |= {"marker": MARKERS[kind], "linestyle": ""}
        looks.append(look)
    return looks


def _place_legend(axes: Any, points: list[dict[str, Any]]) -> None:
    """Beside the axes where it would hide points."""
    crowded = len(points) > 4 or any(len(curve["x"]) > MANY_POINTS for curve in points)
    place = {"loc": "center left", "bbox_to_anchor": (1, 0.5)} if crowded else {}
    legend = axes.legend(fontsize=8, **place)
    for line in legend.get_lines():
        line.set_linewidth(1.2)


def _set_scales(axes: Any, figure: dict[str, Any], points: list[dict[str, Any]]) -> None:
    if figure["axes"] == "equal":
        axes.set_aspect("equal")
    if figure["axes"] != "log-log":
        return
    axes.set_xscale("log")
    axes.set_yscale("log")
    ticks = sorted({x for curve in points for x in curve["x"]})
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    if (slope := figure.get("slope")) is not None:
        # Above all curves, from the end where it is highest.
        start = ticks[0] if slope < 0 else ticks[-1]
        height = 1.6 * max(max(curve["y"]) for curve in points)
        line = [height * (tick / start) ** slope for tick in ticks]
        label = f"slope {slope:g}".replace("-", "−")
        axes.plot(ticks, line, color="0.5", linestyle="--", linewidth=1, label=label, zorder=1)
