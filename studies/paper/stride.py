"""Stride against the speed of the drive, for robots with three, four and five magnets."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from studies.paper.figures import BY_MAGNETS, FAINT, PAPER, legend_above, panels, paper_mark
from studies.paper.passes import AHEADS_M, FRICTIONS, PASSES, Walk, measured_strides
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import ROBOT, SIMULATION, robot
from studies.paper.section import Image, Section
from studies.paper.wording import COUNTS, listed, ranking, trend

Floats = NDArray[np.float64]

PLATFORM_MM_S = 210.0
"""Paper: the platform's limit."""
SLOW_MM_S, PEAK_MM_S, CROSSING_MM_S = 65.0, 110.0, 150.0
"""Paper: strides are equal below, three magnets peak at, five win above."""
PAPER_PEAK_MM, PAPER_FIVE_MM = 4.3, 6.0
GRID_MM_S = 10.0
SPEEDS_MM_S = np.concatenate([np.arange(20.0, 211.0, GRID_MM_S), np.arange(240.0, 401.0, 40.0)])
BACKWARD = "four, backward"
IMAGES = {ROBOT: "stride", SIMULATION: "stride-simulation"}
FITTED = frozenset(
    {"slow", "three_peak", "three_peak_speed", "three_change", "five_change", "five_fast", "lead_slow"}
    | {"lead_fast", "crossing"}
)
"""Rows that the robot's identification knows, read more loosely; it knows nothing of four magnets."""


@dataclass(frozen=True)
class Curve:
    """Stride against speed.

    Attributes:
        mean: Stride at each of the speeds (S,) [mm].
        spread: Its standard deviation (S,) [mm].
        carried: Share of the conditions in which the drive carried the robot along (S,).
        length: Length of the robot [mm].
    """

    mean: Floats
    spread: Floats
    carried: Floats
    length: float

    def at(self, speed_mm_s: float) -> float:
        """Stride at the nearest speed [mm]."""
        return float(self.mean[np.abs(SPEEDS_MM_S - speed_mm_s).argmin()])


def within(low_mm_s: float, high_mm_s: float = PLATFORM_MM_S) -> NDArray[np.bool_]:
    """Which speeds lie in a range (S,)."""
    return np.asarray((low_mm_s <= SPEEDS_MM_S) & (high_mm_s >= SPEEDS_MM_S))


def measured_curves(family: str) -> dict[str, Curve]:
    """Curves of all robots with the parameters of a preset, by name."""
    robots = {COUNTS[count]: (robot(count, family), False) for count in BY_MAGNETS}
    robots[BACKWARD] = (robot(4, family), True)
    walks = [Walk(scene, 1e-3 * v, back) for scene, back in robots.values() for v in SPEEDS_MM_S]
    strides = measured_strides(walks)
    rows = [(MM * stride.mean_m, MM * stride.spread_m, stride.carried) for stride in strides]
    table = np.array(rows).reshape(len(robots), len(SPEEDS_MM_S), 3)
    return {
        name: Curve(columns[:, 0], columns[:, 1], columns[:, 2], MM * scene.body_length_m)
        for (name, (scene, _)), columns in zip(robots.items(), table, strict=True)
    }


def stride_section() -> Section:
    """Runs the sweep with each family of presets."""
    curves = {family: measured_curves(family) for family in (ROBOT, SIMULATION)}
    count = PASSES * len(AHEADS_M) * len(FRICTIONS)
    text = (
        "The paper measured these curves with its robots; its figures are those of an experiment. Drive "
        f"magnets 300 mm apart pass one by one; a stride is the mean of {count} passes: {COUNTS[PASSES]} in "
        f"a row, from {COUNTS[len(AHEADS_M)]} starts, with static friction changed by −2, 0 and +2 %. Bars "
        "are the standard deviation. A run in which the drive carries the robot along, by more than 20 mm "
        f"in a pass, counts up to then. Speeds beyond {PLATFORM_MM_S:g} mm/s are out of reach of the paper's "
        "platform.\n\n"
    )
    text += "\n\n".join(_text(family, found) for family, found in curves.items())
    quantities = [q for family, found in curves.items() for q in _quantities(family, found)]
    images = [
        Image(
            IMAGES[family],
            f"Stride and stride over body length against the speed of the drive, parameters of `{family}`. "
            "Diamonds: the paper's numbers; shaded: beyond its platform.",
            _figure(found),
        )
        for family, found in curves.items()
    ]
    data = {
        family: {
            name: {"mean_mm": c.mean.tolist(), "spread_mm": c.spread.tolist(), "carried": c.carried.tolist()}
            for name, c in found.items()
        }
        for family, found in curves.items()
    }
    data["speed_mm_s"] = SPEEDS_MM_S.tolist()
    return Section("Stride against the speed of the drive", text, images, quantities, data)


def crossing_mm_s(three: Curve, five: Curve) -> float:
    """Lowest speed on the platform from which on five magnets beat three; infinite if there is none."""
    shown = within(0.0)
    above = five.mean[shown] > three.mean[shown]
    losing = np.flatnonzero(~above)
    first = 0 if len(losing) == 0 else int(losing[-1]) + 1
    return float(SPEEDS_MM_S[shown][first]) if first < len(above) else float("inf")


def slow_spread_percent(curves: Mapping[str, Curve]) -> float:
    """How much longer the longest of the three strides is than the shortest below 65 mm/s [%]."""
    slow = within(0.0, SLOW_MM_S)
    means = [float(curves[COUNTS[count]].mean[slow].mean()) for count in BY_MAGNETS]
    return 100.0 * (max(means) / min(means) - 1.0) if min(means) > 0.0 else float("inf")


def _quantities(family: str, curves: Mapping[str, Curve]) -> list[Quantity]:
    three, four, five, back = (curves[name] for name in ("three", "four", "five", BACKWARD))
    key, mark = ("stride", "") if family == ROBOT else ("stride_simulation", f", {family}")
    on, slow, fast = within(0.0), within(0.0, CROSSING_MM_S - 1.0), within(CROSSING_MM_S + 1.0)
    top = int(three.mean[on].argmax())
    lead_slow = float((three.mean - np.maximum(four.mean, five.mean))[slow].mean())
    lead_fast = float((five.mean - np.maximum(three.mean, four.mean))[fast].mean())
    ways = float(np.abs(four.mean - back.mean)[on].mean())
    falling = (-np.inf, -1e-9)

    def held(name: str, what: str, unit: str, model: float, **more: Any) -> Quantity:
        own = family == ROBOT
        origin = Origin.FITTED if own and name in FITTED else Origin.HELD_BACK
        what = f"Stride{mark}: {what}"
        return Quantity(f"{key}.{name}", what, unit, float(model), origin, listed=own, **more)

    return [
        held(
            "slow",
            "longest over shortest of 3, 4, 5 below 65 mm/s",
            "%",
            slow_spread_percent(curves),
            claim="nearly equal (read as within 20 %)",
            holds=(0.0, 20.0),
            digits=0,
        ),
        held(
            "three_peak",
            "longest of three magnets",
            "mm",
            three.mean[on][top],
            paper=PAPER_PEAK_MM,
            spread=float(three.spread[on][top]),
        ),
        held(
            "three_peak_speed",
            "three are best at",
            "mm/s",
            SPEEDS_MM_S[on][top],
            paper=PEAK_MM_S,
            spread=GRID_MM_S,
            digits=0,
        ),
        held(
            "three_change",
            "three, change from 110 to 210 mm/s",
            "mm",
            three.at(210.0) - three.at(110.0),
            claim="falls (below 0)",
            holds=falling,
        ),
        held(
            "four_change",
            "four, change from 110 to 210 mm/s",
            "mm",
            four.at(210.0) - four.at(110.0),
            claim="falls (below 0)",
            holds=falling,
        ),
        held(
            "five_change",
            "five, change from 110 to 210 mm/s",
            "mm",
            five.at(210.0) - five.at(110.0),
            claim="rises (above 0)",
            holds=(1e-9, np.inf),
        ),
        held(
            "five_fast",
            "five at 210 mm/s",
            "mm",
            five.at(210.0),
            paper=PAPER_FIVE_MM,
            spread=float(five.spread[on][-1]),
        ),
        held(
            "lead_slow",
            "lead of three below 150 mm/s, mean",
            "mm",
            lead_slow,
            claim="three are best (above 0)",
            holds=(1e-9, np.inf),
        ),
        held(
            "lead_fast",
            "lead of five above 150 mm/s, mean",
            "mm",
            lead_fast,
            claim="five are best (above 0)",
            holds=(1e-9, np.inf),
        ),
        held(
            "crossing",
            "five lead three from",
            "mm/s",
            crossing_mm_s(three, five),
            paper=CROSSING_MM_S,
            spread=GRID_MM_S,
            digits=0,
        ),
        held(
            "stall",
            "three at 210 mm/s, of their best",
            "%",
            100.0 * three.at(210.0) / three.mean[on][top],
            claim="stall (read as below half)",
            holds=(-np.inf, 50.0),
            digits=0,
        ),
        held(
            "direction",
            "four, difference of forward and backward, mean",
            "mm",
            ways,
            claim="different (read as above 0.1 mm)",
            holds=(0.1, np.inf),
        ),
    ]


def _text(family: str, curves: Mapping[str, Curve]) -> str:
    orders = [
        f"{ranking({name: curve.at(speed) for name, curve in curves.items() if name != BACKWARD})} at "
        f"{speed:g} mm/s"
        for speed in (60.0, 110.0, 160.0, 210.0)
    ]
    lines = [f"- **{name}**: {_course(curve)}" for name, curve in curves.items()]
    robots = ", ".join(f"`paper-{count}`" for count in BY_MAGNETS)
    title = robots if family == ROBOT else f"`{family}`, and the same with four and five magnets"
    return f"{title}:\n\n" + "\n".join(lines) + f"\n- Order: {listed(orders)}."


def _course(curve: Curve) -> str:
    """A sentence on how the stride changes with the speed on the platform."""
    on = within(0.0)
    mean, speeds = curve.mean[on], SPEEDS_MM_S[on]
    scale = float(np.abs(mean).max())
    parts = (within(0.0, SLOW_MM_S), within(SLOW_MM_S, PEAK_MM_S), within(PEAK_MM_S))
    below, between, above = (trend(curve.mean[part], scale) for part in parts)
    sentences = (
        f"{number(mean[0], 2)} mm at 20, {number(curve.at(110.0), 2)} at 110, {number(curve.at(210.0), 2)} "
        f"at 210 mm/s; longest {number(float(mean.max()), 2)} mm at {speeds[mean.argmax()]:g} mm/s. It "
        f"{below} below 65 mm/s, {between} up to 110 mm/s and {above} from there to 210 mm/s."
    )
    if (mean < 0.0).any():
        backward = listed([f"{speed:g}" for speed in speeds[mean < 0.0]])
        sentences += (
            f" At {backward} mm/s it moves with the drive, at worst {number(float(mean.min()), 1)} mm a pass."
        )
    if curve.carried[on].any():
        places = zip(speeds, curve.carried[on], strict=True)
        shares = listed(
            [f"{100.0 * share:.0f} % of the runs at {speed:g} mm/s" for speed, share in places if share]
        )
        sentences += f" The drive carries it along in {shares}."
    return sentences


def _figure(curves: Mapping[str, Curve]) -> Any:
    figure, axes = panels(1, 2, (9.2, 3.9))
    shades = {COUNTS[count]: shade for count, shade in BY_MAGNETS.items()} | {BACKWARD: BY_MAGNETS[4]}
    for axis, normalised in zip(axes, (False, True), strict=True):
        for name, curve in curves.items():
            scale = curve.length if normalised else 1.0
            style = {"ls": "--", "marker": "s", "mfc": "white"} if name == BACKWARD else {"marker": "o"}
            label = f"{name.replace(',', ' magnets,')}" if name == BACKWARD else f"{name} magnets"
            axis.errorbar(
                SPEEDS_MM_S,
                curve.mean / scale,
                curve.spread / scale,
                color=shades[name],
                ms=3.5,
                lw=1.3,
                elinewidth=0.9,
                label=label,
                **style,
            )
        three, five = (curves[name].length if normalised else 1.0 for name in ("three", "five"))
        paper_mark(axis, PEAK_MM_S, PAPER_PEAK_MM / three, "paper, experiment")
        paper_mark(axis, PLATFORM_MM_S, PAPER_FIVE_MM / five, None)
        axis.axvspan(PLATFORM_MM_S, SPEEDS_MM_S[-1] + 10.0, color=FAINT, alpha=0.35, lw=0)
        axis.axhline(0.0, color=PAPER, lw=0.6)
        axis.set_xlim(0.0, SPEEDS_MM_S[-1] + 10.0)
        axis.set_xlabel("speed of the drive [mm/s]")
        axis.annotate(
            "three",
            (PEAK_MM_S, PAPER_PEAK_MM / three),
            (0, -13),
            textcoords="offset points",
            fontsize=7.5,
            ha="center",
        )
        axis.annotate(
            "five", (PLATFORM_MM_S, PAPER_FIVE_MM / five), (7, -3), textcoords="offset points", fontsize=7.5
        )
    axes[0].set_ylabel("stride [mm]")
    axes[1].set_ylabel("stride / body length")
    legend_above(figure, axes[0], 5)
    return figure
