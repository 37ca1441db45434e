"""Settings of a training: read from TOML, overridden by flags, kept as JSON beside the run."""

import dataclasses
import json
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from magworm_gym.learning.command_line import UsageError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2] / "training"
CONFIGS = ROOT / "configs"
ALGORITHMS = ("ppo", "sac")
TRAINED_TASKS = ("crawl", "turn", "reach")
UNITS = {"crawl": "mm/s", "turn": "°/s", "reach": "mm/s"}
"""Unit of the reward of each task, per second."""
TABLES = ("run", "policy", "learning_rate", "algorithm")


@dataclass(frozen=True)
class TrainingSettings:
    """Everything that decides a training.

    Attributes:
        task: "crawl", "turn" or "reach".
        algorithm: "ppo" or "sac", from Stable-Baselines3.
        scene: Preset, or path of a TOML file.
        num_envs: Environments in the batch.
        steps: Environment steps of each seed.
        seeds: Seeds; each gives one policy.
        episode_steps: Control steps of an episode.
        checkpoint_steps: Environment steps between checkpoints.
        removed_share: Share of environments with magnets taken out, 0 to 1.
        parameter_spread: Share by which parameters of an environment differ from the scene's, 0 to 0.9.
        policy: Table [policy]: hidden, activation, normalise, log_std_init, teacher.
        learning_rate: Table [learning_rate]: start and end.
        options: Table [algorithm]: arguments of the algorithm.
    """

    task: str = "crawl"
    algorithm: str = "ppo"
    scene: str = "paper-3"
    num_envs: int = 256
    steps: int = 2_000_000
    seeds: tuple[int, ...] = (0, 1, 2)
    episode_steps: int = 400
    checkpoint_steps: int = 500_000
    removed_share: float = 0.0
    parameter_spread: float = 0.0
    policy: dict[str, Any] = field(default_factory=dict)
    learning_rate: dict[str, float] = field(default_factory=dict)
    options: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Checks ranges. Raises UsageError naming the setting, its value and what is allowed."""
        if self.task not in TRAINED_TASKS:
            raise UsageError(f"task is {self.task!r}; allowed: {', '.join(TRAINED_TASKS)}")
        if self.algorithm not in ALGORITHMS:
            raise UsageError(f"algorithm is {self.algorithm!r}; allowed: {', '.join(ALGORITHMS)}")
        for name in ("num_envs", "steps", "episode_steps", "checkpoint_steps"):
            value = getattr(self, name)
            if not isinstance(value, int) or value < 1:
                raise UsageError(f"{name} is {value!r}; it must be a whole number of at least 1")
        if not self.seeds or any(seed < 0 for seed in self.seeds) or len(set(self.seeds)) < len(self.seeds):
            raise UsageError(f"seeds are {list(self.seeds)}; they must be different whole numbers from 0 on")
        if not 0.0 <= self.removed_share <= 1.0:
            raise UsageError(f"removed_share is {self.removed_share}; it must lie between 0 and 1")
        if not 0.0 <= self.parameter_spread <= 0.9:
            raise UsageError(f"parameter_spread is {self.parameter_spread}; it must lie between 0 and 0.9")

    def to_json(self) -> dict[str, Any]:
        """The settings as plain values."""
        return {**dataclasses.asdict(self), "seeds": list(self.seeds)}


def settings_from(values: dict[str, Any]) -> TrainingSettings:
    """Makes settings of plain values.

    Raises:
        UsageError: An unknown name or a value out of range.
    """
    known = {entry.name for entry in dataclasses.fields(TrainingSettings)}
    unknown = sorted(values.keys() - known)
    if unknown:
        raise UsageError(f"unknown setting {unknown[0]!r}; known: {', '.join(sorted(known))}")
    return TrainingSettings(**{**values, "seeds": tuple(values.get("seeds", (0, 1, 2)))})


def read_toml(path: Path) -> dict[str, Any]:
    """Reads a TOML file.

    Raises:
        UsageError: The file is missing or is not TOML.
    """
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError:
        raise UsageError(f"there is no readable file {path}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UsageError(f"{path} is not TOML: {error}") from None


def read_settings(path: Path, overrides: dict[str, Any]) -> TrainingSettings:
    """Reads settings from TOML and replaces those that flags give.

    Args:
        path: File with the tables [run], [policy], [learning_rate], [algorithm].
        overrides: Settings of [run] by name.

    Raises:
        UsageError: The file cannot be read, or a setting is unknown or out of range.
    """
    tables = read_toml(path)
    unknown = sorted(tables.keys() - set(TABLES))
    if unknown:
        raise UsageError(f"{path} has the unknown table [{unknown[0]}]; known: {', '.join(TABLES)}")
    values = {**tables.get("run", {}), **overrides}
    values["policy"] = tables.get("policy", {})
    values["learning_rate"] = tables.get("learning_rate", {})
    values["options"] = tables.get("algorithm", {})
    return settings_from(values)


def read_saved_settings(path: Path) -> TrainingSettings:
    """Reads settings that a run has kept as JSON.

    Raises:
        UsageError: There is no such file.
    """
    try:
        return settings_from(json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError):
        raise UsageError(f"there is no training to go on with: {path} cannot be read") from None
