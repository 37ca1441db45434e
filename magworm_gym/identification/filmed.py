"""Comparing a recording with what a camera saw."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from magworm_gym.identification.camera import Camera
from magworm_gym.identification.deeplabcut import Tracks
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.residual import robust
from magworm_gym.identification.targets import Outcome, Recordings
from magworm_gym.recording import Recording

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Film:
    """Confident places of magnets in a film.

    Attributes:
        experiment: Name of the experiment that was filmed.
        camera: The camera.
        time_s: Times of the places since the experiment began (N,) [s].
        magnet: Which magnet each place is of (N,), counted from the head.
        points_m: The places (N, 2) in the axes of the scene [m].
        tolerance_m: Deviation that counts as one: what tracking and model may be off [m].
        independent_s: Time after which two deviations count as independent of each other [s].
        fitted: Whether it is part of the loss.
    """

    experiment: str
    camera: Camera
    time_s: Floats
    magnet: NDArray[np.int64]
    points_m: Floats
    tolerance_m: float
    independent_s: float
    fitted: bool = True

    @property
    def sources(self) -> frozenset[str]:
        """Name of its experiment."""
        return frozenset({self.experiment})

    @property
    def name(self) -> str:
        """What is compared."""
        return f"{self.experiment}: tracks, rms deviation of a coordinate in m"

    @property
    def allowance(self) -> float:
        """A tolerance of each of its independent measurements."""
        return self.weight

    @cached_property
    def weight(self) -> float:
        """Number of independent measurements that it counts for [1]."""
        share = min(1.0, 1.0 / (self.independent_s * self.camera.frames_per_second))
        return max(1.0, self.points_m.size * share)

    def deviation_m(self, recording: Recording) -> Floats:
        """Model minus track (N, 2) [m], the camera's offset removed."""
        sample_s = recording.time_s[1] - recording.time_s[0]
        position = np.clip(self.time_s / sample_s, 0.0, len(recording.time_s) - 1)
        before = np.minimum(position.astype(np.int64), len(recording.time_s) - 2)
        share = (position - before)[:, None]
        places = recording.magnet_poses[..., :2]
        model = places[before, self.magnet] * (1.0 - share) + places[before + 1, self.magnet] * share
        deviation = model - self.points_m
        return np.asarray(deviation - self.camera.offset_m(self.time_s, deviation))

    def residuals(self, recordings: Recordings) -> Floats:
        """Residuals (2 N,) [1], scaled so that the film counts for ``weight`` measurements."""
        deviation = self.deviation_m(recordings[self.experiment]).ravel() / self.tolerance_m
        return np.asarray(robust(deviation) * np.sqrt(self.weight / deviation.size))

    def outcome(self, recordings: Recordings) -> Outcome:
        """How well it is met: the root mean square deviation of a coordinate, outliers left out."""
        deviation = self.deviation_m(recordings[self.experiment])
        usual = np.abs(deviation) < 5.0 * max(self.tolerance_m, 1.4826 * float(np.median(np.abs(deviation))))
        rms = float(np.sqrt(np.mean(np.square(deviation[usual]))))
        return Outcome(
            name=self.name,
            target=f"within {self.tolerance_m:g}",
            model=rms,
            error_percent=None,
            error_tolerances=rms / self.tolerance_m,
            loss=float(np.square(self.residuals(recordings)).sum()),
            remark=f"{len(self.time_s)} points of magnets, {np.count_nonzero(~usual)} of "
            f"{usual.size} coordinates are outliers",
            met=rms <= self.tolerance_m,
        )


def film(
    experiment: str,
    tracks: Tracks,
    camera: Camera,
    parts: list[str],
    *,
    duration_s: float,
    least_likelihood: float,
    tolerance_m: float,
    independent_s: float,
) -> Film:
    """Picks the confident points of an experiment.

    Args:
        experiment: Its name.
        tracks: What the tracking found.
        camera: The camera.
        parts: Body part of each magnet from the head; an empty text for one that was not tracked.
        duration_s: Duration of the experiment [s].
        least_likelihood: Points below are left out [1].
        tolerance_m: Deviation that counts as one [m].
        independent_s: Time after which deviations are independent [s].

    Raises:
        ProblemError: No such body part, or nothing left of it.
    """
    time_s = camera.time_s(tracks.frames)
    times, magnets, points = [], [], []
    for magnet, part in enumerate(parts):
        if not part:
            continue
        kept = (time_s >= 0.0) & (time_s <= duration_s + 1e-9)
        kept &= tracks.sure(part, least_likelihood)
        if not kept.any():
            raise ProblemError(
                f"{tracks.file}: no frame of {part!r} lies between 0 and {duration_s:g} s of experiment "
                f"{experiment!r} with a likelihood of at least {least_likelihood:g}"
            )
        times.append(time_s[kept])
        magnets.append(np.full(np.count_nonzero(kept), magnet))
        points.append(camera.points_m(tracks.part(part)[kept, :2]))
    return Film(
        experiment,
        camera,
        np.concatenate(times),
        np.concatenate(magnets),
        np.concatenate(points),
        tolerance_m,
        independent_s,
    )
