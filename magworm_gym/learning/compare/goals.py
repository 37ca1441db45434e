"""The comparisons of turning and reaching: episodes towards set goals, by policies and by steered cycles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines import AIMS, FAMILIES, Flight, Recording, Runner, fly, record
from magworm_gym.learning.compare import rivals
from magworm_gym.learning.compare.budget import GoalBudget
from magworm_gym.learning.compare.contest import FIRST_SEED, Contest
from magworm_gym.learning.compare.rivals import LEARNED, Drive, Plain, Removed, Rival
from magworm_gym.learning.compare.rows import MM_PER_M, Compared, Measure, Row
from magworm_gym.learning.compare.words import page, verdict
from magworm_gym.learning.results import Column, Report, Table
from magworm_gym.tasks import Goal, Reach, Task, Turn

Floats = NDArray[np.float64]

CURVE_EVERY = 5

TIME_TO_30 = Measure("time_to_30_deg_s", "time to 30°", "s", less=True)
TIME_TO_GOAL = Measure("time_s", "time to the goal", "s", less=True)
FINAL_ERROR = Measure("final_error_deg", "final heading error", "°", less=True)
FINAL_DISTANCE = Measure("final_distance_mm", "final distance", "mm", less=True)
LOST = Measure("lost_share", "tipped over or broken", "%", factor=100.0, less=True)


@dataclass(frozen=True)
class Course:
    """What a task with goals has of its own."""

    name: str  # for files
    goals: Floats  # of the final measurement (G, …), as the option of the task takes them
    goal_words: list[str]
    filmed: int  # which of them the animation is of
    measures: tuple[Measure, ...]  # columns of the table
    decisive: tuple[Measure, Measure]  # what the verdict goes by: the second where nobody gets there


TURN_GOALS_DEG = (30.0, -30.0, 90.0, -90.0)
REACH_GOALS_M = ((-0.060, 0.0), (-0.050, 0.020), (-0.050, -0.020), (-0.030, 0.030), (-0.030, -0.030))
COURSES: dict[type[Task], Course] = {
    Turn: Course(
        "turn",
        np.array(TURN_GOALS_DEG),
        [f"{goal:+.0f}°" for goal in TURN_GOALS_DEG],
        2,
        (
            TIME_TO_30,
            Measure("reached_30_deg_share", "30° reached", "%", factor=100.0),
            Measure("time_to_90_deg_s", "time to 90°", "s", less=True),
            Measure("reached_90_deg_share", "90° reached", "%", factor=100.0),
            FINAL_ERROR,
            Measure("way_mm", "way of the centre", "mm"),
            LOST,
        ),
        (TIME_TO_30, FINAL_ERROR),
    ),
    Reach: Course(
        "reach",
        np.array(REACH_GOALS_M),
        [f"({MM_PER_M * x:.0f}, {MM_PER_M * z:.0f}) mm" for x, z in REACH_GOALS_M],
        1,
        (Measure("success_share", "goal reached", "%", factor=100.0), TIME_TO_GOAL, FINAL_DISTANCE, LOST),
        (TIME_TO_GOAL, FINAL_DISTANCE),
    ),
}
"""What tasks with goals have of their own."""


class GoalContest(Contest):
    """Who gets to the goal first, and stays there?"""

    budget_kind = GoalBudget
    made_by = (Runner, Flight, Turn, Reach)
    budget: GoalBudget

    def rivals(self) -> list[Rival]:
        """See :class:`Contest`."""
        size = self.budget.search
        cycles = (
            rivals.searched_cycle(self.scene, self.task, name, family, size.search, size.seeds)
            for name, family in FAMILIES.items()
        )
        return [rivals.learned(self.scene, self.training.folders, ""), *cycles]

    def measured(self, drive: Drive, removed: Removed) -> Plain:
        """See :class:`Contest`."""
        assert drive.controller is not None, "a task with goals is for controlled drives"
        final, task = self.budget.final, self.task
        goals = np.repeat(COURSES[type(task)].goals, final.starts, axis=0)
        worms, seeds = Runner(drive.scene, len(goals), removed, task), FIRST_SEED + np.arange(len(goals))
        flight = fly(worms, drive.controller(), goals, seeds, final.duration_s)
        measured = {"score": AIMS[type(task)].score(flight), LOST.key: flight.lost.astype(np.float64)}
        if isinstance(task, Turn):
            measured |= _turn_samples(flight, goals, task.tolerance_deg)
        elif isinstance(task, Reach):
            measured |= _reach_samples(flight, task.tolerance_m)
        samples = {
            name: [None if np.isnan(value) else value for value in values.tolist()]
            for name, values in measured.items()
        }
        return {"samples": samples, "curve": _curve(flight)}

    def film(self, compared: Compared) -> tuple[Recording, Goal, Floats]:
        """The policy of the best seed towards a goal: recording, goal, and what is left at each instant."""
        row, course, aim = compared.of(LEARNED), COURSES[type(self.task)], AIMS[type(self.task)]
        controller = row.rival.drive(row.best("score")).controller
        assert controller is not None, "policies control"
        worms = Runner(self.scene, 1, task=self.task)
        worms.begin([FIRST_SEED], controller(), goals=course.goals[[course.filmed]])
        task, left = worms.env.task, []
        recording = record(
            worms, self.budget.final.animation_s, watch=lambda: left.append(float(aim.left(task)[0]))
        )
        goal = task.goal(0)
        assert goal is not None, "the task has a goal"
        return recording, goal, np.array(left)

    def report(self, compared: Compared) -> Report:
        """See :class:`Contest`."""
        course, summaries = COURSES[type(self.task)], self.training.summaries
        return page(
            self,
            "goals.md.jinja",
            {"intact": goal_table(compared.whole, course)},
            course=course,
            task=self.task,
            verdict=" ".join(goal_verdict(compared.whole, course)),
            teacher=self.training.settings.learner.get("teacher"),
            rewards=[one["curve"][-1][1] for one in summaries if one["curve"]] or [0.0],
            families=FAMILIES,
        )


def goal_table(rows: list[Row], course: Course) -> Table:
    """A line for each rival."""
    columns = [Column("rival", "rival"), *(measure.column() for measure in course.measures)]
    table = Table([*columns, Column("seeds", "seeds", "g")], [])
    for row in rows:
        found = {measure.key: row.interval(measure) for measure in course.measures}
        table.rows.append({"rival": row.title, **found, "seeds": len(row.found)})
    return table


def goal_verdict(rows: list[Row], course: Course) -> list[str]:
    """How the learned policy compares with each rival.

    Where nobody gets there, times say nothing: then what is left at the end decides.
    """
    measure, left = course.decisive
    times = [sample for row in rows for sample in row.samples[measure.key]]
    sentences = []
    if min(times) == max(times):
        measure, sentences = left, ["Nobody reached a goal in the time given."]
    opponents = [(f"the rival “{row.title}”", row) for row in rows[1:]]
    best = min(rows, key=lambda row: row.interval(measure).value)
    sentences += verdict(rows[0], opponents, measure, f" in {measure.words}")
    return [*sentences, f"Best in {measure.words}: {best.title}."]


def _turn_samples(flight: Flight, goals: Floats, tolerance_deg: float) -> dict[str, Floats]:
    time_s = flight.time_until_s(tolerance_deg)
    near = np.abs(flight.left).min(axis=0) < tolerance_deg
    samples = {"way_mm": MM_PER_M * flight.way_m, FINAL_ERROR.key: np.abs(flight.left[-1])}
    for angle in (30, 90):
        asked = np.abs(goals) == angle
        samples[f"time_to_{angle}_deg_s"] = np.where(asked, time_s, np.nan)
        samples[f"reached_{angle}_deg_share"] = np.where(asked, near, np.nan)
    return samples


def _reach_samples(flight: Flight, tolerance_m: float) -> dict[str, Floats]:
    near = (flight.left.min(axis=0) <= tolerance_m).astype(np.float64)
    time_s, distance_mm = flight.time_until_s(tolerance_m), MM_PER_M * flight.left[-1]
    return {"success_share": near, TIME_TO_GOAL.key: time_s, FINAL_DISTANCE.key: distance_mm}


def _curve(flight: Flight) -> list[list[float]]:
    """Time [s] and mean share of the goal that is done."""
    share = 1.0 - np.abs(flight.left) / np.abs(flight.left[0])
    time_s = np.arange(len(share)) * flight.step_s
    points: list[list[float]] = np.stack([time_s, share.mean(axis=1)], axis=1)[::CURVE_EVERY].tolist()
    return points
