"""From a problem to fitted parameters and what is known of them."""

from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np

from magworm_gym._magworm import Scene
from magworm_gym.arguments import path_of
from magworm_gym.identification.alternatives import Alternative, alternatives
from magworm_gym.identification.combinations import FreeCombination, free_combinations
from magworm_gym.identification.evaluation import Evaluator
from magworm_gym.identification.exploration import explore
from magworm_gym.identification.findings import Finding, findings
from magworm_gym.identification.identifiability import Sensitivity, sensitivity
from magworm_gym.identification.ledger import Ledger
from magworm_gym.identification.limit import CHI_SQUARE_95
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.paths import scene_numbers
from magworm_gym.identification.problem import Problem
from magworm_gym.identification.profiles import profiles
from magworm_gym.identification.search import Evolution, NothingRunsError, Progress, search
from magworm_gym.identification.targets import Outcome
from magworm_gym.recording import Floats

CANDIDATES = "candidates.npz"

LEAST_NOISE = 1e-6
"""Distance of the limit from the least loss that derivatives are still set against [1]."""


@dataclass(frozen=True)
class Identification:
    """What was found.

    Attributes:
        problem: The problem.
        unit: The best point of the unit cube (P,).
        values: Path of each fitted field → its best value, in the field's unit.
        loss: Least loss [1].
        limit: Loss up to which a candidate fits about as well [1].
        candidates: Number of candidates that were simulated.
        outcomes: How well each target is met.
        alternatives: What each fitted target that is not met would cost.
        findings: What is known of each parameter.
        evolutions: The evolutions, best first.
        sensitivity: Derivatives at the best point.
        free: Combinations that the data leave free.
        profiles: Least loss of each parameter's slices, see :func:`profiles`.
        scene: The base scene with the fitted values.
        left_out: Fitted paths that the base scene does not have, such as those of an experiment's drive.
    """

    problem: Problem
    unit: Floats
    values: dict[str, float]
    loss: float
    limit: float
    candidates: int
    outcomes: list[Outcome]
    alternatives: list[Alternative]
    findings: list[Finding]
    evolutions: list[Evolution]
    sensitivity: Sensitivity
    free: list[FreeCombination]
    profiles: Floats
    scene: Scene
    left_out: tuple[str, ...]

    @property
    def misfit(self) -> float:
        """Root of the loss over degrees of freedom: about 1 where the model meets the data [1]."""
        free = max(self.problem.measurements - len(self.problem.space), 1.0)
        return float(np.sqrt(self.loss / free))


def identify(
    problem: Problem,
    out: str | PathLike[str] | None = None,
    *,
    resume: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Identification:
    """Fits the parameters of a problem and finds out which of them the data pin down.

    The result is a function of the problem alone: threads and interruptions do not change it.

    Args:
        problem: The problem.
        out: Folder for the candidates, so that a search that was stopped can go on; None keeps none.
        resume: Whether to go on with what is in the folder.
        threads: None for all cores.
        progress: Told after each batch of candidates.

    Raises:
        ImportError: The library cmaes is missing; the sentence names the extra to install.
        ProblemError: Nothing within the bounds can be simulated, or the folder does not fit.
        KeyboardInterrupt: Stopped; it says how to go on.
    """
    out = None if out is None else path_of("out", out)
    try:
        return _fitted(problem, out, resume, threads, progress)
    except KeyboardInterrupt as stopped:
        kept = f"what was complete is kept in {str(out)!r}; to go on, call identify with resume=True"
        told = "nothing is kept, since no folder was given: out is None" if out is None else kept
        raise KeyboardInterrupt(told) from stopped


def _fitted(
    problem: Problem, out: Path | None, resume: bool, threads: int | None, progress: Progress | None
) -> Identification:
    evaluator = Evaluator(problem, threads)
    path = None if out is None else _open_folder(out, resume) / CANDIDATES
    ledger = Ledger(evaluator, path, resume=resume)
    try:
        evolutions = search(
            ledger.losses, problem.limit, _starts(problem, evaluator), problem.settings, progress
        )
    except NothingRunsError as error:
        refusal = evaluator.refusal(evaluator.base_unit)
        raise ProblemError(f"{error}; nearest to the base scene: {refusal}") from error
    axes = _sensitivity(problem, evaluator, ledger.units, ledger.known).axes
    explore(ledger.losses, problem.limit, axes, ledger.units, ledger.known, problem.settings, progress)
    return _identification(problem, evaluator, evolutions, ledger)


def _starts(problem: Problem, evaluator: Evaluator) -> Floats:
    """Points of the cube (S, P) that are tried first: the base scene unless blind, then known robots."""
    base = [] if problem.settings.blind else [evaluator.base_unit]
    points = [*base, *map(problem.space.unit_of, problem.starts)]
    return np.array(points).reshape(-1, len(problem.space))


def _identification(
    problem: Problem, evaluator: Evaluator, evolutions: list[Evolution], ledger: Ledger
) -> Identification:
    units, known = ledger.units, ledger.known
    best, loss = units[int(known.argmin())], float(known.min())
    limit = problem.limit(loss)
    sensed = _sensitivity(problem, evaluator, units, known)
    values = problem.space.scene_values(best)
    fitting = units[known <= limit]
    scene, left_out = base_with(problem.base, values)
    outcomes = evaluator.outcomes(best)
    return Identification(
        problem=problem,
        unit=best,
        values=values,
        loss=loss,
        limit=limit,
        candidates=len(known),
        outcomes=outcomes,
        alternatives=alternatives(evaluator, outcomes, units, known, ledger.shares),
        findings=findings(problem.space, best, evolutions, fitting, limit, sensed),
        evolutions=evolutions,
        sensitivity=sensed,
        free=free_combinations(best, fitting),
        profiles=profiles(units, known),
        scene=scene,
        left_out=left_out,
    )


def _sensitivity(problem: Problem, evaluator: Evaluator, units: Floats, known: Floats) -> Sensitivity:
    """Derivatives at the best of all candidates, against the noise that the threshold stands for."""
    loss = float(known.min())
    noise = np.sqrt(max(problem.limit(loss) - loss, LEAST_NOISE) / CHI_SQUARE_95)
    return sensitivity(evaluator.evaluations, units[int(known.argmin())], float(noise))


def _open_folder(out: Path, resume: bool) -> Path:
    """Makes a folder that is new or empty; with resume, an old one will do."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        taken = any(out.iterdir())
    except OSError as error:
        raise ProblemError(f"out is {str(out)!r}: {error.strerror}; allowed: a new folder") from error
    if taken and not resume:
        raise ProblemError(
            f"out is {str(out)!r}, which is not empty; allowed: a new folder, or --resume to go on there"
        )
    return out


def base_with(base: Scene, values: dict[str, float]) -> tuple[Scene, tuple[str, ...]]:
    """The base with all values that it has a field for, and the paths of the others."""
    has = scene_numbers(base)
    fitting = {path: value for path, value in values.items() if path in has}
    return base.with_values(fitting), tuple(path for path in values if path not in has)
