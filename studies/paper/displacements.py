"""Displacements of the three magnets during the paper's pass, and the presets behind them."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.figures import BY_PLACE, REFERENCE, legend_above, panels
from studies.kit.passes import MM, PASS_S, ROBOT, SIMULATION, Floats, middle_lift, one_pass, robot, values_of
from studies.paper.experiment import Experiment, Numbers

SAMPLE_S = 0.002
SHOWN_EVERY = 5
"""Samples, of which one is kept for the figure."""
PAPER_MM = {SIMULATION: {"peak": 9.07, "stride": 3.48}, ROBOT: {"peak": 8.30, "stride": 4.17}}
LOOKS = {SIMULATION: ("--", "paper, simulation"), ROBOT: (":", "paper, experiment")}
SECTIONS = {ROBOT: "experiment", SIMULATION: "pass"}
"""Sections of ``quantities.toml``."""


@dataclass(frozen=True)
class Moved:
    """One robot in the pass.

    Attributes:
        peak_mm: Greatest lift of the middle magnet [mm].
        stride_mm: Way of the robot's centre towards its head [mm].
        gained_mm: Way of each magnet towards the head at the end (3,) [mm].
        time_s: Instants of the figure (T,) [s].
        height_mm: Height gained by each magnet (3, T) [mm].
        way_mm: Way of each magnet towards the head (3, T) [mm].
    """

    peak_mm: float
    stride_mm: float
    gained_mm: Floats
    time_s: Floats
    height_mm: Floats
    way_mm: Floats

    @property
    def spread_mm(self) -> float:
        """By how much the ways of the magnets differ [mm]."""
        return float(np.ptp(self.gained_mm))


@dataclass(frozen=True)
class Displacements(Experiment):
    """The pass with each preset for three magnets.

    Attributes:
        robots: What each does, by preset.
        differing: Path of each value in which the presets differ, and both values.
    """

    name: ClassVar[str] = "displacements"
    robots: dict[str, Moved]
    differing: list[list[str]]

    @classmethod
    def measured(cls) -> "Displacements":
        """Runs both passes."""
        presets = [robot(3, family) for family in (ROBOT, SIMULATION)]
        records = record_scenes([one_pass(preset) for preset in presets], PASS_S, SAMPLE_S)
        return cls(dict(zip((ROBOT, SIMULATION), map(_moved, records), strict=True)), differing(*presets))

    def numbers(self) -> Numbers:
        """Peak and stride of both."""
        return {
            f"{SECTIONS[family]}.{name}": value
            for family, of in self.robots.items()
            for name, value in (("peak", of.peak_mm), ("stride", of.stride_mm))
        }

    def figures(self) -> dict[str, Any]:
        """Height and way of each magnet."""
        figure, rows = panels(2, 2, (9.2, 6.8), sharex=True)
        for (family, of), (left, right) in zip(self.robots.items(), rows, strict=True):
            for (name, shade), height, way in zip(BY_PLACE.items(), of.height_mm, of.way_mm, strict=True):
                left.plot(of.time_s, height, color=shade, label=f"{name} magnet")
                right.plot(of.time_s, way, color=shade)
            for source, paper in PAPER_MM.items():
                style, label = LOOKS[source]
                left.axhline(paper["peak"], color=REFERENCE, ls=style, lw=1.0, label=label)
                right.axhline(paper["stride"], color=REFERENCE, ls=style, lw=1.0)
            left.set_ylabel(f"height gained [mm]\n{family}")
            right.set_ylabel("way towards the head [mm]")
        for axis in rows.flat:
            axis.set_xlim(0.0, PASS_S)
            axis.set_xticks(np.arange(0.0, PASS_S + 0.1, 0.25))
        for axis in rows[-1]:
            axis.set_xlabel("time [s]")
        legend_above(figure, rows[0, 0], 5)
        return {"displacements": figure}


def _moved(record: Recording) -> Moved:
    moved = MM * np.moveaxis(record.magnet_poses[..., :2] - record.magnet_poses[0, :, :2], 0, -1)
    return Moved(
        peak_mm=MM * float(middle_lift(record).max()),
        stride_mm=MM * float(record.progress_m[-1]),
        gained_mm=-moved[:, 0, -1],
        time_s=record.time_s[::SHOWN_EVERY],
        height_mm=moved[:, 1, ::SHOWN_EVERY],
        way_mm=-moved[:, 0, ::SHOWN_EVERY],
    )


def differing(first: Scene, second: Scene) -> list[list[str]]:
    """Rows of path and both values for what differs between two scenes, names left out."""
    one, other = dict(_flat(values_of(first))), dict(_flat(values_of(second)))
    paths = [path for path in {**one, **other} if path != "name" and one.get(path) != other.get(path)]
    return [[f"`{path}`", _written(one.get(path)), _written(other.get(path))] for path in paths]


def _flat(values: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{before}{name}.")
        else:
            yield before + name, value


def _written(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else "–" if value is None else str(value)
