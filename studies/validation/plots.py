"""Figures of the cases."""

from collections.abc import Sequence
from typing import Any

from studies.kit.figures import COLOURS, REFERENCE, legend_above, panels
from studies.validation.cases import Curve, Figure

MARKERS = ("o", "s", "^", "D")
MANY_POINTS = 120
"""More are drawn as a line."""


def drawn(figure: Figure) -> Any:
    """Draws a figure: the simulator in colour, references in black."""
    canvas, axes = panels()
    points = [curve for curve in figure.curves if not curve.exact]
    for curve in figure.curves:
        if curve.exact:
            axes.plot(curve.x, curve.y, color=REFERENCE, lw=1, label=curve.label or None, zorder=2)
    for curve, look in zip(points, _looks(points, figure.axes), strict=True):
        axes.plot(curve.x, curve.y, label=curve.label, zorder=3, **look)
    if figure.axes == "equal":
        axes.set_aspect("equal")
    if figure.axes == "log-log":
        _make_logarithmic(axes, points, figure.slope)
    axes.set(xlabel=figure.x, ylabel=figure.y)
    legend_above(canvas, axes, 2)
    return canvas


def _looks(curves: Sequence[Curve], scales: str) -> list[dict[str, Any]]:
    """One colour for what stands before the first comma of a label, one marker for the rest."""
    parts = [curve.label.partition(", ") for curve in curves]
    firsts = list(dict.fromkeys(first for first, _, _ in parts))
    rests = list(dict.fromkeys(rest for _, _, rest in parts))
    looks = []
    for curve, (first, _, rest) in zip(curves, parts, strict=True):
        colour, kind = COLOURS[firsts.index(first) % len(COLOURS)], rests.index(rest) % len(MARKERS)
        look: dict[str, Any] = {"color": colour}
        if len(curve.x) > MANY_POINTS:
            look |= {"lw": 0.6}
        elif scales == "log-log":
            look |= {"marker": MARKERS[kind], "ls": ("-", ":")[kind % 2], "lw": 1}
            look |= {"mfc": (colour, "white")[kind % 2]}
        else:
            look |= {"marker": MARKERS[kind], "ls": ""}
        looks.append(look)
    return looks


def _make_logarithmic(axes: Any, points: Sequence[Curve], slope: float | None) -> None:
    ticks = sorted({x for curve in points for x in curve.x})
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    if slope is not None:
        # Above all curves, from the end where it is highest.
        start = ticks[0] if slope < 0 else ticks[-1]
        height = 1.6 * max(max(curve.y) for curve in points)
        line = [height * (tick / start) ** slope for tick in ticks]
        label = f"slope {slope:g}".replace("-", "−")
        axes.plot(ticks, line, color="0.5", ls="--", lw=1, label=label, zorder=1)
