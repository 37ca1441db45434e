"""What can be seen to be wrong before a search: scale, order, frame rate, clock and place of the drive.

What cannot be meant is refused; what need not be a mistake is said.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from magworm_gym._magworm import Scene, SceneError
from magworm_gym.identification.camera import Camera
from magworm_gym.identification.deeplabcut import Tracks
from magworm_gym.identification.experiment import Experiment
from magworm_gym.identification.filmed import Film
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.targets import Aim, Target
from magworm_gym.recording import Floats, Recording, record_scenes

REST_S = 0.1
"""Time at the beginning of a film in which marks are taken to be at rest [s]."""

WRONG_SCALE, DOUBTFUL_SCALE = 5.0, 1.25
"""Ratio of distances, of the film or of the scene, from which on a scale cannot be meant, or is said [1]."""

BACKWARD = 0.25
"""Part of the way between two magnets by which the next one may lie in the wrong direction [1]."""

TILTED_DEG = 5.0

RATES = (0.125, 0.25, 0.5, 2.0 / 3.0, 0.8, 1.0, 1.25, 1.5, 2.0, 4.0, 8.0)
"""Times the frame rate that is given with which a film is tried [1]."""

SHIFTS_S = tuple(step / 10.0 for step in range(-10, 11))
"""Times by which a film is tried to be late [s]."""

MOST_TRIED_S = 20.0
"""Longest time that is simulated to try other frame rates, unless the film is longer [s]."""

CLEARLY = 0.4
"""Part of its loss, or of that of a robot at rest, with which another reading of a film is suggested [1]."""

STILL, MOVED = 0.1, 10.0
"""Part of the way of marks up to which magnets are still [1]; tolerances from which marks have moved [1]."""

FAR_M = 0.1
"""Distance at which a drive magnet no longer moves a robot [m]."""

MOST_LENGTHS = 10.0
"""Lengths of the body from which on a target is taken to have another unit [1]."""


def check_at_rest(film: Film, scene: Scene) -> list[str]:
    """What there is to say where marks are in the first frames, and where the scene has its magnets.

    Raises:
        ProblemError: A scale or an order that cannot be meant.
    """
    magnets, seen_m = _at_rest(film)
    if len(magnets) < 2:
        return []
    start_m = start_places(scene)[magnets]
    reach_m = start_m[-1] - start_m[0]
    length_m, seen_length_m = np.linalg.norm(reach_m), np.linalg.norm(seen_m[-1] - seen_m[0])
    told = f"{film.experiment}: the marks at rest"
    apart = f"{told} reach over {seen_length_m:.3g} m and the magnets of the scene over {length_m:.3g} m"
    ratio = seen_length_m / length_m
    if not 1.0 / WRONG_SCALE <= ratio <= WRONG_SCALE:
        raise ProblemError(f"{apart}; allowed: a metres_per_pixel (--metres-per-pixel) with which they agree")
    along, meant = (np.diff(places @ reach_m) / length_m for places in (seen_m, start_m))
    if (along < -BACKWARD * meant).all():
        raise ProblemError(
            f"{told} lie from the tail to the head; allowed: magnets (--magnets) from the head, and head "
            f"(--head) as the side of the image that it points to, now {film.camera.head!r}"
        )
    if (along < -BACKWARD * meant).any():
        raise ProblemError(
            f"{told} lie in another order than the magnets; allowed: magnets (--magnets) from the head"
        )
    remarks = []
    if not 1.0 / DOUBTFUL_SCALE <= ratio <= DOUBTFUL_SCALE:
        remarks.append(f"{apart}: is metres_per_pixel right?")
    turned = complex(*(seen_m[-1] - seen_m[0])) / complex(*reach_m)
    turn_deg = np.degrees(np.angle(turned))
    if abs(turn_deg) > TILTED_DEG:
        remarks.append(
            f"{told} are turned by {turn_deg:.0f}° from the magnets of the scene: is angle_deg right?"
        )
    return remarks


def check_frames(tracks: Tracks, camera: Camera) -> None:
    """Refuses frames whose numbers rise as times in ms would.

    Raises:
        ProblemError: They do.
    """
    steps = np.diff(tracks.frames)
    milliseconds = 1000.0 / camera.frames_per_second
    if len(steps) and milliseconds > 2.0 and abs(float(np.median(steps)) - milliseconds) < 0.6:
        raise ProblemError(
            f"{tracks.file}, column 1 rises by {np.median(steps):g} a row, and at frames_per_second = "
            f"{camera.frames_per_second:g} so do ms; allowed: the frame's number; is it a time in ms?"
        )


def start_places(scene: Scene) -> Floats:
    """Places of the magnets in the start pose (M, 2) [m]."""
    step_s = scene.control_step_s
    return record_scenes([scene], step_s, step_s, nodes=False)[0].magnet_poses[0, :, :2]


def _at_rest(film: Film) -> tuple[list[int], Floats]:
    """Magnets that are seen, and the medians of their first places (K, 2) [m]."""
    magnets, places = sorted(set(film.magnet.tolist())), []
    for magnet in magnets:
        time_s = film.time_s[film.magnet == magnet]
        begun = time_s <= time_s.min() + REST_S
        places.append(np.median(film.points_m[film.magnet == magnet][begun], axis=0))
    return magnets, np.array(places)


def doubts(experiments: Sequence[Experiment], aims: Sequence[Aim], sample_s: float) -> Iterator[str]:
    """What there is to say where films and drives are compared with the scene as it is, once run."""
    films = {aim.experiment: aim for aim in aims if isinstance(aim, Film)}
    for experiment in experiments:
        length_m = experiment.scene.body_length_m
        for aim in aims:
            if isinstance(aim, Target) and aim.quantity[0] == experiment.name:
                yield from _doubts_of_unit(aim, length_m)
        try:
            yield from _doubts_of_run(experiment, films.get(experiment.name), sample_s)
        except SceneError:  # the scene as it is may lie outside of the bounds that the search keeps
            continue


def _doubts_of_unit(target: Target, length_m: float) -> Iterator[str]:
    """Of a target that is a length."""
    asked_m = max(abs(bound) for bound in (target.low, target.high) if np.isfinite(bound))
    if target.quantity[1].kind.endswith("_m") and asked_m > MOST_LENGTHS * length_m:
        yield f"{target.name} is asked to be {asked_m:g} m, and the body is {length_m:.3g} m long: in m?"


def _doubts_of_run(experiment: Experiment, film: Film | None, sample_s: float) -> Iterator[str]:
    """Of the time and place of a drive, and of a film."""
    longest_s = max(experiment.duration_s, min(MOST_TRIED_S, experiment.duration_s / min(RATES)))
    tried_s = experiment.duration_s if film is None else sample_s * round(longest_s / sample_s)
    run = replace(experiment, duration_s=tried_s).record({}, sample_s)[experiment.name]
    until = round(experiment.duration_s / sample_s) + 1
    away_m = run.drive_positions[:until, :, None, :2] - run.magnet_poses[:until, None, :, :2]
    nearest_m = float(np.linalg.norm(away_m, axis=-1).min(initial=np.inf))
    if FAR_M < nearest_m < np.inf:
        yield (
            f"{experiment.name}: the drive comes no nearer to the robot than {nearest_m:.3g} m: are its "
            "place in m, its speed and its time right?"
        )
    elif film is not None and run.broken is None:
        yield from _doubts_of_film(film, run)


def _doubts_of_film(film: Film, run: Recording) -> Iterator[str]:
    """Of frame rate, clock and axes, where another reading of the film fits the scene as it is far better."""
    name, camera = film.experiment, film.camera
    losses = {
        (rate, shift_s): _loss(replace(film, time_s=(film.time_s - shift_s) / rate), run)
        for rate, shift_s in product(RATES, SHIFTS_S)
    }
    (rate, shift_s), least = min(losses.items(), key=lambda item: item[1])
    mirrored = _loss(replace(film, points_m=film.points_m * np.array([1.0, -1.0])), run)
    still = _loss(replace(film, time_s=np.zeros(len(film.time_s))), run)
    enough = CLEARLY * min(losses[1.0, 0.0], still)
    rise_m, model_rise_m = _rise_m(film), float(np.ptp(run.magnet_poses[..., 1], axis=0).max())
    as_if = f"{name}: the marks move as the magnets of the scene would"
    if model_rise_m < STILL * rise_m and rise_m > MOVED * film.tolerance:
        yield (
            f"{name}: the marks rise by {rise_m:.2g} m and the scene's magnets by {model_rise_m:.2g} m: does "
            "the drive pass them in that time?"
        )
    elif mirrored < min(enough, least):
        other = "up" if camera.y_axis == "down" else "down"
        yield f'{as_if} with y_axis = "{other}"'
    elif least < enough and rate != 1.0:
        given = camera.frames_per_second
        told = f"about {rate * given:.3g} frames per second: is frames_per_second = {given:g} right?"
        yield f"{as_if} at {told}"
    elif least < enough and shift_s != 0.0:
        when = "earlier" if shift_s > 0.0 else "later"
        yield f"{as_if} {abs(shift_s):.1f} s {when}: is the time right at which the drive begins (start_s)?"


def _rise_m(film: Film) -> float:
    """By how much the mark that moves most rises and falls, outliers left out [m]."""
    heights = (film.points_m[film.magnet == magnet, 1] for magnet in np.unique(film.magnet))
    return max(float(np.ptp(np.percentile(each, [5.0, 95.0]))) for each in heights)


def _loss(film: Film, run: Recording) -> float:
    return float(np.square(film.residuals({film.experiment: run})).sum())
