"""Bouncing: whether single feet or the whole robot leave the ground under a fast drive."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.figures import BY_MAGNETS, REFERENCE, legend_above, panels
from studies.kit.passes import AHEAD_M, MM, Floats, one_pass, robot
from studies.kit.words import COUNTS
from studies.paper.experiment import Experiment, Numbers
from studies.paper.feet import OFF_GROUND_M, sole_heights
from studies.paper.marks import PLATFORM_MM_S, over_speed

SPEEDS_MM_S = np.arange(20.0, 401.0, 20.0)
FAST = (SPEEDS_MM_S > 150.0) & (SPEEDS_MM_S <= PLATFORM_MM_S)
SAMPLE_S = 0.002
AFTER_S = 0.5
STANDARD_GRAVITY_M_S2 = 9.81


@dataclass(frozen=True)
class Flight:
    """What leaves the ground in one pass.

    Attributes:
        feet: Feet that leave it with both ends, counted from 1 at the head.
        takeoffs: How often the whole robot leaves it.
        clearance_mm: Greatest height of the robot's lowest edge [mm].
        airborne_s: Time for which the whole robot is off the ground [s].
        rise_mm_s: Greatest upward speed of the robot's centre [mm/s].
    """

    feet: list[int]
    takeoffs: int
    clearance_mm: float
    airborne_s: float
    rise_mm_s: float


@dataclass(frozen=True)
class Bouncing(Experiment):
    """One pass at each of :data:`SPEEDS_MM_S` with each robot, by its number of magnets."""

    name: ClassVar[str] = "bouncing"
    flights: dict[int, list[Flight]]

    @classmethod
    def measured(cls) -> "Bouncing":
        """Runs all passes."""
        return cls({count: _flights(robot(count)) for count in BY_MAGNETS})

    @property
    def robots(self) -> dict[int, dict[str, Any]]:
        """What the page says of each robot, by its number of magnets."""
        return {count: _words(found) for count, found in self.flights.items()}

    def numbers(self) -> Numbers:
        """Highest flights on the paper's platform and beyond."""
        heights = np.array([[each.clearance_mm for each in found] for found in self.flights.values()])
        return {"bounce.platform": heights[:, FAST].max(), "bounce.beyond": heights.max()}

    def figures(self) -> dict[str, Any]:
        """Heights and speeds."""
        figure, (left, right) = panels(1, 2, (9.2, 3.3))
        for count, found in self.flights.items():
            style = {"color": BY_MAGNETS[count], "marker": "o", "ms": 3.5, "lw": 1.3}
            heights = [flight.clearance_mm for flight in found]
            left.plot(SPEEDS_MM_S, heights, label=f"{COUNTS[count]} magnets", **style)
            right.plot(SPEEDS_MM_S, [flight.rise_mm_s for flight in found], **style)
        left.axhline(MM * OFF_GROUND_M, color=REFERENCE, lw=0.8, ls=":", label="counts as flight")
        for axis in (left, right):
            over_speed(axis, SPEEDS_MM_S[-1])
            axis.set_ylim(bottom=0.0)
        left.set_ylabel("height of the lowest edge [mm]")
        right.set_ylabel("upward speed of the centre [mm/s]")
        legend_above(figure, left, 4)
        return {"bouncing": figure}


def _flights(walker: Scene) -> list[Flight]:
    way_m = walker.body_length_m + 2.0 * AHEAD_M
    scenes = [one_pass(walker, 1e-3 * speed) for speed in SPEEDS_MM_S]
    durations = [round((way_m / (1e-3 * speed) + AFTER_S) / SAMPLE_S) * SAMPLE_S for speed in SPEEDS_MM_S]
    records = record_scenes(scenes, durations, SAMPLE_S, nodes=False)
    return [flight_of(scene, record) for scene, record in zip(scenes, records, strict=True)]


def flight_of(scene: Scene, record: Recording) -> Flight:
    """Counts what leaves the ground in a recording that keeps every solver step."""
    lowest = sole_heights(scene, record).min(axis=2)
    robot_off = lowest.min(axis=1)
    return Flight(
        feet=(np.flatnonzero((lowest > OFF_GROUND_M).any(axis=0)) + 1).tolist(),
        takeoffs=takeoffs(robot_off),
        clearance_mm=MM * float(robot_off.max()),
        airborne_s=float((robot_off > OFF_GROUND_M).sum() * SAMPLE_S),
        rise_mm_s=MM * float(np.diff(record.centre[:, 1]).max() / SAMPLE_S),
    )


def takeoffs(height_m: Floats) -> int:
    """How often something leaves the ground.

    Args:
        height_m: Height over time (T,) [m].
    """
    off = height_m > OFF_GROUND_M
    return int((off[1:] & ~off[:-1]).sum())


def _words(found: list[Flight]) -> dict[str, Any]:
    highest = max(found, key=lambda flight: flight.clearance_mm)
    fastest = max(found, key=lambda flight: flight.rise_mm_s)
    return {
        "feet": [flight.feet or ["none"] for flight in (found[0], found[-1])],
        "flying_at": [speed for speed, of in zip(SPEEDS_MM_S, found, strict=True) if of.takeoffs],
        "passes": len(found),
        "highest": highest,
        "fastest": fastest,
        "fastest_at": SPEEDS_MM_S[found.index(fastest)],
        "thrown_mm": fastest.rise_mm_s**2 / (2.0 * MM * STANDARD_GRAVITY_M_S2),
    }
