"""What a target that is not met would cost: the best candidate that meets it, and what that one misses."""

from dataclasses import dataclass

import numpy as np

from magworm_gym.identification.evaluation import BROKEN, Evaluator
from magworm_gym.identification.targets import Outcome
from magworm_gym.recording import Floats

TRIES = 3
"""Candidates that are looked at again: a share that is allowed may still miss at one of several speeds."""


@dataclass(frozen=True)
class Alternative:
    """The best candidate that meets a target which the best of all does not.

    Attributes:
        target: Name of the target.
        values: Path of each fitted field → its value; None where no candidate meets it.
        loss: Its loss [1].
        missed: Names of the fitted targets that it misses.
    """

    target: str
    values: dict[str, float] | None = None
    loss: float = np.inf
    missed: tuple[str, ...] = ()


def alternatives(
    evaluator: Evaluator, outcomes: list[Outcome], units: Floats, losses: Floats, shares: Floats
) -> list[Alternative]:
    """One for each fitted target that is not met.

    Args:
        evaluator: Runs candidates again.
        outcomes: How well the best candidate meets all targets.
        units: All candidates (C, P).
        losses: Their losses (C,).
        shares: Shares of the fitted aims (C, A); NaN where they are not known.
    """
    fitted = [outcome for outcome in outcomes if outcome.fitted]
    return [
        _alternative(evaluator, place, units, np.where(losses < BROKEN, losses, np.inf), shares[:, place])
        for place, outcome in enumerate(fitted)
        if not outcome.met
    ]


def _alternative(
    evaluator: Evaluator, place: int, units: Floats, losses: Floats, shares: Floats
) -> Alternative:
    aims = evaluator.problem.fitted
    meeting = np.flatnonzero((shares <= aims[place].allowance) & np.isfinite(losses))
    for at in meeting[np.argsort(losses[meeting], kind="stable")][:TRIES]:
        again = evaluator.outcomes(units[at], aims)
        if again[place].met:
            missed = tuple(outcome.name for outcome in again if not outcome.met)
            loss = float(sum(outcome.loss for outcome in again))
            return Alternative(
                aims[place].name, evaluator.problem.space.scene_values(units[at]), loss, missed
            )
    return Alternative(aims[place].name)
