"""All candidates with their losses, kept on disk, so that a search can go on."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from magworm_gym.atomic_files import replace_file
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.recording import Floats

LossesAndShares = Callable[[Floats, Floats], tuple[Floats, Floats]]

SAME = 1e-6
"""Distance in the unit cube up to which a candidate is the one that was kept [1]."""


class Ledger:
    """Asks for losses and remembers them.

    A search is a function of its seed and of losses alone. So to go on, it runs again from the
    beginning and the losses that are kept answer it at once; no state of an optimiser is stored.

    Args:
        path: The file, numpy's npz, written anew after each question; None keeps nothing.
        ask: Gives losses (C,) of points of the unit cube (C, P), exact up to bounds (C,), and shares of
            the aims (C, A).
        dimension: Number of parameters P.
        aims: Number of aims A that share the loss.
        fingerprint: Of the problem that the losses belong to.
    """

    def __init__(
        self, path: Path | None, ask: LossesAndShares, dimension: int, aims: int, fingerprint: str
    ) -> None:
        self._path, self._ask, self._fingerprint = path, ask, fingerprint
        self._units, self._losses, self._shares = np.empty((0, dimension)), np.empty(0), np.empty((0, aims))
        self._used = 0

    def load(self) -> int:
        """Reads what was kept, and returns the number of candidates.

        Raises:
            ProblemError: It is of another problem or cannot be read.
        """
        assert self._path is not None
        try:
            with self._path.open("rb") as file, np.load(file) as kept:
                fingerprint = str(kept["fingerprint"])
                units, losses, shares = kept["units"], kept["losses"], kept["shares"]
            sizes = (len(losses), units.shape[1]), (len(losses), shares.shape[1])
            if (units.shape, shares.shape, losses.ndim) != (*sizes, 1):
                raise ValueError("sizes differ")
        except Exception as error:  # what damaged bytes make zipfile and NumPy raise has no end
            raise ProblemError(
                f"{self._path} cannot be read; allowed: the file of a run that was stopped"
            ) from error
        if fingerprint != self._fingerprint:
            raise ProblemError(
                f"{self._path} belongs to another problem, other settings or another version; "
                "allowed with --resume: exactly what the run was started with"
            )
        self._units, self._losses, self._shares = units, losses, shares
        return len(losses)

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
        """Losses (C,) of points of the unit cube (C, P); kept before it returns.

        Args:
            units: The points.
            bounds: Losses (C,) beyond which they need not be exact.

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
