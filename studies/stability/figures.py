"""Maps of verdicts over two axes, and bodies that start bent."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from studies.kit.figures import BLUE, FAINT, INK, RED, WIDTH_IN, legend_above, panels
from studies.kit.words import plain
from studies.stability.axes import CROSSED, Axis
from studies.stability.cases import INTEGRATORS, VERDICTS, Outcome
from studies.stability.postures import SHOWN, WATCHED_MS, Posture

COLOURS = dict(zip(VERDICTS, (BLUE, "#f3d35e", "#a4acb8", RED), strict=True))
"""Told apart by all kinds of colour vision."""
HIGH = 0.1
"""An error from here on is written into its field."""


def rod_map(outcomes: Sequence[Outcome]) -> Any:
    """The rod's pairs, a row each, with a column for each scheme."""
    pairs = CROSSED["rod"]
    figure, axes = panels(len(pairs), len(INTEGRATORS), (WIDTH_IN, 5.6), sharey="row")
    for row, pair in zip(axes, pairs, strict=True):
        for place, integrator in zip(row, INTEGRATORS, strict=True):
            draw(place, "rod", pair, [of for of in outcomes if of.case.integrator == integrator])
            place.set_title(integrator)
        for place in row[1:]:
            place.set_ylabel("")
    legend_above(figure, axes[0, 0])
    return figure


def robot_map(outcomes: Sequence[Outcome]) -> Any:
    """The robot's pairs under the default scheme."""
    pairs = CROSSED["robot"]
    figure, axes = panels(2, len(pairs) // 2, (WIDTH_IN, 6.2))
    for place, pair in zip(axes.flat, pairs, strict=True):
        draw(place, "robot", pair, outcomes)
    legend_above(figure, axes[0, 0])
    return figure


def draw(place: Any, body: str, pair: tuple[Axis, Axis], outcomes: Sequence[Outcome]) -> None:
    """The outcomes of a body on a pair of axes as a map."""
    across, up = pair
    for verdict, colour in COLOURS.items():
        place.bar(0, 0, color=colour, label=verdict)
    for outcome in outcomes:
        case = outcome.case
        if (case.body, case.axis, case.second_axis) == (body, across.title, up.title):
            x, y = across.values.index(case.value), up.values.index(case.second_value or 0.0)
            place.bar(x, 0.94, 0.94, y - 0.47, color=COLOURS[outcome.verdict])
            if outcome.verdict == "stable" and outcome.error >= HIGH:
                text = f"{100 * outcome.error:.0f}" if outcome.error < 10 else ">"
                place.text(x, y, text, ha="center", va="center", fontsize=5.5, color=INK)
    for axis, name in ((across, "x"), (up, "y")):
        getattr(place, f"set_{name}ticks")(range(len(axis.values)), map(plain, axis.values), fontsize=7)
        getattr(place, f"set_{name}label")(axis.title)
    place.tick_params(axis="x", rotation=45)
    place.grid(visible=False)


def start_strip(postures: Sequence[Posture]) -> Any:
    """Bent starts, a row each, and what becomes of them."""
    figure, axes = panels(len(SHOWN), len(WATCHED_MS), (WIDTH_IN, 9.4))
    for place, posture in zip(axes.flat, postures, strict=True):
        draw_body(place, posture)
    for place, time_ms in zip(axes[0], WATCHED_MS, strict=True):
        place.set_title(f"{time_ms:g} ms")
    for place, (body, start) in zip(axes[:, 0], SHOWN, strict=True):
        place.set_ylabel(f"{body}:\n{start}", fontsize=8)
    return figure


def draw_body(place: Any, posture: Posture) -> None:
    """The centre line from the side, what is nearer over what is further."""
    x, y, z = (np.array(places_mm) for places_mm in (posture.x_mm, posture.y_mm, posture.z_mm))
    for element in np.argsort(z[1:] + z[:-1], kind="stable"):
        ends = slice(element, element + 2)
        place.plot(x[ends], y[ends], color="white", linewidth=4.5, solid_capstyle="butt")
        colour, width = (RED, 5.0) if element in posture.magnets else (BLUE, 2.2)
        place.plot(x[ends], y[ends], color=colour, linewidth=width, solid_capstyle="round")
    place.axhline(0.0, color=FAINT, linewidth=1.5, zorder=0)
    place.set(
        xlim=(x.mean() - 29.0, x.mean() + 29.0), ylim=(-6.0, 50.0), xticks=[], yticks=[], aspect="equal"
    )
    place.grid(visible=False)
    place.spines[["left", "bottom"]].set_visible(False)
