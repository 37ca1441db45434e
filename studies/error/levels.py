"""What `solver.accuracy` costs and how far it is off, for the robot in the plane and in space."""

from dataclasses import dataclass

from magworm_gym import Scene
from studies.error.case import Case
from studies.error.errors import Errors, errors
from studies.error.settings import MS, Settings, quarter
from studies.paper.scenes import values_of
from studies.throughput import measured

LEVELS = ("fast", "balanced", "reference")
TASKS = {"crawl": ("MagWorm/Crawl-v0", "paper-3"), "turn": ("MagWorm/Turn-v0", "turn-3")}

CONTROL_STEPS = {"fast": 50, "balanced": 50, "reference": 10}
"""Of each run: as many as `studies.throughput` takes, but that the reference is slow."""


@dataclass(frozen=True)
class Level:
    """One word.

    Attributes:
        name: The word.
        settings: What it stands for.
        errors: Against the case's reference.
        steps_per_second: Environment steps per second with random actions on all cores, by run.
    """

    name: str
    settings: Settings
    errors: Errors
    steps_per_second: tuple[float, ...]


def settings_of(name: str, scene: str) -> Settings:
    """What a word stands for in a preset."""
    chosen = Scene.preset(scene).with_values({"solver.accuracy": name})
    return read_settings(chosen)


def read_settings(scene: Scene) -> Settings:
    """Numerical choices of a worm's scene."""
    values = values_of(scene)
    solver, body = values["solver"], values["body"]
    foot_end = body["elements_per_foot_end"]
    return Settings(
        step_ms=round(MS * solver["step_s"], 6),
        elements=body["elements_per_bridge"],
        order=solver["quadrature_order"],
        integrator=solver["integrator"],
        interval=solver["wrench_interval"],
        precision=solver["precision"],
        foot_end=None if foot_end == quarter(body["elements_per_bridge"]) else foot_end,
    )


def levels(case: Case, repetitions: int) -> list[Level]:
    """Measures the words for a case; the last one is its reference, or close to it."""
    task, scene = TASKS[case.name]
    reference = case.run(case.reference)
    found = []
    for name in LEVELS:
        settings = settings_of(name, scene)
        off = errors(case.run(settings), reference, {})
        if off is None:
            raise RuntimeError(f"{case.name} broke down with accuracy {name}")
        changed = Scene.preset(scene).with_values({"solver.accuracy": name})
        rates = measured(task, changed, repetitions, control_steps=CONTROL_STEPS[name])
        found.append(Level(name, settings, off, tuple(rates.per_second)))
    return found
