"""Maps of verdicts over two axes, and bodies that start bent."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording
from studies.kit.figures import BLUE, FAINT, INK, RED, panels
from studies.stability.axes import CROSSED, Axis
from studies.stability.cases import INTEGRATORS, VERDICTS, Outcome
from studies.stability.starts import WATCHED_MS, watched

COLOURS = {"accurate": "#5aa67c", "stable": "#e6c35c", "refused": "#c3cad5", "broken": RED}
HIGH = 0.1
"""An error from here on is written into its field."""

SHOWN = (
    ("rod", "folded over itself"),
    ("rod", "rolled up in three turns"),
    ("rod", "knotted"),
    ("robot", "folded twice"),
    ("robot", "rolled up in two turns"),
    ("robot", "bent and twisted"),
)
"""Bent starts of the picture."""
MAGNET_MM = 6.303


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


def start_strip() -> Any:
    """Bent starts, a row each, and what becomes of them."""
    figure, axes = panels(len(SHOWN), len(WATCHED_MS), (9.2, 9.4))
    for place, time_ms in zip(axes[0], WATCHED_MS, strict=True):
        place.set_title(f"{time_ms:g} ms")
    for row, (body, name) in zip(axes, SHOWN, strict=True):
        record = watched(body, name)
        for place, time_ms in zip(row, WATCHED_MS, strict=True):
            _body(place, record, int(np.abs(record.time_s - time_ms / 1e3).argmin()))
        row[0].set_ylabel(f"{body}:\n{name}", fontsize=8)
    return figure


def _body(place: Any, record: Recording, instant: int) -> None:
    """The centre line from the side, what is nearer over what is further."""
    line = 1e3 * record.nodes[instant]
    depth = line[:, 2] if line.shape[1] == 3 else np.zeros(len(line))
    middles = 0.5 * (depth[1:] + depth[:-1])
    magnets = _magnets(1e3 * record.nodes[0], len(record.magnet_poses[0]))
    for element in np.argsort(middles):
        x, y = line[element : element + 2, 0], line[element : element + 2, 1]
        place.plot(x, y, color="white", linewidth=4.5, solid_capstyle="butt")
        colour, width = (RED, 5.0) if element in magnets else (BLUE, 2.2)
        place.plot(x, y, color=colour, linewidth=width, solid_capstyle="round")
    place.axhline(0.0, color=FAINT, linewidth=1.5, zorder=0)
    middle = line[:, :2].mean(axis=0)
    place.set_xlim(middle[0] - 29.0, middle[0] + 29.0)
    place.set_ylim(-6.0, 50.0)
    place.set_aspect("equal")
    place.grid(visible=False)
    place.set_xticks([])
    place.set_yticks([])
    place.spines[["left", "bottom"]].set_visible(False)


def _magnets(line: NDArray[np.float64], count: int) -> set[int]:
    """The elements that magnets fill: those of their length."""
    lengths = np.linalg.norm(np.diff(line, axis=0), axis=1)
    found = set(np.flatnonzero(np.abs(lengths - MAGNET_MM) < 1e-6).tolist())
    if len(found) != count:
        raise RuntimeError(f"{len(found)} elements are as long as a magnet; the body has {count}")
    return found
