"""The loss of candidates: all experiments of all candidates in one parallel run."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene, SceneError
from magworm_gym.identification.problem import Problem, scene_numbers
from magworm_gym.identification.targets import Outcome, Recordings
from magworm_gym.recording import Recording, record_scenes

Floats = NDArray[np.float64]

BROKEN = 1e6
"""Loss from which on a simulation broke down: up to three times as much, the less the sooner it did."""

REFUSED = 1e9
"""Loss from which on a scene cannot be simulated at all: it grows with the distance from the base."""

CHUNK_S = 4e4
"""Simulated time that is run at a time, so that recordings fit into memory [s]."""


@dataclass(frozen=True)
class Verdict:
    """What became of a candidate.

    Attributes:
        loss: Sum of the squares of the residuals, or a penalty [1].
        residuals: Residuals (R,) [1]; None where there is a penalty.
    """

    loss: float
    residuals: Floats | None = None


class Evaluator:
    """Runs candidates.

    Args:
        problem: The problem.
        threads: None for all cores; the result is the same bit for bit.
    """

    def __init__(self, problem: Problem, threads: int | None = None) -> None:
        self.problem = problem
        self.base_unit = problem.space.unit_of(_base_values(problem))
        self._threads = threads

    def losses(self, units: Floats) -> Floats:
        """Losses (C,) of points of the cube (C, P)."""
        return np.array([verdict.loss for verdict in self.verdicts(units)])

    def verdicts(self, units: Floats) -> list[Verdict]:
        """What becomes of points of the cube (C, P)."""
        return [self._verdict(unit, runs) for unit, runs in self._runs(units)]

    def outcomes(self, unit: Floats) -> list[Outcome]:
        """How well a point of the cube (P,) meets each target; empty where it cannot be simulated."""
        ((_, runs),) = self._runs(unit[None])
        if not isinstance(runs, dict):
            return []
        return [aim.outcome(runs) for aim in self.problem.aims]

    def refusal(self, unit: Floats) -> str:
        """Why a point of the cube (P,) cannot be simulated, in words."""
        ((_, runs),) = self._runs(unit[None])
        if isinstance(runs, str):
            return runs
        return next((run.broken for run in runs.values() if run.broken), "it can")

    def _runs(self, units: Floats) -> Iterator[tuple[Floats, Recordings | str]]:
        """Each point with its recordings, or with why its scene was refused."""
        size = max(1, int(CHUNK_S / self.problem.simulated_s))
        for first in range(0, len(units), size):
            chunk = units[first : first + size]
            scenes = [self._scenes(unit) for unit in chunk]
            yield from zip(chunk, self._record(scenes), strict=True)

    def _scenes(self, unit: Floats) -> list[Scene] | str:
        values = self.problem.space.scene_values(unit)
        try:
            return [experiment.scene_with(values) for experiment in self.problem.experiments]
        except SceneError as error:
            return str(error)

    def _record(self, candidates: list[list[Scene] | str]) -> list[Recordings | str]:
        experiments = self.problem.experiments
        good = [scenes for scenes in candidates if not isinstance(scenes, str)]
        recordings = iter(
            record_scenes(
                [scene for scenes in good for scene in scenes],
                [experiment.duration_s for experiment in experiments] * len(good),
                self.problem.sample_s,
                nodes=False,
                threads=self._threads,
            )
            if good
            else []
        )
        names = [experiment.name for experiment in experiments]
        return [
            scenes if isinstance(scenes, str) else {name: next(recordings) for name in names}
            for scenes in candidates
        ]

    def _verdict(self, unit: Floats, runs: Recordings | str) -> Verdict:
        if isinstance(runs, str):
            return Verdict(REFUSED * (1.0 + float(np.square(unit - self.base_unit).sum())))
        stood_still = [_share_after_break(run) for run in runs.values() if run.broken]
        if stood_still:
            return Verdict(BROKEN * (1.0 + len(stood_still) / len(runs) + float(np.mean(stood_still))))
        residuals = np.concatenate([aim.residuals(runs) for aim in self.problem.aims])
        loss = float(np.square(residuals).sum())
        if not np.isfinite(loss):
            return Verdict(BROKEN * 3.0)
        return Verdict(min(loss, BROKEN), residuals)


def _base_values(problem: Problem) -> dict[str, float]:
    """Numbers of the base scene, and of the experiments where it has none."""
    numbers: dict[str, float] = {}
    for experiment in problem.experiments[::-1]:
        numbers.update(scene_numbers(experiment.scene))
    return {**numbers, **scene_numbers(problem.base)}


def _share_after_break(run: Recording) -> float:
    """Share of a recording in which a broken robot stands still [1]."""
    moves = np.flatnonzero((np.diff(run.magnet_poses, axis=0) != 0.0).any(axis=(1, 2)))
    last = int(moves[-1]) + 1 if len(moves) else 0
    return 1.0 - last / max(len(run.magnet_poses) - 1, 1)
