"""Environment steps per second, beside the errors of the step they are taken with, in the plane and in space.

Prints a table and writes JSON: the native vector environments of the tasks to crawl (plane) and to turn
(space), in lanes and one by one, in double and single precision, on all cores and on one, each the median of
several runs after a warm-up, with what the contact solve took; and what passes of the drive give at several
solver steps against steps of 0.05 ms: stride in the plane, stride and yaw in space, there also with friction
that does not fall as a foot begins to slide. About five minutes.

    python -m studies.throughput --out runs/bench/throughput.json
"""

import argparse
import json
import os
import platform
import statistics
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import gymnasium

from magworm_gym import Scene
from studies.step_error import EVEN_FRICTION, Converged, plane, space

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


def speeds(result: dict[str, Any]) -> list[str]:
    """Lines about the speed of a scene."""
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
    return lines


def report(result: dict[str, Any], errors: dict[str, Converged]) -> str:
    """A dimension as text."""
    lines = speeds(result)
    for name, error in errors.items():
        what, unit = name.rsplit("_", 1)
        lines += error.lines(what.replace("_", " "), {"mm": "mm", "deg": "°"}[unit])
    return "\n".join(lines)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--repetitions", type=int, default=7, help="runs whose median is taken")
    parser.add_argument("--out", type=Path, help="JSON file to write")
    arguments = parser.parse_args()
    speed_of = {
        "plane": summary("MagWorm/Crawl-v0", "paper-3", arguments.repetitions),
        "space": summary("MagWorm/Turn-v0", "turn-3", arguments.repetitions),
    }
    stride, yaw = space()
    even_stride, even_yaw = space(EVEN_FRICTION)
    errors = {
        "plane": {"stride_mm": plane("paper-3")},
        "space": {
            "stride_mm": stride,
            "yaw_deg": yaw,
            "stride_at_even_friction_mm": even_stride,
            "yaw_at_even_friction_deg": even_yaw,
        },
    }
    for dimension, speed in speed_of.items():
        print(report(speed, errors[dimension]))
    if arguments.out is not None:
        data = {
            dimension: speed | {name: error.data() for name, error in errors[dimension].items()}
            for dimension, speed in speed_of.items()
        }
        arguments.out.parent.mkdir(parents=True, exist_ok=True)
        arguments.out.write_text(json.dumps(data, indent=2) + "\n")


if __name__ == "__main__":
    main()
