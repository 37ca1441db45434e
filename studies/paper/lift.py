"""The paper's first case: the drive rises under the middle magnet, and the robot arches."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.figures import BLUE, BY_PLACE, ORANGE, REFERENCE, TEAL, legend_beside, panels
from studies.kit.passes import (
    HOLD_S,
    LOW_M,
    MM,
    PLANE_M,
    RISE_S,
    ROBOT,
    SIMULATION,
    Floats,
    middle_lift,
    robot,
    under_middle,
)
from studies.kit.words import number
from studies.paper.experiment import Experiment, Numbers
from studies.paper.marks import mark_paper
from studies.paper.robot_picture import draw_scene, moments

PAPER_LIFT_MM = 7.7
"""Paper: about 1/7 of the body length, 54 mm."""
SAMPLE_S = 0.002
HEIGHTS_M = np.linspace(LOW_M, PLANE_M, 13)
REST_S = 2.0
SLOW_S = 30.0
SLOW_SAMPLE_S = 0.05
SHOWN_S = (0.0, 0.3, 0.4, 0.8)
WAYS = ("raised", "lowered")


@dataclass(frozen=True)
class Lift(Experiment):
    """The case, and sweeps over the height of the drive.

    Attributes:
        time_s: Instants of the case (T,) [s].
        lift_mm: Height gained by the middle magnet (T,) [mm].
        slides_mm: Way of head and tail end towards the tail (2, T) [mm].
        apart_mm: Greatest distance of the tail half from the mirrored head half [mm].
        robot_mm: The lift at the end with the robot of the experiment [mm].
        at_rest_mm: The lift at rest at each of :data:`HEIGHTS_M` [mm].
        slow_height_mm: Height of a drive that is slowly raised, and lowered again (2, S) [mm].
        slow_mm: The lift meanwhile (2, S) [mm].
        postures: The case at :data:`SHOWN_S`.
    """

    name: ClassVar[str] = "lift"
    time_s: Floats
    lift_mm: Floats
    slides_mm: Floats
    apart_mm: float
    robot_mm: float
    at_rest_mm: Floats
    slow_height_mm: Floats
    slow_mm: Floats
    postures: Recording

    @classmethod
    def measured(cls) -> "Lift":
        """Runs the case with both robots, and the sweeps."""
        held = [raised(SIMULATION, height) for height in HEIGHTS_M]
        slow = under_middle(robot(3, SIMULATION), [0.0, SLOW_S, 2.0 * SLOW_S], [LOW_M, PLANE_M, LOW_M])
        record, other = record_scenes([raised(SIMULATION), raised(ROBOT)], RISE_S + HOLD_S, SAMPLE_S)
        settled = record_scenes(held, RISE_S + REST_S, SLOW_SAMPLE_S, nodes=False)
        (both_ways,) = record_scenes([slow], 2.0 * SLOW_S, SLOW_SAMPLE_S, nodes=False)
        ends = record.nodes[:, [0, -1], 0].T
        return cls(
            time_s=record.time_s,
            lift_mm=MM * middle_lift(record),
            slides_mm=MM * (ends - ends[:, :1]),
            apart_mm=MM * mirror_error(record),
            robot_mm=MM * float(middle_lift(other)[-1]),
            at_rest_mm=np.array([MM * middle_lift(run)[-1] for run in settled]),
            slow_height_mm=MM * _halves(both_ways.drive_positions[:, 0, 1]),
            slow_mm=MM * _halves(middle_lift(both_ways)),
            postures=moments(record, [round(time_s / SAMPLE_S) for time_s in SHOWN_S]),
        )

    @property
    def end_mm(self) -> float:
        """The lift at the end of the case [mm]."""
        return float(self.lift_mm[-1])

    @property
    def overshoot_mm(self) -> float:
        """How much higher the middle was before [mm]."""
        return float(self.lift_mm.max()) - self.end_mm

    @property
    def drift_mm(self) -> float:
        """How far it moves within the last 50 ms [mm]."""
        return float(np.ptp(self.lift_mm[-25:]))

    @property
    def hysteresis_mm(self) -> float:
        """Greatest difference of lifts at equal height of the slow drive [mm]."""
        up, down = self.slow_mm
        return float(np.abs(up - down[::-1]).max())

    def numbers(self) -> Numbers:
        """Lift, symmetry, slides."""
        return {
            "lift.final": self.end_mm,
            "lift.mirror": 100.0 * self.apart_mm / self.end_mm,
            "lift.slide": 0.5 * float(self.slides_mm[0, -1] - self.slides_mm[1, -1]),
            "lift.robot": self.robot_mm,
        }

    def figures(self) -> dict[str, Any]:
        """Postures, and lifts over time and height."""
        return {"lift-postures": self._postures(), "lift": self._curves()}

    def _postures(self) -> Any:
        figure, axes = panels(1, len(SHOWN_S), (9.2, 2.3), sharex=True, sharey=True)
        scene = raised(SIMULATION)
        for sample, (axis, time_s) in enumerate(zip(axes, SHOWN_S, strict=True)):
            draw_scene(axis, scene, self.postures, sample)
            height = MM * self.postures.drive_positions[sample, 0, 1]
            axis.set_title(f"{time_s:g} s, drive at {number(height, 0)} mm", fontsize=9)
            axis.set(xlim=(-10.0, 64.0), ylim=(-56.0, 20.0), xlabel="x [mm]")
        axes[0].set_ylabel("y [mm]")
        return figure

    def _curves(self) -> Any:
        figure, (left, right) = panels(1, 2, (9.2, 3.5))
        left.plot(self.time_s, self.lift_mm, color=BY_PLACE["middle"], label="lift of the middle")
        for end, way in zip(("head", "tail"), self.slides_mm, strict=True):
            left.plot(self.time_s, way, color=BY_PLACE[end], label=f"{end} end, x")
        left.axhline(PAPER_LIFT_MM, color=REFERENCE, ls="--", lw=1.0, label="paper: lift ≈ L/7")
        left.axvline(RISE_S, color=REFERENCE, lw=0.6, ls=":")
        left.set(xlabel="time [s]", ylabel="displacement [mm]")
        left.set_ylim(top=12.0)
        legend_beside(left, "upper left")
        for height, lift, shade, way in zip(
            self.slow_height_mm, self.slow_mm, (TEAL, BLUE), WAYS, strict=True
        ):
            right.plot(height, lift, color=shade, label=f"slowly {way}")
        right.plot(MM * HEIGHTS_M, self.at_rest_mm, "o", color=ORANGE, label="raised in 0.5 s, at rest")
        mark_paper(right, MM * PLANE_M, PAPER_LIFT_MM, "paper")
        right.set(xlabel="height of the drive [mm]", ylabel="lift of the middle [mm]")
        legend_beside(right, "upper left")
        return figure


def raised(family: str, height_m: float = PLANE_M) -> Scene:
    """A robot with three magnets over a drive that rises to a height, in the case to its plane."""
    return under_middle(robot(3, family), [0.0, RISE_S], [LOW_M, height_m])


def _halves(values: Floats) -> Floats:
    """What belongs to the way up, and to the way down; both have the turn."""
    turn = len(values) // 2
    return np.array([values[: turn + 1], values[turn:]])


def mirror_error(recording: Recording) -> float:
    """Greatest distance of the tail half from the mirrored head half of the centre line [m]."""
    middle = recording.nodes[:1, [0, -1], 0].mean(axis=1)
    mirrored = recording.nodes[:, ::-1] * (-1.0, 1.0)
    mirrored[..., 0] += 2.0 * middle
    return float(np.linalg.norm(mirrored - recording.nodes, axis=-1).max())
