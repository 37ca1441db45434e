"""The loss of candidates, many side by side."""

import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from magworm_gym._magworm import SceneError
from magworm_gym.identification.experiment import Run
from magworm_gym.identification.paths import scene_numbers
from magworm_gym.identification.problem import Problem
from magworm_gym.identification.targets import Aim, Outcome
from magworm_gym.recording import Floats, Recording

T = TypeVar("T")

BROKEN = 1e6
"""Loss from which on a simulation broke down: up to three times as much, the less the later it did."""

REFUSED = 1e9
"""Loss from which on a scene cannot be simulated at all: it grows with the distance from the base."""


@dataclass(frozen=True)
class Evaluation:
    """What became of a candidate.

    Attributes:
        loss: Sum of the squares of the residuals, or a penalty [1]. Beyond the bound that was asked for it is
            the sum of those that were known by then, which is less.
        shares: Each fitted aim's share of it (A,) [1]; NaN where it is not known.
        residuals: Residuals (R,) [1]; None where there is a penalty or the bound was passed.
    """

    loss: float
    shares: Floats
    residuals: Floats | None = None


class Evaluator:
    """Runs candidates.

    A candidate runs on one thread, one stage after the other, until its loss is beyond a bound: what fits
    badly costs little.

    Args:
        problem: The problem.
        threads: Candidates that run at once, None for as many as there are cores; the result is the same bit
            for bit.
    """

    def __init__(self, problem: Problem, threads: int | None = None) -> None:
        self.problem = problem
        self.base_unit = problem.space.unit_of(_base_values(problem))
        self._threads = threads or os.cpu_count() or 1
        self._stages = _stages(problem.runs, problem.fitted)

    def losses_and_shares(self, units: Floats, bounds: Floats) -> tuple[Floats, Floats]:
        """Losses (C,) of points of the cube (C, P), and shares of the fitted aims (C, A).

        Losses beyond bounds (C,) are less than exact, shares that are not known are NaN.
        """
        found = self._all(self._evaluation, units, bounds)
        return np.array([each.loss for each in found]), np.array([each.shares for each in found])

    def evaluations(self, units: Floats) -> list[Evaluation]:
        """What becomes of points of the cube (C, P)."""
        return self._all(self._evaluation, units, np.full(len(units), np.inf))

    def outcomes(self, unit: Floats, aims: Sequence[Aim] | None = None) -> list[Outcome]:
        """How well a point of the cube (P,) meets aims, or all; those that cannot be simulated say so."""
        aims = self.problem.aims if aims is None else aims
        runs = [run for run in self.problem.runs if any(run.name in aim.sources for aim in aims)]
        values = self.problem.space.scene_values(unit)
        told = self._all(lambda run: self._attempt(run, values), runs)
        by_name = {run.name: each for run, each in zip(runs, told, strict=True)}
        return [_outcome(aim, [by_name[source] for source in sorted(aim.sources)]) for aim in aims]

    def refusal(self, unit: Floats) -> str:
        """Why a point of the cube (P,) cannot be simulated, in words."""
        values = self.problem.space.scene_values(unit)
        for run, _ in self._stages:
            told = self._attempt(run, values)
            broken = [told] if isinstance(told, str) else [each.broken for each in told.values()]
            if reason := next(filter(None, broken), None):
                return reason
        return "it can"

    def _all(self, task: Callable[..., T], *arguments: Iterable[object]) -> list[T]:
        """Runs a task for each of its arguments; an interruption drops those that have not begun."""
        with ThreadPoolExecutor(self._threads) as pool:
            return list(pool.map(task, *arguments))

    def _attempt(self, run: Run, values: dict[str, float]) -> dict[str, Recording] | str:
        """Recordings of a run, or why its scene was refused."""
        try:
            return run.record(values, self.problem.sample_s)
        except SceneError as error:
            return str(error)

    def _evaluation(self, unit: Floats, bound: float) -> Evaluation:
        values = self.problem.space.scene_values(unit)
        recordings: dict[str, Recording] = {}
        residuals: list[Floats] = []
        shares = np.full(len(self.problem.fitted), np.nan)
        for done, (run, aims) in enumerate(self._stages):
            told = self._attempt(run, values)
            if isinstance(told, str):
                return Evaluation(REFUSED * (1.0 + float(np.square(unit - self.base_unit).sum())), shares)
            left = _share_left(list(told.values()))
            if left > 0.0:
                left = (len(self._stages) - done - 1 + left) / len(self._stages)
                return Evaluation(BROKEN * (1.0 + 2.0 * left), shares)
            recordings.update(told)
            for place, aim in aims.items():
                residuals.append(aim.residuals(recordings))
                shares[place] = np.square(residuals[-1]).sum()
                if not np.isfinite(shares[place]):
                    return Evaluation(BROKEN * 3.0, shares)
            if np.nansum(shares) > bound:
                return Evaluation(min(float(np.nansum(shares)), BROKEN), shares)
        return Evaluation(min(float(shares.sum()), BROKEN), shares, np.concatenate(residuals))


def _stages(runs: Iterable[Run], aims: Sequence[Aim]) -> list[tuple[Run, dict[int, Aim]]]:
    """Runs that an aim needs, in their order, each with the aims by place that can be told after it."""
    stages: list[tuple[Run, dict[int, Aim]]] = []
    known: set[str] = set()
    for run in runs:
        if any(run.name in aim.sources for aim in aims):
            known.add(run.name)
            ready = {
                at: aim for at, aim in enumerate(aims) if run.name in aim.sources and aim.sources <= known
            }
            stages.append((run, ready))
    return stages


def _outcome(aim: Aim, told: Sequence[dict[str, Recording] | str]) -> Outcome:
    """How well an aim is met by what its runs gave, or why a scene was refused."""
    recordings: dict[str, Recording] = {}
    for given in told:
        if isinstance(given, str):
            return aim.refused(given)
        recordings.update(given)
    outcome = aim.outcome(recordings)
    broken = [recording.broken for recording in recordings.values() if recording.broken]
    return replace(outcome, met=False, remark=broken[0]) if broken else outcome


def _base_values(problem: Problem) -> dict[str, float]:
    """Numbers of the base scene, and of the runs where it has none."""
    numbers: dict[str, float] = {}
    for run in problem.runs[::-1]:
        numbers.update(scene_numbers(run.scene))
    return {**numbers, **scene_numbers(problem.base)}


def _share_left(runs: list[Recording]) -> float:
    """How much of a run is left when it breaks, from 0, where it does not, to 1, where nobody moved [1]."""
    idle = [_share_after_break(run) for run in runs if run.broken]
    return (len(idle) + sum(idle)) / (2.0 * len(runs))


def _share_after_break(run: Recording) -> float:
    """Share of a recording in which a broken robot stands still [1]."""
    moves = np.flatnonzero((np.diff(run.magnet_poses, axis=0) != 0.0).any(axis=(1, 2)))
    last = int(moves[-1]) + 1 if len(moves) else 0
    return 1.0 - last / max(len(run.magnet_poses) - 1, 1)
