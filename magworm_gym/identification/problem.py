"""What is to be identified from what."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil
from pathlib import Path
from typing import Any

from magworm_gym import __version__
from magworm_gym._magworm import Scene, SceneError
from magworm_gym.identification.claim_file import read_claim
from magworm_gym.identification.claims import Claim
from magworm_gym.identification.experiment import Experiment, Run, edited_scene
from magworm_gym.identification.limit import threshold
from magworm_gym.identification.measurements import read_comparison, read_film, read_targets
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.parameters import ParameterSpace, read_parameter
from magworm_gym.identification.paths import dotted, scene_numbers, scene_paths, whole_numbers
from magworm_gym.identification.plain_check import doubts
from magworm_gym.identification.settings import SearchSettings, read_settings
from magworm_gym.identification.sweep import Sweep
from magworm_gym.identification.sweep_file import read_sweeps
from magworm_gym.identification.table import Table
from magworm_gym.identification.targets import Aim
from magworm_gym.scene import load_scene

BOUNDS = frozenset({"low", "high"})
"""Entries of a parameter, by which it is told from a table of some."""

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
        sweeps: Robots at many speeds of the drive.
        aims: What was measured, and what is only reported.
        starts: Field values of known robots, tried first.
        sample_s: Time between two instants of a recording [s].
        settings: Settings of the search.
        fingerprint: Changes with anything that changes the result.
        remarks: What there is to say of the files that were read, in sentences.
    """

    base_name: str
    base: Scene
    fixed: tuple[str, ...]
    space: ParameterSpace
    experiments: tuple[Experiment, ...]
    sweeps: tuple[Sweep, ...]
    aims: tuple[Aim, ...]
    starts: tuple[dict[str, float], ...]
    sample_s: float
    settings: SearchSettings
    fingerprint: str
    remarks: tuple[str, ...] = ()

    @cached_property
    def noticed(self) -> tuple[str, ...]:
        """What may be a mistake, in sentences: remarks, and what a run of the scene as it is shows."""
        return (*self.remarks, *doubts(self))

    @property
    def measurements(self) -> float:
        """Number of independent measurements that are fitted [1]."""
        return sum(aim.weight for aim in self.fitted)

    @property
    def fitted(self) -> tuple[Aim, ...]:
        """The aims that are part of the loss (A)."""
        return tuple(aim for aim in self.aims if aim.fitted)

    @property
    def runs(self) -> tuple[Run, ...]:
        """Experiments and sweeps, in the order of the file: what comes first decides first."""
        return (*self.experiments, *self.sweeps)

    @property
    def simulated_s(self) -> float:
        """Simulated time of one candidate that is run to its end [s]."""
        needed = {source for aim in self.fitted for source in aim.sources}
        return sum(run.simulated_s for run in self.runs if run.name in needed)

    def limit(self, loss: float) -> float:
        """Loss up to which a candidate fits about as well as one with the least loss [1]."""
        if self.settings.fits_within is not None:
            return max(self.settings.fits_within * loss, self.settings.fits_below)
        return threshold(loss, self.measurements, len(self.space))


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
    fixed = scene_paths(table.mapping("values"), scene)
    base = edited_scene(scene, fixed, "values")
    space = _space(table)
    experiments, aims, remarks = _experiments(table, base, space, folder)
    sweeps = _sweeps(table, base, {experiment.name for experiment in experiments})
    if not experiments and not sweeps:
        raise ProblemError("experiment is missing; allowed: at least one [[experiment]] or one [[sweep]]")
    names = {experiment.name: experiment.scene.magnets for experiment in experiments}
    aims += [read_comparison(each, names) for each in table.tables("comparison")]
    aims += _claims(table, sweeps)
    starts = tuple(_start(each) for each in table.tables("start"))
    runs: list[Run] = [*experiments, *sweeps]
    sample_s = _sample(table, runs)
    settings = read_settings(Table(table.take("search", {}), "search"))
    table.done()
    if not any(aim.fitted for aim in aims):
        raise ProblemError("nothing is fitted; allowed: at least one target, track, comparison or claim")
    _check_paths(space, runs)
    return Problem(
        base_name=name,
        base=base,
        fixed=tuple(fixed),
        space=space,
        experiments=tuple(experiments),
        sweeps=tuple(sweeps),
        aims=tuple(aims),
        starts=starts,
        sample_s=sample_s,
        settings=settings,
        fingerprint=_fingerprint(entries, base, runs, aims),
        remarks=tuple(remarks),
    )


def _base(table: Table, folder: Path) -> tuple[str, Scene]:
    name = table.text("scene")
    path = folder / name
    try:
        return name, load_scene(path if path.is_file() else name)
    except SceneError as error:
        raise ProblemError(f"scene: {error}" if path.is_file() else str(error)) from error


def _space(table: Table) -> ParameterSpace:
    entries = dotted(table.mapping("parameters"), lambda _, value: not BOUNDS & value.keys())
    return ParameterSpace(
        [read_parameter(path, Table(entry, f"parameters.{path}")) for path, entry in entries.items()]
    )


def _experiments(
    table: Table, base: Scene, space: ParameterSpace, folder: Path
) -> tuple[list[Experiment], list[Aim], list[str]]:
    experiments: list[Experiment] = []
    aims: list[Aim] = []
    remarks: list[str] = []
    for each in table.tables("experiment"):
        name = each.text("name", f"experiment-{len(experiments) + 1}")
        if name in {experiment.name for experiment in experiments} or "." in name:
            raise each.refusal("name", name, "a name without a dot that no other experiment has")
        values = scene_paths(each.mapping("values"), base)
        scene = edited_scene(base, values, each.place("values"))
        if not scene.magnets:
            raise ProblemError(f"{each.where}: the scene has no body magnets; allowed: a scene with some")
        filmed, motion, duration_s, more = read_film(each, name, scene, folder)
        remarks += more
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
        experiments.append(Experiment(name, duration_s, scene, _known(values, scene, space)))
    return experiments, aims, remarks


def _known(values: dict[str, Any], scene: Scene, space: ParameterSpace) -> frozenset[str]:
    """Paths that values set, also those of parameters within a table that leaves them out."""
    numbers = scene_numbers(scene)
    left_out = {
        parameter.path
        for parameter in space.parameters
        if parameter.path not in numbers and any(parameter.path.startswith(f"{path}.") for path in values)
    }
    return frozenset(values) | left_out


def _sweeps(table: Table, base: Scene, taken: set[str]) -> list[Sweep]:
    sweeps: list[Sweep] = []
    for each in table.tables("sweep"):
        read = read_sweeps(each, base)
        for sweep in read:
            if sweep.name in taken:
                raise each.refusal("name", sweep.name, "a name that no other run has")
        taken |= {sweep.name for sweep in read}
        sweeps += read
    return sweeps


def _claims(table: Table, sweeps: list[Sweep]) -> list[Claim]:
    """Claims; those of a group that is left out are only reported."""
    claims = [read_claim(each, {sweep.name: sweep for sweep in sweeps}) for each in table.tables("claim")]
    groups = sorted({claim.group for claim in claims if claim.group})
    without = table.take("without", [])
    if not isinstance(without, list) or not set(without) <= set(groups):
        raise table.refusal(
            "without", without, f"a list of groups of claims, of {', '.join(groups) or 'none'}"
        )
    return [replace(claim, fitted=claim.fitted and claim.group not in without) for claim in claims]


def _start(table: Table) -> dict[str, float]:
    """Field values of a known robot."""
    values = dotted(table.mapping("values"), lambda *_: True)
    table.done()
    for path, value in values.items():
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ProblemError(f"{table.place('values')}.{path} is {value!r}; allowed: a number")
    return {path: float(value) for path, value in values.items()}


def _sample(table: Table, runs: list[Run]) -> float:
    steps = [_scene_value(run.scene, "solver.step_s") or 1e-3 for run in runs]
    longest = max(steps)
    usual = longest * max(1, ceil(LEAST_SAMPLE_S / longest - 1e-6))
    sample_s = table.number("sample_s", usual, low=1e-7, high=1.0)
    for run, step_s in zip(runs, steps, strict=True):
        if not _whole(sample_s / step_s):
            allowed = f"a whole number of solver steps of {step_s:g} s, as in {run.name!r}"
            raise table.refusal("sample_s", sample_s, allowed)
        if isinstance(run, Experiment) and not _whole(run.duration_s / sample_s):
            raise ProblemError(
                f"duration_s of experiment {run.name!r} is {run.duration_s:g}; "
                f"allowed: a whole number of times sample_s = {sample_s:g}"
            )
    return sample_s


def _whole(ratio: float) -> bool:
    return round(ratio) >= 1 and abs(ratio - round(ratio)) < 1e-6 * max(1.0, ratio)


def _check_paths(space: ParameterSpace, runs: list[Run]) -> None:
    """Refuses a parameter that is no number of the scene, a whole one, or that every run sets itself."""
    for parameter in space.parameters:
        fitted = [run for run in runs if parameter.path not in run.known]
        if not fitted:
            raise ProblemError(
                f"parameters.{parameter.path} is set by the values of every experiment; "
                "allowed: a field that at least one of them leaves open"
            )
        for run in runs:
            if parameter.times in run.known and parameter.path not in run.known:
                raise ProblemError(
                    f"experiment {run.name!r} sets {parameter.times} but leaves {parameter.path} to a "
                    "ratio of it; allowed: both or none of them"
                )
        for run in fitted:
            if parameter.path in whole_numbers(run.scene):
                raise ProblemError(
                    f"parameters.{parameter.path} is a whole number and cannot be fitted; allowed: "
                    "a number that may have decimals (give this one by values or --set, and fit the others)"
                )
            if _scene_value(run.scene, parameter.path) is None:
                raise ProblemError(
                    f"parameters.{parameter.path} is no number in the scene of experiment "
                    f"{run.name!r}; allowed: the path of one, such as material.youngs_modulus_pa"
                )


def _scene_value(scene: Scene, path: str) -> float | None:
    return scene_numbers(scene).get(path)


def _fingerprint(entries: Mapping[str, Any], base: Scene, runs: list[Run], aims: list[Aim]) -> str:
    """Digest of everything that the result depends on, files included."""
    digest = hashlib.sha256(json.dumps([__version__, entries], sort_keys=True, default=str).encode())
    for scene in (base, *(run.scene for run in runs)):
        digest.update(scene.to_toml().encode())
    for aim in aims:
        digest.update(repr(aim).encode())
        digest.update(getattr(aim, "points_m", b""))
    return digest.hexdigest()
