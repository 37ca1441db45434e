"""All candidates with their losses, kept on disk, so that a search can go on."""

from pathlib import Path

import numpy as np

from magworm_gym.atomic_files import replace_file
from magworm_gym.identification.evaluation import Evaluator
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.recording import Floats

SAME = 1e-6
"""Distance in the unit cube up to which a candidate is the one that was kept [1]."""


class Ledger:
    """Asks for losses and remembers them.

    A search is a function of its seed and of losses alone. So to go on, it runs again from the
    beginning and the losses that are kept answer it at once; no state of an optimiser is stored.

    Args:
        evaluator: Gives losses and shares of the aims (A).
        path: The file, numpy's npz, written anew after each question; None keeps nothing.
        resume: Whether to begin with what the file keeps.

    Raises:
        ProblemError: What was kept is of another problem or cannot be read.
    """

    def __init__(self, evaluator: Evaluator, path: Path | None = None, *, resume: bool = False) -> None:
        problem = evaluator.problem
        self._path, self._ask, self._fingerprint = path, evaluator.losses_and_shares, problem.fingerprint
        self._units, self._losses = np.empty((0, len(problem.space))), np.empty(0)
        self._shares = np.empty((0, len(problem.fitted)))
        self._used = 0
        if resume and path is not None and path.exists():
            self._load(path)

    def _load(self, path: Path) -> None:
        unreadable = f"{path} cannot be read; allowed: the file of a run that was stopped"
        try:
            with path.open("rb") as file, np.load(file) as kept:
                fingerprint = str(kept["fingerprint"])
                found = kept["units"], kept["losses"], kept["shares"]
        except Exception as error:  # what damaged bytes make zipfile and NumPy raise has no end
            raise ProblemError(unreadable) from error
        if fingerprint != self._fingerprint:
            raise ProblemError(
                f"{path} belongs to another problem, other settings or another version; "
                "allowed with --resume: exactly what the run was started with"
            )
        sizes = [(len(found[1]), *each.shape[1:]) for each in (self._units, self._losses, self._shares)]
        if [each.shape for each in found] != sizes:
            raise ProblemError(unreadable)
        self._units, self._losses, self._shares = found

    @property
    def units(self) -> Floats:
        """Points of the cube so far (C, P)."""
        return self._units[: self._used]

    @property
    def known(self) -> Floats:
        """Their losses (C,) [1]."""
        return self._losses[: self._used]

    @property
    def shares(self) -> Floats:
        """What each aim's share of them is (C, A) [1]; NaN where it is not known."""
        return self._shares[: self._used]

    def losses(self, units: Floats, bounds: Floats) -> Floats:
        """Losses (C,) of points of the unit cube (C, P), exact up to bounds (C,); kept before it returns.

        Raises:
            ProblemError: What was kept does not fit, so it was made by another version.
        """
        end = self._used + len(units)
        if len(self._losses) < end:
            losses, shares = self._ask(units, bounds)
            self._units = np.concatenate([self._units[: self._used], units])
            self._losses = np.concatenate([self._losses[: self._used], losses])
            self._shares = np.concatenate([self._shares[: self._used], shares])
            if self._path is not None:
                self._save(self._path)
        elif np.abs(self._units[self._used : end] - units).max(initial=0.0) > SAME:
            raise ProblemError(
                f"{self._path} holds other candidates than this search makes, so libraries or machine "
                "differ; allowed: what the run was started with, or a new folder"
            )
        self._used = end
        return self._losses[end - len(units) : end]

    def _save(self, path: Path) -> None:
        with replace_file(path) as part, part.open("wb") as file:
            np.savez(
                file,
                units=self._units,
                losses=self._losses,
                shares=self._shares,
                fingerprint=np.array(self._fingerprint),
            )
