"""Drives that are compared: how each is found, and how it drives."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from magworm_gym import Scene
from magworm_gym.baselines import (
    SHUTTLE_AXES,
    TOW_AXES,
    Controller,
    CycleSearch,
    Family,
    PeriodicStrokes,
    Runner,
    Shuttle,
    Steered,
    Stroke,
    StrokeSearch,
    Sweep,
    Tow,
    belt_scene,
    search,
    stroke_from_unit,
    sweep,
    sweep_belt,
)
from magworm_gym.learning.compare.budget import StrokeSearchSize, SweepSize
from magworm_gym.learning.compare.stages import content_digest
from magworm_gym.policy import Network, Policy, load_policy
from magworm_gym.tasks import Task

Removed = tuple[int, ...]
Plain = dict[str, Any]

MM_PER_M = 1000.0
LEARNED = "learned policy"
STROKE = "CMA-ES stroke"


@dataclass(frozen=True)
class Drive:
    """A drive with its settings."""

    scene: Scene
    controller: Callable[[], Controller] | None  # makes a fresh one; None for a belt
    pitch_m: float = 0.0  # of a belt: its starts are spread over it


@dataclass(frozen=True)
class Rival:
    """A kind of drive. What is found of it are plain values."""

    name: str  # for files
    title: str  # for tables and pictures
    find: Callable[[Removed, int], Plain]  # its settings for a robot, by the magnets it lacks, and a seed
    drive: Callable[[Plain], Drive]  # the drive with such settings
    describe: Callable[[Sequence[Plain]], str]  # all that was found, in a few words
    decided_by: Plain = field(default_factory=dict)  # what else decides what is found
    made_by: tuple[Any, ...] = ()  # whose source files do, see Stages.result
    seeds: tuple[int, ...] = ()  # of independent finds; empty where there is one: its samples are its starts
    shared: bool = False  # whether robots with damage take what is found for the whole one
    kept: bool = True  # whether to keep what is found: not where finding is no work


class Pilot:
    """A policy as a controller.

    Args:
        policy: The policy.
    """

    def __init__(self, policy: Policy) -> None:
        self._policy = policy

    def start(self, worms: Runner) -> None:
        """Refuses robots that the policy was not trained for; it has no memory to prepare."""
        self._policy.check_fit(worms.declarer)

    def act(self, worms: Runner) -> NDArray[np.float64]:
        """Actions (N, A) without exploring."""
        return np.asarray(self._policy(worms.observations), np.float64)


def learned(scene: Scene, folders: dict[int, Path], words: str) -> Rival:
    """Policies by their seeds. What decides about one is the content of its folder."""
    return Rival(
        "learned",
        LEARNED,
        lambda _, seed: {"seed": seed, "content": content_digest(folders[seed])},
        lambda found: Drive(scene, lambda: Pilot(load_policy(folders[found["seed"]]))),
        lambda _: words,
        made_by=(Pilot, Policy, Network),
        seeds=tuple(folders),
        kept=False,
    )


def swept_speeds_m_s(scene: Scene, count: int) -> NDArray[np.float64]:
    """Drive speeds [m/s], evenly spaced from a small one up to the stage's limit."""
    return np.array([_limits(scene)["speed_m_s"] * (number + 1) / count for number in range(count)])


def belt(scene: Scene, pitch_m: float, size: SweepSize) -> Rival:
    """The paper's belt at its best constant speed."""

    def find(removed: Removed, _: int) -> Plain:
        speeds = swept_speeds_m_s(scene, size.speeds)
        swept = sweep_belt(scene, pitch_m, speeds, size.trial, starts=size.starts, removed=removed)
        return {**swept.best, "curve": swept.along("drive_speed_m_s").tolist()}

    return Rival(
        f"belt-{MM_PER_M * pitch_m:.0f}",
        f"belt, {MM_PER_M * pitch_m:.0f} mm pitch",
        find,
        lambda found: Drive(belt_scene(scene, pitch_m, found["drive_speed_m_s"]), None, pitch_m),
        lambda found: f"{MM_PER_M * found[0]['drive_speed_m_s']:.0f} mm/s",
        msgspec.to_builtins(size),
        (sweep_belt, Sweep),
    )


def shuttle(scene: Scene, size: SweepSize) -> Rival:
    """A single magnet to and fro, at its best speed, stroke, offset and return."""
    limit_mm_s, reach_mm = (MM_PER_M * _limits(scene)[name] for name in ("speed_m_s", "reach_m"))

    def describe(found: Sequence[Plain]) -> str:
        best = found[0]["settings"]
        back = "low" if best["low_return"] else "at the same height"
        return (
            f"{limit_mm_s * best['work_speed']:.0f} mm/s, ±{reach_mm * best['half_stroke']:.0f} mm about "
            f"{reach_mm * best['offset']:+.0f} mm, return {back}"
        )

    speeds = swept_speeds_m_s(scene, size.speeds)
    axes = {"work_speed": speeds / _limits(scene)["speed_m_s"], **SHUTTLE_AXES}
    return _swept("shuttle", scene, Shuttle, axes, size, describe, _limits(scene)["speed_m_s"])


def held(scene: Scene, size: SweepSize) -> Rival:
    """A magnet held at the place from which it tows the robot best."""

    def describe(found: Sequence[Plain]) -> str:
        best, limits = found[0]["settings"], _limits(scene)
        low, high = limits["lowest_m"], limits["highest_m"]
        height_m = low + 0.5 * (1.0 + best["height"]) * (high - low)
        place_mm = MM_PER_M * limits["reach_m"] * best["offset"]
        return f"held at {place_mm:+.0f} mm, height {MM_PER_M * height_m:.0f} mm"

    return _swept("tow", scene, Tow, TOW_AXES, size, describe)


def _swept(
    name: str,
    scene: Scene,
    kind: Callable[..., Controller],
    axes: dict[str, NDArray[np.float64]],
    size: SweepSize,
    describe: Callable[[Sequence[Plain]], str],
    unit: float = 1.0,
) -> Rival:
    """A controller at its best settings; its curve is along the first of them, in that unit."""

    def find(removed: Removed, _: int) -> Plain:
        swept = sweep(scene, kind, axes, size.trial, starts=size.shuttle_starts, removed=removed)
        return {"settings": swept.best, "curve": (swept.along(next(iter(axes))) * [unit, 1.0]).tolist()}

    def drive(found: Plain) -> Drive:
        return Drive(scene, lambda: kind(**found["settings"]))

    return Rival(name, name, find, drive, describe, msgspec.to_builtins(size), (kind, Sweep))


def stroke(scene: Scene, size: StrokeSearchSize, budget_s: float) -> Rival:
    """Periodic open-loop strokes, each searched in a time of simulation [s]."""

    def find(removed: Removed, seed: int) -> Plain:
        how = size.search
        found = how.found(scene, budget_s, seed, removed)
        best, times_s = stroke_from_unit(found.parameters), how.times_s(found)
        return {
            "seed": seed,
            "period_s": best.period_s,
            "points": best.points.tolist(),
            "simulated_s": float(times_s[-1]),
            "curve": np.stack([times_s, found.bests], axis=1).tolist(),
        }

    def describe(found: Sequence[Plain]) -> str:
        periods = sorted(one["period_s"] for one in found)
        if periods[-1] - periods[0] < 0.005:
            return f"period {periods[0]:.2f} s"
        return f"periods {periods[0]:.2f} to {periods[-1]:.2f} s"

    def drive(found: Plain) -> Drive:
        best = Stroke(found["period_s"], np.array(found["points"]))
        return Drive(scene, lambda: PeriodicStrokes([best]))

    return Rival(
        "cma-es",
        STROKE,
        find,
        drive,
        describe,
        {**msgspec.to_builtins(size), "budget_s": budget_s},
        (StrokeSearch, PeriodicStrokes, search),
        tuple(range(size.seeds)),
        shared=not size.each_robot,
    )


def searched_cycle(
    scene: Scene, task: Task, name: str, family: Family, how: CycleSearch, seeds: int
) -> Rival:
    """Cycles of a family, each searched towards the goals of a task."""

    def find(_: Removed, seed: int) -> Plain:
        found = how.found(scene, task, family, seed)
        parameters = found.parameters.tolist()
        return {"seed": seed, "parameters": parameters, "score": found.score, "simulated_s": how.simulated_s}

    def drive(found: Plain) -> Drive:
        own = family.scene(scene)
        best = family.cycle(np.array(found["parameters"]), own.stage_limits or {})
        return Drive(own, lambda: Steered([best]))

    return Rival(
        name,
        family.title,
        find,
        drive,
        lambda _: family.what,
        {**task.arguments(), **vars(how)},
        (CycleSearch, Family, Steered, search),
        tuple(range(seeds)),
    )


def _limits(scene: Scene) -> dict[str, float]:
    return scene.stage_limits or {}
