"""What each effect and each phase of a step costs, in instructions of a solver step of eight robots."""

from collections.abc import Mapping
from dataclasses import dataclass

from studies.needs.counts import count, for_all, phases

Counts = Mapping[str, float]

SIDES = ("plane", "space")
"""Suffixes of the tasks: paper-3, and the same robot in space, turn-3."""
TASKS = {
    "paper-3": "step-plane",
    "turn-3": "step-space",
    "belt-125": "belt-plane",
    "belt-125 with 16": "belt-16-plane",
}
"""Scenes with the task that steps each."""
HELD = {
    "paper-3": "held-plane",
    "turn-3": "held-space",
    "belt-125 with 16": "held-belt-16-plane",
}
"""The same where wrenches are computed in one of five steps."""


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
    without: str = "bare"
    phases: tuple[str, ...] = ()


EFFECTS = (
    Effect("gravity", "gravity", phases=("gravity",)),
    Effect("damping of the rubber", "damping"),
    Effect("rubber that relaxes, one branch", "relaxation"),
    Effect("one drive magnet", "drive", phases=("magnets", "drive")),
    Effect("a uniform field", "field", phases=("magnets",)),
    Effect("magnets on each other", "mutual", phases=("mutual magnets",)),
    Effect("a magnet lost", "damage"),
    Effect("ground, robots in the air", "ground"),
    Effect("magnets on each other, robots crawling", "step", "no-mutual", ("mutual magnets",)),
    Effect("friction and adhesion, robots crawling", "step", "no-friction"),
    Effect("adhesion, robots crawling", "step", "no-adhesion"),
)


@dataclass(frozen=True)
class Phase:
    """Instructions of a phase of a task's step."""

    task: str
    phase: str
    instructions: float


def count_phases() -> list[Phase]:
    """Counts the phases of all tasks that the page splits into them."""
    named = ["step", "air", "no-ground", *(effect.with_it for effect in EFFECTS if effect.phases)]
    wanted = [f"{name}-{side}" for name in dict.fromkeys(named) for side in SIDES]
    wanted += [task for task in (*TASKS.values(), *HELD.values()) if task not in wanted]
    found = for_all(count, [(task, phase) for task in wanted for phase in phases(task)])
    return [Phase(*names, instructions) for names, instructions in found.items()]


def by_task(found: list[Phase]) -> dict[str, dict[str, float]]:
    """Instructions of phases, by task and phase."""
    tasks: dict[str, dict[str, float]] = {}
    for one in found:
        tasks.setdefault(one.task, {})[one.phase] = one.instructions
    return tasks


@dataclass(frozen=True)
class Cost:
    """Instructions of an effect in the plane or in space.

    Attributes:
        words: The effect.
        side: Plane or space.
        without: Instructions of the scene without it.
        with_it: Of the scene with it.
        rest: What the scene with it takes beside the effect's own phases, over the scene without, less one;
            none where it has no phases of its own.
    """

    words: str
    side: str
    without: float
    with_it: float
    rest: float | None


def costs(counts: Counts, of_phases: Mapping[str, Counts]) -> list[Cost]:
    """All effects, in the plane and in space."""
    return [cost(effect, side, counts, of_phases) for effect in EFFECTS for side in SIDES]


def cost(effect: Effect, side: str, counts: Counts, of_phases: Mapping[str, Counts]) -> Cost:
    """One effect."""
    without, with_it = counts[f"{effect.without}-{side}"], counts[f"{effect.with_it}-{side}"]
    rest = None
    if effect.phases:
        own = sum(of_phases[f"{effect.with_it}-{side}"][phase] for phase in effect.phases)
        rest = (with_it - own) / without - 1.0
    return Cost(effect.words, side, without, with_it, rest)
