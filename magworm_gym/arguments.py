"""Checks of arguments: each raises ValueError naming the argument, its value and what is allowed."""

import operator
from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

SEED_LIMIT = 2**63
"""Seeds are smaller than this."""

T = TypeVar("T")


def action_rows(actions: ArrayLike, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Actions as numbers of the given shape."""
    try:
        values = np.ascontiguousarray(actions, np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"actions are {actions!r}; they must be numbers of shape {shape}") from error
    if values.shape != shape:
        raise ValueError(f"actions have shape {values.shape}; expected {shape}")
    return values


def seeds_of(seed: int | Sequence[int | None] | None, num_envs: int) -> list[int | None]:
    """One seed per environment: s + i from a number s, a sequence as it is."""
    if seed is None:
        return [None] * num_envs
    single = isinstance(seed, (int, np.integer))
    given = [int(seed) + i for i in range(num_envs)] if single else list(seed)  # type: ignore[arg-type]
    if len(given) != num_envs:
        raise ValueError(f"seed has {len(given)} entries; it must have one per environment ({num_envs})")
    for value in given:
        if value is not None and not (isinstance(value, (int, np.integer)) and 0 <= value < SEED_LIMIT):
            raise ValueError(f"seed is {value!r}; allowed: None or whole numbers from 0 to 2^63 - 1")
    return [None if value is None else int(value) for value in given]


def positive(name: str, value: int) -> int:
    """A whole number from 1 on."""
    number = operator.index(value)
    if number < 1:
        raise ValueError(f"{name} is {value!r}; it must be 1 or more")
    return number


def choice(name: str, value: T, allowed: Sequence[T]) -> T:
    """One of the values allowed."""
    if value not in allowed:
        raise ValueError(f"{name} is {value!r}; allowed: {', '.join(map(repr, allowed))}")
    return value


def indices(name: str, value: Sequence[int], count: int) -> tuple[int, ...]:
    """One or more different indices of `count` environments."""
    chosen = tuple(dict.fromkeys(operator.index(i) for i in value))
    if not chosen or not all(0 <= i < count for i in chosen):
        raise ValueError(f"{name} is {value!r}; allowed: indices from 0 to {count - 1}, one at least")
    return chosen
