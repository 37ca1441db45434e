"""Stride against the speed of the drive, for robots with three, four and five magnets."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from studies.kit.figures import BY_MAGNETS, legend_above, panels
from studies.kit.passes import MM, ROBOT, SIMULATION, Floats, robot
from studies.kit.words import COUNTS, listed, ranking, trend
from studies.paper.experiment import Experiment, Numbers
from studies.paper.marks import PLATFORM_MM_S, WAYS, draw_spread, mark_paper, over_speed
from studies.paper.passes import AHEADS_M, FRICTIONS, PASSES, Strides, Walk, measured_strides
from studies.paper.quantity import AGAIN

SLOW_MM_S, PEAK_MM_S, CROSSING_MM_S = 65.0, 110.0, 150.0
"""Paper: strides are equal below, three magnets peak at, five win above."""
PAPER_PEAK_MM, PAPER_FIVE_MM = 4.3, 6.0
GRID_MM_S = 10.0
SPEEDS_MM_S = np.concatenate([np.arange(20.0, 211.0, GRID_MM_S), np.arange(240.0, 401.0, 40.0)])
BACKWARD = "four, backward"
SHADES = {COUNTS[count]: shade for count, shade in BY_MAGNETS.items()} | {BACKWARD: BY_MAGNETS[4]}
ORDERED_MM_S = (60.0, 110.0, 160.0, 210.0)
"""Speeds at which the page ranks the robots."""
SECTIONS = {ROBOT: "stride", SIMULATION: AGAIN}
"""Sections of ``quantities.toml``."""


@dataclass(frozen=True)
class Curve:
    """Stride of a robot at each of :data:`SPEEDS_MM_S`.

    Attributes:
        strides: The strides (S,).
        length_mm: Length of the robot [mm].
    """

    strides: Strides
    length_mm: float

    @property
    def mean(self) -> Floats:
        """Means (S,) [mm]."""
        return self.strides.mean_mm

    def at(self, speed_mm_s: float) -> float:
        """Stride at the nearest speed [mm]."""
        return float(self.mean[np.abs(SPEEDS_MM_S - speed_mm_s).argmin()])

    @property
    def change(self) -> float:
        """From the paper's best speed of three magnets to the fastest of its platform [mm]."""
        return self.at(PLATFORM_MM_S) - self.at(PEAK_MM_S)

    @property
    def course(self) -> dict[str, Any]:
        """How the stride changes with the speed on the platform, for the page."""
        on = within()
        mean, speeds, carried = self.mean[on], SPEEDS_MM_S[on], self.strides.carried[on]
        parts = (within(0.0, SLOW_MM_S), within(SLOW_MM_S, PEAK_MM_S), within(PEAK_MM_S))
        return {
            "some": [mean[0], self.at(PEAK_MM_S), self.at(PLATFORM_MM_S)],
            "longest": mean.max(),
            "longest_at": speeds[mean.argmax()],
            "trends": [trend(self.mean[part], float(np.abs(mean).max())) for part in parts],
            "backward_at": list(speeds[mean < 0.0]),
            "worst": mean.min(),
            "carried": dict(zip(speeds[carried > 0.0], carried[carried > 0.0], strict=True)),
        }


Curves = Mapping[str, Curve]


def within(low_mm_s: float = 0.0, high_mm_s: float = PLATFORM_MM_S) -> NDArray[np.bool_]:
    """Which speeds lie in a range (S,)."""
    return np.asarray((low_mm_s <= SPEEDS_MM_S) & (high_mm_s >= SPEEDS_MM_S))


@dataclass(frozen=True)
class Stride(Experiment):
    """The sweep with each family of presets.

    Attributes:
        curves: By family, and by name of the robot.
    """

    name: ClassVar[str] = "stride"
    curves: dict[str, dict[str, Curve]]

    @classmethod
    def measured(cls) -> "Stride":
        """Runs all robots at all speeds."""
        return cls({family: measured_curves(family) for family in SECTIONS})

    @property
    def passes(self) -> int:
        """How many are averaged."""
        return PASSES * len(AHEADS_M) * len(FRICTIONS)

    @property
    def orders(self) -> dict[str, str]:
        """How the robots rank at some speeds, by family."""
        return {family: listed(_orders(curves)) for family, curves in self.curves.items()}

    def numbers(self) -> Numbers:
        """What the paper says of the curves, with both families."""
        return {
            f"{SECTIONS[family]}.{name}": value
            for family, curves in self.curves.items()
            for name, value in _numbers(curves).items()
        }

    def figures(self) -> dict[str, Any]:
        """Strides, and strides over body length."""
        return {"stride": _figure(self.curves[ROBOT]), "stride-simulation": _figure(self.curves[SIMULATION])}


def measured_curves(family: str) -> dict[str, Curve]:
    """Curves of all robots with the parameters of a preset, by name."""
    robots = {COUNTS[count]: (robot(count, family), False) for count in BY_MAGNETS}
    robots[BACKWARD] = (robot(4, family), True)
    walks = [Walk(scene, v, back) for scene, back in robots.values() for v in SPEEDS_MM_S]
    strides = measured_strides(walks).reshaped(len(robots), len(SPEEDS_MM_S))
    return {
        name: Curve(strides[row], MM * scene.body_length_m)
        for row, (name, (scene, _)) in enumerate(robots.items())
    }


def crossing_mm_s(three: Curve, five: Curve) -> float:
    """Lowest speed on the platform from which on five magnets beat three; infinite if there is none."""
    shown = within()
    losing = np.flatnonzero(five.mean[shown] <= three.mean[shown])
    first = 0 if len(losing) == 0 else int(losing[-1]) + 1
    return float(SPEEDS_MM_S[shown][first]) if first < shown.sum() else float("inf")


def slow_spread_percent(curves: Curves) -> float:
    """How much longer the longest of the three strides is than the shortest below 65 mm/s [%]."""
    slow = within(0.0, SLOW_MM_S)
    means = [float(curves[COUNTS[count]].mean[slow].mean()) for count in BY_MAGNETS]
    return 100.0 * (max(means) / min(means) - 1.0) if min(means) > 0.0 else float("inf")


def _numbers(curves: Curves) -> Numbers:
    three, four, five, back = (curves[name] for name in ("three", "four", "five", BACKWARD))
    on, slow, fast = within(), within(0.0, CROSSING_MM_S - 1.0), within(CROSSING_MM_S + 1.0)
    top = int(three.mean[on].argmax())
    return {
        "slow": slow_spread_percent(curves),
        "three_peak": (three.mean[on][top], three.strides.spread_mm[on][top]),
        "three_peak_speed": (SPEEDS_MM_S[on][top], GRID_MM_S),
        "three_change": three.change,
        "four_change": four.change,
        "five_change": five.change,
        "five_fast": (five.at(PLATFORM_MM_S), five.strides.spread_mm[on][-1]),
        "lead_slow": (three.mean - np.maximum(four.mean, five.mean))[slow].mean(),
        "lead_fast": (five.mean - np.maximum(three.mean, four.mean))[fast].mean(),
        "crossing": (crossing_mm_s(three, five), GRID_MM_S),
        "stall": 100.0 * three.at(PLATFORM_MM_S) / three.mean[on][top],
        "direction": np.abs(four.mean - back.mean)[on].mean(),
    }


def _orders(curves: Curves) -> list[str]:
    forward = {name: curve for name, curve in curves.items() if name != BACKWARD}
    return [
        f"{ranking({name: curve.at(speed) for name, curve in forward.items()})} at {speed:g} mm/s"
        for speed in ORDERED_MM_S
    ]


def _figure(curves: Curves) -> Any:
    figure, axes = panels(1, 2, (9.2, 3.9))
    for axis, normalised in zip(axes, (False, True), strict=True):
        scales = {name: curve.length_mm if normalised else 1.0 for name, curve in curves.items()}
        for name, curve in curves.items():
            mean, spread = (of / scales[name] for of in (curve.mean, curve.strides.spread_mm))
            label = "four magnets, backward" if name == BACKWARD else f"{name} magnets"
            style = {"color": SHADES[name], "label": label, **WAYS[name == BACKWARD]}
            draw_spread(axis, SPEEDS_MM_S, mean, spread, **style)
        three, five = PAPER_PEAK_MM / scales["three"], PAPER_FIVE_MM / scales["five"]
        mark_paper(axis, PEAK_MM_S, three, "paper, experiment")
        mark_paper(axis, PLATFORM_MM_S, five, None)
        over_speed(axis, SPEEDS_MM_S[-1])
        small: dict[str, Any] = {"textcoords": "offset points", "fontsize": 7.5}
        axis.annotate("three", (PEAK_MM_S, three), (0, -13), ha="center", **small)
        axis.annotate("five", (PLATFORM_MM_S, five), (7, -3), **small)
    axes[0].set_ylabel("stride [mm]")
    axes[1].set_ylabel("stride / body length")
    legend_above(figure, axes[0], 5)
    return figure
