"""Numbers and words as pages print them: a true minus, no negative zero, no computer's exponents."""

import math
import re
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

LEVEL = 0.05
COUNTS = {0: "none", 1: "one", 2: "two", 3: "three", 4: "four", 5: "five"}


def number(value: float, digits: int = 2) -> str:
    """A number with this many decimals."""
    text = f"{abs(value):.{digits}f}"
    return text if value >= 0.0 or float(text) == 0.0 else f"−{text}"


def signed(value: float, digits: int = 2) -> str:
    """The same with its sign, plus as well."""
    return f"{'+' if value >= 0.0 else '−'}{abs(value):.{digits}f}"


def thousands(value: float) -> str:
    """A whole number in groups of three digits: ``1,234,568``."""
    return f"{value:,.0f}"


def signed_thousands(value: float) -> str:
    """The same with its sign."""
    return f"{'+' if value >= 0.0 else '−'}{abs(value):,.0f}"


def percent(part: float, digits: int = 0) -> str:
    """A part of a whole: ``12 %``."""
    return f"{number(100.0 * part, digits)} %"


def signed_percent(part: float, digits: int = 0) -> str:
    """The same with its sign."""
    return f"{signed(100.0 * part, digits)} %"


def with_spread(value: float, spread: float, digits: int = 2) -> str:
    """A number and what it leaves open: ``4.31 ± 0.12``."""
    return f"{number(value, digits)} ± {number(spread, digits)}"


def short(value: float, digits: int = 2) -> str:
    """A number with this many significant digits, where it needs an exponent as ``1.2e-7``."""
    return exponent("0" if value == 0.0 else f"{value:.{digits - 1}e}")


def plain(value: float) -> str:
    """A number with up to six significant digits and no more zeros than it needs."""
    return exponent(f"{value:g}")


def exponent(text: str) -> str:
    """A number that Python wrote: 1.0e-07 as 1.0e-7, 1.0e+00 as 1.0, with a true minus in front."""
    text = re.sub(r"e[+]?0+$", "", text)
    text = re.sub(r"e([+-])0*(\d)", lambda found: "e" + found[1].replace("+", "") + found[2], text)
    return re.sub(r"^-", "−", text)


def listed(words: Sequence[object]) -> str:
    """Words with commas and an "and"."""
    texts = [f"{word:g}" if isinstance(word, float) else str(word) for word in words]
    return texts[0] if len(texts) == 1 else f"{', '.join(texts[:-1])} and {texts[-1]}"


def ranking(values: Mapping[str, float]) -> str:
    """Names from the greatest value to the smallest."""
    return " > ".join(sorted(values, key=lambda name: -values[name]))


def capital(sentence: str) -> str:
    """A sentence with a capital letter."""
    return sentence[:1].upper() + sentence[1:]


def in_words(count: int) -> str:
    """A small number as a word."""
    return COUNTS.get(count, str(count))


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
    if math.fabs(change) <= threshold:
        return "stays level"
    return "rises" if change > 0.0 else "falls"
