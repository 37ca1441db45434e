"""Maps of verdicts over two axes."""

from collections.abc import Sequence
from typing import Any

from studies.paper.figures import INK, RED, panels
from studies.stability.axes import CROSSED, Axis
from studies.stability.cases import INTEGRATORS, VERDICTS, Outcome

COLOURS = {"accurate": "#5aa67c", "stable": "#e6c35c", "refused": "#c3cad5", "broken": RED}
HIGH = 0.1
"""An error from here on is written into its field."""


def rod_map(outcomes: Sequence[Outcome]) -> Any:
    """The rod's pairs, a row each, with a column for each scheme."""
    pairs = CROSSED["rod"]
    figure, axes = panels(len(pairs), len(INTEGRATORS), (9.2, 5.6), sharey="row")
    for row, pair in zip(axes, pairs, strict=True):
        for place, integrator in zip(row, INTEGRATORS, strict=True):
            chosen = [o for o in outcomes if _pair(o) == pair and o.case.integrator == integrator]
            _draw(place, pair, chosen)
            place.set_title(integrator)
        for place in row[1:]:
            place.set_ylabel("")
    _legend(figure, axes[0, 0])
    return figure


def robot_map(outcomes: Sequence[Outcome]) -> Any:
    """The robot's pairs under the default scheme."""
    pairs = CROSSED["robot"]
    figure, axes = panels(2, len(pairs) // 2, (9.2, 6.2))
    for place, pair in zip(axes.flat, pairs, strict=True):
        _draw(place, pair, [outcome for outcome in outcomes if _pair(outcome) == pair])
    _legend(figure, axes[0, 0])
    return figure


def _pair(outcome: Outcome) -> tuple[Axis, ...]:
    return tuple(axis for axis, _ in outcome.case.settings)


def _draw(place: Any, pair: tuple[Axis, Axis], outcomes: Sequence[Outcome]) -> None:
    across, up = pair
    for outcome in outcomes:
        (_, a), (_, b) = outcome.case.settings
        x, y = across.values.index(a), up.values.index(b)
        place.bar(x, 0.94, 0.94, y - 0.47, color=COLOURS[outcome.verdict])
        if outcome.verdict == "stable" and outcome.error >= HIGH:
            text = f"{100 * outcome.error:.0f}" if outcome.error < 10 else ">"
            place.text(x, y, text, ha="center", va="center", fontsize=5.5, color=INK)
    for axis, name in ((across, "x"), (up, "y")):
        places = range(len(axis.values))
        getattr(place, f"set_{name}ticks")(places, [f"{value:g}" for value in axis.values], fontsize=7)
        getattr(place, f"set_{name}label")(axis.title)
    place.tick_params(axis="x", rotation=45)
    place.grid(visible=False)


def _legend(figure: Any, place: Any) -> None:
    for verdict in VERDICTS:
        place.bar(0, 0, color=COLOURS[verdict], label=verdict)
    handles, labels = place.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper left", ncols=len(VERDICTS), frameon=False, fontsize=8.5)
