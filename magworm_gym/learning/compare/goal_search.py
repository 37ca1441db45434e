"""CMA-ES on the parameters of a family of cycles, for turning or reaching."""

from dataclasses import dataclass
from typing import Any

import cmaes
import numpy as np
from numpy.typing import NDArray

from magworm_gym import Scene
from magworm_gym.learning.compare.goal_trials import Flight, fly
from magworm_gym.learning.compare.pilots import Family, Steered

Floats = NDArray[np.float64]

FIRST_SIGMA = 0.3
SEED_LIMIT = 2**31
LOST_SCORE = -1.0
TURN_GOAL_DEG = 90.0
TURN_STAGES_DEG = (30.0, 90.0)
REACH_GOALS_M = ((-0.050, 0.015), (-0.045, -0.030))


@dataclass(frozen=True)
class SearchSize:
    """Size of a search.

    Attributes:
        seeds: Independent searches of each family.
        scouts: Random cycles tried first; the evolution begins at the best.
        population: Cycles of a generation.
        generations: Generations.
        starts: Trials of each cycle.
        duration_s: Time of a trial [s].
    """

    seeds: int = 5
    scouts: int = 128
    population: int = 24
    generations: int = 10
    starts: int = 2
    duration_s: float = 6.0


def searched(scene: Scene, task: str, family: Family, size: SearchSize, seed: int) -> dict[str, Any]:
    """Searches the best cycle of a family.

    Returns:
        ``seed``, best ``parameters`` (P,), their ``score``, ``simulated_s`` spent.
    """
    generator = np.random.default_rng(seed)
    scene = family.scene(scene)
    best = generator.uniform(-1.0, 1.0, (size.scouts, family.size))
    scores = _scores(scene, task, family, size, best, generator)
    at = int(scores.argmax())
    parameters, score = best[at], float(scores[at])
    strategy = cmaes.CMA(
        mean=parameters,
        sigma=FIRST_SIGMA,
        bounds=np.tile([-1.0, 1.0], (family.size, 1)),
        population_size=size.population,
        seed=int(generator.integers(SEED_LIMIT)),
    )
    for _ in range(size.generations):
        candidates = np.array([strategy.ask() for _ in range(size.population)])
        scores = _scores(scene, task, family, size, candidates, generator)
        strategy.tell(
            [(candidate, -value) for candidate, value in zip(candidates, scores.tolist(), strict=True)]
        )
        at = int(scores.argmax())
        if scores[at] > score:
            parameters, score = candidates[at], float(scores[at])
    trials = (size.scouts + size.generations * size.population) * size.starts
    return {
        "seed": seed,
        "parameters": parameters.tolist(),
        "score": score,
        "simulated_s": trials * size.duration_s,
    }


def _scores(
    scene: Scene,
    task: str,
    family: Family,
    size: SearchSize,
    candidates: Floats,
    generator: np.random.Generator,
) -> Floats:
    """Mean score of each candidate over starts that are the same for all; goals alternate in side."""
    limits = scene.stage_limits or {}
    cycles = [family.cycle(candidate, limits) for candidate in candidates for _ in range(size.starts)]
    seeds = np.tile(generator.integers(SEED_LIMIT, size=size.starts), len(candidates))
    which = np.tile(np.arange(size.starts) % 2, len(candidates))
    goals: Floats = np.array(REACH_GOALS_M)[which]
    if task == "turn":
        goals = np.where(which == 0, TURN_GOAL_DEG, -TURN_GOAL_DEG)
    flight = fly(scene, task, Steered(cycles), goals, seeds.tolist(), size.duration_s)
    scores = np.where(flight.lost, LOST_SCORE, score_of(flight, task))
    return np.asarray(scores.reshape(len(candidates), size.starts).mean(axis=1))


def score_of(flight: Flight, task: str) -> Floats:
    """What a search maximises (E,): quick to the first 30° counts as much as quick to 90°.

    Turning: the shares of 30° and of 90° that are turned, averaged over the time. Reaching: the share of
    the way that is done, averaged over the time.
    """
    done = np.abs(flight.left[0]) - np.abs(flight.left)
    if task == "turn":
        shares = [np.clip(done, -stage, stage) / stage for stage in TURN_STAGES_DEG]
        return np.asarray(np.mean(shares, axis=0).mean(axis=0))
    return np.asarray((done / flight.left[0]).mean(axis=0))
