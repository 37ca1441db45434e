"""Searches of the best stroke in the plane, and of the best cycle of a family towards a goal."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene
from magworm_gym.baselines.cycle import Steered
from magworm_gym.baselines.family import Family
from magworm_gym.baselines.flight import AIMS, fly
from magworm_gym.baselines.runner import Runner
from magworm_gym.baselines.search import SEED_LIMIT, Found, search
from magworm_gym.baselines.stroke import PeriodicStrokes, stroke_from_unit
from magworm_gym.baselines.trial import Trial
from magworm_gym.tasks import Task

Floats = NDArray[np.float64]

LOST_SCORE = -1.0


@dataclass(frozen=True)
class StrokeSearch:
    """Search of a periodic open-loop stroke that crawls fast.

    Attributes:
        control_points: Control points of a stroke K.
        scouts: Random strokes tried first, half of them to and fro between two actions.
        starts: Trials of each stroke, with different seeds.
        trial: How a speed is measured during the search.
        population: Strokes of a generation.
    """

    control_points: int = 6
    scouts: int = 512
    starts: int = 2
    trial: Trial = field(default_factory=lambda: Trial(settle_s=0.5, measure_s=3.0))
    population: int = 16

    @property
    def scouting_s(self) -> float:
        """Simulated time of trying the scouts [s]."""
        return self.scouts * self.starts * self.trial.duration_s

    @property
    def generation_s(self) -> float:
        """Simulated time of one generation [s]."""
        return self.population * self.starts * self.trial.duration_s

    def found(
        self,
        scene: Scene,
        budget_s: float,
        seed: int,
        removed: Sequence[int] | None = None,
        progress: Callable[[int], None] | None = None,
    ) -> Found:
        """Searches; the score is the crawling speed [m/s].

        Args:
            scene: Scene with a controlled drive.
            budget_s: Simulated time to spend [s], scouting included; at least one generation runs.
            seed: Seed of the search and of the trials.
            removed: Magnets taken out; None for those that the scene lacks.
            progress: Called after each generation with their number so far.

        Raises:
            ImportError: The library cmaes is missing; the sentence names the extra to install.
            ValueError: The scene has no controlled drive.
        """
        generator = np.random.default_rng(seed)
        scouts = self._scouts(generator)
        worms = {
            count: Runner(scene, count * self.starts, removed) for count in {self.scouts, self.population}
        }

        def speeds(candidates: Floats) -> Floats:
            seeds = generator.integers(SEED_LIMIT, size=self.starts, dtype=np.uint64)
            strokes = [stroke_from_unit(candidate) for candidate in candidates for _ in seeds]
            everyone = np.tile(seeds, len(candidates))
            measured = self.trial.speed_m_s(worms[len(candidates)], everyone, PeriodicStrokes(strokes))
            return np.asarray(measured.reshape(len(candidates), -1).mean(axis=1))

        generations = int((budget_s - self.scouting_s) / self.generation_s + 1e-9)
        sizes: dict[str, Any] = {"population": self.population, "generations": generations}
        return search(speeds, scouts, generator, **sizes, progress=progress)

    def times_s(self, found: Found) -> Floats:
        """Simulated time after the scouts and after each generation (1 + G,) [s]."""
        return np.asarray(self.scouting_s + self.generation_s * np.arange(len(found.bests)), np.float64)

    def _scouts(self, generator: np.random.Generator) -> Floats:
        """Random strokes (scouts, 1 + 3 K): half of them anything, half of them to and fro.

        To and fro means one action for a part of the period and another one for the rest.
        """
        points = self.control_points
        scouts: Floats = generator.uniform(-1.0, 1.0, (self.scouts, 1 + 3 * points))
        for row in range(self.scouts // 2):
            forth, back = generator.uniform(-1.0, 1.0, (2, 3))
            part = generator.integers(1, max(points, 2))
            scouts[row, 1:] = np.where(np.arange(points)[:, None] < part, forth, back).ravel()
        return scouts


@dataclass(frozen=True)
class CycleSearch:
    """Search of the best cycle of a family towards the goals of a task.

    Attributes:
        scouts: Random cycles tried first.
        population: Cycles of a generation.
        generations: Generations.
        starts: Trials of each cycle.
        duration_s: Time of a trial [s].
    """

    scouts: int = 128
    population: int = 24
    generations: int = 10
    starts: int = 2
    duration_s: float = 6.0

    @property
    def simulated_s(self) -> float:
        """Simulated time of a search [s]."""
        return (self.scouts + self.generations * self.population) * self.starts * self.duration_s

    def found(self, scene: Scene, task: Task, family: Family, seed: int) -> Found:
        """Searches; the score is the task's, see :data:`~magworm_gym.baselines.flight.AIMS`.

        Args:
            scene: Scene in space, whose drive the family replaces.
            task: One of those.
            family: Which cycles.
            seed: Seed of the search and of the trials.
        """
        generator = np.random.default_rng(seed)
        scene, aim = family.scene(scene), AIMS[type(task)]
        limits = scene.stage_limits or {}
        scouts = generator.uniform(-1.0, 1.0, (self.scouts, family.size))
        worms = {
            count: Runner(scene, count * self.starts, task=task) for count in {self.scouts, self.population}
        }

        def scores(candidates: Floats) -> Floats:
            cycles = [family.cycle(candidate, limits) for candidate in candidates for _ in range(self.starts)]
            seeds = np.tile(generator.integers(SEED_LIMIT, size=self.starts), len(candidates))
            goals = aim.tried[np.tile(np.arange(self.starts) % len(aim.tried), len(candidates))]
            flight = fly(worms[len(candidates)], Steered(cycles), goals, seeds, self.duration_s)
            scored = np.where(flight.lost, LOST_SCORE, aim.score(flight))
            return np.asarray(scored.reshape(len(candidates), self.starts).mean(axis=1))

        sizes: dict[str, Any] = {"population": self.population, "generations": self.generations}
        return search(scores, scouts, generator, **sizes, sigma=0.3)
