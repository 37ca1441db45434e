"""Environment steps per second, beside the errors of the step they are taken with, in the plane and in space.

Prints a table and writes JSON: the native vector environments of the tasks to crawl (plane) and to turn
(space), eight lanes and one, on all cores and on one, each the median of several runs after a warm-up;
and what one pass of the drive gives at the preset's solver step against steps twenty to forty times
shorter: the stride, and in space, with the drive 3 mm aside, stride and yaw as means over neighbouring
heights, since stick and slip make a single pass rugged.

    python studies/throughput.py --out runs/bench/throughput.json
"""

import argparse
import json
import os
import platform
import statistics
import time
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

from magworm_gym import Batch, Scene

ENVIRONMENTS = 256
CONTROL_STEPS = 50
SHORT_STEPS_S = (1e-4, 8e-5, 6.25e-5, 5e-5)
PASS_DURATION_S = 1.5
NEIGHBOURS_M = tuple(-0.022 + 1e-4 * k for k in range(-2, 3))


def steps_per_second(task: str, scene: str, lanes: str, threads: int | None, repetitions: int) -> list[float]:
    """Environment steps per second of each repetition, random actions."""
    environment: Any = gymnasium.make_vec(
        task, num_envs=ENVIRONMENTS, scene=scene, lanes=lanes, threads=threads
    )
    environment.reset(seed=0)
    environment.action_space.seed(0)
    actions = [environment.action_space.sample() for _ in range(CONTROL_STEPS)]
    rates = []
    for repetition in range(repetitions + 1):
        start = time.perf_counter()
        for action in actions:
            environment.step(action)
        if repetition > 0:  # the first warms up
            rates.append(ENVIRONMENTS * CONTROL_STEPS / (time.perf_counter() - start))
    environment.close()
    return rates


def stride_mm(scene: str, step_s: float | None) -> float:
    """Stride of one pass at 100 mm/s from 50 mm ahead [mm]; solver step None: the scene's."""
    motion = {"kind": "constant", "x_m": -0.05, "y_m": -0.022, "speed_m_s": 0.1}
    changes: dict[str, Any] = {"drive.motion": motion}
    if step_s is not None:
        changes["solver.step_s"] = step_s
    batch = Batch(Scene.preset(scene).with_values(changes), 1, lanes="scalar", threads=1)
    zero = np.zeros(1, np.uint64)
    batch.reset(np.ones(1, bool), zero, zero)
    start = batch.magnet_poses()[0, :, 0].mean()
    batch.advance(PASS_DURATION_S)
    return float(start - batch.magnet_poses()[0, :, 0].mean()) * 1e3


def turning(step_s: float | None) -> tuple[float, float]:
    """Stride [mm] and yaw [°] of a pass 3 mm aside, means over neighbouring heights of the drive."""
    scenes = []
    for height_m in NEIGHBOURS_M:
        motion = {
            "kind": "constant",
            "x_m": -0.05,
            "y_m": height_m,
            "z_m": 0.003,
            "speed_m_s": 0.1,
        }
        changes: dict[str, Any] = {"dimensions": 3, "drive.motion": motion}
        if step_s is not None:
            changes["solver.step_s"] = step_s
        scenes.append(Scene.preset("paper-3").with_values(changes))
    strides, yaws = [], []
    for scene in scenes:
        batch = Batch(scene, 1, lanes="scalar", threads=1)
        zero = np.zeros(1, np.uint64)
        batch.reset(np.ones(1, bool), zero, zero)
        start = batch.robot_poses()[0]
        batch.advance(PASS_DURATION_S)
        end = batch.robot_poses()[0]
        strides.append(1e3 * float(start[0] - end[0]))
        yaws.append(float(np.degrees(end[2] - start[2])))
    return statistics.mean(strides), statistics.mean(yaws)


def rates(task: str, scene: str, repetitions: int) -> dict[str, list[float]]:
    """Environment steps per second of the three ways to run, each repetition."""
    cases: dict[str, tuple[str, int | None]] = {
        "eight lanes, all cores": ("wide", None),
        "eight lanes, one core": ("wide", 1),
        "one lane, all cores": ("scalar", None),
    }
    return {name: steps_per_second(task, scene, *case, repetitions) for name, case in cases.items()}


def summary(scene: str, measured: dict[str, list[float]]) -> dict[str, Any]:
    """What both dimensions report about their speed."""
    return {
        "scene": scene,
        "environments": ENVIRONMENTS,
        "control_step_s": Scene.preset(scene).control_step_s,
        "cores": os.cpu_count(),
        "processor": platform.processor() or platform.machine(),
        "steps_per_second": {name: statistics.median(values) for name, values in measured.items()},
        "steps_per_second_range": {name: [min(v), max(v)] for name, v in measured.items()},
    }


def measure(scene: str, repetitions: int) -> dict[str, Any]:
    """All figures of a scene in the plane, and of the task to turn in space."""
    strides = [stride_mm(scene, step) for step in SHORT_STEPS_S]
    converged = statistics.mean(strides)
    stride = stride_mm(scene, None)
    plane = summary(scene, rates("MagWorm/Crawl-v0", scene, repetitions)) | {
        "stride_mm": stride,
        "stride_converged_mm": converged,
        "stride_converged_range_mm": [min(strides), max(strides)],
        "stride_error": abs(stride / converged - 1),
    }
    stride, yaw = turning(None)
    fine_strides, fine_yaws = zip(*(turning(step) for step in SHORT_STEPS_S), strict=True)
    fine_stride, fine_yaw = statistics.mean(fine_strides), statistics.mean(fine_yaws)
    space = summary("turn-3", rates("MagWorm/Turn-v0", "turn-3", repetitions)) | {
        "stride_mm": stride,
        "stride_converged_mm": fine_stride,
        "stride_converged_range_mm": [min(fine_strides), max(fine_strides)],
        "stride_error": abs(stride / fine_stride - 1),
        "yaw_deg": yaw,
        "yaw_converged_deg": fine_yaw,
        "yaw_converged_range_deg": [min(fine_yaws), max(fine_yaws)],
        "yaw_error": abs(yaw / fine_yaw - 1),
    }
    return plane | {"space": space}


def table(result: dict[str, Any]) -> str:
    """The figures as text."""
    low, high = result["stride_converged_range_mm"]
    space = result["space"]
    strides, yaws = space["stride_converged_range_mm"], space["yaw_converged_range_deg"]
    return "\n".join(
        [
            *speeds(result),
            f"stride of one pass {result['stride_mm']:.3f} mm; converged"
            f" {result['stride_converged_mm']:.3f} ({low:.3f} to {high:.3f}) mm;"
            f" error {100 * result['stride_error']:.2f} %",
            *speeds(space),
            f"stride of a pass 3 mm aside {space['stride_mm']:.3f} mm; converged"
            f" {space['stride_converged_mm']:.3f} ({strides[0]:.3f} to {strides[1]:.3f}) mm;"
            f" error {100 * space['stride_error']:.2f} %",
            f"yaw of it {space['yaw_deg']:.3f}°; converged {space['yaw_converged_deg']:.3f}°"
            f" ({yaws[0]:.3f}° to {yaws[1]:.3f}°); error {100 * space['yaw_error']:.2f} %",
        ]
    )


def speeds(result: dict[str, Any]) -> list[str]:
    """Lines about the speed of a scene."""
    lines = [
        f"{result['scene']}, {result['environments']} environments, control step"
        f" {result['control_step_s']} s, {result['cores']} cores",
    ]
    for name, rate in result["steps_per_second"].items():
        low, high = result["steps_per_second_range"][name]
        lines.append(f"{name:<24}{rate:>10,.0f} environment steps/s ({low:,.0f} to {high:,.0f})")
    return lines


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--scene", default="paper-3", help="preset")
    parser.add_argument("--repetitions", type=int, default=7, help="runs whose median is taken")
    parser.add_argument("--out", type=Path, help="JSON file to write")
    arguments = parser.parse_args()
    result = measure(arguments.scene, arguments.repetitions)
    print(table(result))
    if arguments.out is not None:
        arguments.out.parent.mkdir(parents=True, exist_ok=True)
        arguments.out.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
