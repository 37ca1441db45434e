"""Bands: what each figure of the page may be before ``render`` complains.

Of identification targets and closed forms it is what ``quantities.toml`` requires. All others may be what the
model gave when ``bands.toml`` was written, with a margin, so that a change is noticed.
"""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from studies.paper.quantity import Quantity

PATH = Path(__file__).with_name("bands.toml")
SHARE, SPREADS = 0.05, 2.0
"""How far a figure may move: this share of it, or so many of its spreads, whichever is more,"""
SMALLEST = {
    "mm": 0.15,
    "mm/s": 1.0,
    "L/s": 0.01,
    "%": 2.0,
    "°": 0.1,
    "N": 0.01,
    "mN·m": 0.02,
    "µm": 1.0,
    "": 0.02,
}
"""and by unit never less than this."""
HEAD = """\
# Bands of what docs/paper.md gives, lowest and greatest value, written from the data with a margin by
# `python -m studies measure paper --write-bands`, so that a change is noticed; whether the model agrees
# with the paper is said on the page. Bands that are required stand in quantities.toml.

"""
Bands = Mapping[str, tuple[float, float]]


def read_bands(path: Path = PATH) -> Bands:
    """The bands of ``bands.toml``, by key."""
    return msgspec.toml.decode(path.read_bytes(), type=dict[str, tuple[float, float]])


def outside(quantities: Sequence[Quantity], bands: Bands) -> list[str]:
    """A sentence for each figure that is not within its band, and for each key without its partner."""
    found = [sentence for quantity in quantities if (sentence := _complaint(quantity, bands))]
    known = {quantity.key for quantity in quantities}
    return found + [f"{key} has a band but no figure" for key in bands if key not in known]


def written(quantities: Sequence[Quantity]) -> str:
    """``bands.toml`` anew, from what the model gives."""
    free = [quantity for quantity in quantities if quantity.row.band is None]
    return HEAD + "".join(f'"{quantity.key}" = [{", ".join(_around(quantity))}]\n' for quantity in free)


def margin(quantity: Quantity) -> float:
    """How far a figure may move, in its unit."""
    smallest = SMALLEST[quantity.row.unit]
    return max(SHARE * abs(quantity.model), SPREADS * quantity.spread, smallest)


def _complaint(quantity: Quantity, bands: Bands) -> str:
    required = quantity.row.band
    if required is None and quantity.key not in bands:
        return f"{quantity.key} has no band; --write-bands gives it one"
    low, high = required or bands[quantity.key]
    if low <= quantity.model <= high and (math.isfinite(quantity.model) or low == high):
        return ""
    why = quantity.row.why if required else "what the model gave before"
    unit = f" {quantity.row.unit}".rstrip()
    return f"{quantity.key} is {quantity.model:.4g}{unit}; allowed: {low:g} to {high:g} ({why})"


def _around(quantity: Quantity) -> list[str]:
    """What is never reached may never be reached."""
    way = margin(quantity) if math.isfinite(quantity.model) else 0.0
    return [f"{quantity.model + sign * way:.4g}" for sign in (-1.0, 1.0)]
