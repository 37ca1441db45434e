"""The report: results as JSON, and tables and a verdict in Markdown."""

from dataclasses import dataclass
from typing import Any

from magworm_gym.learning.compare.comparison import Comparison, Row
from magworm_gym.learning.compare.intervals import Interval, interval

MM_PER_M = 1000.0
# A tow that reaches this share of the best speed is worth a warning.
TOWED_SHARE = 0.5
FIGURES = {
    "speeds.png": "Speeds of all drives with 95 % confidence intervals.",
    "speed_curves.png": "Crawling speed against drive speed of belts and shuttle.",
    "learning_curves.png": "Learning and searching against simulated time.",
    "portraits.png": "Path of the drive magnet relative to the robot centre, two seconds of each.",
}


@dataclass(frozen=True)
class Result:
    """One line of a table.

    Attributes:
        row: Drive, robot, setting and samples, see ``Comparison.rows``.
        speed_m_s: Crawling speed with its interval [m/s].
    """

    row: Row
    speed_m_s: Interval


def results_of(rows: list[Row]) -> list[Result]:
    """Adds interquartile means and intervals."""
    return [Result(row, interval(row["samples_m_s"])) for row in rows]


def limits_sentence(comparison: Comparison) -> str:
    """The limits of the stage, which decide every figure."""
    limits = comparison.scene.stage_limits or {}
    low, high = MM_PER_M * limits["lowest_m"], MM_PER_M * limits["highest_m"]
    control_ms = MM_PER_M * comparison.scene.control_step_s
    return (
        f"Limits of the stage: speed {MM_PER_M * limits['speed_m_s']:.0f} mm/s, acceleration "
        f"{limits['acceleration_m_s2']:g} m/s², drive height {low:.0f} to {high:.0f} mm, reach "
        f"±{MM_PER_M * limits['reach_m']:.0f} mm, control period {control_ms:.0f} ms; "
        f"belts run at {high:.0f} mm and at no more than the same speed."
    )


def table(comparison: Comparison, results: list[Result]) -> str:
    """Markdown table of one robot, limits of the stage below it."""
    length = comparison.scene.body_length_m
    lines = [
        "| drive | setting | mm/s [95 % interval] | body lengths/s [95 % interval] | samples |",
        "| --- | --- | --- | --- | --- |",
    ]
    for result in results:
        row = result.row
        lines.append(
            f"| {row['drive']} | {row['setting']} | {_cell(result.speed_m_s.scaled(MM_PER_M), 2)} "
            f"| {_cell(result.speed_m_s.scaled(1.0 / length), 3)} "
            f"| {result.speed_m_s.count} {row['sampled_over']} |"
        )
    return "\n".join([*lines, "", limits_sentence(comparison)])


def robots_table(comparison: Comparison, by_robot: dict[str, list[Result]]) -> str:
    """Markdown table of all robots, one column for each drive, in mm/s."""
    drives = [result.row["drive"] for result in next(iter(by_robot.values()))]
    lines = [
        "| robot | " + " | ".join(drives) + " |",
        "| --- |" + " --- |" * len(drives),
    ]
    for robot, results in by_robot.items():
        cells = [_cell(result.speed_m_s.scaled(MM_PER_M), 1) for result in results]
        lines.append(f"| {robot} | " + " | ".join(cells) + " |")
    return "\n".join([*lines, "", limits_sentence(comparison)])


def verdict(results: list[Result]) -> str:
    """Says in words how the learned policy compares with belt, shuttle and open-loop stroke."""
    learned = _of(results, "learned policy")
    belts = [result for result in results if result.row["drive"].startswith("belt")]
    best_belt = max(belts, key=lambda result: result.speed_m_s.value)
    stroke = _of(results, "CMA-ES stroke")
    texts = [
        _against(learned.speed_m_s, best_belt.speed_m_s, "the best constant-speed belt"),
        _against(learned.speed_m_s, _of(results, "shuttle").speed_m_s, "the best shuttle"),
        _against(learned.speed_m_s, stroke.speed_m_s, "the best open-loop stroke of CMA-ES"),
    ]
    tow = _of(results, "tow").speed_m_s.value
    if tow > TOWED_SHARE * max(learned.speed_m_s.value, best_belt.speed_m_s.value):
        texts.append(
            f"Beware: a magnet held at one place ahead of the robot tows it at {MM_PER_M * tow:.2f} mm/s, so "
            "what wins here need not be a gait."
        )
    return " ".join(texts)


def report(comparison: Comparison, by_robot: dict[str, list[Result]], training_text: str) -> str:
    """The whole report in Markdown."""
    scene, whole = comparison.scene, next(iter(by_robot.values()))
    conditions, search = comparison.conditions, comparison.budget.search
    parts = [
        f"# Crawling of {scene.name}: learned against tuned drives",
        verdict(whole),
        f"## The {next(iter(by_robot))} robot",
        table(comparison, whole),
        f"Speed towards the head over {conditions.trial.measure_s:g} s, after "
        f"{conditions.trial.settle_s:g} s of settling, from {conditions.starts} starts with the same seeds "
        "for every drive (belts: spread over one pitch). Interquartile mean and 95 % percentile bootstrap "
        "interval over the samples of the last column: starts of a drive with fixed settings, seeds of one "
        "that is trained or searched (each seed's sample is its mean over all starts); over fewer than five "
        "samples an interval is hardly more than their range. Body length "
        f"{MM_PER_M * scene.body_length_m:.0f} mm.",
    ]
    if len(by_robot) > 1:
        tuned = "searched anew" if search.each_robot else "that of the whole robot"
        parts += [
            "## Every set of magnets removed that leaves at least three",
            robots_table(comparison, by_robot),
            "mm/s [95 % interval]; magnets are counted from 0 at the head. Belts and shuttle are tuned anew "
            f"on each robot, the CMA-ES stroke is {tuned}; the learned policy is the same on all, and is not "
            "told which magnets are missing.",
        ]
    parts += ["## How the drives were made", training_text, _search_text(comparison), "## Figures"]
    parts += [f"![{text}]({name})\n\n{text}" for name, text in FIGURES.items()]
    parts.append("Animation: [race.mp4](race.mp4), [race.gif](race.gif), the same start, in real time.")
    return "\n\n".join(parts) + "\n"


def results_json(comparison: Comparison, by_robot: dict[str, list[Result]]) -> dict[str, Any]:
    """All results as plain values, SI units in the names."""
    whole = comparison.whole
    strokes = [comparison.stroke(seed, whole) for seed in range(comparison.budget.search.seeds)]
    return {
        "scene": comparison.scene.to_toml(),
        "body_length_m": comparison.scene.body_length_m,
        "control_step_s": comparison.scene.control_step_s,
        "stage_limits": comparison.scene.stage_limits,
        "conditions": vars(comparison.budget.final),
        "verdict": verdict(next(iter(by_robot.values()))),
        "speeds": [
            {**result.row, "speed_m_s": vars(result.speed_m_s)}
            for results in by_robot.values()
            for result in results
        ],
        "training": comparison.policies.summaries,
        "strokes": strokes,
    }


def _cell(value: Interval, digits: int) -> str:
    return f"{value.value:.{digits}f} [{value.low:.{digits}f}, {value.high:.{digits}f}]"


def _of(results: list[Result], drive: str) -> Result:
    return next(result for result in results if result.row["drive"] == drive)


def _against(learned: Interval, rival: Interval, name: str) -> str:
    """One sentence; a difference counts where the intervals do not overlap."""
    speeds = f"{MM_PER_M * learned.value:.2f} against {MM_PER_M * rival.value:.2f} mm/s"
    if learned.low > rival.high:
        ratio = f", {learned.value / rival.value:.1f} times as fast" if rival.value > 0.0 else ""
        return f"The learned policy beats {name}: {speeds}{ratio}."
    if learned.high < rival.low:
        return f"The learned policy does not beat {name}: {speeds}."
    return f"The learned policy cannot be told from {name}: {speeds}, and the intervals overlap."


def _search_text(comparison: Comparison) -> str:
    search, sweep = comparison.budget.search, comparison.budget.sweep
    return (
        f"CMA-ES (library cmaes): {search.seeds} independent searches of a periodic trajectory of all three "
        f"actions, {search.control_points} control points, period 0.1 to 1.5 s, each with the "
        f"{comparison.policies.simulated_s:.0f} simulated seconds of one training, {search.population} "
        f"strokes a generation, begun at the best of {search.scouts} random ones. Sweeps: {sweep.speeds} "
        "drive speeds up to the limit; the shuttle also over stroke, offset and return; the tow over place "
        "and height."
    )
