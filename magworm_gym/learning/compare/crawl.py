"""The comparison of crawling: belts, a shuttle, searched strokes and a tow, on whole and damaged robots."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines import PAPER_PITCHES_M, Controller, Recording, Runner, Trial, belt_starts, record
from magworm_gym.learning.compare import rivals
from magworm_gym.learning.compare.budget import CrawlBudget
from magworm_gym.learning.compare.contest import FIRST_SEED, Contest
from magworm_gym.learning.compare.rivals import LEARNED, STROKE, Drive, Plain, Removed, Rival
from magworm_gym.learning.compare.rows import MM_PER_M, Compared, Measure, Row
from magworm_gym.learning.compare.words import page, verdict
from magworm_gym.learning.results import Column, Report, Table
from magworm_gym.randomise import FEWEST_MAGNETS

SPEED = Measure("speed_m_s", "speed", "mm/s", ".2f", MM_PER_M)
TOWED_SHARE = 0.5
"""A tow that reaches this share of the best speed is worth a warning."""


class CrawlContest(Contest):
    """Who crawls fastest? Samples are speeds towards the head."""

    budget_kind = CrawlBudget
    made_by = (Runner, Trial, belt_starts)
    budget: CrawlBudget

    @property
    def robots(self) -> dict[str, Removed]:
        """The whole robot, and it without every set of magnets that leaves three."""
        sets = removable_sets(self.scene.magnets, self.scene.removed)
        return {robot_name(removed, self.scene.removed): removed for removed in sets}

    def rivals(self) -> list[Rival]:
        """See :class:`Contest`."""
        scene, budget, training = self.scene, self.budget, self.training
        steps = max(int(summary["steps"]) for summary in training.summaries)
        words = f"{training.settings.algorithm.upper()}, {steps / 1e6:.2g} million steps"
        return [
            rivals.learned(scene, training.folders, words),
            *(rivals.belt(scene, pitch, budget.sweep) for pitch in PAPER_PITCHES_M),
            rivals.shuttle(scene, budget.sweep),
            rivals.stroke(scene, budget.search, training.simulated_s),
            rivals.held(scene, budget.sweep),
        ]

    def measured(self, drive: Drive, removed: Removed) -> Plain:
        """See :class:`Contest`."""
        final = self.budget.final
        worms = Runner(drive.scene, final.starts, removed)
        trial = Trial(final.settle_s, final.measure_s)
        return {"samples": {SPEED.key: trial.speed_m_s(worms, *_beginning(drive, final.starts)).tolist()}}

    def recordings(self, compared: Compared) -> dict[str, Recording]:
        """The first start of the best of each rival on the whole robot, but for the tow."""
        recorded = {}
        for row in compared.whole[:-1]:
            drive = row.rival.drive(row.best(SPEED.key))
            worms = Runner(drive.scene, 1, self.scene.removed)
            worms.begin(*_beginning(drive, 1))
            recorded[row.title] = record(worms, self.budget.final.animation_s)
        return recorded

    def report(self, compared: Compared) -> Report:
        """See :class:`Contest`."""
        whole, robots = _table(compared.whole, self.scene.body_length_m), _robots_table(compared)
        return page(
            self,
            "crawl.md.jinja",
            {"intact": whole, "robots": robots},
            verdict=" ".join(_verdict(compared)),
            damaged=len(compared.rows) > 1,
            randomise=self.training.settings.environment.get("randomise", {}),
        )


def removable_sets(magnets: int, lacking: Removed = ()) -> list[Removed]:
    """Every set of body magnets that can be taken out with three left, the smallest first.

    Args:
        magnets: Number of body magnets M, those that the scene lacks included.
        lacking: Magnets that the scene itself lacks; they are part of every set.

    Returns:
        Sets of indices counted from 0 at the head; the first one is ``lacking``.
    """
    left = [magnet for magnet in range(magnets) if magnet not in lacking]
    sizes = range(max(0, len(left) - FEWEST_MAGNETS) + 1)
    chosen = [taken for size in sizes for taken in itertools.combinations(left, size)]
    return [tuple(sorted((*lacking, *taken))) for taken in chosen]


def robot_name(removed: Removed, lacking: Removed = ()) -> str:
    """Name of a robot by the magnets it lacks beside those of the scene, counted from 0 at the head."""
    taken = [str(magnet) for magnet in removed if magnet not in lacking]
    return "without " + " and ".join(taken) if taken else "intact"


def best_belt(rows: Sequence[Row]) -> Row:
    """The faster of the belts."""
    belts = [row for row in rows if row.title.startswith("belt")]
    return max(belts, key=lambda row: row.interval(SPEED).value)


def _beginning(
    drive: Drive, starts: int
) -> tuple[NDArray[np.int64], Controller | None, NDArray[np.float64] | None]:
    """Seeds, controller and start poses of the final measurement."""
    seeds = FIRST_SEED + np.arange(starts)
    if drive.controller is None:
        return seeds, None, belt_starts(drive.pitch_m, starts, FIRST_SEED)
    return seeds, drive.controller(), None


def _verdict(compared: Compared) -> list[str]:
    """How the learned policy compares with belt, shuttle and stroke, and whether a tow is as fast."""
    learned, belt = compared.of(LEARNED), best_belt(compared.whole)
    opponents = [
        ("the best constant-speed belt", belt),
        ("the best shuttle", compared.of("shuttle")),
        ("the best open-loop stroke of CMA-ES", compared.of(STROKE)),
    ]
    sentences = verdict(learned, opponents, SPEED)
    tow = compared.of("tow").interval(SPEED).value
    if tow > TOWED_SHARE * max(row.interval(SPEED).value for row in (learned, belt)):
        sentences.append(
            f"Beware: a magnet held at one place ahead of the robot tows it at {MM_PER_M * tow:.2f} mm/s, so "
            "what wins here need not be a gait."
        )
    return sentences


def _table(rows: Sequence[Row], body_length_m: float) -> Table:
    """One robot, a line for each drive."""
    drive, setting, samples = (Column(name, name) for name in ("drive", "setting", "samples"))
    lengths = Column(SPEED.key, "body lengths/s [95 % interval]", ".3f", 1.0 / body_length_m)
    columns = [drive, setting, SPEED.column("mm/s [95 % interval]"), lengths, samples]
    table = Table(columns, [], f"The {rows[0].robot} robot")
    for row in rows:
        words = {"drive": row.title, "setting": row.rival.describe(row.found)}
        count = f"{len(row.samples[SPEED.key])} {row.sampled_over}"
        table.rows.append({**words, SPEED.key: row.interval(SPEED), "samples": count})
    return table


def _robots_table(compared: Compared) -> Table:
    """All robots, a column for each drive, in mm/s."""
    columns = [Column("robot", "robot")]
    columns += [Column(row.title, row.title, ".1f", SPEED.factor) for row in compared.whole]
    table = Table(columns, [], "Every set of magnets removed that leaves at least three")
    for robot, rows in compared.rows.items():
        table.rows.append({"robot": robot, **{row.title: row.interval(SPEED) for row in rows}})
    return table
