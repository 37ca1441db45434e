"""The cost of a control step of one scene: wall time and counted work."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Batch
from magworm_gym._magworm import Trajectories
from studies.growth.sweeps import Setting
from studies.kit.timing import timed

CONTROL_STEPS = 5
MOST_REPETITIONS = 30
ENOUGH_S = 0.5


@dataclass(frozen=True)
class Size:
    """What is simulated: numbers of each; threads are none for all cores."""

    dimensions: int
    environments: int
    threads: int | None
    nodes: int
    magnets: int
    drive_magnets: int


@dataclass(frozen=True)
class Cost:
    """Of a control step of all environments; counts are of blocks of eight.

    Attributes:
        wall_s: Wall time [s], the least of several runs: what other programs take only ever adds.
        processor_s: Time of all processors together [s], the least of several runs.
        systems: Linear systems with contact that were solved.
        wrenches: Wrenches of a drive magnet on a body magnet, and of two body magnets on each other.
        broken: Environments that broke.
    """

    wall_s: float
    processor_s: float
    systems: float
    wrenches: float
    broken: int


@dataclass(frozen=True)
class Point:
    """A point of a sweep."""

    sweep: str
    size: Size
    cost: Cost


def started(setting: Setting, dimensions: int) -> Batch:
    """The environments of a setting at the start of their first episode."""
    batch = Batch(setting.scene(dimensions), setting.environments, threads=setting.threads)
    begin(batch)
    return batch


def begin(batch: Batch) -> None:
    """Puts every environment at the start of its first episode."""
    numbers = np.arange(batch.num_envs, dtype=np.uint64)
    batch.reset(np.ones(batch.num_envs, np.bool_), numbers, np.zeros_like(numbers))


def actions(batch: Batch, control_steps: int) -> NDArray[np.float64]:
    """Random actions (T, N, A)."""
    size = sum(part.size for part in batch.action_specification)
    return np.random.default_rng(0).uniform(-1.0, 1.0, (control_steps, batch.num_envs, size))


def point(sweep: str, setting: Setting, dimensions: int) -> Point:
    """Runs the same first control steps again and again, with random actions."""
    batch = started(setting, dimensions)
    plan = actions(batch, CONTROL_STEPS)
    before, seen = batch.counters(), list[Trajectories]()
    times = timed(
        lambda: seen.append(batch.rollout(plan)),
        2,
        prepare=lambda: begin(batch),
        enough_s=ENOUGH_S,
        most=MOST_REPETITIONS,
    )
    steps = CONTROL_STEPS * len(seen)
    done = {name: (count - before[name]) / steps for name, count in batch.counters().items()}
    nodes, drives = batch.node_positions().shape[1], batch.drive_positions().shape[1]
    return Point(
        sweep,
        Size(dimensions, setting.environments, setting.threads, nodes, batch.scene.magnets, drives),
        Cost(
            wall_s=times.best_s / CONTROL_STEPS,
            processor_s=min(times.processor_s) / CONTROL_STEPS,
            systems=done["factorisations"],
            wrenches=done["wrenches"],
            broken=int(np.count_nonzero(seen[-1].status[-1])),
        ),
    )
