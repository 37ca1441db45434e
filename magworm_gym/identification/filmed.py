"""Comparing a recording with what a camera saw."""

from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from magworm_gym.documents import Text
from magworm_gym.identification.camera import Camera
from magworm_gym.identification.deeplabcut import Tracks
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.residual import robust
from magworm_gym.identification.targets import Aim, Outcome, Recordings
from magworm_gym.recording import Floats, Recording

DEFAULT_TOLERANCE_PX = 1.5


class FilmTable(Camera, frozen=True, kw_only=True):
    """Tracks and the camera that they were seen with, as they stand in a problem file.

    Attributes:
        file: Name of the file.
        magnets: Body part of each magnet from the head; an empty text for one that was not tracked.
        individual: Which animal, where there are several.
        least_likelihood: Points below are left out [1].
        tolerance_m: Deviation that counts as one [m]; None for 1.5 pixels.
        independent_s: Time after which deviations are independent [s].
    """

    file: Text
    magnets: list[str]
    individual: Text | None = None
    least_likelihood: Annotated[float, Meta(ge=0.0, le=1.0)] = 0.6
    tolerance_m: Annotated[float, Meta(ge=1e-9, le=1.0)] | None = None
    independent_s: Annotated[float, Meta(ge=1e-6, le=1e3)] = 0.1


@dataclass(frozen=True, kw_only=True)
class Film(Aim):
    """Confident places of magnets in a film.

    Attributes:
        experiment: Name of the experiment that was filmed.
        camera: The camera.
        time_s: Times of the places since the experiment began (N,) [s].
        magnet: Which magnet each place is of (N,), counted from the head.
        points_m: The places (N, 2) in the axes of the scene [m].
    """

    experiment: str
    camera: Camera
    time_s: Floats
    magnet: NDArray[np.int64]
    points_m: Floats

    @property
    def allowance(self) -> float:
        """A tolerance of each of its independent measurements."""
        return self.weight

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

    def compared(self, recordings: Recordings) -> tuple[float, Floats]:
        """The root mean square deviation of a coordinate (1,), outliers left out."""
        rms = float(np.sqrt(np.mean(np.square(self._usual(recordings)))))
        return rms, np.array([rms / self.tolerance])

    def residuals(self, recordings: Recordings) -> Floats:
        """Residuals (2 N,) [1], scaled so that the film counts for ``weight`` measurements."""
        deviation = self.deviation_m(recordings[self.experiment]).ravel() / self.tolerance
        return np.asarray(robust(deviation) * np.sqrt(self.weight / deviation.size))

    def outcome(self, recordings: Recordings) -> Outcome:
        """How well it is met, and how many outliers there are."""
        coordinates = self.points_m.size
        outliers = coordinates - self._usual(recordings).size
        return replace(
            super().outcome(recordings),
            remark=f"{len(self.time_s)} points of magnets, {outliers} of {coordinates} coordinates are "
            "outliers",
        )

    def _usual(self, recordings: Recordings) -> Floats:
        """Deviations of coordinates (U,) that are no outliers [m]."""
        deviation = self.deviation_m(recordings[self.experiment])
        spread = 1.4826 * float(np.median(np.abs(deviation)))
        return np.asarray(deviation[np.abs(deviation) < 5.0 * max(self.tolerance, spread)])


def film(experiment: str, tracks: Tracks, table: FilmTable, duration_s: float) -> Film:
    """Picks the confident points of an experiment.

    Args:
        experiment: Its name.
        tracks: What the tracking found.
        table: How it was filmed.
        duration_s: Duration of the experiment [s].

    Raises:
        ProblemError: No such body part, or nothing left of it.
    """
    time_s = table.time_s(tracks.frames)
    during = (time_s >= 0.0) & (time_s <= duration_s + 1e-9)
    times, magnets, points = [], [], []
    for magnet, part in enumerate(table.magnets):
        if not part:
            continue
        kept = during & tracks.sure(part, table.least_likelihood)
        if not kept.any():
            raise ProblemError(
                f"{tracks.file}: no frame of {part!r} lies between 0 and {duration_s:g} s of experiment "
                f"{experiment!r} with a likelihood of at least {table.least_likelihood:g}"
            )
        times.append(time_s[kept])
        magnets.append(np.full(np.count_nonzero(kept), magnet))
        points.append(table.points_m(tracks.part(part)[kept, :2]))
    points_m = np.concatenate(points)
    tolerance_m = table.tolerance_m or DEFAULT_TOLERANCE_PX * table.metres_per_pixel
    share = min(1.0, 1.0 / (table.independent_s * table.frames_per_second))
    return Film(
        name=f"{experiment}: tracks, rms deviation of a coordinate in m",
        wanted=f"within {tolerance_m:g}",
        sources=frozenset({experiment}),
        tolerance=tolerance_m,
        band=1.0,
        weight=max(1.0, points_m.size * share),
        experiment=experiment,
        camera=table,
        time_s=np.concatenate(times),
        magnet=np.concatenate(magnets),
        points_m=points_m,
    )
