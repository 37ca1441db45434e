"""Figures of the page: errors against each value that is varied, and errors against cost."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.ticker import NullFormatter

from studies.error.case import Case
from studies.error.front import cost_s, pareto, size
from studies.error.measured import Row
from studies.error.settings import INTEGRATORS
from studies.paper.figures import BLUE, INK, ORANGE, RED, TEAL, VIOLET, panels

COLOURS = (BLUE, ORANGE, TEAL, RED, VIOLET)
LABELS = {
    "step": "step [ms]",
    "elements": "elements",
    "order": "order of the quadrature, 0: dipoles",
    "interval": "steps of a wrench",
    "precision": "step [ms]",
}
PERCENT = 100.0


def unit(figure: str) -> str:
    """What errors of a figure are counted in."""
    return "mm" if figure == "pose" else "%"


def scale(figure: str) -> float:
    """From the data to that unit."""
    return 1.0 if figure == "pose" else PERCENT


def value_on(axis: str, row: Row) -> float:
    """Where a row stands on an axis."""
    settings = row.settings
    values = {
        "step": settings.step_ms,
        "elements": settings.elements,
        "order": settings.order,
        "interval": settings.interval,
        "precision": settings.step_ms,
    }
    return values[axis]


def line_of(axis: str, row: Row) -> str:
    """What sets the lines of a figure apart on an axis."""
    settings = row.settings
    words = {"interval": f"{settings.step_ms:g} ms", "precision": f"{settings.precision} precision"}
    return words.get(axis, INTEGRATORS[settings.integrator])


def draw_case(case: Case, rows: Sequence[Row], path: Path) -> None:
    """Errors along each axis, then those of one figure against cost with the front."""
    axes_names = list(dict.fromkeys(axis.name for axis in case.axes))
    figure, axes = panels(1, len(axes_names) + 1, (3.1 * (len(axes_names) + 1), 4.4))
    for name, panel in zip(axes_names, axes, strict=False):
        _draw_axis(name, [row for row in rows if row.part == f"axis {name}"], panel)
    _draw_front(case.ranked, [row for row in rows if row.part == "front"], axes[-1])
    figure.savefig(path, format="png", dpi=140)


def _draw_axis(name: str, rows: Sequence[Row], panel: Any) -> None:
    # What is its own reference has no error to draw.
    drawn = [row for row in rows if row.figure != "broken" and size(row) > 0.0]
    lines: dict[tuple[str, str], list[Row]] = {}
    for row in drawn:
        lines.setdefault((line_of(name, row), row.figure), []).append(row)
    figures = list(dict.fromkeys(figure for _, figure in lines))
    kinds = list(dict.fromkeys(kind for kind, _ in lines))
    for (kind, figure), line in lines.items():
        look = ("-", ":", "--")[kinds.index(kind)]
        words = f"{figure} [{unit(figure)}]"
        panel.plot(
            [value_on(name, row) for row in line],
            [max(scale(figure) * size(row), 1e-4) for row in line],
            look,
            marker="o",
            color=COLOURS[figures.index(figure) % len(COLOURS)],
            label=words if len(kinds) == 1 else f"{words}, {kind}",
        )
    panel.set(xlabel=LABELS[name], ylabel="error", yscale="log")
    values = sorted({value_on(name, row) for row in drawn})
    if name != "order":
        panel.set(xscale="log")
    if name != "step":
        panel.set_xticks(values, [f"{value:g}" for value in values])
    _finish(panel)


def kind_of(row: Row) -> tuple[bool, bool, int]:
    """What sets the points of a front apart: single precision, held wrenches, the mesh."""
    settings = row.settings
    return settings.precision == "single", settings.interval > 1, settings.elements


def _draw_front(ranked: str, rows: Sequence[Row], panel: Any) -> None:
    first = ranked or rows[0].figure
    shown = [row for row in rows if row.figure == first and row.work is not None]
    meshes = sorted({row.settings.elements for row in shown})
    for single, held, mesh in sorted({kind_of(row) for row in shown}):
        points = [row for row in shown if kind_of(row) == (single, held, mesh)]
        panel.plot(
            [1.0 / cost_s(row) for row in points],
            [scale(first) * size(row) for row in points],
            "s" if single else "o",
            color=COLOURS[meshes.index(mesh) % len(COLOURS)],
            markerfacecolor="none" if held else None,
            label=None if held or single else f"{mesh} elements",
        )
    best = pareto(shown)
    panel.plot(
        [1.0 / cost_s(r) for r in best], [scale(first) * size(r) for r in best], "-", color=INK, lw=0.8
    )
    panel.set(xlabel="robot-seconds per second of a core", ylabel=f"error of the {first} [{unit(first)}]")
    panel.set(xscale="log", yscale="log")
    _finish(panel)


def _finish(panel: Any) -> None:
    """Legend below, where it covers nothing, and numbers at whole powers of ten alone."""
    for axis in (panel.xaxis, panel.yaxis):
        axis.set_minor_formatter(NullFormatter())
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), frameon=False, fontsize=8)
