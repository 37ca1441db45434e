"""The cost of a control step of one scene: wall time and counted work."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Batch, Scene

CONTROL_STEPS = 5
MOST_REPETITIONS = 30
ENOUGH_S = 0.5
SEED = 0


@dataclass(frozen=True)
class Setting:
    """What is simulated.

    Attributes:
        space: In space, or in the plane.
        environments: Number of environments.
        threads: Threads; None for all cores.
        nodes: Nodes of a body.
        magnets: Magnets of a body.
        drives: Drive magnets.
        scene: The scene.
    """

    space: bool
    environments: int
    threads: int | None
    nodes: int
    magnets: int
    drives: int
    scene: Scene


@dataclass(frozen=True)
class Cost:
    """Of a control step of all environments; counts are of blocks of eight.

    Attributes:
        seconds: Wall time [s], the least of several runs: what other programs take only ever adds.
        processor_s: Time of all processors together [s], the least of several runs.
        systems: Linear systems with contact that were solved.
        wrenches: Wrenches of a drive magnet on a body magnet, and of two body magnets on each other.
        broken: Environments that broke.
    """

    seconds: float
    processor_s: float
    systems: float
    wrenches: float
    broken: int


def setting(
    space: bool,
    edits: Mapping[str, Any] | None = None,
    environments: int = 64,
    threads: int | None = 1,
    drives: int = 1,
) -> Setting:
    """``paper-3`` or, in space, ``turn-3``, with fields of its scene replaced.

    Raises:
        SceneError: The scene cannot be simulated.
    """
    scene = Scene.preset("turn-3" if space else "paper-3").with_values(dict(edits or {}))
    nodes = Batch(scene, 1).node_positions().shape[1]
    return Setting(space, environments, threads, nodes, scene.magnets, drives, scene)


def started(setting: Setting) -> Batch:
    """The environments of a setting at the start of their first episode."""
    batch = Batch(setting.scene, setting.environments, threads=setting.threads)
    begin(batch)
    return batch


def begin(batch: Batch) -> None:
    """Puts every environment at the start of its first episode."""
    numbers = np.arange(batch.num_envs, dtype=np.uint64)
    batch.reset(np.ones(batch.num_envs, np.bool_), numbers + np.uint64(SEED), np.zeros_like(numbers))


def actions(batch: Batch, control_steps: int) -> NDArray[np.float64]:
    """Random actions (T, N, A)."""
    size = sum(part.size for part in batch.action_specification)
    return np.random.default_rng(SEED).uniform(-1.0, 1.0, (control_steps, batch.num_envs, size))


def cost(setting: Setting) -> Cost:
    """Runs the same first control steps again and again, with random actions."""
    batch = started(setting)
    plan = actions(batch, CONTROL_STEPS)
    seconds: list[float] = []
    processor_s: list[float] = []
    before = batch.counters()
    while len(seconds) < 2 or (sum(seconds) < ENOUGH_S and len(seconds) < MOST_REPETITIONS):
        begin(batch)
        start, processor_start = time.perf_counter(), time.process_time()
        seen = batch.rollout(plan)
        seconds.append(time.perf_counter() - start)
        processor_s.append(time.process_time() - processor_start)
    after = batch.counters()
    steps = CONTROL_STEPS * len(seconds)
    return Cost(
        min(seconds) / CONTROL_STEPS,
        min(processor_s) / CONTROL_STEPS,
        (after["factorisations"] - before["factorisations"]) / steps,
        (after["wrenches"] - before["wrenches"]) / steps,
        int(np.count_nonzero(seen.status[-1])),
    )
