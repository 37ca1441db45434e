"""CMA-ES with restarts in the unit cube.

Stick and slip make the loss jump: gradients mislead, and a single evolution may end in a groove that
is not the deepest. So candidates are scattered first, several evolutions begin at the best of them, and
all candidates of all evolutions run side by side.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.identification.evaluation import BROKEN
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.settings import SearchSettings

Floats = NDArray[np.float64]
Losses = Callable[[Floats], Floats]
Progress = Callable[[str, int, int, float], None]
"""Called with the stage, what of it is done, how much it is at most, and the best loss."""

APART = 0.15
"""Distance in the unit cube that beginnings of evolutions keep where they can [1]."""

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
        ended: Why it ended, in words; empty while it goes on.
    """

    strategy: Any
    best: Floats
    loss: float = np.inf
    idle: int = 0
    generations: int = 0
    ended: str = field(default="")

    def tell(self, units: Floats, losses: Floats, settings: SearchSettings) -> None:
        """Learns from a generation."""
        self.strategy.tell(list(zip(units, losses.tolist(), strict=True)))
        self.generations += 1
        least = float(losses.min())
        progress = self.generations == 1 or least < self.loss - LEAST_PROGRESS * abs(self.loss)
        self.idle = 0 if progress else self.idle + 1
        if least < self.loss:
            self.best, self.loss = units[int(losses.argmin())].copy(), least
        if np.ptp(units, axis=0).max() < 4.0 * settings.finest_step or self.strategy.should_stop():
            self.ended = "converged"
        elif self.idle >= settings.patience:
            self.ended = f"no progress in {settings.patience} generations"


def search(
    losses: Losses, base: Floats, settings: SearchSettings, progress: Progress | None = None
) -> list[Evolution]:
    """Searches the least loss.

    Args:
        losses: Gives the losses (C,) of points of the unit cube (C, P).
        base: Point of the base scene (P,), tried first.
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
    scatter = np.vstack([base, latin_hypercube(settings.scatter, len(base), generator)])
    scattered = losses(scatter)
    if scattered.min() >= BROKEN:
        raise NothingRunsError("no candidate within the bounds can be simulated")
    seeds = generator.integers(SEED_LIMIT, size=settings.restarts)
    evolutions = [
        Evolution(strategy(origin, int(seed)), origin)
        for origin, seed in zip(_origins(scatter, scattered, settings.restarts), seeds, strict=True)
    ]
    best = float(scattered.min())
    for generation in range(settings.generations):
        active = [evolution for evolution in evolutions if not evolution.ended]
        if not active:
            break
        asked = np.array([e.strategy.ask() for e in active for _ in range(settings.population)])
        blocks = losses(asked).reshape(len(active), -1)
        for evolution, units, block in zip(active, np.split(asked, len(active)), blocks, strict=True):
            evolution.tell(units, block, settings)
        best = min(best, float(blocks.min()))
        if progress is not None:
            progress("search", generation + 1, settings.generations, best)
    for evolution in evolutions:
        evolution.ended = evolution.ended or "out of generations"
    return sorted(evolutions, key=lambda evolution: evolution.loss)


def latin_hypercube(count: int, dimension: int, generator: np.random.Generator) -> Floats:
    """Points (count, dimension) of the unit cube, one in each of ``count`` slices of every axis."""
    slices = np.stack([generator.permutation(count) for _ in range(dimension)], axis=1)
    return np.asarray((slices + generator.random((count, dimension))) / count)


def _origins(scatter: Floats, losses: Floats, count: int) -> list[Floats]:
    """The best scattered points, apart from each other where that is possible."""
    order = list(scatter[np.argsort(losses, kind="stable")])
    chosen: list[Floats] = []
    while len(chosen) < count:
        if not order:
            order = list(scatter[np.argsort(losses, kind="stable")])
        apart = (at for at, u in enumerate(order) if all(np.linalg.norm(u - o) >= APART for o in chosen))
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
