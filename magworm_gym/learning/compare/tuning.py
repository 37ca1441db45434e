"""Finding the best settings of the drives that do not learn; results are plain values."""

from collections.abc import Callable
from typing import Any

import numpy as np

from magworm_gym import Scene
from magworm_gym.baselines import (
    SearchSettings,
    Trial,
    search_stroke,
    sweep_belt,
    sweep_shuttle,
    sweep_tow,
)
from magworm_gym.learning.compare.evaluation_settings import SearchBudget, SweepBudget
from magworm_gym.learning.damage import present_after


def swept_speeds_m_s(scene: Scene, count: int) -> list[float]:
    """Drive speeds [m/s], evenly spaced from a small one up to the stage's limit."""
    limit = (scene.stage_limits or {})["speed_m_s"]
    return [limit * (number + 1) / count for number in range(count)]


def tuned_belt(scene: Scene, pitch_m: float, budget: SweepBudget, removed: tuple[int, ...]) -> dict[str, Any]:
    """Sweeps a belt.

    Args:
        scene: Scene with a controlled drive.
        pitch_m: Pitch of the belt [m].
        budget: Size of the sweep.
        removed: Magnets that the robot lacks.

    Returns:
        ``curve`` (drive speed [m/s], mean crawling speed [m/s]) and the best ``drive_speed_m_s``.
    """
    curve = sweep_belt(
        scene,
        pitch_m,
        swept_speeds_m_s(scene, budget.speeds),
        budget.trial,
        starts=budget.starts,
        present=present_after(scene.magnets, removed),
    )
    means = curve.speed_m_s.mean(axis=1)
    return {
        "pitch_m": pitch_m,
        "drive_speed_m_s": float(curve.drive_speed_m_s[curve.best]),
        "curve": np.stack([curve.drive_speed_m_s, means], axis=1).tolist(),
    }


def tuned_shuttle(scene: Scene, budget: SweepBudget, removed: tuple[int, ...]) -> dict[str, Any]:
    """Sweeps speed, stroke, offset and return of a shuttle.

    Returns:
        ``curve`` (drive speed [m/s], crawling speed [m/s] at the best other settings), and the best
        ``drive_speed_m_s``, ``half_stroke`` and ``offset`` as shares of the reach, ``low_return``.
    """
    curve = sweep_shuttle(
        scene,
        swept_speeds_m_s(scene, budget.speeds),
        budget.trial,
        starts=budget.shuttle_starts,
        present=present_after(scene.magnets, removed),
    )
    speed, stroke, offset, low = curve.best
    return {
        "drive_speed_m_s": float(curve.drive_speed_m_s[speed]),
        "half_stroke": curve.half_strokes[stroke],
        "offset": curve.offsets[offset],
        "low_return": bool(low),
        "curve": np.stack([curve.drive_speed_m_s, curve.best_per_drive_speed_m_s], axis=1).tolist(),
    }


def tuned_tow(scene: Scene, budget: SweepBudget, removed: tuple[int, ...]) -> dict[str, Any]:
    """Sweeps place and height of a magnet that is held still relative to the robot.

    Returns:
        Best ``offset`` (share of the reach) and ``height`` (-1 lowest, 1 highest), and ``curve``
        (offset, speed [m/s]) at that height.
    """
    present = present_after(scene.magnets, removed)
    curve = sweep_tow(scene, budget.trial, starts=budget.shuttle_starts, present=present)
    place, height = curve.best
    speeds = curve.speed_m_s[:, height].mean(axis=-1)
    return {
        "offset": float(curve.offsets[place]),
        "height": float(curve.heights[height]),
        "curve": np.stack([curve.offsets, speeds], axis=1).tolist(),
    }


def searched_stroke(
    scene: Scene,
    budget: SearchBudget,
    budget_s: float,
    seed: int,
    removed: tuple[int, ...],
    progress: Callable[[float], None] | None = None,
) -> dict[str, Any]:
    """Searches a stroke with CMA-ES in a budget of simulated time [s].

    Returns:
        ``period_s``, ``points`` (K, 3), the ``simulated_s`` spent and ``curve`` (simulated time [s],
        best speed so far [m/s]).
    """
    settings = SearchSettings(
        control_points=budget.control_points,
        scouts=budget.scouts,
        population=budget.population,
        starts=budget.starts,
        trial=Trial(budget.settle_s, budget.measure_s),
    )
    present = present_after(scene.magnets, removed)
    found = search_stroke(scene, budget_s, seed, settings, present, progress)
    return {
        "seed": seed,
        "period_s": found.stroke.period_s,
        "points": found.stroke.points.tolist(),
        "simulated_s": float(found.simulated_s[-1]),
        "curve": np.stack([found.simulated_s, found.best_m_s], axis=1).tolist(),
    }
