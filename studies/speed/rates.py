"""Environment steps per second of the native vector environments, with random actions."""

import statistics
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

import gymnasium

from magworm_gym import Scene
from studies.kit.timing import timed

ENVIRONMENTS = 256
CONTROL_STEPS = 50
TASKS = {2: ("MagWorm/Crawl-v0", "paper-3"), 3: ("MagWorm/Turn-v1", "turn-3")}
"""Environment and preset, by dimensions."""


@dataclass(frozen=True)
class Way:
    """A way to run: kernel ("wide" or "scalar"), threads (none: all cores), step of the solver, precision."""

    lanes: str
    threads: int | None
    step_ms: float
    precision: str = "double"

    def text(self) -> str:
        """In words."""
        many = {"double": "eight", "single": "sixteen"}[self.precision]
        lanes = f"{many} lanes" if self.lanes == "wide" else "one lane"
        cores = "all cores" if self.threads is None else "one core"
        single = "single precision, " if self.precision == "single" else ""
        return f"{lanes}, {single}{cores}, {self.step_ms:g} ms"


WAYS = (
    Way("wide", None, 2.0),
    Way("wide", 1, 2.0),
    Way("scalar", None, 2.0),
    Way("wide", None, 1.0),
    Way("wide", None, 5.0),
    Way("wide", None, 2.0, "single"),
    Way("wide", None, 5.0, "single"),
)


@dataclass(frozen=True)
class Rate:
    """Environment steps per second of several runs, and the work of a step of a block of lanes.

    Attributes:
        dimensions: 2 or 3.
        way: How it was run.
        median, least, most: Environment steps per second.
        systems: Linear systems with contact.
        trials: Trials of the contact solve.
    """

    dimensions: int
    way: Way
    median: float
    least: float
    most: float
    systems: float
    trials: float


def rates(repetitions: int) -> Iterator[Rate]:
    """Runs the presets in all ways."""
    for way, (dimensions, (task, preset)) in product(WAYS, TASKS.items()):
        values = {"solver.step_s": way.step_ms / 1e3, "solver.precision": way.precision}
        scene = Scene.preset(preset).with_values(values)
        found, done = measured(task, scene, repetitions, lanes=way.lanes, threads=way.threads)
        median, work = statistics.median(found), (done["factorisations"], done["trials"])
        yield Rate(dimensions, way, median, min(found), max(found), *work)


def measured(
    task: str,
    scene: Scene,
    repetitions: int,
    *,
    lanes: str = "wide",
    threads: int | None = None,
    control_steps: int = CONTROL_STEPS,
) -> tuple[list[float], dict[str, float]]:
    """Environment steps per second of each run, and counted work of a step of a block."""
    environment: Any = gymnasium.make_vec(
        task, num_envs=ENVIRONMENTS, scene=scene, lanes=lanes, threads=threads
    )
    environment.reset(seed=0)
    environment.action_space.seed(0)
    actions = [environment.action_space.sample() for _ in range(control_steps)]

    def run() -> None:
        for action in actions:
            environment.step(action)

    run()  # warms up
    times = timed(run, repetitions)
    counters = environment.unwrapped.batch.counters()
    environment.close()
    work = {name: count / counters["steps"] for name, count in counters.items() if name != "steps"}
    return [ENVIRONMENTS * control_steps / wall_s for wall_s in times.wall_s], work
