"""What each effect and each phase of a step costs, in instructions of a solver step of eight robots."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from studies.needs.counts import THREADS, count, phases

SIDES = ("plane", "space")
"""Suffixes of the tasks: paper-3, and the same robot in space, turn-3."""


@dataclass(frozen=True)
class Effect:
    """An optional effect.

    Attributes:
        words: What it is.
        with_it: Task of a scene that has it, without suffix.
        without: Task of the scene without.
        phases: The phases that only a scene with it has; none where it changes what other phases compute.
    """

    words: str
    with_it: str
    without: str
    phases: tuple[str, ...] = ()


EFFECTS = (
    Effect("gravity", "gravity", "bare", ("gravity",)),
    Effect("damping of the rubber", "damping", "bare"),
    Effect("rubber that relaxes, one branch", "relaxation", "bare"),
    Effect("one drive magnet", "drive", "bare", ("magnets", "drive")),
    Effect("a uniform field", "field", "bare", ("magnets",)),
    Effect("magnets on each other", "mutual", "bare", ("mutual magnets",)),
    Effect("a magnet lost", "damage", "bare"),
    Effect("ground, robots in the air", "ground", "bare"),
    Effect("magnets on each other, robots crawling", "step", "no-mutual", ("mutual magnets",)),
    Effect("friction and adhesion, robots crawling", "step", "no-friction"),
    Effect("adhesion, robots crawling", "step", "no-adhesion"),
)


def count_phases(tasks: tuple[str, ...]) -> dict[str, dict[str, float]]:
    """Instructions of each phase of a step, by task."""
    pairs = [(task, phase) for task in tasks for phase in phases(task)]
    with ThreadPoolExecutor(THREADS) as pool:
        counted = list(pool.map(lambda pair: count(*pair), pairs))
    of_phases: dict[str, dict[str, float]] = {task: {} for task in tasks}
    for (task, phase), instructions in zip(pairs, counted, strict=True):
        of_phases[task][phase] = instructions
    return of_phases


def own_phases(effect: Effect, side: str, of_phases: Mapping[str, Mapping[str, float]]) -> float | None:
    """Instructions of the phases that a scene has for an effect alone; none where it has no such phase."""
    if not effect.phases:
        return None
    return sum(of_phases[f"{effect.with_it}-{side}"][phase] for phase in effect.phases)
