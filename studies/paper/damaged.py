"""Robots with magnets taken out: which of them still crawl?"""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from studies.kit.figures import BLUE, ORANGE, REFERENCE, legend_above, panels
from studies.kit.passes import AHEAD_M, robot
from studies.kit.words import COUNTS, listed
from studies.paper.experiment import Experiment, Numbers
from studies.paper.passes import CRAWLS_MM, Strides, Walk, measured_strides

SPEEDS_MM_S = (60.0, 100.0, 140.0, 180.0, 210.0)
SHOWN = SPEEDS_MM_S.index(100.0)
LOWEST_MM = -10.0
DIRECTIONS = ("forward", "backward")
"""Drive from head to tail, and from tail to head."""
TAKEN_OUT = ((5, 1), (5, 2), (4, 1), (5, 3), (4, 2), (3, 1))
"""Magnets, and how many of them are taken out."""
SETS = [(n, out) for n, count in TAKEN_OUT for out in itertools.combinations(range(n), count)]
"""Magnets of each robot, and which of them are taken out, counted from 0 at the head."""
NAMES = ["".join("○" if k in out else "●" for k in range(n)) for n, out in SETS]


@dataclass(frozen=True)
class Damaged(Experiment):
    """Every damaged robot at every speed in both directions.

    Attributes:
        strides: Its strides (robots, directions, speeds).
    """

    name: ClassVar[str] = "damaged"
    strides: Strides

    @classmethod
    def measured(cls) -> "Damaged":
        """Runs all robots."""
        scenes = [robot(n).with_values({"body.removed": list(out)}) for n, out in SETS]
        walks = [Walk(scene, v, back) for scene in scenes for back in (False, True) for v in SPEEDS_MM_S]
        strides = measured_strides(walks, aheads_m=(AHEAD_M,))
        return cls(strides.reshaped(len(SETS), len(DIRECTIONS), len(SPEEDS_MM_S)))

    @property
    def best(self) -> list[tuple[Strides, str]]:
        """The best stride of each robot, and where it was made; of equals the first."""
        wheres = [f"{direction}, {speed:g} mm/s" for direction in DIRECTIONS for speed in SPEEDS_MM_S]
        flat = self.strides.reshaped(len(SETS), -1)
        marks = np.where(flat.carried == 0.0, flat.mean_mm - flat.spread_mm, -1e3 * (1.0 + flat.carried))
        return [(flat[row, at], wheres[at]) for row, at in enumerate(marks.argmax(axis=1))]

    @property
    def rows(self) -> Iterator[tuple[str, list[Strides], Strides, str]]:
        """Of the table: name, strides at 100 mm/s in both directions, the best and where it was made."""
        for row, (name, (best, where)) in enumerate(zip(NAMES, self.best, strict=True)):
            yield name, [self.strides[row, way, SHOWN] for way in range(len(DIRECTIONS))], best, where

    @property
    def groups(self) -> Iterator[str]:
        """How many crawl of those with equally many magnets taken out, and which."""
        for magnets, count in TAKEN_OUT:
            group = self._fit(magnets, count)
            fit = [name for name, crawls in group.items() if crawls]
            which = f": {listed(fit)}" if 0 < len(fit) < len(group) else ""
            yield f"{COUNTS[magnets]} magnets, {count} taken out: {len(fit)} of {len(group)} crawl{which}"

    def numbers(self) -> Numbers:
        """How many robots crawl."""
        fit = {pair: sum(self._fit(*pair).values()) for pair in TAKEN_OUT}
        return {
            "damage.pairs": fit[5, 2],
            "damage.four": fit[4, 1],
            "damage.three": fit[3, 1],
            "damage.two_left": fit[5, 3] + fit[4, 2] + fit[3, 1],
        }

    def _fit(self, magnets: int, count: int) -> dict[str, bool]:
        """Which robots crawl, of those with this many magnets and so many taken out."""
        each = zip(NAMES, SETS, self.best, strict=True)
        return {
            name: bool(best.crawls) for name, (n, out), (best, _) in each if (n, len(out)) == (magnets, count)
        }

    def figures(self) -> dict[str, Any]:
        """Strides of all robots."""
        figure, axis = panels(1, 1, (9.2, 3.6))
        places = np.arange(len(SETS))
        for column, (offset, shade) in enumerate(((-0.2, BLUE), (0.2, ORANGE))):
            strides = self.strides[:, column, SHOWN]
            walked = strides.carried == 0.0
            label = DIRECTIONS[column]
            error = {"yerr": strides.spread_mm[walked], "error_kw": {"lw": 0.9}}
            axis.bar(
                places[walked] + offset, strides.mean_mm[walked], 0.38, color=shade, label=label, **error
            )
            gone = places[~walked] + offset
            label = "carried along" if column else ""
            axis.plot(gone, np.full(len(gone), LOWEST_MM + 0.6), "v", color=shade, ms=4, label=label or None)
        axis.axhline(0.0, color=REFERENCE, lw=0.8)
        axis.axhline(CRAWLS_MM, color=REFERENCE, lw=0.7, ls=":", label="counts as crawling")
        kinds = [(n, len(out)) for n, out in SETS]
        for place, (before, after) in enumerate(itertools.pairwise(kinds)):
            if before != after:
                axis.axvline(place + 0.5, color=REFERENCE, lw=0.5)
        axis.set_xticks(places, ["\n".join(name) for name in NAMES], fontsize=8, linespacing=0.9)
        axis.set_xlim(-0.7, len(SETS) - 0.3)
        axis.set_ylim(bottom=LOWEST_MM)
        axis.set_ylabel("stride at 100 mm/s [mm]")
        legend_above(figure, axis, 4)
        return {"damaged": figure}
