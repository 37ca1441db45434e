"""Settings of the search."""

from dataclasses import dataclass
from itertools import pairwise

from magworm_gym.identification.table import Table


@dataclass(frozen=True)
class SearchSettings:
    """Settings of the search; all candidates of a generation run side by side.

    Attributes:
        restarts: Evolutions, each from another of the best scattered candidates with its own seed.
        population: Candidates of each evolution in a generation.
        generations: Most generations of an evolution.
        patience: Generations without progress after which an evolution ends.
        halve_after: Generations after each of which the worse half of the evolutions ends.
        scatter: Candidates spread over the bounds first.
        blind: Whether the base scene and the robots that a problem names as starts are left out.
        rounds: Rounds, of 64 candidates, that explore what fits as well as the best.
        first_step: Standard deviation of an evolution's first generation, as a part of the bounds [1].
        finest_step: An evolution ends where its standard deviations fall below [1].
        fits_within: Times the least loss that a candidate may have and still fit about as well [1]; None for
            a likelihood interval.
        fits_below: Loss that fits whatever the least one is, beside ``fits_within`` [1].
        seed: Seed of everything random.
    """

    restarts: int = 5
    population: int = 32
    generations: int = 100
    patience: int = 30
    halve_after: tuple[int, ...] = ()
    scatter: int = 256
    blind: bool = False
    rounds: int = 30
    first_step: float = 0.15
    finest_step: float = 2e-4
    fits_within: float | None = None
    fits_below: float = 0.0
    seed: int = 0


def read_settings(table: Table) -> SearchSettings:
    """Reads the table ``search``; what it leaves out has its default.

    Raises:
        ProblemError: A value that is not allowed.
    """
    default = SearchSettings()
    settings = SearchSettings(
        restarts=table.whole("restarts", default.restarts, low=1, high=1000),
        population=table.whole("population", default.population, low=4, high=10_000),
        generations=table.whole("generations", default.generations, low=1),
        patience=table.whole("patience", default.patience, low=1),
        halve_after=_generations(table),
        blind=table.flag("blind", default.blind),
        scatter=table.whole("scatter", default.scatter, low=8, high=1_000_000),
        rounds=table.whole("rounds", default.rounds, low=0),
        first_step=table.number("first_step", default.first_step, low=1e-3, high=1.0),
        finest_step=table.number("finest_step", default.finest_step, low=1e-9, high=0.1),
        fits_within=table.number("fits_within", low=1.0, high=1e3) if table.has("fits_within") else None,
        fits_below=table.number("fits_below", default.fits_below, low=0.0, high=1e6),
        seed=table.whole("seed", default.seed, low=0, high=2**31 - 1),
    )
    table.done()
    return settings


def _generations(table: Table) -> tuple[int, ...]:
    """Takes ``halve_after``."""
    value = table.take("halve_after", [])
    whole = isinstance(value, list) and all(type(each) is int and each >= 1 for each in value)
    if not whole or any(one >= other for one, other in pairwise(value)):
        raise table.refusal(
            "halve_after", value, "a list of whole numbers from 1, each greater than the last"
        )
    return tuple(value)
