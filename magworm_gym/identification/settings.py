"""Settings of the search."""

from itertools import pairwise
from typing import Annotated

from msgspec import Meta

from magworm_gym.documents import Table

RISING = "a list of whole numbers from 1, each greater than the last"
Count = Annotated[int, Meta(ge=1, le=10**9)]


class SearchSettings(Table, frozen=True):
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

    restarts: Annotated[int, Meta(ge=1, le=1000)] = 5
    population: Annotated[int, Meta(ge=4, le=10_000)] = 32
    generations: Count = 100
    patience: Count = 30
    halve_after: Annotated[tuple[Count, ...], Meta(description=RISING)] = ()
    scatter: Annotated[int, Meta(ge=8, le=1_000_000)] = 256
    blind: bool = False
    rounds: Annotated[int, Meta(ge=0, le=10**9)] = 30
    first_step: Annotated[float, Meta(ge=1e-3, le=1.0)] = 0.15
    finest_step: Annotated[float, Meta(ge=1e-9, le=0.1)] = 2e-4
    fits_within: Annotated[float, Meta(ge=1.0, le=1e3)] | None = None
    fits_below: Annotated[float, Meta(ge=0.0, le=1e6)] = 0.0
    seed: Annotated[int, Meta(ge=0, le=2**31 - 1)] = 0

    def __post_init__(self) -> None:
        """Refuses generations that do not rise."""
        if any(one >= other for one, other in pairwise(self.halve_after)):
            raise ValueError(f"halve_after is {list(self.halve_after)}; allowed: {RISING}")
