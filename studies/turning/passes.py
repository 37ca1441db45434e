"""One pass of a drive magnet in space, averaged over neighbouring heights of its plane.

x runs from head to tail, y is up, z to the robot's left. The drive moves along +x, beside the robot by its
offset along +z. Yaw is positive anticlockwise as seen from above: towards a drive on the left.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.passes import AHEAD_M, CARRIED_M

Floats = NDArray[np.float64]

MM = 1e3
NEIGHBOURS_MM = (-0.2, -0.1, 0.0, 0.1, 0.2)
"""Ours: heights around that of a point; stick and slip make a single pass a rugged function of everything."""
TIPPED_DEG = 60.0
"""Ours: a foot that rolls further has tipped over, as in Turn-v0."""
BEYOND_M = 0.050
"""Ours: where a pass ends, beyond the tail."""
REST_S = 0.3
"""Ours: how long the robot then lies."""
SAMPLE_S = 0.01


@dataclass(frozen=True)
class Drive:
    """A pass: the robot and how the drive magnet goes by.

    Attributes:
        magnets: Magnets of the robot.
        offset_mm: Offset of the drive along z [mm].
        yaw_deg: Yaw of the drive [°].
        height_mm: Height of the drive [mm].
        speed_mm_s: Its speed along x [mm/s].
        step_ms: Step of the solver [ms].
        friction: Coefficient at rest and in motion; none for the preset's, which falls as a foot slides.
    """

    magnets: int
    offset_mm: float = 0.0
    yaw_deg: float = 0.0
    height_mm: float = -22.0
    speed_mm_s: float = 100.0
    step_ms: float = 2.0
    friction: float | None = None

    def scene(self) -> Scene:
        """The preset with as many magnets, in space, under this drive."""
        motion = {
            "kind": "constant",
            "x_m": -AHEAD_M,
            "y_m": self.height_mm / MM,
            "z_m": self.offset_mm / MM,
            "yaw_deg": self.yaw_deg,
            "speed_m_s": self.speed_mm_s / MM,
        }
        changes = {"dimensions": 3, "drive.motion": motion, "solver.step_s": self.step_ms / MM}
        if self.friction is not None:
            changes |= {f"ground.{kind}_friction": self.friction for kind in ("static", "dynamic")}
        return Scene.preset(f"paper-{self.magnets}").with_values(changes)

    def duration_s(self, body_length_m: float) -> float:
        """From 50 mm ahead of the head to 50 mm beyond the tail, and a rest [s]."""
        way_s = (AHEAD_M + body_length_m + BEYOND_M) * MM / self.speed_mm_s
        return SAMPLE_S * math.ceil((way_s + REST_S) / SAMPLE_S)


@dataclass(frozen=True)
class Outcome:
    """What one pass did.

    Attributes:
        yaw_deg: Turn of the line from head to tail magnet [°].
        side_mm: Way of the centre along +z [mm].
        stride_mm: Way of the centre along −x [mm].
        roll_deg: Greatest roll of each foot during the pass (M,) [°].
        end_roll_deg: Greatest roll of any foot at its end [°].
    """

    yaw_deg: float
    side_mm: float
    stride_mm: float
    roll_deg: Floats
    end_roll_deg: float

    @property
    def tipped(self) -> bool:
        """Whether a foot rolled beyond 60° at any time."""
        return bool(self.roll_deg.max() > TIPPED_DEG)

    @property
    def overturned(self) -> bool:
        """Whether a foot lies beyond 60° at the end."""
        return self.end_roll_deg > TIPPED_DEG

    @property
    def carried(self) -> bool:
        """Whether the drive carried the robot along, further than one magnet pitch."""
        return self.stride_mm < -MM * CARRIED_M


@dataclass(frozen=True)
class Spread:
    """A mean over neighbours, and their range; not a number where none of them is kept."""

    mean: float
    low: float
    high: float


@dataclass(frozen=True)
class Point:
    """A pass averaged over neighbouring heights. Means are over passes that neither tipped nor were carried.

    Attributes:
        drive: The pass in the middle.
        passes: How many neighbours were run.
        tipped: In how many a foot rolled beyond 60°.
        overturned: In how many it did not come back.
        carried: How many others the drive carried along.
        yaw_deg: Turn [°].
        side_mm: Way along +z, towards the drive [mm].
        stride_mm: Way along −x [mm].
        roll_deg: Greatest roll of each foot, mean over all neighbours (M,) [°].
    """

    drive: Drive
    passes: int
    tipped: int
    overturned: int
    carried: int
    yaw_deg: Spread
    side_mm: Spread
    stride_mm: Spread
    roll_deg: Floats

    @property
    def kept(self) -> int:
        """How many neighbours the means are over."""
        return self.passes - self.tipped - self.carried


def rolls_deg(quaternions: Floats) -> Floats:
    """Roll of magnets about their own tangents (...) [°], from quaternions w, x, y, z (..., 4)."""
    w, x, y, z = np.moveaxis(quaternions, -1, 0)
    up_y, side_y = 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)
    return np.asarray(np.degrees(np.arctan2(-side_y, up_y)))


def outcome_of(record: Recording) -> Outcome:
    """What a pass did.

    Raises:
        RuntimeError: The simulation broke down; the sentence says why.
    """
    if record.broken is not None:
        raise RuntimeError(f"a simulation broke down: {record.broken}")
    along = record.magnet_poses[[0, -1], -1, :3] - record.magnet_poses[[0, -1], 0, :3]
    before, after = np.degrees(np.arctan2(-along[:, 2], along[:, 0]))
    moved = MM * (record.centre[-1] - record.centre[0])
    roll = np.abs(rolls_deg(record.magnet_poses[..., 3:]))
    return Outcome(
        yaw_deg=float((after - before + 180.0) % 360.0 - 180.0),
        side_mm=float(moved[2]),
        stride_mm=float(-moved[0]),
        roll_deg=np.asarray(roll.max(axis=0)),
        end_roll_deg=float(roll[-1].max()),
    )


def outcomes(drives: Sequence[Drive]) -> list[Outcome]:
    """Runs passes, all side by side."""
    scenes = [drive.scene() for drive in drives]
    durations = [drive.duration_s(scene.body_length_m) for drive, scene in zip(drives, scenes, strict=True)]
    return [outcome_of(record) for record in record_scenes(scenes, durations, SAMPLE_S, nodes=False)]


def averaged(drive: Drive, found: Sequence[Outcome]) -> Point:
    """Averages the neighbours of a pass."""
    upright = [outcome for outcome in found if not outcome.tipped]
    kept = [outcome for outcome in upright if not outcome.carried]
    return Point(
        drive=drive,
        passes=len(found),
        tipped=len(found) - len(upright),
        overturned=sum(outcome.overturned for outcome in found),
        carried=len(upright) - len(kept),
        yaw_deg=spread([outcome.yaw_deg for outcome in kept]),
        side_mm=spread([outcome.side_mm for outcome in kept]),
        stride_mm=spread([outcome.stride_mm for outcome in kept]),
        roll_deg=np.mean([outcome.roll_deg for outcome in found], axis=0),
    )


def spread(values: Sequence[float]) -> Spread:
    """Mean and range of values, of which there may be none."""
    if not values:
        return Spread(math.nan, math.nan, math.nan)
    return Spread(float(np.mean(values)), min(values), max(values))


def points(drives: Sequence[Drive], neighbours_mm: Sequence[float] = NEIGHBOURS_MM) -> list[Point]:
    """Runs each pass at neighbouring heights and averages."""
    around = [
        replace(drive, height_mm=drive.height_mm + shift) for drive in drives for shift in neighbours_mm
    ]
    found, count = outcomes(around), len(neighbours_mm)
    return [averaged(drive, found[i * count : (i + 1) * count]) for i, drive in enumerate(drives)]
