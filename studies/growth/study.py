"""How the cost of a control step grows: ``docs/growth.md`` and its figure."""

import argparse
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.ticker import NullFormatter

from studies.growth.measure import CONTROL_STEPS, Point, point
from studies.growth.memory import FEW, MANY, Memory, memory
from studies.growth.share import AIM, CASES, ENVIRONMENTS, ROLLOUTS, Share, share
from studies.growth.sweeps import PITCH_M, PRESETS, SWEEPS, Exponent, Sweep, exponent, refusals
from studies.kit.data import read_json, read_rows, write_json, write_rows
from studies.kit.figures import BLUE, ORANGE, REFERENCE, legend_above, panels
from studies.kit.page import page
from studies.kit.passes import MM
from studies.kit.study import Study
from studies.kit.timing import Stopwatch

HERE = Path(__file__).parent
DATA = HERE / "data"
PLACES = {2: "plane", 3: "space"}
WORK = {"wall": "wall_s", "processor": "processor_s", "systems": "systems", "wrenches": "wrenches"}
"""What is fitted: its name on the page, and in the data."""


@dataclass(frozen=True)
class Machine:
    """Cores that were there, and what the simulator says to the first scene beyond each range."""

    cores: int
    refusals: list[str]


def options(parser: argparse.ArgumentParser) -> None:
    """Of the measurement."""
    parser.add_argument("--share", action="store_true", help="measure only the share of a training")


def measure(arguments: argparse.Namespace) -> None:
    """Measures memory, sweeps and the share of a training. Minutes."""
    said = Stopwatch().said
    if not arguments.share:
        # First, while this process holds little.
        write_rows(DATA / "memory.csv", Memory, [memory(dimensions) for dimensions in PLACES])
        said("memory")
        points = []
        for sweep in SWEEPS:
            for dimensions, place in PLACES.items():
                points += [point(sweep.name, sweep.setting(size), dimensions) for size in sweep.sizes]
                said(f"{sweep.name}, {place}")
        write_rows(DATA / "sweeps.csv", Point, points)
        write_json(DATA / "machine.json", Machine(os.cpu_count() or 1, refusals()))
    write_rows(DATA / "share.csv", Share, [share(case) for case in CASES])
    said("share of a training")


@dataclass(frozen=True)
class Found:
    """A sweep and its points in the plane and in space."""

    sweep: Sweep
    points: dict[int, list[Point]]

    def sizes(self, dimensions: int = 2) -> list[int]:
        """What is varied."""
        return [int(getattr(point.size, self.sweep.name)) for point in self.points[dimensions]]

    def costs(self, dimensions: int, name: str) -> list[float]:
        """One column of the costs."""
        return [float(getattr(point.cost, name)) for point in self.points[dimensions]]

    @property
    def exponents(self) -> list[Exponent]:
        """Of all that is fitted, in the plane and in space; none of a sweep that is too short."""
        fits = [exponent(self.sizes(of), self.costs(of, name)) for of in PLACES for name in WORK.values()]
        return [fit for fit in fits if fit is not None]

    @property
    def broken(self) -> int:
        """Environments that broke on the way."""
        return sum(point.cost.broken for points in self.points.values() for point in points)


def found(points: Sequence[Point]) -> list[Found]:
    """All sweeps with their points."""
    return [
        Found(
            sweep,
            {
                of: [point for point in points if (point.sweep, point.size.dimensions) == (sweep.name, of)]
                for of in PLACES
            },
        )
        for sweep in SWEEPS
    ]


def pages() -> dict[str, str]:
    """The page from the data."""
    points, memories = read_rows(DATA / "sweeps.csv", Point), read_rows(DATA / "memory.csv", Memory)
    machine = read_json(DATA / "machine.json", Machine)
    return {"growth.md": text(points, memories, machine, read_rows(DATA / "share.csv", Share))}


def text(
    points: Sequence[Point], memories: Sequence[Memory], machine: Machine, shares: Sequence[Share]
) -> str:
    """The page."""
    return page(
        HERE / "page.md",
        found={of.sweep.name: of for of in found(points)},
        memories=memories,
        machine=machine,
        shares=shares,
        places=PLACES,
        presets=PRESETS,
        work=WORK,
        control_steps=CONTROL_STEPS,
        pitch_mm=MM * PITCH_M,
        processes=(FEW, MANY),
        aim=AIM,
        environments=ENVIRONMENTS,
        rollouts=ROLLOUTS,
    )


def figures() -> dict[str, Any]:
    """The figure from the data."""
    return {"growth.png": figure(read_rows(DATA / "sweeps.csv", Point))}


def figure(points: Sequence[Point]) -> Any:
    """Wall and processor time of a control step against each size, on logarithmic axes."""
    drawn, axes = panels(2, 2, (8.0, 6.0))
    sweeps = [of for of in found(points) if of.sweep.name != "threads"]
    for panel, of in zip(axes.flat, sweeps, strict=True):
        for (dimensions, place), colour in zip(PLACES.items(), (BLUE, ORANGE), strict=True):
            draw(panel, of, dimensions, place, colour)
        panel.set(xscale="log", yscale="log", xlabel=of.sweep.title, ylabel="time of a control step [ms]")
        sizes = of.sizes()
        if len(sizes) < 8:
            panel.set_xticks(sizes, [f"{size}" for size in sizes])
            panel.xaxis.set_minor_formatter(NullFormatter())
    legend_above(drawn, axes.flat[0], 4)
    return drawn


def draw(panel: Any, of: Found, dimensions: int, place: str, colour: str) -> None:
    """Times of one sweep, and a line of exponent 1."""
    sizes = of.sizes(dimensions)
    wall_ms, processor_ms = (
        [MM * seconds for seconds in of.costs(dimensions, name)] for name in ("wall_s", "processor_s")
    )
    panel.plot(sizes, wall_ms, "o:", mfc="white", lw=0.9, label=f"{place}, wall", color=colour)
    panel.plot(sizes, processor_ms, "o-", label=f"{place}, processor", color=colour)
    slope = [processor_ms[-1] * size / sizes[-1] for size in sizes]
    panel.plot(sizes, slope, "--", color=REFERENCE, lw=0.7, zorder=1)


STUDY = Study(
    about="how the cost of a control step grows with what is simulated",
    options=options,
    measure=measure,
    pages=pages,
    figures=figures,
)
