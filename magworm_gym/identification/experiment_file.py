"""Experiments as they stand in a problem file: films, measured drives, targets and comparisons."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import floor, inf
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta, field

from magworm_gym._magworm import Scene
from magworm_gym.documents import Number, Table, Text
from magworm_gym.identification.deeplabcut import Tracks, read_deeplabcut
from magworm_gym.identification.drive_motion import drive_from_film, drive_from_stage, read_stage
from magworm_gym.identification.experiment import Experiment, edited_scene
from magworm_gym.identification.filmed import FilmTable, film
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.paths import scene_numbers, scene_paths
from magworm_gym.identification.plain_check import check_at_rest, check_frames, start_places
from magworm_gym.identification.quantities import MEASURES, Measure, Quantity, named_quantity
from magworm_gym.identification.targets import Aim, Target, Tolerance, target

SHORTEST_S, LONGEST_S = 0.01, 3600.0

Duration = Annotated[float, Meta(ge=1e-4, le=LONGEST_S)]


class TargetTable(Table, frozen=True):
    """A target: a value, or one or two bounds of a quantity; the attributes are those of :class:`Target`."""

    quantity: Measure
    tolerance: Tolerance
    magnet: Annotated[int, Meta(ge=0, le=10**6)] | None = None
    value: Number | None = None
    at_least: Number | None = None
    at_most: Number | None = None
    fit: bool = True

    def __post_init__(self) -> None:
        """Refuses a target without a value or with bounds in the wrong order."""
        if self.value is None and self.at_least is None and self.at_most is None:
            raise ValueError("value is missing; allowed: value, at_least or at_most")
        if self.value is not None and (self.at_least is not None or self.at_most is not None):
            raise ValueError(
                f"value is {self.value:g} beside bounds; allowed: value, or at_least and at_most"
            )
        if self.bounds[0] > self.bounds[1]:
            raise ValueError(
                f"at_least is {self.at_least}; allowed: a number up to at_most = {self.at_most:g}"
            )

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and greatest value allowed."""
        if self.value is not None:
            return self.value, self.value
        return -inf if self.at_least is None else self.at_least, inf if self.at_most is None else self.at_most


class ComparisonTable(Table, frozen=True):
    """One quantity is greater than another; the difference is a :class:`Target`."""

    greater: Text
    less: Text
    tolerance: Tolerance
    by: Number = 0.0
    fit: bool = True


class DriveTable(Table, frozen=True):
    """A measured drive: a file of the stage and the time in it when the experiment begins, or a body part."""

    file: Text | None = None
    start_s: Number | None = None
    part: Text | None = None
    height_m: Annotated[float, Meta(ge=-1.0, le=1.0)] | None = None

    def __post_init__(self) -> None:
        """Refuses entries that do not go together."""
        if (self.file is None) == (self.part is None):
            raise ValueError(f"file is {self.file!r} and part is {self.part!r}; allowed: one of them")
        name, stray = ("start_s", self.start_s) if self.file is None else ("height_m", self.height_m)
        if stray is not None:
            allowed = "file, start_s" if self.part is None else "part, height_m"
            raise ValueError(f"{name} is not a setting; allowed here: {allowed}")


class ExperimentTable(Table, frozen=True):
    """An experiment; without a duration it lasts as long as its tracks."""

    name: Text | None = None
    values: dict[str, Any] = field(default_factory=dict)
    duration_s: Duration | None = None
    targets: tuple[TargetTable, ...] = ()
    tracks: FilmTable | None = None
    drive: DriveTable | None = None


@dataclass(frozen=True)
class Found:
    """An experiment, what it is compared with, and what there is to say of its files."""

    experiment: Experiment
    aims: list[Aim]
    remarks: list[str]


def read_experiment(
    table: ExperimentTable, name: str, where: str, base: Scene, paths: list[str], folder: Path
) -> Found:
    """The experiment of a table that stands at a place of the file, which names files of a folder.

    A parameter of one of the paths is not fitted there where values set it, or a table that leaves it out.

    Raises:
        ProblemError: A value that is not allowed, or a mistake in a file.
    """
    values = scene_paths(table.values, base)
    scene = edited_scene(base, values, f"{where}.values")
    if not scene.magnets:
        raise ProblemError(f"{where}: the scene has no body magnets; allowed: a scene with some")
    aims: list[Aim] = []
    remarks: list[str] = []
    tracks = None if table.tracks is None else _tracks(table.tracks, scene.magnets, f"{where}.tracks", folder)
    duration_s = _duration(table, tracks, where)
    if table.tracks is not None and tracks is not None:
        filmed = film(name, tracks, table.tracks, duration_s)
        check_frames(tracks, table.tracks)
        remarks += check_at_rest(filmed, scene)
        aims.append(filmed)
    if table.drive is not None:
        motion, more = _motion(table.drive, table.tracks, tracks, scene, duration_s, f"{where}.drive", folder)
        values["drive.motion"], remarks = motion, remarks + more
        scene = edited_scene(scene, {"drive.motion": motion}, f"{where}.drive")
    if scene.controlled:
        raise ProblemError(
            f"{where}: the drive is a controlled one and would stand still; allowed: values with "
            '"drive.motion" of kind "constant" or "waypoints", or drive'
        )
    aims += [
        _target(each, name, scene.magnets, f"{where}.targets[{at}]") for at, each in enumerate(table.targets)
    ]
    within = tuple(f"{path}." for path in values)
    left_out = {path for path in paths if path.startswith(within) and path not in scene_numbers(scene)}
    return Found(
        Experiment(name, scene, duration_s, known=frozenset(left_out | values.keys())), aims, remarks
    )


def _tracks(table: FilmTable, magnets: int, where: str, folder: Path) -> Tracks:
    """Tracks of a film that has a body part, or an empty text, for each magnet."""
    parts = [part for part in table.magnets if part]
    if len(table.magnets) != magnets or not parts:
        raise ProblemError(
            f"{where}.magnets is {table.magnets}; allowed: the body part of each of the {magnets} magnets "
            'from the head, "" for one that was not tracked'
        )
    if twice := [part for part in parts if parts.count(part) > 1]:
        raise ProblemError(
            f"{where}.magnets is {table.magnets}; allowed: each body part once, and "
            f"{twice[0]!r} is there twice"
        )
    return read_deeplabcut(folder / table.file, table.individual)


def _duration(table: ExperimentTable, tracks: Tracks | None, where: str) -> float:
    """The duration given, or until the last frame, rounded down to 0.01 s."""
    if table.duration_s is not None:
        return table.duration_s
    if table.tracks is None or tracks is None:
        raise ProblemError(f"{where}.duration_s is missing; allowed: a number from 0.0001 to {LONGEST_S:g}")
    camera, last_s = table.tracks, float(table.tracks.time_s(tracks.frames)[-1])
    if not SHORTEST_S <= last_s <= LONGEST_S:
        raise ProblemError(
            f"{where}: the tracks end at {last_s:g} s after start_s = {camera.start_s:g}, with frame "
            f"{tracks.frames[-1]} and frames_per_second = {camera.frames_per_second:g}; allowed: "
            f"{SHORTEST_S:g} to {LONGEST_S:g} s"
        )
    return floor(last_s * 100.0 + 1e-6) / 100.0


def _motion(
    drive: DriveTable,
    film: FilmTable | None,
    tracks: Tracks | None,
    scene: Scene,
    duration_s: float,
    where: str,
    folder: Path,
) -> tuple[dict[str, Any], list[str]]:
    """The motion of a measured drive, and what there is to say of it."""
    if drive.file is not None:
        return drive_from_stage(read_stage(folder / drive.file), drive.start_s or 0.0, duration_s)
    if film is None or tracks is None or drive.part is None or drive.part in film.magnets:
        raise ProblemError(
            f"{where}.part is {drive.part!r}; allowed: a body part of tracks that is none of the magnets"
        )
    return drive_from_film(tracks, film, drive.part, start_places(scene), duration_s, drive.height_m)


def _target(table: TargetTable, experiment: str, magnets: int, where: str) -> Target:
    if table.magnet is not None and table.magnet >= magnets:
        raise ProblemError(
            f"{where}.magnet is {table.magnet}; allowed: a whole number from 0 to {magnets - 1}"
        )
    quantity = experiment, Quantity(table.quantity, table.magnet)
    return target(quantity, *table.bounds, table.tolerance, table.fit)


def read_comparison(table: ComparisonTable, where: str, magnets: Mapping[str, int]) -> Target:
    """The comparison of a table that stands at a place of the file, given the magnets of each experiment.

    Raises:
        ProblemError: A value that is not allowed.
    """

    def measured(key: str, text: str) -> tuple[str, Quantity]:
        name, _, rest = text.partition(".")
        quantity = named_quantity(rest, magnets.get(name, 0))
        if quantity is None or name not in magnets:
            raise ProblemError(
                f"{where}.{key} is {text!r}; allowed: experiment.quantity or experiment.quantity.magnet, of "
                f"{', '.join(magnets)} and {', '.join(MEASURES)}"
            )
        return name, quantity

    greater, less = measured("greater", table.greater), measured("less", table.less)
    return target(greater, table.by, inf, table.tolerance, table.fit, less)
