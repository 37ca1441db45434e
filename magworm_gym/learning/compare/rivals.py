"""Drives that are compared, all measured and recorded in the same way."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Batch, Scene
from magworm_gym.baselines import (
    Controller,
    PeriodicStrokes,
    Recording,
    Shuttle,
    Stroke,
    Tow,
    Trial,
    belt_scene,
    belt_starts,
    crawl_speed_m_s,
    record,
)
from magworm_gym.learning.crawl_policy import LearnedController
from magworm_gym.learning.damage import present_after


@dataclass(frozen=True)
class Conditions:
    """Conditions that all rivals share.

    Attributes:
        trial: How a speed is measured.
        first_seed: Seed of the first start.
        starts: Number of starts E.
    """

    trial: Trial
    first_seed: int
    starts: int

    @property
    def seeds(self) -> NDArray[np.uint64]:
        """Seeds of the starts (E,)."""
        return np.arange(self.starts, dtype=np.uint64) + np.uint64(self.first_seed)


@dataclass(frozen=True)
class Rival:
    """A drive with its settings.

    Attributes:
        title: Name for tables and pictures.
        scene: Scene with the robot and this drive.
        controller: Makes a fresh controller; None for a belt.
        pitch_m: Pitch of a belt [m], over which its starts are spread.
    """

    title: str
    scene: Scene
    controller: Callable[[], Controller] | None
    pitch_m: float = 0.0

    def speeds_m_s(self, conditions: Conditions, removed: tuple[int, ...]) -> NDArray[np.float64]:
        """Crawling speeds (E,) [m/s] of a robot without the magnets ``removed``."""
        batch = self._batch(conditions.starts, removed)
        return crawl_speed_m_s(
            batch, conditions.trial, conditions.seeds, self._controller(), self._start(conditions)
        )

    def recording(self, conditions: Conditions, removed: tuple[int, ...], duration_s: float) -> Recording:
        """Records the first start for a time [s]."""
        first = Conditions(conditions.trial, conditions.first_seed, 1)
        batch = self._batch(1, removed)
        return record(batch, duration_s, first.seeds, self._controller(), self._start(first))

    def _batch(self, count: int, removed: tuple[int, ...]) -> Batch:
        batch = Batch(self.scene, count)
        batch.set_magnets_present(np.tile(present_after(self.scene.magnets, removed), (count, 1)))
        return batch

    def _controller(self) -> Controller | None:
        return None if self.controller is None else self.controller()

    def _start(self, conditions: Conditions) -> NDArray[np.float64] | None:
        if self.controller is not None:
            return None
        return belt_starts(self.pitch_m, conditions.starts, conditions.first_seed)


def belt_title(pitch_m: float) -> str:
    """Title of a belt."""
    return f"belt, {1000.0 * pitch_m:.0f} mm pitch"


def belt(scene: Scene, pitch_m: float, speed_m_s: float) -> Rival:
    """A belt at constant speed [m/s] over the robot of a controlled scene."""
    return Rival(belt_title(pitch_m), belt_scene(scene, pitch_m, speed_m_s), None, pitch_m)


def shuttle(scene: Scene, settings: dict[str, Any]) -> Rival:
    """A shuttle; ``settings`` as ``tuning.tuned_shuttle`` gives them."""
    limit = (scene.stage_limits or {})["speed_m_s"]
    speed = settings["drive_speed_m_s"] / limit
    stroke, offset, low = settings["half_stroke"], settings["offset"], settings["low_return"]
    return Rival("shuttle", scene, lambda: Shuttle(speed, stroke, offset, low))


def tow(scene: Scene, settings: dict[str, Any]) -> Rival:
    """A magnet at a fixed place; ``settings`` as ``tuning.tuned_tow`` gives them."""
    return Rival("tow", scene, lambda: Tow(settings["offset"], settings["height"]))


def open_loop(scene: Scene, settings: dict[str, Any]) -> Rival:
    """A periodic stroke; ``settings`` as ``tuning.searched_stroke`` gives them."""
    stroke = Stroke(settings["period_s"], np.array(settings["points"]))
    return Rival("CMA-ES stroke", scene, lambda: PeriodicStrokes([stroke]))


def learned(scene: Scene, folder: Path, algorithm: str) -> Rival:
    """A trained policy from its folder."""
    return Rival("learned policy", scene, lambda: LearnedController(folder))
