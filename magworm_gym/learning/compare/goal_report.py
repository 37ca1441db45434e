"""The report of a comparison of turning or reaching: table, verdict, figure."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from magworm_gym.learning.compare.goal_comparison import (
    LEARNED,
    REACH_GOALS_M,
    TURN_GOALS_DEG,
    GoalComparison,
    Row,
)
from magworm_gym.learning.compare.intervals import Interval, interval
from magworm_gym.learning.compare.pilots import FAMILIES

mpl.use("Agg")

from matplotlib import pyplot as plt

COLUMNS = {
    "time_to_30_deg_s": ("time to 30° [s]", 1.0),
    "reached_30_deg_share": ("30° reached [%]", 100.0),
    "time_to_90_deg_s": ("time to 90° [s]", 1.0),
    "reached_90_deg_share": ("90° reached [%]", 100.0),
    "final_error_deg": ("final heading error [°]", 1.0),
    "way_mm": ("way of the centre [mm]", 1.0),
    "success_share": ("goal reached [%]", 100.0),
    "time_s": ("time to the goal [s]", 1.0),
    "final_distance_mm": ("final distance [mm]", 1.0),
    "lost_share": ("tipped over or broken [%]", 100.0),
}
"""Figures of the table in order, those that a task has: heading and factor."""
DECISIVE = {
    "time_to_30_deg_s": ("time to 30°", "s"),
    "time_s": ("time to the goal", "s"),
    "final_error_deg": ("final heading error", "°"),
    "final_distance_mm": ("final distance", "mm"),
}
"""What the verdict compares, the first that tells anything: less is better."""
UNITS = {"turn": "°/s", "reach": "mm/s"}
COLOURS = ("#1c8c7a", "#3b6fb6", "#7a5ca8", "#c25a1e", "#8a8a8a")


def intervals_of(row: Row) -> dict[str, Interval]:
    """Interquartile mean and interval of each figure of the table."""
    return {name: interval(row["samples"][name]) for name in COLUMNS if name in row["samples"]}


def table(rows: list[Row]) -> str:
    """Markdown table of all rivals."""
    names = [name for name in COLUMNS if name in rows[0]["samples"]]
    lines = [
        "| rival | " + " | ".join(COLUMNS[name][0] for name in names) + " | seeds |",
        "| --- |" + " --- |" * (len(names) + 1),
    ]
    for row in rows:
        found = intervals_of(row)
        cells = [_cell(found[name].scaled(COLUMNS[name][1])) for name in names]
        lines.append(f"| {row['rival']} | " + " | ".join(cells) + f" | {found[names[0]].count} |")
    return "\n".join(lines)


def verdict(rows: list[Row]) -> str:
    """Says in words how the learned policy compares with each rival; intervals decide.

    Where hardly anyone gets there, times say nothing: then what is left at the end decides.
    """
    figures = [name for name in DECISIVE if name in rows[0]["samples"]]
    figure = next(
        (name for name in figures if any(min(row["samples"][name]) < _censored(rows, name) for row in rows)),
        figures[-1],
    )
    name, unit = DECISIVE[figure]
    learned = interval(rows[0]["samples"][figure])
    sentences = [] if figure == figures[0] else ["Nobody reached a goal in the time given."]
    for row in rows[1:]:
        rival = interval(row["samples"][figure])
        if learned.high < rival.low:
            outcome = "beats"
        elif learned.low > rival.high:
            outcome = "does not beat"
        else:
            outcome = "cannot be told, their intervals overlap, from"
        sentences.append(
            f"The learned policy {outcome} the rival “{row['rival']}” in {name}: "
            f"{learned.value:.1f} against {rival.value:.1f} {unit}."
        )
    best = min(rows, key=lambda row: interval(row["samples"][figure]).value)
    sentences.append(f"Best in {name}: {best['rival']}.")
    return " ".join(sentences)


def _censored(rows: list[Row], figure: str) -> float:
    """What a figure is where nobody gets there."""
    worst: float = max(max(row["samples"][figure]) for row in rows)
    return worst


def report(comparison: GoalComparison, rows: list[Row]) -> str:
    """The whole report in Markdown."""
    final, size, task = comparison.budget.final, comparison.size, comparison.task
    settings, summary = comparison.budget.training, comparison.summaries[0]
    limits = ", ".join(f"`{name}` {value:g}" for name, value in (comparison.scene.stage_limits or {}).items())
    censored = (
        f"An episode in which that never happens counts with the whole {final.duration_s:g} s: such times "
        "are censored, the true ones are longer; how many got there stands beside them."
    )
    if task == "turn":
        goals = ", ".join(f"{goal:+.0f}°" for goal in TURN_GOALS_DEG)
        meaning = (
            "Time to 30° and to 90°: until less than 3° are left for the first time of such a goal. The "
            "task does not ask the robot to stay where it is: a long way of the centre means that the "
            "magnets tow it, so what wins here need not be a gait."
        )
        title, maximised = "Turning", "the shares of 30° and of 90° that are turned"
        steering = "they park the magnet while less than 2° are left"
    else:
        goals = ", ".join(f"({1e3 * x:.0f}, {1e3 * z:.0f}) mm" for x, z in REACH_GOALS_M)
        meaning = "Time to the goal: until the robot's centre is within 5 mm of it."
        title, maximised = "Reaching", "the share of the way that is done"
        steering = "they keep to the middle while it is within 10° of straight ahead"
    rivals = [f"- **{family.title}**: {family.what}." for family in FAMILIES.values()]
    parts = [
        f"# {title} in {comparison.scene.name}: learned against searched drives",
        verdict(rows),
        table(rows),
        f"Goals {goals}, {final.starts} starts of each with the same seeds for every rival, episodes of "
        f"{final.duration_s:g} s. {meaning} {censored} Each seed's sample is its mean over goals and starts; "
        "interquartile mean and 95 % percentile bootstrap interval over the seeds of a training or a search. "
        "Over five seeds an interval is hardly more than their range.",
        f"Limits of the stage: {limits}; control period {1e3 * comparison.scene.control_step_s:.0f} ms.",
        "## How the rivals were made",
        f"- **{LEARNED}**: {settings.algorithm.upper()} (Stable-Baselines3), {settings.num_envs} "
        f"environments, {summary['steps']} environment steps = {summary['simulated_s']:.0f} simulated "
        f"seconds for each seed{_taught(comparison)}, goals drawn as the task draws them, evaluated with its "
        "mean action. While "
        f"exploring it got {_exploring(comparison)} {UNITS[task]} in the end.\n" + "\n".join(rivals),
        f"Every search: CMA-ES (library cmaes), begun at the best of {size.scouts} random ones, "
        f"{size.generations} generations of {size.population}, {size.starts} trials of {size.duration_s:g} s "
        f"each = {_searched_s(comparison):.0f} simulated seconds; {size.seeds} independent searches. It "
        f"maximises {maximised}, averaged over the time. Rivals know the side on which the goal is and are "
        f"mirrored to it at every control step; {steering}.",
        f"![Share of the goal done against time, and learning]({task}.png)",
        "Animation of the best seed, from above and from the side: "
        f"[{task}.mp4]({task}.mp4), [{task}.gif]({task}.gif).",
        "All of this is of the model, not of a robot in a laboratory.",
    ]
    return "\n\n".join(parts) + "\n"


def results(comparison: GoalComparison, rows: list[Row]) -> dict[str, Any]:
    """All results as plain values."""
    return {
        "task": comparison.task,
        "scene": comparison.scene.to_toml(),
        "verdict": verdict(rows),
        "rivals": [
            {
                "rival": row["rival"],
                "samples": row["samples"],
                "intervals": {name: vars(value) for name, value in intervals_of(row).items()},
            }
            for row in rows
        ],
        "training": comparison.summaries,
        "searches": {
            name: [comparison.search(name, seed) for seed in range(comparison.size.seeds)]
            for name in FAMILIES
        },
    }


def draw(path: Path, comparison: GoalComparison, rows: list[Row]) -> None:
    """Draws the share of the goal done against time (a band is the range of seeds), and learning curves."""
    with mpl.rc_context({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False}):
        figure, (done, learning) = plt.subplots(1, 2, figsize=(10.0, 4.0), layout="constrained")
        for row, colour in zip(rows, COLOURS, strict=True):
            curves = np.array(row["curves"])
            time_s, shares = curves[0, :, 0], 100.0 * curves[:, :, 1]
            done.plot(time_s, shares.mean(axis=0), color=colour, label=row["rival"])
            done.fill_between(time_s, shares.min(axis=0), shares.max(axis=0), color=colour, alpha=0.15, lw=0)
        done.set_xlabel("time [s]")
        done.set_ylabel("share of the goal done, all goals [%]")
        done.legend(frameon=False)
        for summary in comparison.summaries:
            steps, rewards = np.array(summary["curve"]).reshape(-1, 2).T
            learning.plot(1e-3 * steps, rewards, color=COLOURS[0], lw=1.0, label=f"seed {summary['seed']}")
        learning.set_xlabel("thousand environment steps")
        learning.set_ylabel(f"reward while exploring [{UNITS[comparison.task]}]")
        part = path.with_name(f".part-{path.name}")
        figure.savefig(part, dpi=130, format="png")
        plt.close(figure)
        part.replace(path)


def _taught(comparison: GoalComparison) -> str:
    teacher = comparison.budget.training.learner.get("teacher")
    if teacher is None:
        return ""
    return (
        f", after it was begun as a copy of a cycle of “{FAMILIES[teacher].title}” (behaviour cloning), "
        "found by a search of its own"
    )


def _exploring(comparison: GoalComparison) -> str:
    last = [summary["curve"][-1][1] for summary in comparison.summaries if summary["curve"]]
    return f"{min(last):.2f} to {max(last):.2f}" if last else "an unknown number of"


def _searched_s(comparison: GoalComparison) -> float:
    simulated_s: float = comparison.search(next(iter(FAMILIES)), 0)["simulated_s"]
    return simulated_s


def _cell(value: Interval) -> str:
    return f"{value.value:.1f} [{value.low:.1f}, {value.high:.1f}]"
