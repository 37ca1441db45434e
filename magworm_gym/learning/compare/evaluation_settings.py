"""Budgets of an evaluation, read from TOML."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from magworm_gym import CRAWL_ID
from magworm_gym.baselines import Trial
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.settings import CONFIGS, TrainingSettings, read_settings, read_toml

Table = TypeVar("Table")


@dataclass(frozen=True)
class SweepBudget:
    """Sweeps of belts and shuttles.

    Attributes:
        speeds: Drive speeds up to the stage's limit.
        starts: Starts of a belt at each speed.
        shuttle_starts: Starts of a shuttle or a tow at each setting.
        settle_s: Time before the speed is measured [s].
        measure_s: Time over which it is measured [s].
    """

    speeds: int = 21
    starts: int = 8
    shuttle_starts: int = 2
    settle_s: float = 1.0
    measure_s: float = 8.0

    @property
    def trial(self) -> Trial:
        """How a speed is measured."""
        return Trial(self.settle_s, self.measure_s)


@dataclass(frozen=True)
class SearchBudget:
    """Search of open-loop strokes; its simulated time is that of the training.

    Attributes:
        seeds: Independent searches.
        control_points: Control points of a stroke.
        scouts: Random strokes tried before.
        population: Strokes for each generation.
        starts: Trials of each stroke.
        settle_s: Time before the speed is measured [s].
        measure_s: Time over which it is measured [s].
        each_robot: Whether damaged robots get searches of their own.
    """

    seeds: int = 3
    control_points: int = 6
    scouts: int = 512
    population: int = 16
    starts: int = 2
    settle_s: float = 0.5
    measure_s: float = 3.0
    each_robot: bool = False


@dataclass(frozen=True)
class FinalBudget:
    """Final measurement, with the same starts for all.

    Attributes:
        first_seed: Seed of the first start; no training or tuning uses it.
        starts: Starts of each drive.
        settle_s: Time before the speed is measured [s].
        measure_s: Time over which it is measured [s].
        animation_s: Duration of the animation [s].
    """

    first_seed: int = 900_000_000
    starts: int = 32
    settle_s: float = 1.0
    measure_s: float = 8.0
    animation_s: float = 8.0


@dataclass(frozen=True)
class Budget:
    """Everything that decides an evaluation, beside the policies.

    Attributes:
        training: Training of the policies, where none are given.
        sweep: Sweeps of belts and shuttles.
        search: Search of strokes.
        final: Final measurement.
    """

    training: TrainingSettings
    sweep: SweepBudget
    search: SearchBudget
    final: FinalBudget


def read_budget(name: str, scene: str | None) -> Budget:
    """Reads a budget.

    Args:
        name: "small", "full" or the path of a TOML file with the tables [training], [sweep],
            [search] and [final].
        scene: Replaces the scene of the training, unless it is None.

    Raises:
        UsageError: The file cannot be read, or a setting is unknown or out of range.
    """
    path = CONFIGS / f"budget-{name}.toml"
    tables = read_toml(path if path.exists() else Path(name))
    unknown = sorted(tables.keys() - {"training", "sweep", "search", "final"})
    if unknown:
        raise UsageError(f"budget {name!r} has the unknown table [{unknown[0]}]")
    training = dict(tables.get("training", {}))
    config = CONFIGS / training.pop("config", "ppo.toml")
    if scene is not None:
        training["environment"] = {**training.get("environment", {}), "scene": scene}
    return Budget(
        read_settings(config, CRAWL_ID, training),
        _table(SweepBudget, "sweep", tables),
        _table(SearchBudget, "search", tables),
        _table(FinalBudget, "final", tables),
    )


def _table(kind: type[Table], name: str, tables: dict[str, Any]) -> Table:
    values = tables.get(name, {})
    known = {entry.name: entry.type for entry in dataclasses.fields(kind)}  # type: ignore[arg-type]
    for key, value in values.items():
        if key not in known:
            raise UsageError(f"[{name}] has the unknown setting {key!r}; known: {', '.join(known)}")
        if not isinstance(value, bool) and not (isinstance(value, int | float) and value >= 0):
            raise UsageError(f"[{name}] {key} is {value!r}; it must be a number of at least 0")
    return kind(**values)
