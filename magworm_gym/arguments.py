"""Checks of arguments: each raises ValueError naming the argument, its value and what is allowed."""

import operator
import reprlib
from collections.abc import Iterable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Literal, TypeAlias, TypeVar, get_args

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import ArrayLike, NDArray

RenderMode: TypeAlias = Literal["human", "rgb_array"]
RENDER_MODES = get_args(RenderMode)
AnyAutoreset: TypeAlias = AutoresetMode | Literal["NextStep", "SameStep", "Disabled"]
Lanes: TypeAlias = Literal["wide", "scalar"]

SEED_LIMIT = 2**63
"""Seeds are smaller than this."""

LONGEST = 200
"""Most characters of a value in a message."""

T = TypeVar("T", bound=str | None)


def shown(value: Any) -> str:
    """A value in a message: cut where it is long, deep or holds itself."""
    try:
        text = reprlib.repr(value) if isinstance(value, (list, tuple, dict, set, int)) else repr(value)
    except Exception:  # whatever a foreign __repr__ raises
        return f"of type {type(value).__name__}"
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} …"


def numbers(value: ArrayLike) -> NDArray[np.float64] | None:
    """A value as an array of numbers; None where it is none."""
    try:
        return np.asarray(value, np.float64)
    except (TypeError, ValueError, OverflowError, RecursionError):
        return None


def path_of(name: str, value: str | PathLike[str]) -> Path:
    """A path, from text or a path."""
    if not isinstance(value, (str, PathLike)):
        raise ValueError(f"{name} is {shown(value)}; allowed: a path")
    return Path(value)


def action_rows(actions: ArrayLike, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Actions as numbers of the given shape."""
    values = numbers(actions)
    if values is None:
        raise ValueError(f"actions are {shown(actions)}; they must be numbers of shape {shape}")
    if values.shape != shape:
        raise ValueError(f"actions have shape {values.shape}; expected {shape}")
    return values


def whole(value: Any) -> int | None:
    """A whole number of Python or NumPy; None for anything else, flags included."""
    if isinstance(value, (bool, np.bool_)):
        return None
    try:
        return operator.index(value)
    except TypeError:
        return None


def seeds_of(seed: int | Sequence[int | None] | None, num_envs: int) -> list[int | None]:
    """One seed per environment: s + i from a number s, a sequence as it is."""
    if seed is None:
        return [None] * num_envs
    single = whole(seed)
    if single is None and (isinstance(seed, str) or not isinstance(seed, Iterable)):
        raise ValueError(f"seed is {shown(seed)}; allowed: None, a whole number, or one for each environment")
    if single is not None and 0 <= single < SEED_LIMIT - num_envs:
        return list(range(single, single + num_envs))
    given = list(seed) if single is None else [single + i for i in range(num_envs)]  # type: ignore[arg-type]
    if len(given) != num_envs:
        raise ValueError(f"seed has {len(given)} entries; it must have one per environment ({num_envs})")
    seeds = [None if value is None else whole(value) for value in given]
    for value, number in zip(given, seeds, strict=True):
        if value is not None and (number is None or not 0 <= number < SEED_LIMIT):
            raise ValueError(f"seed is {shown(value)}; allowed: None or whole numbers from 0 to 2^63 - 1")
    return seeds


def positive(name: str, value: int) -> int:
    """A whole number from 1 on."""
    number = whole(value)
    if number is None or number < 1:
        raise ValueError(f"{name} is {shown(value)}; it must be 1 or more, and whole")
    return number


def share(name: str, value: float, *, below: bool = False) -> float:
    """A number from 0 to 1; with `below` less than 1."""
    number = None if isinstance(value, (bool, np.bool_)) else numbers(value)
    if number is None or number.shape or not (0.0 <= number < 1.0 or (number == 1.0 and not below)):
        raise ValueError(f"{name} is {shown(value)}; allowed: 0 to {'below ' if below else ''}1")
    return float(number)


def choice(name: str, value: T, allowed: Sequence[T]) -> T:
    """One of the words allowed, or None where that is."""
    if not (value is None or isinstance(value, str)) or value not in allowed:
        raise ValueError(f"{name} is {shown(value)}; allowed: {', '.join(map(repr, allowed))}")
    return value


def autoreset(value: AnyAutoreset) -> AutoresetMode:
    """A mode of autoreset, or the one of a name."""
    modes = tuple(mode.value for mode in AutoresetMode)
    return (
        value if isinstance(value, AutoresetMode) else AutoresetMode(choice("autoreset_mode", value, modes))
    )


def indices(name: str, value: Sequence[int], count: int) -> tuple[int, ...]:
    """One or more different indices of `count` environments."""
    given = [whole(index) for index in value] if isinstance(value, Iterable) else []
    if not given or not all(index is not None and 0 <= index < count for index in given):
        raise ValueError(f"{name} is {shown(value)}; allowed: indices from 0 to {count - 1}, one at least")
    return tuple(dict.fromkeys(index for index in given if index is not None))
