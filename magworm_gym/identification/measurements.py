"""Targets and tracks of an experiment, as they stand in a problem file."""

from collections.abc import Mapping
from math import floor, inf
from pathlib import Path
from typing import Any

from magworm_gym._magworm import Scene
from magworm_gym.identification.camera import START, WHOLE, Camera
from magworm_gym.identification.deeplabcut import Tracks, read_deeplabcut
from magworm_gym.identification.drive_motion import drive_from_film, drive_from_stage, read_stage
from magworm_gym.identification.filmed import Film, film
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.plain_check import check_at_rest, check_frames, start_places
from magworm_gym.identification.quantities import MEASURES, Quantity
from magworm_gym.identification.table import Table
from magworm_gym.identification.targets import Aim, Comparison, Target

DEFAULT_TOLERANCE_PX = 1.5
DEFAULT_INDEPENDENT_S = 0.1
SHORTEST_S, LONGEST_S = 0.01, 3600.0


def read_targets(experiment: Table, name: str, magnets: int) -> list[Aim]:
    """Takes the list ``targets`` of an experiment.

    Args:
        experiment: Its table.
        name: Its name.
        magnets: Body magnets of its scene.

    Raises:
        ProblemError: A value that is not allowed.
    """
    return [_target(table, name, magnets) for table in experiment.tables("targets")]


def _target(table: Table, name: str, magnets: int) -> Target:
    kind = table.choice("quantity", "", tuple(MEASURES))
    magnet = table.whole("magnet", 0, low=0, high=magnets - 1) if table.has("magnet") else None
    tolerance = table.number("tolerance", low=1e-12)
    if table.has("value"):
        low = high = table.number("value")
    else:
        low = table.number("at_least") if table.has("at_least") else -inf
        high = table.number("at_most") if table.has("at_most") else inf
        if low == -inf and high == inf:
            raise ProblemError(f"{table.where} has no value; allowed: value, at_least or at_most")
        if low > high:
            raise table.refusal("at_least", low, f"a number up to at_most = {high:g}")
    fitted = table.flag("fit", True)
    table.done()
    return Target(name, Quantity(kind, magnet), low, high, tolerance, fitted)


def read_comparison(table: Table, magnets: Mapping[str, int]) -> Comparison:
    """Reads ``{ greater, less, by, tolerance, fit }``.

    Args:
        table: The table.
        magnets: Name of an experiment → body magnets of its scene.

    Raises:
        ProblemError: A value that is not allowed.
    """
    greater, less = _measured(table, "greater", magnets), _measured(table, "less", magnets)
    by, tolerance = table.number("by", 0.0), table.number("tolerance", low=1e-12)
    fitted = table.flag("fit", True)
    table.done()
    return Comparison(greater, less, by, tolerance, fitted)


def _measured(table: Table, key: str, magnets: Mapping[str, int]) -> tuple[str, Quantity]:
    """Takes ``experiment.quantity`` or ``experiment.quantity.magnet``."""
    text = table.text(key)
    words = text.split(".")
    known = len(words) in (2, 3) and words[0] in magnets and words[1] in MEASURES
    if known and len(words) == 3:
        known = words[2].isdecimal() and int(words[2]) < magnets[words[0]]
    if not known:
        raise table.refusal(
            key,
            text,
            f"experiment.quantity or experiment.quantity.magnet, of {', '.join(magnets)} and "
            f"{', '.join(MEASURES)}",
        )
    return words[0], Quantity(words[1], int(words[2]) if len(words) == 3 else None)


def read_film(
    experiment: Table, name: str, scene: Scene, folder: Path
) -> tuple[Film | None, dict[str, Any] | None, float, list[str]]:
    """Takes ``tracks``, ``drive`` and ``duration_s`` of an experiment.

    Args:
        experiment: Its table.
        name: Its name.
        scene: Its scene.
        folder: Folder of the files.

    Returns:
        The film, the drive's motion as it was measured, each None where there is none, the duration [s]:
        that of the tracks where it is not given, and what there is to say of them.

    Raises:
        ProblemError: A value that is not allowed, or a mistake in a file.
    """
    if not experiment.has("tracks"):
        duration_s = experiment.number("duration_s", low=1e-4, high=LONGEST_S)
        if not experiment.has("drive"):
            return None, None, duration_s, []
        drive = Table(experiment.take("drive"), experiment.place("drive"))
        stage, remarks = _drive_file(drive, folder, duration_s)
        return None, stage, duration_s, remarks
    table = Table(experiment.take("tracks"), experiment.place("tracks"))
    camera = _camera(table)
    individual = table.text("individual") if table.has("individual") else None
    tracks = read_deeplabcut(folder / table.text("file"), individual)
    parts = _parts(table, scene.magnets)
    likelihood = table.number("least_likelihood", 0.6, low=0.0, high=1.0)
    duration_s = _duration(experiment, tracks, camera)
    filmed = film(
        name,
        tracks,
        camera,
        parts,
        duration_s=duration_s,
        least_likelihood=likelihood,
        tolerance_m=table.number(
            "tolerance_m", DEFAULT_TOLERANCE_PX * camera.metres_per_pixel, low=1e-9, high=1.0
        ),
        independent_s=table.number("independent_s", DEFAULT_INDEPENDENT_S, low=1e-6, high=1e3),
    )
    table.done()
    check_frames(tracks, camera)
    remarks = check_at_rest(filmed, scene)
    motion: dict[str, Any] | None = None
    if experiment.has("drive"):
        drive = Table(experiment.take("drive"), experiment.place("drive"))
        if drive.has("part"):
            motion = _drive_part(drive, tracks, camera, parts, scene, likelihood, duration_s)
        else:
            motion, more = _drive_file(drive, folder, duration_s)
            remarks += more
    return filmed, motion, duration_s, remarks


def _camera(table: Table) -> Camera:
    origin = table.take("origin", WHOLE)
    if isinstance(origin, list) and len(origin) == 2 and all(isinstance(at, int | float) for at in origin):
        origin = (float(origin[0]), float(origin[1]))
    elif origin not in (WHOLE, START):
        raise table.refusal("origin", origin, f'"{WHOLE}", "{START}" or [x_px, y_px]')
    return Camera(
        metres_per_pixel=table.number("metres_per_pixel", low=1e-9, high=1.0),
        frames_per_second=table.number("frames_per_second", low=1e-3, high=1e6),
        head=table.choice("head", "left", ("left", "right")),
        y_axis=table.choice("y_axis", "down", ("down", "up")),
        angle_deg=table.number("angle_deg", 0.0, low=-180.0, high=180.0),
        start_s=table.number("start_s", 0.0),
        origin=origin,
    )


def _parts(table: Table, magnets: int) -> list[str]:
    parts = table.take("magnets")
    if (
        not isinstance(parts, list)
        or not all(isinstance(part, str) for part in parts)
        or len(parts) != magnets
        or not any(parts)
    ):
        raise table.refusal(
            "magnets",
            parts,
            f'the body part of each of the {magnets} magnets from the head, "" for one that was not tracked',
        )
    if twice := [part for part in parts if part and parts.count(part) > 1]:
        raise table.refusal("magnets", parts, f"each body part once, and {twice[0]!r} is there twice")
    return parts


def _duration(experiment: Table, tracks: Tracks, camera: Camera) -> float:
    """The duration given, or until the last frame, rounded down to 0.01 s."""
    if experiment.has("duration_s"):
        return experiment.number("duration_s", low=1e-4, high=LONGEST_S)
    experiment.take("duration_s")
    last = float(camera.time_s(tracks.frames)[-1])
    if not SHORTEST_S <= last <= LONGEST_S:
        raise ProblemError(
            f"{experiment.where}: the tracks end at {last:g} s after start_s = {camera.start_s:g}, with "
            f"frame {tracks.frames[-1]} and frames_per_second = {camera.frames_per_second:g}; allowed: "
            f"{SHORTEST_S:g} to {LONGEST_S:g} s"
        )
    return floor(last * 100.0 + 1e-6) / 100.0


def _drive_file(table: Table, folder: Path, duration_s: float) -> tuple[dict[str, Any], list[str]]:
    path, start_s = folder / table.text("file"), table.number("start_s", 0.0)
    table.done()
    return drive_from_stage(read_stage(path), start_s, duration_s)


def _drive_part(
    table: Table,
    tracks: Tracks,
    camera: Camera,
    parts: list[str],
    scene: Scene,
    likelihood: float,
    duration_s: float,
) -> dict[str, Any]:
    part = table.text("part")
    height_m = table.number("height_m", low=-1.0, high=1.0) if table.has("height_m") else None
    table.done()
    if part in parts:
        raise table.refusal("part", part, "a body part that is none of the magnets")
    return drive_from_film(
        tracks,
        camera,
        part,
        parts,
        start_places(scene),
        duration_s=duration_s,
        least_likelihood=likelihood,
        height_m=height_m,
    )
