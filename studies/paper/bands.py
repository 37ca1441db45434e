"""Bands: what each figure of the page may be before the run fails.

``bands.toml`` has two parts. The upper one is written by hand: the margins, and the bands of the
identification targets and the closed forms, which say what is required. The lower one, below
:data:`MARK`, holds what the model gives today with a margin, so that a change is noticed, and is
written by ``--write-bands``.
"""

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from studies.paper.quantity import Origin, Quantity

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PATH = Path(__file__).parent / "bands.toml"
MARK = "# Below: written by --write-bands.\n"
REQUIRED = (Origin.TARGET, Origin.CLOSED_FORM)


@dataclass(frozen=True)
class Band:
    """What a figure may be.

    Attributes:
        low: Smallest value.
        high: Greatest value.
        why: Where the band comes from.
    """

    low: float
    high: float
    why: str

    def holds(self, value: float) -> bool:
        """Whether a value is inside; an infinite one only where the band says that it is never reached."""
        return self.low == value if math.isinf(value) else self.low <= value <= self.high


@dataclass(frozen=True)
class Margins:
    """How far a figure may move from what the model gave when the bands were written.

    Attributes:
        relative: Share of the value.
        spreads: Multiples of its spread.
        smallest: By unit: never less than this.
    """

    relative: float
    spreads: float
    smallest: dict[str, float]

    def of(self, quantity: Quantity) -> float:
        """The margin of a figure, in its unit: the greatest of the three."""
        smallest = self.smallest.get(quantity.unit, 0.0)
        return max(self.relative * abs(quantity.model), self.spreads * quantity.spread, smallest)


def read_margins(text: str) -> Margins:
    """The margins of ``bands.toml``."""
    return Margins(**tomllib.loads(text)["margins"])


def read_bands(text: str) -> dict[str, Band]:
    """The bands of ``bands.toml``, by key of the quantity. A side that is left out is open."""
    tables = tomllib.loads(text).get("bands", {})
    return {
        f"{section}.{name}": Band(band.get("low", -math.inf), band.get("high", math.inf), band["why"])
        for section, bands in tables.items()
        for name, band in bands.items()
    }


def outside(quantities: Sequence[Quantity], bands: dict[str, Band]) -> list[str]:
    """A sentence for each figure that is not within its band, and for each key without its partner."""
    found = []
    for quantity in quantities:
        band = bands.get(quantity.key)
        if band is None:
            found.append(f"{quantity.key} has no band; --write-bands gives it one")
        elif not band.holds(quantity.model):
            unit = f" {quantity.unit}" if quantity.unit else ""
            allowed = f"{band.low:g} to {band.high:g}"
            found.append(f"{quantity.key} is {quantity.model:.4g}{unit}; allowed: {allowed} ({band.why})")
    known = {quantity.key for quantity in quantities}
    found.extend(f"{key} has a band but no figure" for key in bands if key not in known)
    return found


def rewritten(text: str, quantities: Sequence[Quantity]) -> str:
    """``bands.toml`` with its lower part made anew from what the model gives.

    Raises:
        ValueError: A target or closed form has no band in the upper part; that is written by hand.
    """
    upper = text.split(MARK)[0]
    by_hand, margins = read_bands(upper), read_margins(upper)
    missing = [q.key for q in quantities if q.origin in REQUIRED and q.key not in by_hand]
    if missing:
        raise ValueError(f"no band by hand in {PATH.name} for {', '.join(missing)}")
    present = [q for q in quantities if q.key not in by_hand]
    return upper + MARK + "".join(_written(q, margins.of(q)) for q in present)


def _written(quantity: Quantity, margin: float) -> str:
    low, high = (f"{quantity.model + sign * margin:.4g}" for sign in (-1.0, 1.0))
    why = f"the model's {quantity.model:.4g} ± {margin:.2g}"
    if math.isinf(quantity.model):
        low = high = f"{quantity.model}"
        why = "never reached by the model"
    return f'\n[bands.{quantity.key}]\nlow = {low}\nhigh = {high}\nwhy = "{why}"\n'
