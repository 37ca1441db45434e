"""Figures of an evaluation."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from magworm_gym.baselines import PAPER_PITCHES_M, Recording
from magworm_gym.learning.compare.comparison import Comparison
from magworm_gym.learning.compare.report import Result

mpl.use("Agg")

from matplotlib import pyplot as plt

MM_PER_M = 1000.0
PORTRAIT_S = 2.0
SMOOTHED_POINTS = 3
SEEN_MM = 200.0
COLOURS = {
    "learned policy": "#1c8c7a",
    "CMA-ES stroke": "#c25a1e",
    "shuttle": "#7a5ca8",
    "tow": "#8a8a8a",
    "belt, 125 mm pitch": "#3b6fb6",
    "belt, 170 mm pitch": "#8fb3dd",
}


def draw_speeds(path: Path, by_robot: dict[str, list[Result]]) -> None:
    """Draws bars of all drives, grouped by robot."""
    drives = [result.row["drive"] for result in next(iter(by_robot.values()))]
    width = 0.8 / len(drives)
    with _figure(path, (max(6.4, 1.2 + 1.3 * len(by_robot)), 4.0)) as axes:
        for number, drive in enumerate(drives):
            speeds = [results[number].speed_m_s.scaled(MM_PER_M) for results in by_robot.values()]
            places = np.arange(len(speeds)) + (number - 0.5 * (len(drives) - 1)) * width
            values = np.array([speed.value for speed in speeds])
            errors = np.abs(np.array([(speed.low, speed.high) for speed in speeds]).T - values)
            axes.bar(places, values, 0.92 * width, color=COLOURS[drive], label=drive)
            axes.errorbar(places, values, errors, fmt="none", ecolor="#222222", capsize=3, lw=1.2)
        axes.set_xticks(np.arange(len(by_robot)), list(by_robot), rotation=30 if len(by_robot) > 5 else 0)
        axes.axhline(0.0, color="#222222", lw=0.8)
        axes.set_ylabel("crawling speed [mm/s]")
        if len(by_robot) > 1:
            axes.set_xlabel("robot, magnets counted from 0 at the head")
        axes.legend(frameon=False, fontsize=9, ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def draw_speed_curves(path: Path, comparison: Comparison, results: list[Result]) -> None:
    """Draws crawling speed against drive speed, with the free drives as lines."""
    curves = {
        f"belt, {MM_PER_M * pitch:.0f} mm pitch": comparison.belt(pitch, comparison.whole)
        for pitch in PAPER_PITCHES_M
    }
    curves["shuttle"] = comparison.shuttle(comparison.whole)
    with _figure(path, (6.4, 4.0)) as axes:
        for title, tuned in curves.items():
            drive, crawl = MM_PER_M * np.array(tuned["curve"]).T
            label = f"{title} (best stroke at each speed)" if title == "shuttle" else title
            axes.plot(drive, crawl, "o-", ms=3.5, color=COLOURS[title], label=label)
        for result in results:
            title = result.row["drive"]
            if title in ("learned policy", "CMA-ES stroke"):
                speed = result.speed_m_s.scaled(MM_PER_M)
                axes.axhline(speed.value, color=COLOURS[title], ls="--", label=title)
                axes.axhspan(speed.low, speed.high, color=COLOURS[title], alpha=0.15, lw=0)
        axes.set_xlabel("speed of the belt, or of the work stroke [mm/s]")
        axes.set_ylabel("crawling speed [mm/s]")
        axes.legend(frameon=False, fontsize=9, ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def draw_learning_curves(path: Path, comparison: Comparison, results: list[Result]) -> None:
    """Draws training and search against simulated time, with the best belt as a line."""
    step_s = comparison.scene.control_step_s
    with _figure(path, (6.4, 4.0)) as axes:
        for number, summary in enumerate(comparison.policies.summaries):
            steps, speeds = np.array(summary["curve"]).reshape(-1, 2).T
            label = "learned policy, while exploring" if number == 0 else None
            _smooth_line(axes, steps * step_s, speeds, COLOURS["learned policy"], label)
        for seed in range(comparison.budget.search.seeds):
            times, bests = np.array(comparison.stroke(seed, comparison.whole)["curve"]).T
            label = "CMA-ES stroke, best so far" if seed == 0 else None
            axes.plot(times, MM_PER_M * bests, color=COLOURS["CMA-ES stroke"], lw=1.3, label=label)
        belts = [result for result in results if result.row["drive"].startswith("belt")]
        best = max(belts, key=lambda result: result.speed_m_s.value)
        axes.axhline(
            MM_PER_M * best.speed_m_s.value,
            color=COLOURS[best.row["drive"]],
            ls="--",
            label=best.row["drive"],
        )
        axes.set_xlabel("simulated time of one seed [s]")
        axes.set_ylabel("crawling speed [mm/s]")
        axes.legend(frameon=False, fontsize=9)


def draw_portraits(path: Path, recordings: dict[str, Recording], limits: dict[str, float]) -> None:
    """Draws the path of the drive magnet relative to the robot centre; darker is later.

    Args:
        path: Picture to write.
        recordings: One for each drive, by title.
        limits: ``Scene.stage_limits``.
    """
    low, high, reach = (MM_PER_M * limits[name] for name in ("lowest_m", "highest_m", "reach_m"))
    columns = len(recordings)
    with mpl.rc_context({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False}):
        figure, panels = plt.subplots(
            1, columns, figsize=(2.6 * columns, 2.9), sharex=True, sharey=True, layout="constrained"
        )
        for axes, (title, recording) in zip(np.atleast_1d(panels), recordings.items(), strict=True):
            _portrait(axes, recording, COLOURS[title])
            axes.set_xlim(-1.15 * reach, 1.15 * reach)
            axes.set_ylim(low - 0.08 * (high - low), high + 0.08 * (high - low))
            axes.set_title(title, fontsize=10)
            axes.set_xlabel("drive x - robot centre [mm]")
        np.atleast_1d(panels)[0].set_ylabel("drive height [mm]")
        _save(figure, path)


def _portrait(axes: Any, recording: Recording, colour: str) -> None:
    step_s = float(recording.time_s[1] - recording.time_s[0])
    last = slice(-max(2, round(PORTRAIT_S / step_s)), None)
    relative = recording.drive_positions[last] - recording.centre[last, None] * (1.0, 0.0)
    for magnet in range(relative.shape[1]):
        x, y = MM_PER_M * relative[:, magnet].T
        # A belt closes on itself out of sight: that jump is no path.
        shown = np.where(np.abs(x) < SEEN_MM, x, np.nan)
        axes.plot(shown, y, color=colour, lw=0.9, alpha=0.45)
        axes.scatter(shown, y, c=np.linspace(0.25, 1.0, len(y)), cmap=_shades(colour), vmin=0, vmax=1, s=7)
    axes.axvline(0.0, color="#999999", lw=0.6)


def _shades(colour: str) -> Any:
    return mpl.colors.LinearSegmentedColormap.from_list("shades", ["#ffffff", colour])


def _smooth_line(axes: Any, times: Any, speeds: Any, colour: str, label: str | None) -> None:
    if len(speeds) >= SMOOTHED_POINTS:
        weights = np.ones(SMOOTHED_POINTS) / SMOOTHED_POINTS
        speeds = np.convolve(speeds, weights, mode="valid")
        times = times[SMOOTHED_POINTS - 1 :]
    axes.plot(times, speeds, color=colour, lw=1.3, label=label)


@contextmanager
def _figure(path: Path, size: tuple[float, float]) -> Iterator[Any]:
    """Gives axes and saves the figure at the end."""
    with mpl.rc_context({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False}):
        figure, axes = plt.subplots(figsize=size, layout="constrained")
        yield axes
        _save(figure, path)


def _save(figure: Any, path: Path) -> None:
    part = path.with_name(f".part-{path.name}")
    figure.savefig(part, dpi=150, format="png")
    plt.close(figure)
    part.replace(path)
