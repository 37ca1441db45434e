"""What is to be identified from what."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from msgspec import Meta, field
from msgspec.structs import asdict

from magworm_gym import __version__
from magworm_gym._magworm import Scene, SceneError
from magworm_gym.documents import Number, Table, Text, checked
from magworm_gym.identification.claim_file import read_claim
from magworm_gym.identification.claims import Claim, ClaimTable
from magworm_gym.identification.experiment import Experiment, Run, edited_scene
from magworm_gym.identification.experiment_file import (
    ComparisonTable,
    ExperimentTable,
    Found,
    read_comparison,
    read_experiment,
)
from magworm_gym.identification.filmed import Film
from magworm_gym.identification.limit import threshold
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.parameters import Bounds, Parameter, ParameterSpace
from magworm_gym.identification.paths import dotted, scene_numbers, scene_paths, whole_numbers
from magworm_gym.identification.plain_check import doubts
from magworm_gym.identification.settings import SearchSettings
from magworm_gym.identification.sweep import Sweep
from magworm_gym.identification.sweep_file import SweepTable, read_sweeps
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
        return (*self.remarks, *doubts(self.experiments, self.aims, self.sample_s))

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


class StartTable(Table, frozen=True):
    """A known robot."""

    values: dict[str, Any] = field(default_factory=dict)


class ProblemTable(Table, frozen=True):
    """A problem file; what ``like`` names is part of it already."""

    scene: Text
    values: dict[str, Any] = field(default_factory=dict)
    parameters: dict[str, Any] = field(default_factory=dict)
    experiment: tuple[ExperimentTable, ...] = ()
    sweep: tuple[SweepTable, ...] = ()
    comparison: tuple[ComparisonTable, ...] = ()
    claim: tuple[ClaimTable, ...] = ()
    start: tuple[StartTable, ...] = ()
    without: Annotated[tuple[str, ...], Meta(description="a list of groups of claims")] = ()
    sample_s: Annotated[float, Meta(ge=1e-7, le=1.0)] | None = None
    search: SearchSettings = SearchSettings()


def make_problem(entries: Mapping[str, Any], folder: Path) -> Problem:
    """Makes a problem from what a problem file holds.

    Args:
        entries: The tables of the file.
        folder: Folder of the files that it names.

    Raises:
        ProblemError: A mistake in it or in a file that it names.
    """
    table = checked(entries, ProblemTable, mistake=ProblemError)
    scene = _scene(table.scene, folder)
    fixed = scene_paths(table.values, scene)
    base = edited_scene(scene, fixed, "values")
    space = _space(table.parameters)
    found = _experiments(table.experiment, base, [parameter.path for parameter in space.parameters], folder)
    experiments = [each.experiment for each in found]
    sweeps = _sweeps(table.sweep, base, {experiment.name for experiment in experiments})
    starts = tuple(_start(each, at) for at, each in enumerate(table.start))
    runs: list[Run] = [*experiments, *sweeps]
    if not runs:
        raise ProblemError("experiment is missing; allowed: at least one [[experiment]] or one [[sweep]]")
    magnets = {experiment.name: experiment.scene.magnets for experiment in experiments}
    aims = [aim for each in found for aim in each.aims]
    aims += [read_comparison(each, f"comparison[{at}]", magnets) for at, each in enumerate(table.comparison)]
    aims += _claims(table, sweeps)
    if not any(aim.fitted for aim in aims):
        raise ProblemError("nothing is fitted; allowed: at least one target, track, comparison or claim")
    _check_paths(space, runs)
    return Problem(
        base_name=table.scene,
        base=base,
        fixed=tuple(fixed),
        space=space,
        experiments=tuple(experiments),
        sweeps=tuple(sweeps),
        aims=tuple(aims),
        starts=() if table.search.blind else starts,
        sample_s=_sample(table.sample_s, runs),
        settings=table.search,
        fingerprint=_fingerprint(entries, base, runs, aims),
        remarks=tuple(remark for each in found for remark in each.remarks),
    )


def _scene(name: str, folder: Path) -> Scene:
    path = folder / name
    try:
        return load_scene(path if path.is_file() else name)
    except SceneError as error:
        raise ProblemError(f"scene: {error}" if path.is_file() else str(error)) from error


def _space(parameters: dict[str, Any]) -> ParameterSpace:
    entries = dotted(parameters, lambda _, value: not BOUNDS & value.keys())
    bounds = {
        path: checked(each, Bounds, f"parameters.{path}", ProblemError) for path, each in entries.items()
    }
    return ParameterSpace([Parameter(path=path, **asdict(each)) for path, each in bounds.items()])


def _experiments(
    tables: Sequence[ExperimentTable], base: Scene, paths: list[str], folder: Path
) -> list[Found]:
    found: dict[str, Found] = {}
    for at, table in enumerate(tables):
        where, name = f"experiment[{at}]", table.name or f"experiment-{at + 1}"
        if name in found or "." in name:
            raise ProblemError(
                f"{where}.name is {name!r}; allowed: a name without a dot that no other experiment has"
            )
        found[name] = read_experiment(table, name, where, base, paths, folder)
    return list(found.values())


def _sweeps(tables: Sequence[SweepTable], base: Scene, taken: set[str]) -> list[Sweep]:
    sweeps: list[Sweep] = []
    for at, table in enumerate(tables):
        read = read_sweeps(table, f"sweep[{at}]", base)
        if twice := [sweep.name for sweep in read if sweep.name in taken]:
            raise ProblemError(f"sweep[{at}].name is {twice[0]!r}; allowed: a name that no other run has")
        taken = taken | {sweep.name for sweep in read}
        sweeps += read
    return sweeps


def _claims(table: ProblemTable, sweeps: list[Sweep]) -> list[Claim]:
    """Claims; those of a group that is left out are only reported."""
    named = {sweep.name: sweep for sweep in sweeps}
    claims = [read_claim(each, f"claim[{at}]", named) for at, each in enumerate(table.claim)]
    groups = sorted({claim.table.group for claim in claims if claim.table.group})
    if not set(table.without) <= set(groups):
        raise ProblemError(
            f"without is {list(table.without)}; allowed: a list of groups of claims, of "
            f"{', '.join(groups) or 'none'}"
        )
    return [
        replace(claim, fitted=claim.fitted and claim.table.group not in table.without) for claim in claims
    ]


def _start(table: StartTable, at: int) -> dict[str, float]:
    """Field values of a known robot."""
    values = dotted(table.values, lambda *_: True)
    return {
        path: checked(each, Number, f"start[{at}].values.{path}", ProblemError)
        for path, each in values.items()
    }


def _sample(asked_s: float | None, runs: list[Run]) -> float:
    steps = [scene_numbers(run.scene).get("solver.step_s") or 1e-3 for run in runs]
    longest = max(steps)
    sample_s = asked_s or longest * max(1, ceil(LEAST_SAMPLE_S / longest - 1e-6))
    for run, step_s in zip(runs, steps, strict=True):
        if not _whole(sample_s / step_s):
            raise ProblemError(
                f"sample_s is {sample_s}; allowed: a whole number of solver steps of {step_s:g} s, "
                f"as in {run.name!r}"
            )
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
            if parameter.path not in scene_numbers(run.scene):
                raise ProblemError(
                    f"parameters.{parameter.path} is no number in the scene of experiment "
                    f"{run.name!r}; allowed: the path of one, such as material.youngs_modulus_pa"
                )


def _fingerprint(entries: Mapping[str, Any], base: Scene, runs: list[Run], aims: list[Aim]) -> str:
    """Digest of everything that the result depends on, files included."""
    digest = hashlib.sha256(json.dumps([__version__, entries], sort_keys=True, default=str).encode())
    for scene in (base, *(run.scene for run in runs)):
        digest.update(scene.to_toml().encode())
    for aim in aims:
        if isinstance(aim, Film):
            digest.update(np.column_stack([aim.time_s, aim.magnet, aim.points_m]).tobytes())
    return digest.hexdigest()
