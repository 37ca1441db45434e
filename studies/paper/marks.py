"""What several figures of the page mark alike: the paper's numbers, the reach of its platform."""

from typing import Any

from studies.kit.figures import FAINT, REFERENCE

PLATFORM_MM_S = 210.0
"""Paper: the platform's limit."""
WAYS = ({"marker": "o", "ls": "-"}, {"marker": "s", "ls": "--", "mfc": "white"})
"""Looks of lines: the usual one, the other."""


def mark_paper(axes: Any, x: float, y: float, label: str | None) -> None:
    """A number of the paper at a place of the axes."""
    axes.plot([x], [y], "D", color=REFERENCE, ms=5.5, mfc="white", mew=1.4, zorder=6, label=label, ls="none")


def over_speed(axes: Any, last_mm_s: float, label: str = "speed of the drive [mm/s]") -> None:
    """Makes the axes those of a sweep of speeds, shaded where the paper's platform cannot follow."""
    axes.axhline(0.0, color=REFERENCE, lw=0.6)
    if last_mm_s > PLATFORM_MM_S:
        axes.axvspan(PLATFORM_MM_S, last_mm_s + 10.0, color=FAINT, alpha=0.35, lw=0)
    axes.set_xlim(0.0, last_mm_s + 10.0)
    axes.set_xlabel(label)


def draw_spread(axes: Any, x: Any, mean: Any, spread: Any, **style: Any) -> None:
    """A line with bars of its standard deviation."""
    axes.errorbar(x, mean, spread, ms=3.5, lw=1.3, elinewidth=0.9, **style)
