"""Environment steps per second in the plane and in space.

Prints a table and writes a report as JSON, from which pages are filled:
the native vector environments of the tasks to crawl (plane) and to turn
(space), in lanes and one by one, in double and single precision, on all cores and on one, each the median of
several runs after a warm-up, with what the contact solve took. What steps of the solver cost in accuracy is
in ``docs/performance.md``. A minute.

    python -m studies.throughput --out docs/results/throughput.json
"""

import argparse
import os
import platform
import statistics
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import gymnasium

from magworm_gym import Scene
from magworm_gym.learning.results import Column, Interval, Report, Table

ENVIRONMENTS = 256
CONTROL_STEPS = 50


@dataclass(frozen=True)
class Case:
    """A way to run: kernel, threads (None: all cores), step of the solver [ms], precision."""

    lanes: str
    threads: int | None
    step_ms: float
    precision: str = "double"

    def name(self) -> str:
        """As the report calls it."""
        many = {"double": "eight", "single": "sixteen"}[self.precision]
        lanes = f"{many} lanes" if self.lanes == "wide" else "one lane"
        cores = "all cores" if self.threads is None else f"{self.threads} core"
        return f"{lanes}, {cores}, {self.step_ms:g} ms"

    def measured(self, task: str, scene: str, repetitions: int) -> "Rates":
        """Runs a preset this way."""
        values = {"solver.step_s": self.step_ms / 1e3, "solver.precision": self.precision}
        changed = Scene.preset(scene).with_values(values)
        return measured(task, changed, repetitions, lanes=self.lanes, threads=self.threads)


CASES = (
    Case("wide", None, 2.0),
    Case("wide", 1, 2.0),
    Case("scalar", None, 2.0),
    Case("wide", None, 5.0),
    Case("wide", None, 1.0),
    Case("wide", None, 2.0, "single"),
    Case("wide", None, 5.0, "single"),
)


@dataclass(frozen=True)
class Rates:
    """Environment steps per second of each repetition, and the work of a step of a block of lanes."""

    per_second: list[float]
    work: dict[str, float]


def measured(
    task: str,
    scene: Scene,
    repetitions: int,
    *,
    lanes: str = "wide",
    threads: int | None = None,
    control_steps: int = CONTROL_STEPS,
) -> Rates:
    """Steps environments of a scene with random actions."""
    environment: Any = gymnasium.make_vec(
        task, num_envs=ENVIRONMENTS, scene=scene, lanes=lanes, threads=threads
    )
    environment.reset(seed=0)
    environment.action_space.seed(0)
    actions = [environment.action_space.sample() for _ in range(control_steps)]
    rates = []
    for repetition in range(repetitions + 1):
        start = time.perf_counter()
        for action in actions:
            environment.step(action)
        if repetition > 0:  # the first warms up
            rates.append(ENVIRONMENTS * control_steps / (time.perf_counter() - start))
    counters = environment.unwrapped.batch.counters()
    environment.close()
    work = {name: count / counters["steps"] for name, count in counters.items() if name != "steps"}
    return Rates(rates, work)


def summary(task: str, scene: str, repetitions: int) -> dict[str, Any]:
    """What both dimensions report about their speed."""
    found = {case.name(): case.measured(task, scene, repetitions) for case in CASES}
    return {
        "scene": scene,
        "environments": ENVIRONMENTS,
        "control_step_s": Scene.preset(scene).control_step_s,
        "cores": os.cpu_count(),
        "processor": platform.processor() or platform.machine(),
        "steps_per_second": {name: statistics.median(rates.per_second) for name, rates in found.items()},
        "steps_per_second_range": {
            name: [min(rates.per_second), max(rates.per_second)] for name, rates in found.items()
        },
        "per_block_step": {name: rates.work for name, rates in found.items()},
    }


def report(result: dict[str, Any]) -> str:
    """A dimension as text."""
    lines = [
        f"{result['scene']}, {result['environments']} environments, control step"
        f" {result['control_step_s']} s, {result['cores']} cores",
    ]
    for name, rate in result["steps_per_second"].items():
        low, high = result["steps_per_second_range"][name]
        work = result["per_block_step"][name]
        lines.append(
            f"{name:<30}{rate:>9,.0f} environment steps/s ({low:,.0f} to {high:,.0f});"
            f" {work['factorisations']:.2f} systems, {work['trials']:.2f} trials a step of a block"
        )
    return "\n".join(lines)


def as_report(found: dict[str, dict[str, Any]], repetitions: int) -> Report:
    """Both dimensions as data: medians with their ranges, and all else that was counted."""
    headings = {name: f"{name}: `{result['scene']}`" for name, result in found.items()}
    columns = [Column(name, heading, ",.0f", ends="({} to {})") for name, heading in headings.items()]
    table = Table([Column("how", "environment steps/s"), *columns], [])
    for case in CASES:
        row: dict[str, str | float | Interval] = {"how": case.name()}
        for name, result in found.items():
            low, high = result["steps_per_second_range"][case.name()]
            row[name] = Interval(result["steps_per_second"][case.name()], low, high, repetitions)
        table.rows.append(row)
    return Report("Environment steps per second", {"table": table}, found)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--repetitions", type=int, default=7, help="runs whose median is taken")
    parser.add_argument("--out", type=Path, help="JSON file to write")
    arguments = parser.parse_args()
    found = {
        "plane": summary("MagWorm/Crawl-v0", "paper-3", arguments.repetitions),
        "space": summary("MagWorm/Turn-v0", "turn-3", arguments.repetitions),
    }
    for result in found.values():
        print(report(result))
    if arguments.out is not None:
        arguments.out.parent.mkdir(parents=True, exist_ok=True)
        as_report(found, arguments.repetitions).write(arguments.out)


if __name__ == "__main__":
    main()
