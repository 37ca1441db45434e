"""A robot at many speeds of the drive, side by side in the lanes of a batch.

Speeds and what else differs between its robots are factors of one scene, so they share its model: that costs
a fifth of scenes of their own. Robots are sorted by speed, since lanes wait for the slowest of them.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import ceil
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from magworm_gym._magworm import Batch, Scene
from magworm_gym.documents import Table, parse_toml
from magworm_gym.identification.experiment import Run
from magworm_gym.recording import Floats, Recording

LANES = {"double": 8, "single": 16}
"""Robots that run side by side by the precision: the lanes of a block."""

SPEED = "drive_speed"
"""Name of the factor of the drive's speed."""


class Passes(Table, frozen=True):
    """Passes of a belt that are measured.

    Attributes:
        pitch_m: Distance between its magnets [m].
        first: Passes that are left out at the beginning; ``first_passes`` in a problem file.
        count: Passes that are measured; ``passes`` there.
    """

    pitch_m: Annotated[float, Meta(ge=0.01, le=10.0)]
    first: Annotated[int, Meta(ge=0, le=1000)] = msgspec.field(default=0, name="first_passes")
    count: Annotated[int, Meta(ge=1, le=1000)] = msgspec.field(default=1, name="passes")


@dataclass(frozen=True)
class Lane:
    """One robot of a sweep.

    Attributes:
        name: Name of its recording.
        speed_m_s: Speed of its drive, positive [m/s].
        factors: Factors of its scene's values by name, the speed's left out.
    """

    name: str
    speed_m_s: float
    factors: Mapping[str, float]


@dataclass(frozen=True)
class Sweep(Run):
    """A robot that a drive in constant motion passes at many speeds, each under a few conditions.

    Attributes:
        speeds_m_s: Speeds of the drive (S,), rising [m/s].
        conditions: Factors of the scene's values by name (C,); results are averaged over them.
        backward: Whether the drive moves from tail to head.
        ahead_m: How far ahead of the end that it meets first the drive starts [m].
        beyond_m: How far beyond the other end a single drive magnet has passed [m].
        settle_s: How long the robot is given from then on, while the drive moves on [s].
        belt: Passes that are measured where the drive is a belt.
    """

    speeds_m_s: tuple[float, ...]
    conditions: tuple[Mapping[str, float], ...] = ({},)
    backward: bool = False
    ahead_m: float = 0.05
    beyond_m: float = 0.05
    settle_s: float = 0.25
    belt: Passes | None = None

    @cached_property
    def lanes(self) -> list[list[Lane]]:
        """Its robots, by speed (S) and condition (C)."""
        return [
            [
                Lane(
                    f"{self.name}/{place}/{at}",
                    speed_m_s * condition.get(SPEED, 1.0),
                    {name: factor for name, factor in condition.items() if name != SPEED},
                )
                for at, condition in enumerate(self.conditions)
            ]
            for place, speed_m_s in enumerate(self.speeds_m_s)
        ]

    @property
    def simulated_s(self) -> float:
        """Simulated time of a candidate, all its robots together, before parameters are set [s]."""
        return sum(self._span_s(self.scene, lane)[1] for lanes in self.lanes for lane in lanes)

    def record(self, values: Mapping[str, float], sample_s: float) -> dict[str, Recording]:
        """Every robot in the passes that are measured, by its lane's name; see :meth:`Run.record`."""
        scene = self.fitted_scene(values)
        start_m, sign = (scene.body_length_m + self.ahead_m, -1.0) if self.backward else (-self.ahead_m, 1.0)
        motion = {"drive.motion.x_m": start_m, "drive.motion.speed_m_s": sign * self.speeds_m_s[0]}
        scene = scene.with_values({**motion, "control.step_s": sample_s})
        lanes = sorted((lane for row in self.lanes for lane in row), key=lambda lane: lane.speed_m_s)
        recordings: dict[str, Recording] = {}
        for first in range(0, len(lanes), self._block):
            recordings.update(self._side_by_side(scene, lanes[first : first + self._block], sample_s))
        return recordings

    @cached_property
    def _block(self) -> int:
        """Lanes of a block."""
        return LANES[parse_toml(self.scene.to_toml(), self.name)["solver"]["precision"]]

    def _side_by_side(self, scene: Scene, lanes: list[Lane], sample_s: float) -> dict[str, Recording]:
        batch = self._batch(scene, lanes)
        spans = [_samples(self._span_s(scene, lane), sample_s) for lane in lanes]
        samples = max(last for _, last in spans)
        start = batch.magnet_poses()[None]
        unused = np.zeros((samples, len(lanes), sum(each.size for each in batch.action_specification)))
        seen = batch.rollout(unused, magnet_poses=True)
        assert seen.magnet_poses is not None, "they were asked for"
        poses = np.concatenate([start, seen.magnet_poses])
        present = np.ones(scene.magnets, np.bool_)
        present[list(scene.removed)] = False
        return {
            lane.name: _recording(poses[:, at], present, spans[at], sample_s, int(seen.status[-1, at]))
            for at, lane in enumerate(lanes)
        }

    def _batch(self, scene: Scene, lanes: list[Lane]) -> Batch:
        """A batch at its start with the speeds and factors of its lanes."""
        count = len(lanes)
        batch = Batch(scene, count, threads=1)
        batch.set_parameter(SPEED, [lane.speed_m_s / self.speeds_m_s[0] for lane in lanes])
        for name in lanes[0].factors:
            batch.set_parameter(name, [lane.factors[name] for lane in lanes])
        nought = np.zeros(count, np.uint64)
        batch.reset(np.ones(count, np.bool_), nought, nought)
        return batch

    def _span_s(self, scene: Scene, lane: Lane) -> tuple[float, float]:
        """When what is measured begins and when it ends [s]; on a belt, halfway between its magnets."""
        if self.belt is None:
            way_m = self.ahead_m + scene.body_length_m + self.beyond_m
            return 0.0, way_m / lane.speed_m_s + self.settle_s
        middle_m = self.ahead_m + 0.5 * scene.body_length_m - 0.5 * self.belt.pitch_m
        first_m = max(0.0, middle_m + self.belt.first * self.belt.pitch_m)
        last_m = middle_m + (self.belt.first + self.belt.count) * self.belt.pitch_m
        return first_m / lane.speed_m_s, last_m / lane.speed_m_s


def _samples(span_s: tuple[float, float], sample_s: float) -> tuple[int, int]:
    """First and last sample of a span of time."""
    return round(span_s[0] / sample_s), ceil(span_s[1] / sample_s)


def _recording(
    poses: Floats, present: NDArray[np.bool_], span: tuple[int, int], sample_s: float, status: int
) -> Recording:
    poses = poses[span[0] : span[1] + 1]
    return Recording(
        time_s=sample_s * np.arange(len(poses), dtype=np.float64),
        nodes=np.empty((len(poses), 0, 2)),
        magnet_poses=poses,
        present=present,
        drive_positions=np.empty((len(poses), 0, 2)),
        broken=Batch.status_text(status) if status else None,
    )
