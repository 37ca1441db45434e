"""Settings of a training: read from TOML, overridden by flags, kept as JSON beside the run.

A file has a table for each environment, named by its identifier, and ``[default]`` for those without one.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, TypeVar

import msgspec
from msgspec import Meta

from magworm_gym import documents
from magworm_gym.documents import Table, Text
from magworm_gym.learning.command_line import UsageError

DEFAULT = "default"
LARGEST_SEED = 2**32 - 1

Count = Annotated[int, Meta(ge=1, le=10**12)]
Arguments = Annotated[dict[str, Any], Meta(description="a table")]
AnyTable = TypeVar("AnyTable", bound=msgspec.Struct)


class TrainingSettings(Table, frozen=True, kw_only=True):
    """Everything that decides a training.

    Attributes:
        environment_id: Identifier of the environment in Gymnasium's registry.
        algorithm: Name of the learner, see :func:`magworm_gym.learning.learner.learner_named`.
        num_envs: Environments in the batch.
        steps: Environment steps of each seed.
        seeds: Seeds; each gives one policy.
        checkpoint_steps: Environment steps between checkpoints.
        environment: Table [environment]: arguments of the environment, such as ``scene``.
        learner: Table [learner]: options of the learner.
    """

    environment_id: Text
    algorithm: Text = "ppo"
    num_envs: Annotated[int, Meta(ge=1, le=10**6)] = 256
    steps: Count = 2_000_000
    seeds: Annotated[
        tuple[Annotated[int, Meta(ge=0, le=LARGEST_SEED)], ...],
        Meta(min_length=1, description=f"different whole numbers from 0 to {LARGEST_SEED}"),
    ] = (0, 1, 2)
    checkpoint_steps: Count = 500_000
    environment: Arguments = msgspec.field(default_factory=dict)
    learner: Arguments = msgspec.field(default_factory=dict)

    def __post_init__(self) -> None:
        """Checks that no seed stands twice."""
        if len(set(self.seeds)) < len(self.seeds):
            raise ValueError(f"seeds is {list(self.seeds)}; allowed: different ones")

    def to_json(self) -> dict[str, Any]:
        """The settings as plain values."""
        plain: dict[str, Any] = msgspec.json.decode(msgspec.json.encode(self))
        return plain


def checked(values: object, kind: type[AnyTable], where: str = "") -> AnyTable:
    """Makes a table of plain values. Raises UsageError that says field, value and what is allowed."""
    table: AnyTable = documents.checked(values, kind, where, UsageError)
    return table


def merged(values: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Values with changes on top; tables are merged entry by entry."""
    result = dict(values)
    for name, change in changes.items():
        before = result.get(name)
        nested = isinstance(before, Mapping) and isinstance(change, Mapping)
        result[name] = merged(dict(before or {}), change) if nested else change
    return result


def read_toml(path: Path) -> dict[str, Any]:
    """Reads a TOML file. Raises UsageError where it is missing or is not TOML."""
    try:
        return documents.parse_toml(path.read_text(encoding="utf-8"), str(path), UsageError)
    except OSError:
        raise UsageError(f"there is no readable file {path}") from None
    except UnicodeDecodeError as error:
        raise UsageError(f"{path} is not TOML: {error}") from None


def read_settings(path: Path | None, environment_id: str, changes: Mapping[str, Any]) -> TrainingSettings:
    """Reads the settings of an environment and changes them.

    Args:
        path: File with tables named by identifiers; None for what the package takes by itself.
        environment_id: Which table; without one of its own an environment has ``[default]``.
        changes: Entries that replace those of the file, tables entry by entry.

    Raises:
        UsageError: The file cannot be read, or a setting is unknown or out of range.
    """
    tables = read_toml(path) if path else {DEFAULT: {}}
    name = environment_id if environment_id in tables else DEFAULT
    table: Any = tables.get(name)
    if not isinstance(table, dict):
        raise UsageError(f"{name!r} in {path} is {table!r}; allowed: a table")
    return checked(merged({**table, "environment_id": environment_id}, changes), TrainingSettings)


def read_saved_settings(path: Path) -> TrainingSettings:
    """Reads settings that a run has kept as JSON. Raises UsageError where they are missing or damaged."""
    try:
        return checked(msgspec.json.decode(path.read_bytes()), TrainingSettings)
    except (OSError, msgspec.DecodeError, RecursionError):
        raise UsageError(f"there is no training to go on with: {path} cannot be read") from None
