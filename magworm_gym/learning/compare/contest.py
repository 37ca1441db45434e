"""The path of every comparison: rivals are found and measured, one kept stage after the other."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar

import msgspec
import numpy as np

from magworm_gym import Scene
from magworm_gym.learning.compare.budget import Budget
from magworm_gym.learning.compare.rivals import Drive, Plain, Removed, Rival
from magworm_gym.learning.compare.rows import Compared, Row, Training, without_curve
from magworm_gym.learning.compare.stages import Stages
from magworm_gym.learning.results import Report
from magworm_gym.tasks import Task

FIRST_SEED = 900_000_000
"""Seed of the first start of the final measurement; no training or search uses it or one that follows."""


class Contest(ABC):
    """A comparison; a task's own says who takes part, what is measured and how it is told.

    Args:
        task: What is asked of the robots.
        scene: Scene with a controlled drive.
        budget: Sizes.
        training: The policies.
    """

    budget_kind: ClassVar[type[Budget]]
    made_by: ClassVar[tuple[Any, ...]]
    """Whose source files decide a measurement, beside those of the rival."""

    def __init__(self, task: Task, scene: Scene, budget: Any, training: Training) -> None:
        self.task = task
        self.scene = scene
        self.budget = budget
        self.training = training

    @property
    def robots(self) -> dict[str, Removed]:
        """The robots by name, each by the magnets that it lacks; the whole one first."""
        return {"intact": self.scene.removed}

    @abstractmethod
    def rivals(self) -> list[Rival]:
        """Those who take part, the learned policy first."""

    @abstractmethod
    def measured(self, drive: Drive, removed: Removed) -> Plain:
        """``samples`` of each measure, one an episode, None where it does not apply; a ``curve`` if any."""

    @abstractmethod
    def report(self, compared: Compared) -> Report:
        """The report; verdict and table of the whole robot are its parts ``verdict`` and ``intact``."""

    def compared(self, stages: Stages) -> Compared:
        """Finds every rival for every robot and measures it there; ``stages`` keeps what came of it."""
        rivals = self.rivals()
        rows = {
            robot: [self._row(stages, rival, robot, removed) for rival in rivals]
            for robot, removed in self.robots.items()
        }
        return Compared(self.training, rows)

    def plain(self, compared: Compared) -> Plain:
        """All that a report rests on as plain values, but for curves."""
        return {
            "environment": self.training.settings.environment_id,
            "scene": self.scene.to_toml(),
            "budget": msgspec.to_builtins(self.budget),
            "rivals": [row.plain for rows in compared.rows.values() for row in rows],
            "training": [without_curve(summary) for summary in self.training.summaries],
        }

    def _row(self, stages: Stages, rival: Rival, robot: str, removed: Removed) -> Row:
        own = next(iter(self.robots.items())) if rival.shared else (robot, removed)
        found = [self._found(stages, rival, *own, seed) for seed in rival.seeds or (0,)]
        flown = [self._flown(stages, rival, robot, removed, one) for one in found]
        samples = {}
        for name in flown[0]["samples"]:
            runs = [np.array([x for x in run["samples"][name] if x is not None]) for run in flown]
            samples[name] = [float(run.mean()) for run in runs] if rival.seeds else runs[0].tolist()
        return Row(robot, rival, found, samples, [run.get("curve") for run in flown])

    def _found(self, stages: Stages, rival: Rival, robot: str, removed: Removed, seed: int) -> Plain:
        if not rival.kept:
            return rival.find(removed, seed)
        decided_by = {**rival.decided_by, "scene": self.scene.to_toml(), "removed": removed, "seed": seed}
        name, made_by = _name(rival, robot, seed), (Rival, *rival.made_by, *self.made_by)
        found: Plain = stages.result(name, decided_by, made_by, lambda: rival.find(removed, seed))
        return found

    def _flown(self, stages: Stages, rival: Rival, robot: str, removed: Removed, found: Plain) -> Any:
        drive = rival.drive(found)
        decided_by = {
            "found": without_curve(found),
            "scene": drive.scene.to_toml(),
            "task": self.task.arguments(),
            "removed": removed,
            "final": msgspec.to_builtins(self.budget.final),
        }
        name = f"final-{_name(rival, robot, found.get('seed'))}"
        made_by = (Rival, *rival.made_by, *self.made_by, type(self))
        return stages.result(name, decided_by, made_by, lambda: self.measured(drive, removed))


def _name(rival: Rival, robot: str, seed: Any) -> str:
    """Name of a stage."""
    seeds = [f"seed-{seed}"] if rival.seeds else []
    return "-".join([rival.name, *seeds, robot.replace(" ", "-")])
