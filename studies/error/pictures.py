"""Figures of the page: the error along each value that is varied, and one that is set against cost."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

from matplotlib.ticker import NullFormatter

from studies.error.case import Case
from studies.error.rows import Row, pareto, priced, wall_s
from studies.error.settings import INTEGRATORS
from studies.kit.figures import COLOURS, INK, WIDTH_IN, legend_above, legend_beside, panels

LABELS = {
    "step": "step [ms]",
    "elements": "elements",
    "order": "order of the quadrature, 0: dipoles",
    "interval": "steps of a wrench",
    "precision": "step [ms], single precision",
}
LEAST = 1e-4
"""What is less is drawn here."""
MOST_TICKS = 6


def figure_of(case: Case, rows: Sequence[Row]) -> Any:
    """Errors of the pose, or of the figure that is ranked, along each axis; last that one against cost.

    What is its own reference has no error to draw.
    """
    names = list(dict.fromkeys(axis.name for axis in case.axes))
    high = math.ceil((len(names) + 1) / 3)
    wide = math.ceil((len(names) + 1) / high)
    figure, axes = panels(high, wide, (WIDTH_IN, 3.0 * high), squeeze=False)
    followed = "pose" if any(row.error.figure == "pose" for row in rows) else case.ranked
    drawn = [
        row for row in rows if row.part in names and row.error.figure == followed and row.error.size > 0.0
    ]
    shown = [max(row.error.shown, LEAST) for row in drawn]
    for name, panel in zip(names, axes.flat, strict=False):
        draw_axis(name, [row for row in drawn if row.part == name], panel)
        panel.set_ylim(0.5 * min(shown), 2.0 * max(shown))
    draw_front(priced(rows, case.ranked), axes.flat[len(names)])
    legend_above(figure, axes.flat[len(names)], columns=5)
    return figure


def draw_axis(name: str, rows: Sequence[Row], panel: Any) -> None:
    """Errors of one figure along an axis."""
    lines: dict[str, list[Row]] = {}
    for row in rows:
        lines.setdefault(line_of(name, row), []).append(row)
    for words, line in lines.items():
        places = [value_on(name, row) for row in line]
        panel.plot(places, [max(row.error.shown, LEAST) for row in line], marker="o", label=words)
    finish(panel, LABELS[name], rows[0], "linear" if name == "order" else "log")
    values = sorted({value_on(name, row) for row in rows})
    if len(values) > MOST_TICKS:
        values = [value for value in values if math.log10(value).is_integer()]
    panel.set_xticks(values, [f"{value:g}" for value in values])
    if len(lines) > 1:
        legend_beside(panel)


def value_on(axis: str, row: Row) -> float:
    """Where a row stands on an axis."""
    settings = row.settings
    values = {"elements": settings.elements, "order": settings.order, "interval": settings.interval}
    return values.get(axis, settings.step_ms)


def line_of(axis: str, row: Row) -> str:
    """What sets the lines apart on an axis."""
    settings = row.settings
    words = {"interval": f"{settings.step_ms:g} ms", "precision": f"{settings.precision} precision"}
    return words.get(axis, INTEGRATORS[settings.integrator])


def draw_front(rows: Sequence[Row], panel: Any) -> None:
    """Errors against cost, with the front: a colour for each mesh, see the page for shapes."""
    meshes = sorted({row.settings.elements for row in rows})
    for single, held, mesh in sorted({kind_of(row) for row in rows}):
        panel.plot(
            *against_cost(row for row in rows if kind_of(row) == (single, held, mesh)),
            "s" if single else "o",
            color=COLOURS[meshes.index(mesh) % len(COLOURS)],
            markerfacecolor="none" if held else None,
            label=None if held or single else f"{mesh} elements",
        )
    panel.plot(*against_cost(pareto(rows)), "-", color=INK, lw=0.8)
    finish(panel, "robot-seconds per second of a core", rows[0], "log")


def kind_of(row: Row) -> tuple[bool, bool, int]:
    """What sets the points of a front apart: single precision, held wrenches, the mesh."""
    settings = row.settings
    return settings.precision == "single", settings.interval > 1, settings.elements


def against_cost(rows: Iterable[Row]) -> tuple[list[float], list[float]]:
    """Robot-seconds a second, and errors."""
    points = [(1.0 / wall_s(row), row.error.shown) for row in rows]
    return [speed for speed, _ in points], [error for _, error in points]


def finish(panel: Any, label: str, row: Row, scale: str) -> None:
    """Words of the axes, and numbers at whole powers of ten alone."""
    panel.set(xlabel=label, ylabel=f"error of the {row.error.figure} [{row.error.unit}]")
    panel.set(xscale=scale, yscale="log")
    for axis in (panel.xaxis, panel.yaxis):
        axis.set_minor_formatter(NullFormatter())
