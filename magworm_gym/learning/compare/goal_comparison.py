"""The stages of a comparison of turning or reaching, from searches to final figures."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene
from magworm_gym.learning.compare import goal_search
from magworm_gym.learning.compare.goal_trials import FIRST_SEED, TURN_TOLERANCE_DEG, Flight, filmed, fly
from magworm_gym.learning.compare.pilots import FAMILIES, Learned, Pilot, Steered
from magworm_gym.learning.compare.stages import Stages
from magworm_gym.tasks import Goal

if TYPE_CHECKING:
    from magworm_gym.learning.compare.evaluate_goals import GoalBudget

Floats = NDArray[np.float64]
Row = dict[str, Any]

TURN_GOALS_DEG = (30.0, -30.0, 90.0, -90.0)
REACH_GOALS_M = ((-0.060, 0.0), (-0.050, 0.020), (-0.050, -0.020), (-0.030, 0.030), (-0.030, -0.030))
REACH_TOLERANCE_M = 0.005
MM_PER_M = 1000.0
CURVE_EVERY = 5
LEARNED = "learned policy"


class GoalComparison:
    """Searches every rival and measures all on the same goals, one kept stage after the other.

    Args:
        scene: Scene in space with a controlled drive.
        budget: Task and sizes.
        folder: Folder of the training.
        summaries: Summary of each seed, see ``crawl_training.train_seed``.
        stages: Keeps results.
    """

    def __init__(
        self, scene: Scene, budget: GoalBudget, folder: Path, summaries: list[dict[str, Any]], stages: Stages
    ) -> None:
        self.scene = scene
        self.task = budget.task
        self.budget = budget
        self.summaries = summaries
        self.size = goal_search.SearchSize(**budget.search)
        self._folder = folder
        self._stages = stages

    @property
    def goals(self) -> Floats:
        """Every goal once for each start (E,) [°] or (E, 2) [m]."""
        distinct = np.array(TURN_GOALS_DEG if self.task == "turn" else REACH_GOALS_M)
        return np.repeat(distinct, self.budget.final.starts, axis=0)

    def search(self, name: str, seed: int) -> dict[str, Any]:
        """The best cycle of a family that one search found."""
        family = FAMILIES[name]
        decided_by = {"scene": self.scene.to_toml(), "task": self.task, "size": vars(self.size), "seed": seed}
        result: dict[str, Any] = self._stages.result(
            f"search-{name}-{seed}",
            decided_by,
            lambda: goal_search.searched(self.scene, self.task, family, self.size, seed),
        )
        return result

    def rows(self) -> list[Row]:
        """Figures of every rival, the learned policy first.

        Returns:
            For each ``rival``, ``samples`` by figure (one for each seed), and ``curves`` of the share done.
        """
        learned = [self._flown_policy(summary) for summary in self.summaries]
        rows = [_row(LEARNED, learned)]
        for name, family in FAMILIES.items():
            rows.append(
                _row(family.title, [self._flown_cycle(name, seed) for seed in range(self.size.seeds)])
            )
        return rows

    def film(self) -> tuple[Recording, Goal, Floats]:
        """The policy of the best seed towards one goal."""
        flown = [self._flown_policy(summary)["figures"]["score"] for summary in self.summaries]
        pilot = self._policy(self.summaries[int(np.argmax(flown))])
        goal = np.array(90.0 if self.task == "turn" else REACH_GOALS_M[1])
        return filmed(self.scene, self.task, pilot, goal, FIRST_SEED, self.budget.final.animation_s)

    def _policy(self, summary: dict[str, Any]) -> Pilot:
        return Learned(self._folder / f"seed-{summary['seed']}" / "policy", summary["algorithm"])

    def _flown_policy(self, summary: dict[str, Any]) -> dict[str, Any]:
        decided_by = {"training": self.budget.training.to_json(), "policy": str(self._folder.resolve())}
        return self._flown(
            f"learned-{summary['seed']}", decided_by, self.scene, lambda: self._policy(summary)
        )

    def _flown_cycle(self, name: str, seed: int) -> dict[str, Any]:
        family = FAMILIES[name]
        scene = family.scene(self.scene)
        parameters = self.search(name, seed)["parameters"]
        cycle = family.cycle(np.array(parameters), scene.stage_limits or {})
        return self._flown(f"{name}-{seed}", {"parameters": parameters}, scene, lambda: Steered([cycle]))

    def _flown(self, name: str, decided_by: dict[str, Any], scene: Scene, pilot: Any) -> dict[str, Any]:
        final = self.budget.final
        goals = self.goals

        def compute() -> dict[str, Any]:
            seeds = range(FIRST_SEED, FIRST_SEED + len(goals))
            flight = fly(scene, self.task, pilot(), goals, seeds, final.duration_s)
            return {"figures": self._figures(flight), "curve": _curve(flight)}

        settings = {**decided_by, "scene": scene.to_toml(), "task": self.task, "final": vars(final)}
        result: dict[str, Any] = self._stages.result(f"flown-{name}", settings, compute)
        return result

    def _figures(self, flight: Flight) -> dict[str, float]:
        figures = {
            "score": float(goal_search.score_of(flight, self.task).mean()),
            "lost_share": float(flight.lost.mean()),
        }
        if self.task == "turn":
            # Less than a tolerance left: what the task itself calls reached.
            time_s = flight.time_until_s(TURN_TOLERANCE_DEG)
            near = np.abs(flight.left).min(axis=0) < TURN_TOLERANCE_DEG
            for angle in (30.0, 90.0):
                asked = np.abs(self.goals) == angle
                figures[f"time_to_{angle:.0f}_deg_s"] = float(time_s[asked].mean())
                figures[f"reached_{angle:.0f}_deg_share"] = float(near[asked].mean())
            if flight.way_m is not None:
                figures["way_mm"] = float(MM_PER_M * flight.way_m.mean())
            figures["final_error_deg"] = float(np.abs(flight.left[-1]).mean())
            return figures
        figures["success_share"] = float((flight.left.min(axis=0) <= REACH_TOLERANCE_M).mean())
        figures["time_s"] = float(flight.time_until_s(REACH_TOLERANCE_M).mean())
        figures["final_distance_mm"] = float(MM_PER_M * flight.left[-1].mean())
        return figures


def _curve(flight: Flight) -> list[list[float]]:
    """Time [s] and mean share of the goal that is done."""
    share = 1.0 - np.abs(flight.left) / np.abs(flight.left[0])
    time_s = np.arange(len(share)) * flight.step_s
    points: list[list[float]] = np.stack([time_s, share.mean(axis=1)], axis=1)[::CURVE_EVERY].tolist()
    return points


def _row(title: str, flown: list[dict[str, Any]]) -> Row:
    samples = {name: [run["figures"][name] for run in flown] for name in flown[0]["figures"]}
    return {"rival": title, "samples": samples, "curves": [run["curve"] for run in flown]}
