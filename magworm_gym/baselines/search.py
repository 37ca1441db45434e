"""The best periodic open-loop stroke that CMA-ES finds in a budget of simulated time."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch, Scene
from magworm_gym.baselines.stroke import PeriodicStrokes, Stroke, stroke_from_unit
from magworm_gym.baselines.trial import Trial, crawl_speed_m_s

Floats = NDArray[np.float64]

FIRST_SIGMA = 0.15
LEAST_PROGRESS = 0.002
SEED_LIMIT = 2**31


@dataclass(frozen=True)
class SearchSettings:
    """Settings of the search.

    Attributes:
        control_points: Control points of a stroke K.
        scouts: Random strokes tried first, half of them to and fro between two actions; each
            evolution begins at the best one not yet used.
        population: Strokes for each generation.
        starts: Trials of each stroke, with different seeds.
        patience: Generations without progress after which an evolution is given up.
        trial: How a speed is measured during the search.
    """

    control_points: int = 6
    scouts: int = 512
    population: int = 16
    starts: int = 2
    patience: int = 30
    trial: Trial = field(default_factory=lambda: Trial(settle_s=0.5, measure_s=3.0))

    @property
    def scouting_s(self) -> float:
        """Simulated time of trying the scouts [s]."""
        return self.scouts * self.starts * self.trial.duration_s

    @property
    def generation_s(self) -> float:
        """Simulated time of one generation [s]."""
        return self.population * self.starts * self.trial.duration_s


@dataclass(frozen=True)
class SearchResult:
    """What the search found.

    Attributes:
        stroke: The best stroke.
        speed_m_s: Its crawling speed during the search [m/s].
        simulated_s: Simulated time after each generation (G,) [s].
        best_m_s: Best speed so far after each generation (G,) [m/s].
    """

    stroke: Stroke
    speed_m_s: float
    simulated_s: Floats
    best_m_s: Floats


def search_stroke(
    scene: Scene,
    budget_s: float,
    seed: int,
    settings: SearchSettings | None = None,
    present: NDArray[np.bool_] | None = None,
    progress: Callable[[float], None] | None = None,
) -> SearchResult:
    """Searches the best periodic stroke; a generation is one batch.

    Random strokes are tried first, and the evolution begins at the best of them. One that makes no
    progress is followed by another, from the next best, until the budget of simulated time is spent.

    Args:
        scene: Scene with a controlled drive.
        budget_s: Simulated time to spend [s], scouting included; at least one generation runs.
        seed: Seed of the search and of the trials.
        settings: Settings of the search; None for the defaults.
        present: Which body magnets are in place (M,); None for all.
        progress: Called after each generation with the simulated time spent [s].

    Returns:
        The best stroke of all generations, and how the search went.

    Raises:
        ImportError: The library cmaes is missing; the sentence names the extra to install.
        ValueError: The scene has no controlled drive.
    """
    settings = settings or SearchSettings()
    generator = np.random.default_rng(seed)
    scouts = _scouts(generator, settings)
    speeds = _speeds(_batch(scene, settings.scouts, settings, present), settings, scouts, generator)
    origins = iter(scouts[np.argsort(-speeds)])
    best, best_speed = scouts[speeds.argmax()], float(speeds.max())
    spent, history = settings.scouting_s, [(settings.scouting_s, best_speed)]
    batch = _batch(scene, settings.population, settings, present)
    strategy, record, idle = _strategy(settings, next(origins), generator), -np.inf, 0
    while len(history) == 1 or spent + settings.generation_s <= budget_s:
        if strategy.should_stop() or idle >= settings.patience:
            strategy, record, idle = _strategy(settings, next(origins), generator), -np.inf, 0
        candidates = np.array([strategy.ask() for _ in range(settings.population)])
        speeds = _speeds(batch, settings, candidates, generator)
        strategy.tell(list(zip(candidates, -1e3 * speeds, strict=True)))
        idle = 0 if speeds.max() > record + LEAST_PROGRESS * abs(record) else idle + 1
        record = max(record, float(speeds.max()))
        if speeds.max() > best_speed:
            best, best_speed = candidates[speeds.argmax()], float(speeds.max())
        spent += settings.generation_s
        history.append((spent, best_speed))
        if progress is not None:
            progress(spent)
    times, bests = np.array(history).T
    return SearchResult(stroke_from_unit(best), best_speed, times, bests)


def _scouts(generator: np.random.Generator, settings: SearchSettings) -> Floats:
    """Random strokes (scouts, 1 + 3 K): half of them anything, half of them to and fro.

    To and fro means one action for a part of the period and another one for the rest.
    """
    count, points = settings.scouts, settings.control_points
    scouts = generator.uniform(-1.0, 1.0, (count, 1 + 3 * points))
    for row in range(count // 2):
        forth, back = generator.uniform(-1.0, 1.0, (2, 3))
        part = generator.integers(1, max(points, 2))
        scouts[row, 1:] = np.where(np.arange(points)[:, None] < part, forth, back).ravel()
    return scouts


def _batch(scene: Scene, strokes: int, settings: SearchSettings, present: NDArray[np.bool_] | None) -> Batch:
    """Robots for all trials of a number of strokes."""
    batch = Batch(scene, strokes * settings.starts)
    if present is not None:
        batch.set_magnets_present(np.tile(present, (batch.num_envs, 1)))
    return batch


def _speeds(
    batch: Batch, settings: SearchSettings, candidates: Floats, generator: np.random.Generator
) -> Floats:
    """Mean speed [m/s] of each candidate, over starts that are the same for all."""
    seeds = generator.integers(SEED_LIMIT, size=settings.starts, dtype=np.uint64)
    strokes = [stroke_from_unit(candidate) for candidate in candidates for _ in seeds]
    everyone = np.tile(seeds, len(candidates))
    measured = crawl_speed_m_s(batch, settings.trial, everyone, PeriodicStrokes(strokes))
    return np.asarray(measured.reshape(len(candidates), -1).mean(axis=1))


def _strategy(settings: SearchSettings, origin: Floats, generator: np.random.Generator) -> Any:
    """A fresh evolution strategy on the box [-1, 1], around an origin."""
    try:
        import cmaes
    except ImportError as error:
        raise ImportError("CMA-ES needs the library cmaes: pip install 'magworm-gym[train]'.") from error
    return cmaes.CMA(
        mean=origin,
        sigma=FIRST_SIGMA,
        bounds=np.tile([-1.0, 1.0], (len(origin), 1)),
        population_size=settings.population,
        seed=int(generator.integers(SEED_LIMIT)),
    )
