"""A figure of the paper beside the model's, and the words for how they compare."""

import math
from dataclasses import dataclass
from enum import Enum

AGREES, CLOSE = 0.05, 0.15


class Origin(Enum):
    """What a comparison proves."""

    TARGET = "identification target"
    """The presets were identified from it: agreement shows that the identification worked."""
    FITTED = "fitted trend"
    """The preset was fitted to what the paper shows here, read more loosely than below."""
    HELD_BACK = "held back"
    """Not used for the identification: a test of the model."""
    CLOSED_FORM = "closed form"
    """An exact solution: a test of the program."""
    MODEL = "model only"
    """The paper gives no figure."""


@dataclass(frozen=True)
class Quantity:
    """One row of the table.

    Attributes:
        key: Name in ``bands.toml``, section first: ``pass.peak``.
        what: What it is, in words.
        unit: Unit of all its numbers; empty for a ratio or a count.
        model: What the model gives; infinite where it never gets there.
        origin: What the comparison proves.
        paper: The paper's number; None where it has none.
        claim: What the paper says in words, and how that is read here.
        holds: Values that the paper's words allow, (low, high); None where it has a number or nothing.
        spread: Standard deviation of the model's number over repetitions, or the grid it was found on.
        digits: Decimals to print.
        note: Said after the verdict.
        listed: Whether the table at the top of the page has it; its section has it anyway.
    """

    key: str
    what: str
    unit: str
    model: float
    origin: Origin
    paper: float | None = None
    claim: str = ""
    holds: tuple[float, float] | None = None
    spread: float = 0.0
    digits: int = 2
    note: str = ""
    listed: bool = True

    @property
    def error(self) -> float | None:
        """Relative error against the paper's number; None where there is none or it is 0."""
        return self.model / self.paper - 1.0 if self.paper else None

    @property
    def as_claimed(self) -> bool:
        """Whether the model is within what the paper's words allow."""
        if self.holds is None:
            raise ValueError(f"{self.key} has no claim of the paper")
        return self.holds[0] <= self.model <= self.holds[1]


def number(value: float, digits: int) -> str:
    """A number for the page, with a true minus and without a negative zero."""
    text = f"{abs(value):.{digits}f}"
    return text if value >= 0.0 or float(text) == 0.0 else f"−{text}"


def model_text(quantity: Quantity) -> str:
    """The model's number with unit and spread."""
    if math.isinf(quantity.model):
        return "never"
    text = number(quantity.model, quantity.digits)
    if quantity.spread > 0.0:
        text += f" ± {number(quantity.spread, quantity.digits)}"
    return f"{text} {quantity.unit}".rstrip()


def paper_text(quantity: Quantity) -> str:
    """The paper's number with its unit, or its words."""
    if quantity.paper is None:
        return quantity.claim or "–"
    text = f"{quantity.paper:g} {quantity.unit}".rstrip()
    return f"{text} ({quantity.claim})" if quantity.claim else text


def error_text(quantity: Quantity) -> str:
    """The error in percent, signed."""
    error = quantity.error
    if error is None or math.isinf(error) or quantity.origin is Origin.CLOSED_FORM:
        return "–"
    return f"{'+' if error >= 0.0 else '−'}{100.0 * abs(error):.1f} %"


def verdict(quantity: Quantity, inside: bool) -> str:
    """How model and paper compare, in words.

    Args:
        quantity: What is compared.
        inside: Whether the model is within the band of ``bands.toml``: for a target and a closed form
            this is the required accuracy.
    """
    words = _comparison(quantity, inside)
    return f"{words}; {quantity.note}" if quantity.note else words


def _comparison(quantity: Quantity, inside: bool) -> str:
    if quantity.origin is Origin.TARGET:
        return "met" if inside else "**missed**"
    if quantity.origin is Origin.CLOSED_FORM:
        return "agrees" if inside else "**does not agree**"
    if quantity.holds is not None:
        return "as the paper says" if quantity.as_claimed else "**contradicts the paper**"
    error = quantity.error
    if error is None:
        return "no figure in the paper"
    if math.isinf(error):
        return "**disagrees**"
    if abs(error) <= AGREES:
        return "agrees"
    side = "high" if error > 0.0 else "low"
    return f"close, {side}" if abs(error) <= CLOSE else f"**disagrees, too {side}**"
