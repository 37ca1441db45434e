"""The stages of a comparison, from tuning to the final speeds."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from magworm_gym import Scene
from magworm_gym.baselines import PAPER_PITCHES_M, Recording, Trial
from magworm_gym.learning.compare import rivals, tuning
from magworm_gym.learning.compare.evaluation_settings import Budget
from magworm_gym.learning.compare.rivals import Conditions, Rival
from magworm_gym.learning.compare.stages import Stages
from magworm_gym.learning.damage import removable_sets, robot_name

Removed = tuple[int, ...]
Row = dict[str, Any]

MM_PER_M = 1000.0


@dataclass(frozen=True)
class Policies:
    """Trained policies.

    Attributes:
        folder: Folder of the training, with a folder for each seed.
        algorithm: "ppo" or "sac".
        summaries: Summary of each seed, see ``crawl_training.train_seed``.
    """

    folder: Path
    algorithm: str
    summaries: list[dict[str, Any]]

    def of_seed(self, seed: int) -> Path:
        """Folder of the policy of a seed."""
        return self.folder / f"seed-{seed}" / "policy"

    @property
    def simulated_s(self) -> float:
        """Simulated time [s] that went into one policy."""
        return max(float(summary["simulated_s"]) for summary in self.summaries)


class Comparison:
    """Tunes every drive and measures it on every robot, one kept stage after the other.

    Args:
        scene: Scene with a controlled drive.
        policies: Trained policies.
        budget: Sizes of sweeps, searches and measurements.
        stages: Keeps results.
    """

    def __init__(self, scene: Scene, policies: Policies, budget: Budget, stages: Stages) -> None:
        self.scene = scene
        self.policies = policies
        self.budget = budget
        self._stages = stages
        self._common = {"scene": scene.to_toml()}
        final = budget.final
        self.conditions = Conditions(Trial(final.settle_s, final.measure_s), final.first_seed, final.starts)
        self.robots = removable_sets(scene.magnets, scene.removed)

    @property
    def whole(self) -> Removed:
        """The undamaged robot, by the magnets it lacks."""
        return self.robots[0]

    def name(self, removed: Removed) -> str:
        """Name of a robot."""
        return robot_name(removed, self.scene.removed)

    def belt(self, pitch_m: float, removed: Removed) -> dict[str, Any]:
        """Best belt of a pitch on a robot, and its curve."""
        return self._tuned(
            f"belt-{MM_PER_M * pitch_m:.0f}",
            {"sweep": vars(self.budget.sweep)},
            removed,
            lambda: tuning.tuned_belt(self.scene, pitch_m, self.budget.sweep, removed),
        )

    def shuttle(self, removed: Removed) -> dict[str, Any]:
        """Best shuttle on a robot, and its curve."""
        return self._tuned(
            "shuttle",
            {"sweep": vars(self.budget.sweep)},
            removed,
            lambda: tuning.tuned_shuttle(self.scene, self.budget.sweep, removed),
        )

    def tow(self, removed: Removed) -> dict[str, Any]:
        """Best place to tow a robot from, and its curve."""
        return self._tuned(
            "tow",
            {"sweep": vars(self.budget.sweep)},
            removed,
            lambda: tuning.tuned_tow(self.scene, self.budget.sweep, removed),
        )

    def stroke(self, seed: int, removed: Removed) -> dict[str, Any]:
        """Best stroke that one search found, on this robot or, where robots share it, the whole one."""
        searched = removed if self.budget.search.each_robot else self.whole
        budget_s = self.policies.simulated_s
        return self._tuned(
            f"cma-es-seed-{seed}",
            {"search": vars(self.budget.search), "budget_s": budget_s},
            searched,
            lambda: tuning.searched_stroke(self.scene, self.budget.search, budget_s, seed, searched),
        )

    def rows(self, removed: Removed) -> list[Row]:
        """Final speeds of every drive on one robot.

        Returns:
            For each drive a mapping: ``robot``, ``drive``, ``setting``, ``sampled_over`` and
            ``samples_m_s``.
        """
        decided_by = {**self._common, "removed": removed, "final": vars(self.budget.final)}
        decided_by["tuned"] = [self.belt(pitch, removed)["drive_speed_m_s"] for pitch in PAPER_PITCHES_M]
        decided_by["shuttle"] = _without_curve(self.shuttle(removed))
        decided_by["tow"] = _without_curve(self.tow(removed))
        decided_by["strokes"] = [_without_curve(stroke) for stroke in self._strokes(removed)]
        decided_by["policies"] = [_without_curve(summary) for summary in self.policies.summaries]
        name = f"final-{self.name(removed).replace(' ', '-')}"
        rows: list[Row] = self._stages.result(name, decided_by, lambda: self._measured(removed))
        return rows

    def best_of_each(self, removed: Removed, rows: list[Row]) -> dict[str, Rival]:
        """One rival for each drive, for pictures: the fastest policy and stroke by the final speeds."""
        strokes = self._strokes(removed)
        return {
            "learned policy": self._policy(_best_sample(rows, "learned policy")),
            **{rivals.belt_title(pitch): self._belt_rival(pitch, removed) for pitch in PAPER_PITCHES_M},
            "shuttle": rivals.shuttle(self.scene, self.shuttle(removed)),
            "CMA-ES stroke": rivals.open_loop(self.scene, strokes[_best_sample(rows, "CMA-ES stroke")]),
        }

    def recordings(self, removed: Removed, rows: list[Row], duration_s: float) -> dict[str, Recording]:
        """Records the first start of one rival for each drive, for a time [s]."""
        chosen = self.best_of_each(removed, rows)
        return {
            title: rival.recording(self.conditions, removed, duration_s) for title, rival in chosen.items()
        }

    def _tuned(
        self, name: str, settings: dict[str, Any], removed: Removed, compute: Callable[[], dict[str, Any]]
    ) -> dict[str, Any]:
        decided_by = {**self._common, **settings, "removed": removed}
        stage = f"{name}-{self.name(removed).replace(' ', '-')}"
        result: dict[str, Any] = self._stages.result(stage, decided_by, compute)
        return result

    def _strokes(self, removed: Removed) -> list[dict[str, Any]]:
        return [self.stroke(seed, removed) for seed in range(self.budget.search.seeds)]

    def _belt_rival(self, pitch_m: float, removed: Removed) -> Rival:
        return rivals.belt(self.scene, pitch_m, self.belt(pitch_m, removed)["drive_speed_m_s"])

    def _policy(self, number: int) -> Rival:
        seed = self.policies.summaries[number]["seed"]
        return rivals.learned(self.scene, self.policies.of_seed(seed), self.policies.algorithm)

    def _measured(self, removed: Removed) -> list[Row]:
        shuttle, tow, strokes = self.shuttle(removed), self.tow(removed), self._strokes(removed)
        learned = [self._policy(number) for number in range(len(self.policies.summaries))]
        open_loops = [rivals.open_loop(self.scene, stroke) for stroke in strokes]
        belts = [
            self._row(
                self._belt_rival(pitch, removed),
                removed,
                f"{MM_PER_M * self.belt(pitch, removed)['drive_speed_m_s']:.0f} mm/s",
            )
            for pitch in PAPER_PITCHES_M
        ]
        return [
            self._row_over(learned, removed, self._learned_setting()),
            *belts,
            self._row(rivals.shuttle(self.scene, shuttle), removed, self._shuttle_setting(shuttle)),
            self._row_over(open_loops, removed, _stroke_setting(strokes)),
            self._row(rivals.tow(self.scene, tow), removed, self._tow_setting(tow)),
        ]

    def _row(self, rival: Rival, removed: Removed, setting: str) -> Row:
        """A drive with fixed settings: the samples are its starts."""
        samples = rival.speeds_m_s(self.conditions, removed)
        return self._made_row(rival.title, removed, setting, "starts", samples.tolist())

    def _row_over(self, found: list[Rival], removed: Removed, setting: str) -> Row:
        """A drive that was found several times: the samples are the means of each."""
        samples = [float(np.mean(rival.speeds_m_s(self.conditions, removed))) for rival in found]
        return self._made_row(found[0].title, removed, setting, "seeds", samples)

    def _made_row(
        self, drive: str, removed: Removed, setting: str, sampled_over: str, samples: list[float]
    ) -> Row:
        return {
            "robot": self.name(removed),
            "removed": list(removed),
            "drive": drive,
            "setting": setting,
            "sampled_over": sampled_over,
            "samples_m_s": samples,
        }

    def _learned_setting(self) -> str:
        steps = max(int(summary["steps"]) for summary in self.policies.summaries)
        return f"{self.policies.algorithm.upper()}, {steps / 1e6:.2g} million steps"

    def _shuttle_setting(self, shuttle: dict[str, Any]) -> str:
        reach_mm = MM_PER_M * (self.scene.stage_limits or {})["reach_m"]
        returning = "low" if shuttle["low_return"] else "at the same height"
        return (
            f"{MM_PER_M * shuttle['drive_speed_m_s']:.0f} mm/s, ±{reach_mm * shuttle['half_stroke']:.0f} mm "
            f"about {reach_mm * shuttle['offset']:+.0f} mm, return {returning}"
        )

    def _tow_setting(self, tow: dict[str, Any]) -> str:
        limits = self.scene.stage_limits or {}
        low, high = limits["lowest_m"], limits["highest_m"]
        place_mm = MM_PER_M * limits["reach_m"] * tow["offset"]
        height_mm = MM_PER_M * (low + 0.5 * (1.0 + tow["height"]) * (high - low))
        return f"held at {place_mm:+.0f} mm, height {height_mm:.0f} mm"


def _without_curve(result: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in result.items() if name != "curve"}


def _best_sample(rows: list[Row], drive: str) -> int:
    (row,) = (row for row in rows if row["drive"] == drive)
    return int(np.argmax(row["samples_m_s"]))


def _stroke_setting(strokes: list[dict[str, Any]]) -> str:
    periods = sorted(stroke["period_s"] for stroke in strokes)
    if periods[-1] - periods[0] < 0.005:
        return f"period {periods[0]:.2f} s"
    return f"periods {periods[0]:.2f} to {periods[-1]:.2f} s"
