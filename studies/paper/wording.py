"""Words that follow from numbers."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

LEVEL = 0.05


def trend(values: ArrayLike, scale: float | None = None) -> str:
    """Whether a series rises, falls or stays level, from its straight-line fit.

    Args:
        values: At least two values, evenly spaced.
        scale: A change over the series below 5 % of it counts as level; None for the mean magnitude.
    """
    series = np.asarray(values, np.float64)
    places = np.linspace(-0.5, 0.5, len(series))
    change = float(places @ (series - series.mean()) / (places @ places))
    threshold = LEVEL * (float(np.abs(series).mean()) if scale is None else scale)
    if abs(change) <= threshold:
        return "stays level"
    return "rises" if change > 0.0 else "falls"


def listed(words: Sequence[str]) -> str:
    """Words with commas and an "and"."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def ranking(values: Mapping[str, float]) -> str:
    """Names from the greatest value to the smallest."""
    return " > ".join(sorted(values, key=lambda name: -values[name]))


def higher_or_lower(value: float, reference: float) -> str:
    """How a value stands to a reference."""
    return "higher" if value > reference else "lower"


COUNTS = {2: "two", 3: "three", 4: "four", 5: "five"}


def capital(sentence: str) -> str:
    """A sentence with a capital letter."""
    return sentence[:1].upper() + sentence[1:]
