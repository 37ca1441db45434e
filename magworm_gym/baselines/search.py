"""The best parameters that CMA-ES finds, whatever they are of."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

LEAST_PROGRESS = 0.002
SEED_LIMIT = 2**31


@dataclass(frozen=True)
class Found:
    """What a search found.

    Attributes:
        parameters: The best of all candidates (P,).
        score: Its score.
        bests: Best score so far, after the scouts and after each generation (1 + G,).
    """

    parameters: Floats
    score: float
    bests: Floats


def search(
    scores: Callable[[Floats], Floats],
    scouts: Floats,
    generator: np.random.Generator,
    *,
    population: int = 16,
    generations: int = 10,
    sigma: float = 0.15,
    patience: int = 30,
    progress: Callable[[int], None] | None = None,
) -> Found:
    """Searches the parameters in [-1, 1] with the greatest score.

    Scouts are tried first, and the evolution begins at the best of them. One that makes no progress is
    followed by another, from the next best, and after the last from the best again.

    Args:
        scores: Scores (C,) of candidates (C, P).
        scouts: Candidates to begin with (S, P).
        generator: Draws the seeds of evolutions.
        population: Candidates of a generation.
        generations: Generations; at least one runs.
        sigma: Spread of the first generation about where it begins.
        patience: Generations without progress after which an evolution is given up for another one.
        progress: Called after each generation with their number so far.

    Raises:
        ImportError: The library cmaes is missing; the sentence names the extra to install.
    """
    found = scores(scouts)
    origins = itertools.cycle(scouts[np.argsort(-found, kind="stable")])
    best, best_score = scouts[found.argmax()], float(found.max())
    bests = [best_score]
    strategy, reached, idle = _strategy(next(origins), sigma, population, generator), -np.inf, 0
    for generation in range(1, max(generations, 1) + 1):
        if strategy.should_stop() or idle >= patience:
            strategy, reached, idle = _strategy(next(origins), sigma, population, generator), -np.inf, 0
        candidates = np.array([strategy.ask() for _ in range(population)])
        found = scores(candidates)
        # Scores of a worm are small, and the tolerances of the library absolute.
        strategy.tell(list(zip(candidates, -1e3 * found, strict=True)))
        idle = 0 if found.max() > reached + LEAST_PROGRESS * abs(reached) else idle + 1
        reached = max(reached, float(found.max()))
        if found.max() > best_score:
            best, best_score = candidates[found.argmax()], float(found.max())
        bests.append(best_score)
        if progress is not None:
            progress(generation)
    return Found(best, best_score, np.array(bests))


def _strategy(origin: Floats, sigma: float, population: int, generator: np.random.Generator) -> Any:
    """A fresh evolution strategy on the box [-1, 1], around an origin."""
    try:
        import cmaes
    except ImportError as error:
        raise ImportError("CMA-ES needs the library cmaes: pip install 'magworm-gym[train]'.") from error
    return cmaes.CMA(
        mean=origin,
        sigma=sigma,
        bounds=np.tile([-1.0, 1.0], (len(origin), 1)),
        population_size=population,
        seed=int(generator.integers(SEED_LIMIT)),
    )
