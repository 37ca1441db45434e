"""Spaces of Gymnasium, derived from what the simulator declares about its rows."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from magworm_gym._magworm import Specification


@dataclass(frozen=True)
class Part:
    """One named slice of a row that a task appends; as a ``Specification`` of the simulator."""

    name: str
    unit: str
    size: int
    low: float
    high: float
    description: str


AnyPart: TypeAlias = Specification | Part


def box(specifications: Iterable[AnyPart]) -> Box:
    """The space of one row, with components in the order of `specifications`, as float32.

    Bounds that float32 cannot hold are rounded outwards: a value that keeps to the bound in
    double precision keeps to it in single precision too. A bound that is left open is infinite.
    """
    specifications = tuple(specifications)
    low = np.concatenate([np.full(part.size, part.low) for part in specifications])
    high = np.concatenate([np.full(part.size, part.high) for part in specifications])
    return Box(_rounded(low, towards=-np.inf), _rounded(high, towards=np.inf), dtype=np.float32)


def layout(specifications: Iterable[AnyPart]) -> dict[str, slice]:
    """Where each named part stands in a row: ``row[layout["last_action"]]``."""
    slices, start = {}, 0
    for part in specifications:
        slices[part.name] = slice(start, start + part.size)
        start += part.size
    return slices


def _rounded(bounds: NDArray[np.float64], *, towards: float) -> NDArray[np.float32]:
    with np.errstate(over="ignore"):  # beyond the largest number lies infinity
        single = bounds.astype(np.float32)
    inside = single > bounds if towards < 0 else single < bounds
    single[inside] = np.nextafter(single[inside], np.float32(towards))
    return single
