"""Bouncing: whether single feet or the whole robot leave the ground under a fast drive."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, record_scenes
from studies.paper.feet import OFF_GROUND_M, sole_heights
from studies.paper.figures import BY_MAGNETS, FAINT, PAPER, legend_above, panels
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import AHEAD_M, one_pass, robot
from studies.paper.section import Image, Section
from studies.paper.wording import COUNTS, capital, listed

Floats = NDArray[np.float64]

SPEEDS_MM_S = np.arange(20.0, 401.0, 20.0)
PLATFORM_MM_S, FAST_MM_S = 210.0, 150.0
SAMPLE_S = 0.002
AFTER_S = 0.5
STANDARD_GRAVITY_M_S2 = 9.81


@dataclass(frozen=True)
class Flight:
    """What leaves the ground in one pass.

    Attributes:
        feet: Feet that leave it with both ends, counted from 1 at the head.
        whole: How often the whole robot leaves it.
        clearance_m: Greatest height of the robot's lowest edge [m].
        airborne_s: Time for which the whole robot is off the ground [s].
        rise_m_s: Greatest upward speed of the robot's centre [m/s].
    """

    feet: tuple[int, ...]
    whole: int
    clearance_m: float
    airborne_s: float
    rise_m_s: float


def flight_of(scene: Scene, record: Recording) -> Flight:
    """Counts what leaves the ground in a recording that keeps every solver step."""
    lowest = sole_heights(scene, record).min(axis=2)
    robot_off = lowest.min(axis=1)
    return Flight(
        feet=tuple((np.flatnonzero((lowest > OFF_GROUND_M).any(axis=0)) + 1).tolist()),
        whole=takeoffs(robot_off),
        clearance_m=float(robot_off.max()),
        airborne_s=float((robot_off > OFF_GROUND_M).sum() * SAMPLE_S),
        rise_m_s=float(np.diff(record.centre[:, 1]).max() / SAMPLE_S),
    )


def takeoffs(height_m: Floats) -> int:
    """How often something leaves the ground.

    Args:
        height_m: Height over time (T,) [m].
    """
    off = height_m > OFF_GROUND_M
    return int((off[1:] & ~off[:-1]).sum())


def bouncing_section() -> Section:
    """Runs one pass at each speed with each robot."""
    robots = {count: robot(count) for count in BY_MAGNETS}
    cases = [(count, 1e-3 * speed) for count in robots for speed in SPEEDS_MM_S]
    scenes = [one_pass(robots[count], speed) for count, speed in cases]
    ways = [robots[count].body_length_m + 2.0 * AHEAD_M for count, _ in cases]
    durations = [
        round((way / speed + AFTER_S) / SAMPLE_S) * SAMPLE_S
        for way, (_, speed) in zip(ways, cases, strict=True)
    ]
    records = record_scenes(scenes, durations, SAMPLE_S, nodes=False)
    found = [flight_of(scene, record) for scene, record in zip(scenes, records, strict=True)]
    flights = {
        count: found[i * len(SPEEDS_MM_S) : (i + 1) * len(SPEEDS_MM_S)] for i, count in enumerate(robots)
    }
    return Section(
        title="Bouncing",
        text=_text(flights),
        images=[
            Image(
                "bouncing",
                "Left: greatest height of the robot's lowest edge in a pass; right: greatest upward speed "
                "of its centre. Shaded: beyond the paper's platform.",
                _figure(flights),
            )
        ],
        quantities=_quantities(flights),
        data={
            COUNTS[n]: {
                "clearance_mm": [MM * f.clearance_m for f in fs],
                "feet": [f.feet for f in fs],
                "takeoffs": [f.whole for f in fs],
            }
            for n, fs in flights.items()
        }
        | {"speed_mm_s": SPEEDS_MM_S.tolist()},
    )


def _quantities(flights: dict[int, list[Flight]]) -> list[Quantity]:
    fast = (SPEEDS_MM_S > FAST_MM_S) & (SPEEDS_MM_S <= PLATFORM_MM_S)
    on = max(f.clearance_m for fs in flights.values() for f, here in zip(fs, fast, strict=True) if here)
    beyond = max(f.clearance_m for fs in flights.values() for f in fs)
    return [
        Quantity(
            "bounce.platform",
            "Bouncing: highest flight of a robot, 150 to 210 mm/s",
            "mm",
            MM * on,
            Origin.HELD_BACK,
            claim="bounces when very fast (read as above 0.05 mm)",
            holds=(MM * OFF_GROUND_M, np.inf),
        ),
        Quantity("bounce.beyond", "Bouncing: highest flight up to 400 mm/s", "mm", MM * beyond, Origin.MODEL),
    ]


def _text(flights: dict[int, list[Flight]]) -> str:
    sentences = [
        f"- {capital(COUNTS[count])} magnets: {_lifted(found)}; {_flown(found)}."
        for count, found in flights.items()
    ]
    return (
        "A foot is off the ground where both its ends are more than 0.05 mm high, "
        "the robot where all of them are. Passing magnets lift single feet at any "
        "speed; bouncing is read as flight of the whole robot. Impacts are fully "
        "inelastic in the model, as in the paper's, so nothing rebounds: a robot "
        "flies only where the magnets throw it.\n\n" + "\n".join(sentences)
    )


def _lifted(found: list[Flight]) -> str:
    """Which feet leave the ground."""
    slow, fast = (listed([str(foot) for foot in flight.feet] or ["none"]) for flight in (found[0], found[-1]))
    least, most = SPEEDS_MM_S[[0, -1]]
    return f"feet off the ground in a pass: {slow} at {least:g} mm/s, {fast} at {most:g} mm/s"


def _flown(found: list[Flight]) -> str:
    """Whether the whole robot leaves the ground, and how fast it rises."""
    off = [speed for speed, flight in zip(SPEEDS_MM_S, found, strict=True) if flight.whole]
    top = max(found, key=lambda flight: flight.clearance_m)
    rise = max(found, key=lambda flight: flight.rise_m_s)
    thrown = MM * rise.rise_m_s**2 / (2.0 * STANDARD_GRAVITY_M_S2)
    words = (
        f"the whole robot flies at {len(off)} of {len(found)} speeds, first at {off[0]:g} mm/s, at most "
        f"{number(MM * top.clearance_m, 2)} mm high, for {1e3 * top.airborne_s:.0f} ms in a pass"
        if off
        else "the whole robot never"
    )
    return (
        f"{words}. Its centre rises at up to {1e3 * rise.rise_m_s:.0f} mm/s, at {_speed_of(found, rise):g} "
        f"mm/s, enough to throw a free body {number(thrown, 1)} mm high"
    )


def _speed_of(found: list[Flight], flight: Flight) -> float:
    return float(SPEEDS_MM_S[found.index(flight)])


def _figure(flights: dict[int, list[Flight]]) -> Any:
    figure, (left, right) = panels(1, 2, (9.2, 3.3))
    for count, found in flights.items():
        style = {"color": BY_MAGNETS[count], "marker": "o", "ms": 3.5, "lw": 1.3}
        heights = [MM * flight.clearance_m for flight in found]
        left.plot(SPEEDS_MM_S, heights, label=f"{COUNTS[count]} magnets", **style)
        right.plot(SPEEDS_MM_S, [1e3 * flight.rise_m_s for flight in found], **style)
    left.axhline(MM * OFF_GROUND_M, color=PAPER, lw=0.8, ls=":", label="counts as flight")
    for axis in (left, right):
        axis.axvspan(PLATFORM_MM_S, SPEEDS_MM_S[-1] + 10.0, color=FAINT, alpha=0.35, lw=0)
        axis.set_xlim(0.0, SPEEDS_MM_S[-1] + 10.0)
        axis.set_xlabel("speed of the drive [mm/s]")
        axis.set_ylim(bottom=0.0)
    left.set_ylabel("height of the lowest edge [mm]")
    right.set_ylabel("upward speed of the centre [mm/s]")
    legend_above(figure, left, 4)
    return figure
