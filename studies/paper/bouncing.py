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
from studies.paper.wording import COUNTS, capital

Floats = NDArray[np.float64]

SPEEDS_MM_S = np.arange(20.0, 401.0, 20.0)
PLATFORM_MM_S, FAST_MM_S = 210.0, 150.0
SAMPLE_S = 0.002
AFTER_S = 0.5


@dataclass(frozen=True)
class Flight:
    """What leaves the ground in one pass.

    Attributes:
        end_foot_m: Greatest height of the lower edge of the first or the last foot [m].
        whole: How often the whole robot leaves it.
        clearance_m: Greatest height of the robot's lowest edge [m].
        airborne_s: Time for which the whole robot is off the ground [s].
    """

    end_foot_m: float
    whole: int
    clearance_m: float
    airborne_s: float


def flight_of(scene: Scene, record: Recording) -> Flight:
    """Counts what leaves the ground in a recording that keeps every solver step."""
    lowest = sole_heights(scene, record).min(axis=2)
    robot_off = lowest.min(axis=1)
    return Flight(
        end_foot_m=float(lowest[:, [0, -1]].max()),
        whole=takeoffs(robot_off[:, None]),
        clearance_m=float(robot_off.max()),
        airborne_s=float((robot_off > OFF_GROUND_M).sum() * SAMPLE_S),
    )


def takeoffs(height_m: Floats) -> int:
    """How often something leaves the ground.

    Args:
        height_m: Heights over time (T, P) [m].
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
                "Greatest height in a pass, left: of the robot's lowest edge, right: of the lower edge of its first or last"
                " foot. Shaded: beyond the paper's platform.",
                _figure(flights),
            )
        ],
        quantities=_quantities(flights),
        data={
            COUNTS[n]: {"clearance_mm": [MM * f.clearance_m for f in fs], "end_foot_mm": [MM * f.end_foot_m for f in fs],
                        "takeoffs": [f.whole for f in fs]}
            for n, fs in flights.items()
        } | {"speed_mm_s": SPEEDS_MM_S.tolist()},
    )  # fmt: skip


def _quantities(flights: dict[int, list[Flight]]) -> list[Quantity]:
    fast = (SPEEDS_MM_S > FAST_MM_S) & (SPEEDS_MM_S <= PLATFORM_MM_S)
    on = max(f.clearance_m for fs in flights.values() for f, here in zip(fs, fast, strict=True) if here)
    beyond = max(f.clearance_m for fs in flights.values() for f in fs)
    return [
        Quantity(
            "bounce.platform", "Bouncing: highest flight of a robot, 150 to 210 mm/s", "mm", MM * on, Origin.HELD_BACK,
            claim="bounces when very fast (read as above 0.05 mm)", holds=(MM * OFF_GROUND_M, np.inf),
        ),
        Quantity("bounce.beyond", "Bouncing: highest flight up to 400 mm/s", "mm", MM * beyond, Origin.MODEL),
    ]  # fmt: skip


def _text(flights: dict[int, list[Flight]]) -> str:
    sentences = []
    for count, found in flights.items():
        off = [i for i, flight in enumerate(found) if flight.whole]
        feet = [i for i, flight in enumerate(found) if flight.end_foot_m > OFF_GROUND_M]
        high = int(np.argmax([flight.end_foot_m for flight in found]))
        top = int(np.argmax([flight.clearance_m for flight in found]))
        end_foot = (
            f"the first or last foot leaves the ground at {len(feet)} of {len(found)} speeds, first at "
            f"{SPEEDS_MM_S[feet[0]]:g} mm/s, at most {number(MM * found[high].end_foot_m, 2)} mm high at "
            f"{SPEEDS_MM_S[high]:g} mm/s"
            if feet
            else "the first and the last foot always touch the ground"
        )
        flying = (
            f"the whole robot flies at {len(off)} of {len(found)} speeds, first at {SPEEDS_MM_S[off[0]]:g} mm/s, at most "
            f"{number(MM * found[top].clearance_m, 2)} mm high for {1e3 * found[top].airborne_s:.0f} ms in a pass at "
            f"{SPEEDS_MM_S[top]:g} mm/s"
            if off
            else "the whole robot never leaves the ground"
        )
        sentences.append(capital(f"{COUNTS[count]} magnets: {end_foot}; {flying}."))
    return (
        "A foot is off the ground where both its ends are more than 0.05 mm high, the robot where all of them are. "
        "Impacts are fully inelastic in the model, as in the paper's, so that nothing rebounds: a robot flies only where "
        "the magnets throw it. Inner feet are lifted in every pass: that is the wave.\n\n"
        + "\n".join(f"- {sentence}" for sentence in sentences)
    )


def _figure(flights: dict[int, list[Flight]]) -> Any:
    figure, (left, right) = panels(1, 2, (9.2, 3.3))
    for count, found in flights.items():
        style = {"color": BY_MAGNETS[count], "marker": "o", "ms": 3.5, "lw": 1.3}
        left.plot(
            SPEEDS_MM_S,
            [MM * flight.clearance_m for flight in found],
            label=f"{COUNTS[count]} magnets",
            **style,
        )
        right.plot(SPEEDS_MM_S, [MM * flight.end_foot_m for flight in found], **style)
    for axis, label in ((left, "counts as off the ground"), (right, None)):
        axis.axhline(MM * OFF_GROUND_M, color=PAPER, lw=0.8, ls=":", label=label)
    for axis in (left, right):
        axis.axvspan(PLATFORM_MM_S, SPEEDS_MM_S[-1] + 10.0, color=FAINT, alpha=0.35, lw=0)
        axis.set_xlim(0.0, SPEEDS_MM_S[-1] + 10.0)
        axis.set_xlabel("speed of the drive [mm/s]")
        axis.set_ylim(bottom=0.0)
    left.set_ylabel("height of the lowest edge [mm]")
    right.set_ylabel("height of an end foot [mm]")
    legend_above(figure, left, 4)
    return figure
