"""Robots that differ from episode to episode: parameters off their values, magnets missing."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import share, shown
from magworm_gym.draws import ROBOT, uniform

FEWEST_MAGNETS = 3
"""A robot keeps as many magnets, or all where it has fewer."""

VARIED = ("stiffness", "damping", "mass", "remanence", "static_friction", "dynamic_friction")
"""The parameters of a robot and its ground, in the order in which they are drawn. The stage is the rig's."""

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Randomise:
    """Gives each episode a robot of its own.

    What is drawn depends on the seed of the environment and the number of its episode alone: it is the same
    in any batch, at any place. Magnets and parameters that an option of a reset names are not drawn.
    Of an ensemble of scenes (a list as ``scene``) each environment keeps its own, and draws within it.

    Attributes:
        parameters: Width w of the draw about 1, from 0 to below 1: the scene's stiffness, damping, mass,
            remanence, static and dynamic friction get factors of their own, uniform from 1 − w to 1 + w.
        removed: Probability from 0 to 1 that magnets are missing. Which ones is drawn from all sets that
            leave three in place, each as likely; a robot of three stays whole.

    Raises:
        ValueError: A number out of range.
    """

    parameters: float = 0.0
    removed: float = 0.0

    def __post_init__(self) -> None:
        share("randomise.parameters", self.parameters, below=True)
        share("randomise.removed", self.removed)

    def factors(self, seeds: Integers, episodes: Integers) -> dict[str, Floats]:
        """The factors (N,) of parameters, by name, in the episodes (N,) of seeds (N,)."""
        if self.parameters == 0.0:
            return {}
        drawn = uniform(seeds, episodes, len(VARIED), ROBOT)
        return dict(zip(VARIED, (1.0 + self.parameters * (2.0 * drawn - 1.0)).T, strict=True))

    def present(self, whole: NDArray[np.bool_], seeds: Integers, episodes: Integers) -> NDArray[np.bool_]:
        """The magnets in place (N, M) of robots that have those of `whole` (N, M)."""
        if self.removed == 0.0:
            return whole
        drawn = uniform(seeds, episodes, len(VARIED) + 2 + whole.shape[1], ROBOT)[:, len(VARIED) :]
        damaged, size, order = drawn[:, 0] < self.removed, drawn[:, 1], drawn[:, 2:]
        # The magnets whose numbers are the smallest are taken out: every set of one size is as likely.
        place = np.where(whole, order, np.inf).argsort(axis=1).argsort(axis=1)
        missing = np.where(damaged, _sizes(whole.sum(axis=1), size), 0)
        return whole & (place >= missing[:, None])


AnyRandomise: TypeAlias = Randomise | Mapping[str, float]
"""The option, or its attributes by name, as JSON and TOML hold them."""


def load_randomise(value: AnyRandomise | None) -> Randomise:
    """The option from what an environment was given; None draws nothing.

    Raises:
        ValueError: Another kind of value, or a number out of range.
    """
    if value is None or isinstance(value, Randomise):
        return value or Randomise()
    names = [field.name for field in fields(Randomise)]
    if not isinstance(value, Mapping) or not all(key in names for key in value):
        raise ValueError(
            f"randomise is {shown(value)}; allowed: a Randomise, or a mapping with keys among {names}"
        )
    return Randomise(**value)


def _sizes(magnets: Integers, drawn: Floats) -> Integers:
    """How many magnets are taken out (N,) of so many (N,): as often as there are sets of that size."""
    sizes = np.zeros(len(magnets), np.int64)
    for count in np.unique(magnets).tolist():
        sets = [math.comb(count, size) for size in range(1, count - FEWEST_MAGNETS + 1)]
        chosen = np.searchsorted(np.cumsum(sets), drawn * sum(sets), side="right") + 1 if sets else 0
        sizes = np.where(magnets == count, chosen, sizes)
    return sizes
