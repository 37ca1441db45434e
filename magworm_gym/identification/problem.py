"""What is to be identified from what: the problem file."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil
from os import PathLike
from pathlib import Path
from typing import Any

from magworm_gym import __version__
from magworm_gym._magworm import Scene, SceneError
from magworm_gym.arguments import path_of
from magworm_gym.identification.experiment import Experiment, edited_scene
from magworm_gym.identification.measurements import read_comparison, read_film, read_targets
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.parameters import ParameterSpace, read_parameter
from magworm_gym.identification.settings import SearchSettings, read_settings
from magworm_gym.identification.table import Table, parse_toml, read_text
from magworm_gym.identification.targets import Aim
from magworm_gym.scene import load_scene

LEAST_SAMPLE_S = 2e-3
"""Robots are looked at this often or, with longer solver steps, after each of them [s]."""


@dataclass(frozen=True)
class Problem:
    """Parameters, experiments and what was measured in them.

    Attributes:
        base_name: Preset or file that the scene comes from.
        base: That scene, with the fixed values.
        fixed: Paths of the fixed values.
        space: The parameters.
        experiments: The experiments.
        aims: What was measured.
        sample_s: Time between two instants of a recording [s].
        settings: Settings of the search.
        fingerprint: Changes with anything that changes the result.
    """

    base_name: str
    base: Scene
    fixed: tuple[str, ...]
    space: ParameterSpace
    experiments: tuple[Experiment, ...]
    aims: tuple[Aim, ...]
    sample_s: float
    settings: SearchSettings
    fingerprint: str

    @property
    def measurements(self) -> float:
        """Number of independent measurements [1]."""
        return sum(aim.weight for aim in self.aims)

    @property
    def simulated_s(self) -> float:
        """Simulated time of one candidate [s]."""
        return sum(experiment.duration_s for experiment in self.experiments)


def read_problem(path: str | PathLike[str], search: Mapping[str, Any] | None = None) -> Problem:
    """Reads a problem file.

    Args:
        path: The TOML file; files that it names are relative to its folder.
        search: Settings of the search that replace those of the file.

    Raises:
        ProblemError: A mistake in it or in a file that it names.
    """
    path = path_of("path", path)
    entries = parse_toml(read_text(path, "problem file"), str(path))
    if search:
        settings = entries.get("search", {})
        entries["search"] = {**(settings if isinstance(settings, dict) else {}), **search}
    try:
        return make_problem(entries, path.parent)
    except ProblemError as error:
        raise ProblemError(f"{path}: {error}") from error


def make_problem(entries: Mapping[str, Any], folder: Path) -> Problem:
    """Makes a problem from what a problem file holds.

    Args:
        entries: The tables of the file.
        folder: Folder of the files that it names.

    Raises:
        ProblemError: A mistake in it or in a file that it names.
    """
    table = Table(entries, "")
    name, scene = _base(table, folder)
    fixed = table.mapping("values")
    base = edited_scene(scene, fixed, "values")
    space = _space(table)
    experiments, aims = _experiments(table, base, folder)
    names = {experiment.name: experiment.scene.magnets for experiment in experiments}
    aims += [read_comparison(each, names) for each in table.tables("comparison")]
    sample_s = _sample(table, experiments)
    settings = read_settings(Table(table.take("search", {}), "search"))
    table.done()
    if not aims:
        raise ProblemError("no experiment has targets or tracks; allowed: at least one of them")
    _check_paths(space, experiments)
    mark = _fingerprint(entries, base, experiments, aims)
    return Problem(name, base, tuple(fixed), space, tuple(experiments), tuple(aims), sample_s, settings, mark)


def _base(table: Table, folder: Path) -> tuple[str, Scene]:
    name = table.text("scene")
    path = folder / name
    try:
        return name, load_scene(path if path.is_file() else name)
    except SceneError as error:
        raise ProblemError(f"scene: {error}" if path.is_file() else str(error)) from error


def _space(table: Table) -> ParameterSpace:
    entries = table.mapping("parameters")
    return ParameterSpace(
        [read_parameter(path, Table(entry, f"parameters.{path}")) for path, entry in entries.items()]
    )


def _experiments(table: Table, base: Scene, folder: Path) -> tuple[list[Experiment], list[Aim]]:
    experiments: list[Experiment] = []
    aims: list[Aim] = []
    for each in table.tables("experiment"):
        name = each.text("name", f"experiment-{len(experiments) + 1}")
        if name in {experiment.name for experiment in experiments} or "." in name:
            raise each.refusal("name", name, "a name without a dot that no other experiment has")
        values = each.mapping("values")
        scene = edited_scene(base, values, each.place("values"))
        if not scene.magnets:
            raise ProblemError(f"{each.where}: the scene has no body magnets; allowed: a scene with some")
        filmed, motion, duration_s = read_film(each, name, scene, folder)
        if motion is not None:
            scene = edited_scene(scene, {"drive.motion": motion}, each.place("drive"))
            values["drive.motion"] = motion
        aims += ([filmed] if filmed else []) + read_targets(each, name, scene.magnets)
        each.done()
        if scene.controlled:
            raise ProblemError(
                f"{each.where}: the drive is a controlled one and would stand still; allowed: values with "
                '"drive.motion" of kind "constant" or "waypoints", or drive'
            )
        experiments.append(Experiment(name, duration_s, scene, frozenset(values)))
    if not experiments:
        raise ProblemError("experiment is missing; allowed: at least one [[experiment]]")
    return experiments, aims


def _sample(table: Table, experiments: list[Experiment]) -> float:
    steps = [_scene_value(experiment.scene, "solver.step_s") or 1e-3 for experiment in experiments]
    longest = max(steps)
    usual = longest * max(1, ceil(LEAST_SAMPLE_S / longest - 1e-6))
    sample_s = table.number("sample_s", usual, low=1e-7, high=1.0)
    for experiment, step_s in zip(experiments, steps, strict=True):
        if not _whole(sample_s / step_s):
            allowed = f"a whole number of solver steps of {step_s:g} s, as in experiment {experiment.name!r}"
            raise table.refusal("sample_s", sample_s, allowed)
        if not _whole(experiment.duration_s / sample_s):
            raise ProblemError(
                f"duration_s of experiment {experiment.name!r} is {experiment.duration_s:g}; "
                f"allowed: a whole number of times sample_s = {sample_s:g}"
            )
    return sample_s


def _whole(ratio: float) -> bool:
    return round(ratio) >= 1 and abs(ratio - round(ratio)) < 1e-6 * max(1.0, ratio)


def _check_paths(space: ParameterSpace, experiments: list[Experiment]) -> None:
    """Refuses a parameter that is no number of the scene or that every experiment sets itself."""
    for parameter in space.parameters:
        fitted = [experiment for experiment in experiments if parameter.path not in experiment.known]
        if not fitted:
            raise ProblemError(
                f"parameters.{parameter.path} is set by the values of every experiment; "
                "allowed: a field that at least one of them leaves open"
            )
        for experiment in experiments:
            if parameter.times in experiment.known and parameter.path not in experiment.known:
                raise ProblemError(
                    f"experiment {experiment.name!r} sets {parameter.times} but leaves {parameter.path} to a "
                    "ratio of it; allowed: both or none of them"
                )
        for experiment in fitted:
            if _scene_value(experiment.scene, parameter.path) is None:
                raise ProblemError(
                    f"parameters.{parameter.path} is no number in the scene of experiment "
                    f"{experiment.name!r}; allowed: the path of one, such as material.youngs_modulus_pa"
                )


def _scene_value(scene: Scene, path: str) -> float | None:
    return scene_numbers(scene).get(path)


def scene_numbers(scene: Scene) -> dict[str, float]:
    """All numbers of a scene: dotted path → value in the field's unit."""
    numbers: dict[str, float] = {}
    waiting: list[tuple[str, Any]] = [("", parse_toml(scene.to_toml(), "scene"))]
    while waiting:
        place, value = waiting.pop()
        if isinstance(value, dict):
            waiting += [(f"{place}.{key}" if place else key, each) for key, each in value.items()]
        elif isinstance(value, list):
            waiting += [(f"{place}[{index}]", each) for index, each in enumerate(value)]
        elif isinstance(value, int | float) and not isinstance(value, bool):
            numbers[place] = float(value)
    return numbers


def _fingerprint(
    entries: Mapping[str, Any], base: Scene, experiments: list[Experiment], aims: list[Aim]
) -> str:
    """Digest of everything that the result depends on, files included."""
    digest = hashlib.sha256(json.dumps([__version__, entries], sort_keys=True, default=str).encode())
    for scene in (base, *(experiment.scene for experiment in experiments)):
        digest.update(scene.to_toml().encode())
    for aim in aims:
        digest.update(repr(aim).encode())
        digest.update(getattr(aim, "points_m", b""))
    return digest.hexdigest()
