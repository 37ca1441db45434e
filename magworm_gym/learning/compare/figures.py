"""Figures and animations of a comparison."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from magworm_gym.atomic_files import replace_file
from magworm_gym.baselines import Recording
from magworm_gym.learning.compare.contest import Contest
from magworm_gym.learning.compare.crawl import SPEED, CrawlContest, best_belt
from magworm_gym.learning.compare.goals import COURSES, GoalContest
from magworm_gym.learning.compare.rivals import LEARNED, STROKE
from magworm_gym.learning.compare.rows import MM_PER_M, Compared, Row
from magworm_gym.render.animation import write_gif, write_mp4
from magworm_gym.render.race import race_frames
from magworm_gym.render.space_view import SpaceView

mpl.use("Agg")

from matplotlib import pyplot as plt

STYLE: Any = {"font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "savefig.dpi": 150}
RACERS = (LEARNED, "belt, 125 mm pitch", "shuttle", STROKE)
PORTRAIT_S = 2.0
SMOOTHED_POINTS = 3
SEEN_MM = 200.0
COLOURS = {
    LEARNED: "#1c8c7a",
    STROKE: "#c25a1e",
    "shuttle": "#7a5ca8",
    "tow": "#8a8a8a",
    "belt, 125 mm pitch": "#3b6fb6",
    "belt, 170 mm pitch": "#8fb3dd",
    "misaligned belt": "#3b6fb6",
    "alternating offset": "#7a5ca8",
    "two drive magnets (Joyee & Pan)": "#8a8a8a",
}


def draw_crawl(contest: CrawlContest, compared: Compared, out: Path) -> str:
    """Draws figures and race of a comparison of crawling. Returns them as Markdown."""
    with _figure(out / "speeds.png", (max(6.4, 1.2 + 1.3 * len(compared.rows)), 4.0)) as axes:
        _speeds(axes, compared.rows)
    with _figure(out / "speed_curves.png") as axes:
        _speed_curves(axes, compared.whole)
    with _figure(out / "learning_curves.png") as axes:
        _learning_curves(axes, compared, contest.scene.control_step_s)
    recordings = contest.recordings(compared)
    with _figure(out / "portraits.png", (2.6 * len(recordings), 2.9), len(recordings)) as panels:
        _portraits(panels, recordings, contest.scene.stage_limits or {})
    panels = {title: recordings[title] for title in RACERS}
    frames = list(race_frames(panels, {title: contest.scene.geometry for title in panels}))
    fps = 1.0 / contest.scene.control_step_s
    write_mp4(out / "race.mp4", frames, fps)
    write_gif(out / "race.gif", frames[::3], fps / 3, 0.5)
    texts = {
        "speeds.png": "Speeds of all drives with 95 % confidence intervals.",
        "speed_curves.png": "Crawling speed against drive speed of belts and shuttle.",
        "learning_curves.png": "Learning and searching against simulated time.",
        "portraits.png": "Path of the drive magnet relative to the robot centre, two seconds of each.",
    }
    shown = [f"![{text}]({name})\n\n{text}" for name, text in texts.items()]
    film = "Animation: [race.mp4](race.mp4), [race.gif](race.gif), the same start, in real time."
    return "\n\n".join(["## Figures", *shown, film])


def draw_goals(contest: GoalContest, compared: Compared, out: Path) -> str:
    """Draws figure and film of a comparison with goals. Returns them as Markdown."""
    task, fps = COURSES[type(contest.task)].name, 1.0 / contest.scene.control_step_s
    with _figure(out / f"{task}.png", (10.0, 4.0), 2, shared=False) as (done, learning):
        _shares_done(done, compared.whole)
        for summary in compared.training.summaries:
            steps, rewards = np.array(summary["curve"]).reshape(-1, 2).T
            learning.plot(1e-3 * steps, rewards, color=COLOURS[LEARNED], lw=1.0)
        learning.set_xlabel("thousand environment steps, each seed")
        learning.set_ylabel(f"reward while exploring [{compared.training.summaries[0]['curve_unit']}]")
    frames = list(_film(contest, compared))
    write_mp4(out / f"{task}.mp4", frames, fps)
    write_gif(out / f"{task}.gif", frames[::5], fps / 5, 0.75)
    film = f"Animation of the best seed: [{task}.mp4]({task}.mp4), [{task}.gif]({task}.gif)."
    return f"![Share of the goal done against time, and learning]({task}.png)\n\n{film}"


DRAWN: dict[type[Contest], Callable[[Any, Compared, Path], str]] = {
    CrawlContest: draw_crawl,
    GoalContest: draw_goals,
}
"""What draws the figures of a comparison."""


def _speeds(axes: Any, rows: dict[str, list[Row]]) -> None:
    """Bars of all drives, grouped by robot."""
    titles = [row.title for row in next(iter(rows.values()))]
    width = 0.8 / len(titles)
    for number, title in enumerate(titles):
        speeds = [of_robot[number].interval(SPEED).scaled(MM_PER_M) for of_robot in rows.values()]
        places = np.arange(len(speeds)) + (number - 0.5 * (len(titles) - 1)) * width
        values = np.array([speed.value for speed in speeds])
        errors = np.abs(np.array([(speed.low, speed.high) for speed in speeds]).T - values)
        axes.bar(places, values, 0.92 * width, color=COLOURS[title], label=title)
        axes.errorbar(places, values, errors, fmt="none", ecolor="#222222", capsize=3, lw=1.2)
    axes.set_xticks(np.arange(len(rows)), list(rows), rotation=30 if len(rows) > 5 else 0)
    axes.axhline(0.0, color="#222222", lw=0.8)
    axes.set_ylabel("crawling speed [mm/s]")
    if len(rows) > 1:
        axes.set_xlabel("robot, magnets counted from 0 at the head")
    _legend_above(axes, 3)


def _speed_curves(axes: Any, rows: list[Row]) -> None:
    """Crawling speed against drive speed, with the free drives as lines."""
    for row in rows:
        title, colour, speed = row.title, COLOURS[row.title], row.interval(SPEED).scaled(MM_PER_M)
        if title in (LEARNED, STROKE):
            axes.axhline(speed.value, color=colour, ls="--", label=title)
            axes.axhspan(speed.low, speed.high, color=colour, alpha=0.15, lw=0)
        elif title != "tow":
            drive, crawl = MM_PER_M * np.array(row.found[0]["curve"]).T
            label = f"{title} (best stroke at each speed)" if title == "shuttle" else title
            axes.plot(drive, crawl, "o-", ms=3.5, color=colour, label=label)
    axes.set_xlabel("speed of the belt, or of the work stroke [mm/s]")
    axes.set_ylabel("crawling speed [mm/s]")
    _legend_above(axes, 2)


def _learning_curves(axes: Any, compared: Compared, step_s: float) -> None:
    """Training and search against simulated time, with the best belt as a line."""
    for number, summary in enumerate(compared.training.summaries):
        steps, speeds = np.array(summary["curve"]).reshape(-1, 2).T
        label = "learned policy, while exploring" if number == 0 else None
        if len(speeds) >= SMOOTHED_POINTS:
            speeds = np.convolve(speeds, np.ones(SMOOTHED_POINTS) / SMOOTHED_POINTS, mode="valid")
            steps = steps[SMOOTHED_POINTS - 1 :]
        axes.plot(steps * step_s, speeds, color=COLOURS[LEARNED], lw=1.3, label=label)
    for number, found in enumerate(compared.of(STROKE).found):
        times, bests = np.array(found["curve"]).T
        label = "CMA-ES stroke, best so far" if number == 0 else None
        axes.plot(times, MM_PER_M * bests, color=COLOURS[STROKE], lw=1.3, label=label)
    best = best_belt(compared.whole)
    speed_mm_s = MM_PER_M * best.interval(SPEED).value
    axes.axhline(speed_mm_s, color=COLOURS[best.title], ls="--", label=best.title)
    axes.set_xlabel("simulated time of one seed [s]")
    axes.set_ylabel("crawling speed [mm/s]")
    axes.legend(frameon=False, fontsize=9)


def _portraits(panels: Any, recordings: dict[str, Recording], limits: dict[str, float]) -> None:
    """The path of the drive magnet relative to the robot centre; darker is later."""
    low, high, reach = (MM_PER_M * limits[name] for name in ("lowest_m", "highest_m", "reach_m"))
    for axes, (title, recording) in zip(panels, recordings.items(), strict=True):
        step_s = float(recording.time_s[1] - recording.time_s[0])
        last = slice(-max(2, round(PORTRAIT_S / step_s)), None)
        relative = recording.drive_positions[last] - recording.centre[last, None] * (1.0, 0.0)
        shades = mpl.colors.LinearSegmentedColormap.from_list("shades", ["#ffffff", COLOURS[title]])
        for x, y in MM_PER_M * np.moveaxis(relative, (1, 2), (0, 1)):
            # A belt closes on itself out of sight: that jump is no path.
            shown = np.where(np.abs(x) < SEEN_MM, x, np.nan)
            axes.plot(shown, y, color=COLOURS[title], lw=0.9, alpha=0.45)
            axes.scatter(shown, y, c=np.linspace(0.25, 1.0, len(y)), cmap=shades, vmin=0, vmax=1, s=7)
        axes.axvline(0.0, color="#999999", lw=0.6)
        axes.set_xlim(-1.15 * reach, 1.15 * reach)
        axes.set_ylim(low - 0.08 * (high - low), high + 0.08 * (high - low))
        axes.set_title(title, fontsize=10)
        axes.set_xlabel("drive x - robot centre [mm]")
    panels[0].set_ylabel("drive height [mm]")


def _shares_done(axes: Any, rows: list[Row]) -> None:
    """The share of the goal done against time; a band is the range of seeds."""
    for row in rows:
        curves = np.array(row.curves)
        time_s, shares = curves[0, :, 0], 100.0 * curves[:, :, 1]
        axes.plot(time_s, shares.mean(axis=0), color=COLOURS[row.title], label=row.title)
        low, high = shares.min(axis=0), shares.max(axis=0)
        axes.fill_between(time_s, low, high, color=COLOURS[row.title], alpha=0.15, lw=0)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("share of the goal done, all goals [%]")
    axes.legend(frameon=False)


def _film(contest: GoalContest, compared: Compared) -> Iterator[NDArray[np.uint8]]:
    """The best policy towards one goal, from above and from the side."""
    recording, goal, left = contest.film(compared)
    view = SpaceView(contest.scene.geometry, 800, 400)
    for at, time_s in enumerate(recording.time_s):
        still = f"{MM_PER_M * left[at]:.1f} mm" if goal.heading_rad is None else f"{left[at]:.1f}°"
        yield view.draw(recording.at(at), f"{time_s:.2f} s, {still} left", goal)


def _legend_above(axes: Any, columns: int) -> None:
    axes.legend(frameon=False, fontsize=9, ncols=columns, loc="lower center", bbox_to_anchor=(0.5, 1.0))


@contextmanager
def _figure(
    path: Path, size: tuple[float, float] = (6.4, 4.0), columns: int = 1, shared: bool = True
) -> Iterator[Any]:
    """Gives axes, or a row of them, and saves the figure at the end."""
    with mpl.rc_context(STYLE), replace_file(path) as part:
        figure, axes = plt.subplots(
            1, columns, figsize=size, sharex=shared, sharey=shared, squeeze=columns == 1, layout="constrained"
        )
        yield axes if columns == 1 else axes[0]
        figure.savefig(part, format="png")
        plt.close(figure)
