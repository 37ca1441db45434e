"""What can be seen to be wrong before a search: scale, order, frame rate, clock and place of the drive.

What cannot be meant is refused; what need not be a mistake is said.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene, SceneError
from magworm_gym.identification.camera import Camera
from magworm_gym.identification.deeplabcut import Tracks
from magworm_gym.identification.experiment import Experiment
from magworm_gym.identification.filmed import Film
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.targets import Comparison, Target
from magworm_gym.recording import Recording, record_scenes

if TYPE_CHECKING:
    from magworm_gym.identification.problem import Problem

Floats = NDArray[np.float64]

REST_S = 0.1
"""Time at the beginning of a film in which marks are taken to be at rest [s]."""

WRONG_SCALE, DOUBTFUL_SCALE = 5.0, 1.25
"""Ratio of distances, of the film or of the scene, from which on a scale cannot be meant, or is said [1]."""

BACKWARD = 0.25
"""Part of the way between two magnets by which the next one may lie in the wrong direction [1]."""

TILTED_DEG = 5.0

RATES = (0.125, 0.25, 0.5, 2.0 / 3.0, 0.8, 1.0, 1.25, 1.5, 2.0, 4.0, 8.0)
"""Times the frame rate that is given with which a film is tried [1]."""

SHIFTS_S = tuple(0.1 * step for step in range(-10, 11))
"""Times by which a film is tried to be late [s]."""

MOST_TRIED_S = 20.0
"""Longest time that is simulated to try other frame rates, unless the film is longer [s]."""

CLEARLY = 0.4
"""Part of its loss that another reading of a film must have to be suggested [1]."""

FAR_M = 0.1
"""Distance at which a drive magnet no longer moves a robot [m]."""

MOST_LENGTHS = 10.0
"""Lengths of the body from which on a target is taken to have another unit [1]."""


def check_at_rest(film: Film, scene: Scene) -> list[str]:
    """Compares where marks are in the first frames with where the scene has its magnets.

    Args:
        film: The film.
        scene: The scene of its experiment.

    Returns:
        What is to be said of it.

    Raises:
        ProblemError: A scale or an order that cannot be meant.
    """
    magnets, seen_m = _at_rest(film)
    if len(magnets) < 2:
        return []
    start_m = start_places(scene)[magnets]
    reach_m = start_m[-1] - start_m[0]
    length_m, seen_length_m = np.linalg.norm(reach_m), np.linalg.norm(seen_m[-1] - seen_m[0])
    told = f"{film.name.split(':')[0]}: the marks at rest"
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
    turn_deg = _angle_deg(seen_m[-1] - seen_m[0]) - _angle_deg(reach_m)
    turn_deg = (turn_deg + 180.0) % 360.0 - 180.0
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
    """Magnets that are seen at the beginning, and the medians of their places (K, 2) [m]."""
    begun = film.time_s <= film.time_s.min() + REST_S
    magnets = sorted(set(film.magnet[begun].tolist()))
    return magnets, np.array(
        [np.median(film.points_m[begun & (film.magnet == at)], axis=0) for at in magnets]
    )


def _angle_deg(way: Floats) -> float:
    return float(np.degrees(np.arctan2(way[1], way[0])))


def doubts(problem: "Problem") -> Iterator[str]:
    """What there is to say of a problem whose films are compared with the scene as it is.

    Args:
        problem: The problem.
    """
    for aim in problem.aims:
        if isinstance(aim, Target | Comparison):
            yield from _doubts_of_unit(aim, problem.base)
    films = {aim.experiment: aim for aim in problem.aims if isinstance(aim, Film)}
    for experiment in problem.experiments:
        film = films.get(experiment.name)
        try:
            yield from _doubts_of_run(experiment, film, problem.sample_s)
        except SceneError:  # the scene as it is may lie outside of the bounds that the search keeps
            continue


def _doubts_of_unit(aim: Target | Comparison, base: Scene) -> Iterator[str]:
    """Of a target that is a length."""
    if isinstance(aim, Target):
        kind, asked = aim.quantity.kind, [abs(bound) for bound in (aim.low, aim.high) if np.isfinite(bound)]
    else:
        kind, asked = aim.greater[1].kind, [abs(aim.by)]
    if kind.endswith("_m") and max(asked) > MOST_LENGTHS * base.body_length_m:
        length_m = base.body_length_m
        yield f"{aim.name} is asked to be {max(asked):g} m, and the body is {length_m:.3g} m long: in m?"


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
    as_given = losses[1.0, SHIFTS_S[len(SHIFTS_S) // 2]]
    (rate, shift_s), least = min(losses.items(), key=lambda item: item[1])
    mirrored = _loss(replace(film, points_m=film.points_m * np.array([1.0, -1.0])), run)
    if mirrored < min(CLEARLY * as_given, least):
        other = "up" if camera.y_axis == "down" else "down"
        yield f'{name}: the marks move as the magnets of the scene would with y_axis = "{other}"'
    elif least < CLEARLY * as_given and rate != 1.0:
        yield (
            f"{name}: the marks move as the magnets of the scene would at about "
            f"{rate * camera.frames_per_second:.3g} frames per second: is frames_per_second = "
            f"{camera.frames_per_second:g} right?"
        )
    elif least < CLEARLY * as_given and shift_s != 0.0:
        when = "later" if shift_s > 0.0 else "earlier"
        yield (
            f"{name}: the marks move about {abs(shift_s):.1f} s {when} than the scene's magnets would: is "
            "the time right at which the drive begins (start_s)?"
        )


def _loss(film: Film, run: Recording) -> float:
    return float(np.square(film.residuals({film.experiment: run})).sum())
