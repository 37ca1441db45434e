"""Shapes of the robot during one pass, in the paper's four stages, and what it says of each."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.figures import panels
from studies.kit.passes import MM, PASS_S, Floats, one_pass, robot
from studies.paper.experiment import Experiment, Numbers
from studies.paper.feet import OFF_GROUND_M, sole_heights
from studies.paper.loads import magnetic_loads
from studies.paper.quantity import Quantity, quantities_of, read_rows
from studies.paper.robot_picture import draw_scene, moments
from studies.paper.stages import NAMES, spans

SAMPLE_S = 0.002
PICTURES = ((0.66, 0.97), (0.35, 0.85), (0.15, 0.70), (0.06, 0.40))
"""Instants that are drawn, as shares of each stage's duration."""
HEAD, MIDDLE, TAIL = range(3)


@dataclass(frozen=True)
class Pass:
    """One recorded pass.

    Attributes:
        record: Its recording.
        force: Magnetic forces (T, 3, 2) [N].
        torque: Magnetic torques (T, 3), anticlockwise [N·m].
        soles: Heights of both ends of each foot (T, 3, 2) [m].
        stages: Samples of each stage.
    """

    record: Recording
    force: Floats
    torque: Floats
    soles: Floats
    stages: list[slice]


@dataclass(frozen=True)
class Morphology(Experiment):
    """The paper's pass of a robot with three magnets.

    Attributes:
        found: What its statements are about, by name.
        until_s: When each stage ends [s], by name.
        tilt_deg: By how much each foot tilts at most [°].
        flight_mm: Greatest height of the robot's lowest edge [mm].
        pictures: Two instants of each stage.
    """

    name: ClassVar[str] = "morphology"
    found: dict[str, float]
    until_s: dict[str, float]
    tilt_deg: Floats
    flight_mm: float
    pictures: Recording

    @classmethod
    def measured(cls) -> "Morphology":
        """Records the pass."""
        walk = recorded_pass(scene())
        ends = walk.record.time_s.tolist()
        shown = [
            span.start + round(share * (span.stop - 1 - span.start))
            for span, shares in zip(walk.stages, PICTURES, strict=True)
            for share in shares
        ]
        return cls(
            found=_stage_one(walk) | _stage_two(walk) | _stage_three(walk) | _stage_four(walk),
            until_s={name: ends[span.stop - 1] for name, span in zip(NAMES, walk.stages, strict=True)},
            tilt_deg=np.degrees(np.abs(walk.record.magnet_poses[..., 2]).max(axis=0)),
            flight_mm=MM * float(walk.soles.min(axis=(1, 2)).max()),
            pictures=moments(walk.record, shown),
        )

    @property
    def flies(self) -> bool:
        """Whether the whole robot leaves the ground."""
        return self.flight_mm > MM * OFF_GROUND_M

    @property
    def statements(self) -> list[Quantity]:
        """The paper's statements, beside the model."""
        return quantities_of({f"stages.{name}": value for name, value in self.found.items()}, read_rows())

    def numbers(self) -> Numbers:
        """How many statements hold, and each."""
        each = {statement.key: statement.model for statement in self.statements}
        return {"stages.statements": sum(of.as_wanted for of in self.statements), **each}

    def figures(self) -> dict[str, Any]:
        """Two instants of each stage."""
        figure, axes = panels(len(NAMES), 2, (9.2, 7.4), sharex=True, sharey=True)
        robot_and_drive = scene()
        for sample, axis in enumerate(axes.flat):
            draw_scene(axis, robot_and_drive, self.pictures, sample)
            time_s = self.pictures.time_s[sample]
            axis.set_title(f"stage {NAMES[sample // 2]}, {time_s:.2f} s", fontsize=9)
            axis.set(xlim=(-30.0, 90.0), ylim=(-26.0, 20.0))
        for axis in axes[:, 0]:
            axis.set_ylabel("y [mm]")
        for axis in axes[-1]:
            axis.set_xlabel("x [mm]")
        return {"morphology": figure}


def scene() -> Scene:
    """The robot under the drive of the paper's pass."""
    return one_pass(robot(3))


def recorded_pass(moving: Scene) -> Pass:
    """Records a pass of a robot with three magnets."""
    (record,) = record_scenes([moving], PASS_S, SAMPLE_S)
    force, torque = magnetic_loads(moving, record)
    return Pass(record, force, torque, sole_heights(moving, record), spans(record))


def _stage_one(walk: Pass) -> dict[str, float]:
    span = walk.stages[0]
    toe = walk.soles[span, HEAD, 0]
    return {
        "front_torque": 1e3 * walk.torque[span, HEAD][toe.argmax()],
        "front_lift": MM * toe.max(),
        "front_anchor": walk.force[span, HEAD, 1][-1],
    }


def _stage_two(walk: Pass) -> dict[str, float]:
    span = walk.stages[1]
    third = slice(span.start, span.start + (span.stop - span.start) // 3)
    line, poses = walk.record.nodes[third], walk.record.magnet_poses[third]
    crest = np.take_along_axis(line[..., 0], line[..., 1].argmax(axis=1)[:, None], axis=1)[:, 0]
    place = (crest - poses[:, MIDDLE, 0]) / (poses[:, TAIL, 0] - poses[:, MIDDLE, 0])
    torque = 1e3 * walk.torque[span].mean(axis=0)
    return {"wave": place.mean(), "middle_torque": torque[MIDDLE], "rear_torque": torque[TAIL]}


def _stage_three(walk: Pass) -> dict[str, float]:
    poses = walk.record.magnet_poses
    top = int(poses[:, MIDDLE, 1].argmax())
    apart = poses[:, TAIL, 0] - poses[:, HEAD, 0]
    return {
        "peak_force": walk.force[top, MIDDLE, 1],
        "peak_place": MM * (walk.record.drive_positions[top, 0, 0] - poses[top, MIDDLE, 0]),
        "drawn": MM * (apart[0] - apart[top]),
    }


def _stage_four(walk: Pass) -> dict[str, float]:
    poses = walk.record.magnet_poses
    top = int(poses[:, MIDDLE, 1].argmax())
    moved = MM * (poses[top, :, 0] - poses[-1, :, 0])
    return {
        "rear_anchor": walk.force[walk.stages[3], TAIL, 1][0],
        "head_push": moved[HEAD],
        "rear_slip": -moved[TAIL],
        "rear_lift": MM * walk.soles[:, TAIL, 1].max(),
    }
