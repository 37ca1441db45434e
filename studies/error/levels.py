"""What `solver.accuracy` costs and how far it is off, for the robot in the plane and in space."""

import statistics
from collections.abc import Iterator
from dataclasses import dataclass

from magworm_gym import Scene
from studies.error.cases import CASES
from studies.error.errors import Error, errors
from studies.error.settings import MS, Settings, quarter
from studies.kit.passes import values_of
from studies.speed.rates import measured

LEVELS = {"fast": 50, "balanced": 50, "reference": 10}
"""Words, and control steps of each timed run; the reference is slow."""
TASKS = {"crawl": ("MagWorm/Crawl-v0", "paper-3"), "turn": ("MagWorm/Turn-v1", "turn-3")}
"""Environment and preset by case."""


@dataclass(frozen=True)
class Level:
    """What a word stands for in a case, errors against its reference, environment steps per second by run."""

    case: str
    word: str
    settings: Settings
    errors: tuple[Error, ...]
    steps_per_second: tuple[float, ...]

    @property
    def median_per_second(self) -> float:
        """The middle of the runs."""
        return statistics.median(self.steps_per_second)


def levels(repetitions: int) -> Iterator[Level]:
    """Measures the words for both cases; the last one is the case's reference, or close to it."""
    for name, (task, preset) in TASKS.items():
        reference = CASES[name].run(CASES[name].reference)
        for word, control_steps in LEVELS.items():
            scene = Scene.preset(preset).with_values({"solver.accuracy": word})
            found = CASES[name].run(settings_of(scene))
            rates, _ = measured(task, scene, repetitions, control_steps=control_steps)
            yield Level(name, word, settings_of(scene), tuple(errors(found, reference, {})), tuple(rates))


def settings_of(scene: Scene) -> Settings:
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
