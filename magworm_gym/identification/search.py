"""CMA-ES with restarts in the unit cube.

Stick and slip make the loss jump: gradients mislead, and a single evolution may end in a groove that
is not the deepest. So candidates are scattered first, several evolutions begin at the best of them, and
all candidates of all evolutions run side by side. They race: the worse half of the evolutions ends now and
then, and a candidate ends as soon as its loss is beyond what can matter.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from magworm_gym.identification.evaluation import BROKEN
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.settings import SearchSettings
from magworm_gym.recording import Floats

Losses = Callable[[Floats, Floats], Floats]
"""Gives the losses (C,) of points of the unit cube (C, P), exact up to bounds (C,); beyond its bound a loss
is only known to be greater than that."""
Limit = Callable[[float], float]
"""Gives the loss up to which a candidate fits about as well as the best from the least loss."""
Progress = Callable[[str, int, int, float], None]
"""Called with the stage, what of it is done, how much it is at most, and the best loss."""

APART = 0.15
"""Distance in the unit cube that beginnings of evolutions keep where they can [1]."""

ROUND = 64
"""Scattered candidates that run at a time."""

RUNNERS_UP = 4
"""Scattered candidates for each evolution whose losses are known exactly."""

LEAST_PROGRESS = 1e-3
"""Relative change of the best loss that counts as progress [1]."""

SEED_LIMIT = 2**31


class NothingRunsError(ProblemError):
    """No candidate within the bounds can be simulated."""


@dataclass
class Evolution:
    """One run of CMA-ES.

    Attributes:
        strategy: The ``cmaes.CMA``.
        best: Its best point of the cube (P,).
        loss: The loss there [1].
        idle: Generations since the last progress.
        generations: Generations so far.
        parents: Greatest loss of the parents of the last generation, its better half; at least ``loss`` [1].
        ended: Why it ended, in words; empty while it goes on.
    """

    strategy: Any
    best: Floats
    loss: float = np.inf
    idle: int = 0
    generations: int = 0
    parents: float = np.inf
    ended: str = ""

    def tell(self, units: Floats, losses: Floats, settings: SearchSettings) -> None:
        """Learns from a generation."""
        self.strategy.tell(list(zip(units, losses.tolist(), strict=True)))
        self.generations += 1
        least = float(losses.min())
        self.parents = float(np.sort(losses)[(len(losses) - 1) // 2])
        progress = self.generations == 1 or least < self.loss - LEAST_PROGRESS * abs(self.loss)
        self.idle = 0 if progress else self.idle + 1
        if least < self.loss:
            self.best, self.loss = units[int(losses.argmin())].copy(), least
        if np.ptp(units, axis=0).max() < 4.0 * settings.finest_step or self.strategy.should_stop():
            self.ended = "converged"
        elif self.idle >= settings.patience:
            self.ended = f"no progress in {settings.patience} generations"


def search(
    losses: Losses,
    limit: Limit,
    starts: Floats,
    settings: SearchSettings,
    progress: Progress | None = None,
) -> list[Evolution]:
    """Searches the least loss.

    Args:
        losses: Gives the losses.
        limit: Losses up to it are known exactly, whatever races.
        starts: Points (S, P) that are tried first.
        settings: Settings.
        progress: Told after each batch.

    Returns:
        The evolutions, best first.

    Raises:
        ImportError: The library cmaes is missing; the sentence names the extra to install.
        NothingRunsError: No candidate within the bounds can be simulated.
    """
    strategy = _strategy_maker(settings)
    generator = np.random.default_rng([settings.seed, 1])
    scatter = np.vstack([starts, latin_hypercube(settings.scatter, starts.shape[1], generator)])
    exact = min(RUNNERS_UP * settings.restarts, len(scatter))
    scattered = _scattered(losses, limit, scatter, exact, progress)
    known = float(np.sort(scattered)[exact - 1])
    if scattered.min() >= BROKEN:
        raise NothingRunsError("no candidate within the bounds can be simulated")
    seeds = generator.integers(SEED_LIMIT, size=settings.restarts)
    evolutions = []
    for at, seed in zip(_origins(scatter, scattered, settings.restarts), seeds, strict=True):
        evolution = Evolution(strategy(scatter[at], int(seed)), scatter[at])
        if scattered[at] <= known:  # else it may be less than exact; its first parents have to be as good
            evolution.loss, evolution.parents = float(scattered[at]), known
        evolutions.append(evolution)
    best = float(scattered.min())
    for generation in range(settings.generations):
        active = [evolution for evolution in evolutions if not evolution.ended]
        if not active:
            break
        asked = np.array([e.strategy.ask() for e in active for _ in range(settings.population)])
        bounds = np.repeat([max(e.parents, limit(best)) for e in active], settings.population)
        blocks = losses(asked, bounds).reshape(len(active), -1)
        for evolution, units, block in zip(active, np.split(asked, len(active)), blocks, strict=True):
            evolution.tell(units, block, settings)
        best = min(best, float(blocks.min()))
        if progress is not None:
            progress("search", generation + 1, settings.generations, best)
        if generation + 1 in settings.halve_after:
            _end_worse_half(evolutions)
    for evolution in evolutions:
        evolution.ended = evolution.ended or "out of generations"
    return sorted(evolutions, key=lambda evolution: evolution.loss)


def _scattered(
    losses: Losses, limit: Limit, scatter: Floats, exact: int, progress: Progress | None
) -> Floats:
    """Losses (C,) of scattered points (C, P), at least so many of the least ones exactly."""
    known = np.empty(0)
    while len(known) < len(scatter):
        bound = np.inf
        if len(known) >= exact:
            bound = max(float(np.sort(known)[exact - 1]), limit(float(known.min())))
        points = scatter[len(known) : len(known) + ROUND]
        known = np.append(known, losses(points, np.full(len(points), bound)))
        if progress is not None:
            progress("scatter", len(known), len(scatter), float(known.min()))
    return known


def _end_worse_half(evolutions: list[Evolution]) -> None:
    """Ends the worse half of the evolutions that go on."""
    active = sorted((e for e in evolutions if not e.ended), key=lambda evolution: evolution.loss)
    for evolution in active[(len(active) + 1) // 2 :]:
        evolution.ended = "dropped: others fitted better"


def latin_hypercube(count: int, dimension: int, generator: np.random.Generator) -> Floats:
    """Points (count, dimension) of the unit cube, one in each of ``count`` slices of every axis."""
    slices = np.stack([generator.permutation(count) for _ in range(dimension)], axis=1)
    return np.asarray((slices + generator.random((count, dimension))) / count)


def _origins(scatter: Floats, losses: Floats, count: int) -> list[int]:
    """Places of the best scattered points, apart from each other where that is possible."""
    best_first = np.argsort(losses, kind="stable").tolist()
    order: list[int] = []
    chosen: list[int] = []
    while len(chosen) < count:
        order = order or best_first.copy()
        away = (np.linalg.norm(scatter[chosen] - scatter[at], axis=1).min(initial=np.inf) for at in order)
        apart = (place for place, distance in enumerate(away) if distance >= APART)
        chosen.append(order.pop(next(apart, 0)))
    return chosen


def _strategy_maker(settings: SearchSettings) -> Callable[[Floats, int], Any]:
    """What makes an evolution strategy in the unit cube from its origin (P,) and its seed."""
    try:
        import cmaes
    except ImportError as error:
        raise ImportError("CMA-ES needs the library cmaes: pip install 'magworm-gym[identify]'.") from error
    return lambda origin, seed: cmaes.CMA(
        mean=origin,
        sigma=settings.first_step,
        bounds=np.tile([0.0, 1.0], (len(origin), 1)),
        population_size=settings.population,
        seed=seed,
    )
