"""Robots with magnets taken out: which of them still crawl?"""

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from studies.paper.figures import BLUE, ORANGE, PAPER, legend_above, panels
from studies.paper.passes import Stride, Walk, measured_strides
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import AHEAD_M, PASS_SPEED_M_S, robot
from studies.paper.section import Image, Section, table
from studies.paper.wording import COUNTS, listed

SPEEDS_M_S = (0.060, PASS_SPEED_M_S, 0.140, 0.180, 0.210)
CRAWLS_M = 0.5e-3
"""Ours: a robot crawls if it makes more than this in a pass and more than the spread of its passes."""
LOWEST_MM = -10.0
TAKEN_OUT = ((5, 1), (5, 2), (4, 1), (5, 3), (4, 2), (3, 1))
"""Magnets, and how many of them are taken out."""


@dataclass(frozen=True)
class Damaged:
    """One damaged robot.

    Attributes:
        magnets: Number of its feet.
        removed: Magnets taken out, counted from 1 at the head.
        forward: Strides at :data:`SPEEDS_M_S`, drive from head to tail.
        backward: The same, drive from tail to head.
    """

    magnets: int
    removed: tuple[int, ...]
    forward: list[Stride]
    backward: list[Stride]

    @property
    def best(self) -> tuple[Stride, str]:
        """The best stride of all directions and speeds, and where it was made."""
        ways = ((self.forward, "forward"), (self.backward, "backward"))
        found = [
            (stride, f"{direction}, {MM * speed:g} mm/s")
            for strides, direction in ways
            for stride, speed in zip(strides, SPEEDS_M_S, strict=True)
        ]
        return max(found, key=lambda item: (-item[0].carried, item[0].mean_m - item[0].spread_m))

    @property
    def crawls(self) -> bool:
        """Whether it crawls at some speed in some direction."""
        return crawls(self.best[0])

    @property
    def name(self) -> str:
        """Its magnets: ● in place, ○ taken out, head first."""
        return "".join("○" if k + 1 in self.removed else "●" for k in range(self.magnets))


def crawls(stride: Stride) -> bool:
    """Whether a stride counts as crawling: against the drive, clear of its spread, never carried along."""
    return stride.mean_m > max(CRAWLS_M, stride.spread_m) and stride.carried == 0.0


def damaged_section() -> Section:
    """Runs every damaged robot at every speed in both directions."""
    sets = [(n, out) for n, count in TAKEN_OUT for out in itertools.combinations(range(n), count)]
    scenes = [robot(n).with_values({"body.removed": list(out)}) for n, out in sets]
    walks = [Walk(s, v, back) for s in scenes for back in (False, True) for v in SPEEDS_M_S]
    strides = measured_strides(walks, aheads_m=(AHEAD_M,))
    width = len(SPEEDS_M_S)
    robots = []
    for i, (n, out) in enumerate(sets):
        mine = strides[2 * width * i : 2 * width * (i + 1)]
        robots.append(Damaged(n, tuple(k + 1 for k in out), mine[:width], mine[width:]))
    return Section(
        title="Magnets taken out",
        text=_text(robots),
        images=[
            Image(
                "damaged",
                "Stride at 100 mm/s with magnets taken out (○), head on top, drive from the head (forward) "
                "and from the tail (backward). Triangles: carried along by the drive.",
                _figure(robots),
            )
        ],
        quantities=_quantities(robots),
        data={
            r.name: {"best_mm": MM * r.best[0].mean_m, "at": r.best[1], "crawls": r.crawls} for r in robots
        },
    )


def _quantities(robots: list[Damaged]) -> list[Quantity]:
    def crawling(
        key: str, what: str, chosen: list[Damaged], claim: str, holds: tuple[float, float]
    ) -> Quantity:
        count = sum(robot.crawls for robot in chosen)
        return Quantity(
            f"damage.{key}",
            f"{what}: robots that crawl, of {len(chosen)}",
            "",
            count,
            Origin.HELD_BACK,
            claim=claim,
            holds=holds,
            digits=0,
        )

    pairs = [r for r in robots if r.magnets == 5 and len(r.removed) == 2]
    fours = [r for r in robots if r.magnets == 4 and len(r.removed) == 1]
    threes = [r for r in robots if r.magnets == 3 and len(r.removed) == 1]
    twos = [r for r in robots if r.magnets - len(r.removed) == 2]
    some = "crawls (at least one)"
    return [
        crawling("pairs", "Five magnets, two taken out", pairs, some, (1, len(pairs))),
        crawling("four", "Four magnets, one taken out", fours, some, (1, len(fours))),
        crawling("three", "Three magnets, one taken out", threes, "three are the minimum (none)", (0, 0)),
        crawling(
            "two_left",
            "Two magnets left in three, four or five feet",
            twos,
            "three are the minimum (none)",
            (0, 0),
        ),
    ]


def _text(robots: list[Damaged]) -> str:
    rows, sentences = [], []
    at = SPEEDS_M_S.index(PASS_SPEED_M_S)
    for robot_ in robots:
        best, where = robot_.best
        rows.append(
            [
                robot_.name,
                _words(robot_.forward[at]),
                _words(robot_.backward[at]),
                _words(best) if best.carried == 1.0 else f"{_words(best)} ({where})",
                "yes" if robot_.crawls else "**no**",
            ]
        )
    for magnets, count in TAKEN_OUT:
        group = [r for r in robots if r.magnets == magnets and len(r.removed) == count]
        fit = [r.name for r in group if r.crawls]
        which = f": {listed(fit)}" if 0 < len(fit) < len(group) else ""
        sentences.append(
            f"- {COUNTS[magnets]} magnets, {count} taken out: {len(fit)} of {len(group)} crawl{which}"
        )
    return (
        f"Each robot was driven in both directions at {listed([f'{MM * speed:g}' for speed in SPEEDS_M_S])} "
        f"mm/s. It counts as crawling where it makes more than {MM * CRAWLS_M:g} mm against the motion of "
        "the drive in a pass, more than the spread of its passes, and is never carried along. A foot whose "
        "magnet is taken out stays as stiff as before. The paper shows one pair without saying which, and "
        "states three magnets as the minimum.\n\n"
        + "\n".join(sentences)
        + "\n\n"
        + table(["robot, head first", "forward, 100 mm/s", "backward, 100 mm/s", "best", "crawls"], rows)
    )


def _words(stride: Stride) -> str:
    if stride.carried == 1.0:
        return "carried along"
    text = f"{number(MM * stride.mean_m, 1)} ± {number(MM * stride.spread_m, 1)} mm"
    return f"{text}, carried along in {100.0 * stride.carried:.0f} % of the runs" if stride.carried else text


def _figure(robots: list[Damaged]) -> Any:
    figure, axis = panels(1, 1, (9.2, 3.6))
    at, places = SPEEDS_M_S.index(PASS_SPEED_M_S), np.arange(len(robots))
    sides = ((-0.2, "forward", BLUE), (0.2, "backward", ORANGE))
    for offset, direction, shade in sides:
        strides = [(r.forward if direction == "forward" else r.backward)[at] for r in robots]
        walked = np.array([s.carried == 0.0 for s in strides])
        means, spreads = MM * np.array([(s.mean_m, s.spread_m) for s in strides])[walked].T
        axis.bar(
            places[walked] + offset,
            means,
            0.38,
            yerr=spreads,
            color=shade,
            error_kw={"lw": 0.9},
            label=direction,
        )
        gone = places[~walked] + offset
        label = "carried along" if direction == "backward" else None
        axis.plot(gone, np.full(len(gone), LOWEST_MM + 0.6), "v", color=shade, ms=4, label=label)
    axis.axhline(0.0, color=PAPER, lw=0.8)
    axis.axhline(MM * CRAWLS_M, color=PAPER, lw=0.7, ls=":", label="counts as crawling")
    groups = [(r.magnets, len(r.removed)) for r in robots]
    for i in range(1, len(groups)):
        if groups[i] != groups[i - 1]:
            axis.axvline(i - 0.5, color=PAPER, lw=0.5)
    axis.set_xticks(places, ["\n".join(r.name) for r in robots], fontsize=8, linespacing=0.9)
    axis.set_xlim(-0.7, len(robots) - 0.3)
    axis.set_ylim(bottom=LOWEST_MM)
    axis.set_ylabel("stride at 100 mm/s [mm]")
    legend_above(figure, axis, 4)
    return figure
