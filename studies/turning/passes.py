"""One pass of a drive magnet in space.

x runs from head to tail, y is up, z to the robot's left. The drive moves along +x, beside the robot by its
offset along +z. Angles are positive anticlockwise as seen from above: towards a drive on the left.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.passes import AHEAD_M, CARRIED_M, MM, robot, steady, unbroken

Floats = NDArray[np.float64]

TIPPED_DEG = 60.0
"""Ours: a foot that rolls further has tipped over, as in the task of turning."""
BEYOND_M = 0.050
"""Ours: where a pass ends, beyond the tail."""
REST_S = 0.3
"""Ours: how long the robot then lies."""
SAMPLE_S = 0.01


@dataclass(frozen=True)
class Drive:
    """A pass: the robot and how the drive magnet goes by."""

    magnets: int  # magnets of the robot
    offset_mm: float = 0.0  # offset of the drive along z [mm]
    yaw_deg: float = 0.0  # yaw of the drive [°]
    height_mm: float = -22.0  # height of the drive [mm]
    speed_mm_s: float = 100.0  # its speed along x [mm/s]
    step_ms: float = 2.0  # step of the solver [ms]
    friction: float | None = None  # none for the preset's, which falls as a foot begins to slide

    def scene(self) -> Scene:
        """The preset with as many magnets, in space, under this drive."""
        beside = {"z_m": self.offset_mm / MM, "yaw_deg": self.yaw_deg}
        motion = steady(-AHEAD_M, self.height_mm / MM, self.speed_mm_s / MM, **beside)
        changes = {"dimensions": 3, "drive.motion": motion, "solver.step_s": self.step_ms / MM}
        if self.friction is not None:
            changes |= {f"ground.{kind}_friction": self.friction for kind in ("static", "dynamic")}
        return robot(self.magnets).with_values(changes)

    def duration_s(self, body_length_m: float) -> float:
        """From 50 mm ahead of the head to 50 mm beyond the tail, and a rest [s]."""
        way_s = (AHEAD_M + body_length_m + BEYOND_M) * MM / self.speed_mm_s
        return SAMPLE_S * math.ceil((way_s + REST_S) / SAMPLE_S)


@dataclass(frozen=True)
class Rolls:
    """How far feet rolled about their own length."""

    roll_deg: tuple[float, ...]  # greatest roll of each foot during the pass, from the head on [°]
    end_roll_deg: float  # greatest roll of any foot at its end [°]

    @property
    def tipped(self) -> bool:
        """Whether a foot rolled beyond 60° at any time."""
        return max(self.roll_deg) > TIPPED_DEG

    @property
    def overturned(self) -> bool:
        """Whether a foot lies beyond 60° at the end."""
        return self.end_roll_deg > TIPPED_DEG


@dataclass(frozen=True)
class Outcome:
    """What one pass did."""

    turn_deg: float  # turn of the line from head to tail magnet [°]
    side_mm: float  # way of the centre along +z [mm]
    stride_mm: float  # way of the centre along −x [mm]
    rolls: Rolls  # how far the feet rolled

    @property
    def carried(self) -> bool:
        """Whether the drive carried the robot along, further than one magnet pitch."""
        return self.stride_mm < -MM * CARRIED_M


@dataclass(frozen=True)
class Tipping:
    """A single pass and how far the feet rolled in it."""

    drive: Drive
    rolls: Rolls


def outcomes(drives: Sequence[Drive]) -> list[Outcome]:
    """Runs passes, all side by side.

    Raises:
        RuntimeError: A simulation broke down; the sentence says why.
    """
    scenes = [drive.scene() for drive in drives]
    durations = [drive.duration_s(scene.body_length_m) for drive, scene in zip(drives, scenes, strict=True)]
    return [outcome_of(record) for record in record_scenes(scenes, durations, SAMPLE_S, nodes=False)]


def outcome_of(record: Recording) -> Outcome:
    """What a pass did.

    Raises:
        RuntimeError: The simulation broke down; the sentence says why.
    """
    poses = unbroken(record).magnet_poses
    along = poses[[0, -1], -1, :3] - poses[[0, -1], 0, :3]
    before, after = np.degrees(np.arctan2(-along[:, 2], along[:, 0]))
    moved = MM * (record.centre[-1] - record.centre[0])
    roll = np.abs(rolls_deg(poses[..., 3:]))
    return Outcome(
        turn_deg=float((after - before + 180.0) % 360.0 - 180.0),
        side_mm=float(moved[2]),
        stride_mm=float(-moved[0]),
        rolls=Rolls(tuple(roll.max(axis=0).tolist()), float(roll[-1].max())),
    )


def rolls_deg(quaternions: Floats) -> Floats:
    """Roll of magnets about their own tangents (...) [°], from quaternions w, x, y, z (..., 4)."""
    w, x, y, z = np.moveaxis(quaternions, -1, 0)
    up_y, side_y = 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)
    return np.asarray(np.degrees(np.arctan2(-side_y, up_y)))
