"""Settings of a training: read from TOML, overridden by flags, kept as JSON beside the run.

A file has a table for each environment, named by its identifier, and ``[default]`` for those without one.
"""

import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin, get_type_hints

import msgspec
from msgspec import Meta, Struct

from magworm_gym.learning.command_line import UsageError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CONFIGS = Path(__file__).parents[2] / "training" / "configs"
DEFAULT = "default"
LARGEST_SEED = 2**32 - 1

Count = Annotated[int, Meta(ge=1, le=10**12, description="a whole number from 1 to 10^12")]
Environments = Annotated[int, Meta(ge=1, le=10**6, description="a whole number from 1 to 10^6")]
Seed = Annotated[int, Meta(ge=0, le=LARGEST_SEED)]
Table = Annotated[dict[str, Any], Meta(description="a table")]

Settings = TypeVar("Settings", bound=Struct)


class TrainingSettings(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
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

    environment_id: Annotated[str, Meta(description="an identifier of Gymnasium's registry")]
    algorithm: Annotated[str, Meta(description="the name of a learner")] = "ppo"
    num_envs: Environments = 256
    steps: Count = 2_000_000
    seeds: Annotated[
        tuple[Seed, ...], Meta(min_length=1, description=f"different whole numbers from 0 to {LARGEST_SEED}")
    ] = (0, 1, 2)
    checkpoint_steps: Count = 500_000
    environment: Table = {}
    learner: Table = {}

    def __post_init__(self) -> None:
        """Raises UsageError where a seed stands twice."""
        if len(set(self.seeds)) < len(self.seeds):
            raise UsageError(
                f"seeds is {list(self.seeds)}; allowed: different whole numbers from 0 to {LARGEST_SEED}"
            )

    def to_json(self) -> dict[str, Any]:
        """The settings as plain values."""
        plain: dict[str, Any] = msgspec.json.decode(msgspec.json.encode(self))
        return plain


def checked(values: Any, kind: type[Settings], where: str = "") -> Settings:
    """Makes settings of plain values.

    Args:
        values: What a file or a command line gave.
        kind: What they are to be; each field's ``Meta`` describes what is allowed.
        where: Name of the table, for the message.

    Raises:
        UsageError: An unknown name or a value that is not allowed.
    """
    try:
        return msgspec.convert(values, kind)
    except msgspec.ValidationError as error:
        raise UsageError(_sentence(str(error), values, kind, where)) from None


def merged(values: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Values with changes on top; tables are merged entry by entry."""
    result = dict(values)
    for name, change in changes.items():
        before = result.get(name)
        nested = isinstance(before, Mapping) and isinstance(change, Mapping)
        result[name] = merged(dict(before or {}), change) if nested else change
    return result


def read_toml(path: Path) -> dict[str, Any]:
    """Reads a TOML file.

    Raises:
        UsageError: The file is missing or is not TOML.
    """
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError:
        raise UsageError(f"there is no readable file {path}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
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
    """Reads settings that a run has kept as JSON.

    Raises:
        UsageError: There is no such file, or it is damaged.
    """
    try:
        return checked(msgspec.json.decode(path.read_bytes()), TrainingSettings)
    except (OSError, msgspec.DecodeError):
        raise UsageError(f"there is no training to go on with: {path} cannot be read") from None


def _sentence(error: str, values: Any, kind: Any, where: str) -> str:
    """Field, value and what is allowed, from what msgspec says, such as "… - at `$.seeds[0]`"."""
    path = re.search(r"at `\$(\.[^`]*)`$", error)
    names = re.sub(r"\[[^]]*\]", "", path[1]).split(".")[1:] if path else []
    hint = kind
    for name in names:
        hint, values = get_type_hints(_bare(hint), include_extras=True)[name], values[name]
    unknown, field = re.search(r"unknown field `(.*?)`", error), ".".join([where, *names]).strip(".")
    if unknown:
        known = ", ".join(sorted(get_type_hints(_bare(hint))))
        return f"unknown setting {unknown[1]!r}{f' in [{field}]' if field else ''}; allowed: {known}"
    shown = repr(values)
    return f"{field or 'settings'} is {shown[:60] + '…' * (len(shown) > 60)}; allowed: {_allowed(hint)}"


def _bare(hint: Any) -> Any:
    return get_args(hint)[0] if get_origin(hint) is Annotated else hint


def _allowed(hint: Any) -> str:
    """What a field may be, in words."""
    if get_origin(hint) is Literal:
        return ", ".join(map(str, get_args(hint)))
    if get_origin(hint) is Annotated:
        return next(str(meta.description) for meta in hint.__metadata__ if meta.description)
    return {bool: "true or false"}.get(hint, "a table")
