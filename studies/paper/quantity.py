"""Figures of the paper beside the model's, from ``quantities.toml``, and the words for how they compare."""

import math
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

import msgspec

from studies.kit.words import number, signed, with_spread
from studies.paper.experiment import Numbers

PATH = Path(__file__).with_name("quantities.toml")
AGREES, CLOSE = 0.05, 0.15
AGAIN = "stride_simulation"
"""The figures of ``stride`` with the robot of the paper's simulation, to which none of them was fitted."""


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


REQUIRED = (Origin.TARGET, Origin.CLOSED_FORM)


class Row(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What is known of a figure before anything is simulated.

    Attributes:
        what: What it is, in words.
        origin: What the comparison proves.
        unit: Unit of all its numbers; empty for a ratio or a count.
        paper: The paper's number; None where it has none.
        claim: What the paper says in words, and how that is read here.
        holds: Values that the paper's words allow, (low, high); None where it has a number or nothing.
        digits: Decimals to print.
        note: Said after the verdict that the model disagrees.
        listed: Whether the table at the top of the page has it; its section has it anyway.
        band: What is required of it, (low, high); targets and closed forms have one.
        why: Where that comes from.
        guess: Why the model may disagree.
    """

    what: str
    origin: Origin
    unit: str = ""
    paper: float | None = None
    claim: str = ""
    holds: tuple[float, float] | None = None
    digits: int = 2
    note: str = ""
    listed: bool = True
    band: tuple[float, float] | None = None
    why: str = ""
    guess: str = "No hypothesis yet."

    def __post_init__(self) -> None:
        if (self.origin in REQUIRED) != (self.band is not None):
            raise ValueError(f"{self.what}: targets and closed forms have a band, no others")


@dataclass(frozen=True)
class Quantity:
    """A figure with what the model gives.

    Attributes:
        key: Name in ``quantities.toml``, section first: ``pass.peak``.
        row: What is known of it.
        model: What the model gives; infinite where it never gets there.
        spread: Its standard deviation over repetitions, or the grid it was found on.
    """

    key: str
    row: Row
    model: float
    spread: float = 0.0

    @property
    def error(self) -> float | None:
        """Relative error against the paper's number; None where there is none or it is 0."""
        return self.model / self.row.paper - 1.0 if self.row.paper else None

    @property
    def as_wanted(self) -> bool:
        """Whether the model is within the band that is required, or within what the paper's words allow."""
        low, high = self.row.band or self.row.holds or (math.nan, math.nan)
        return low <= self.model <= high

    @property
    def disagrees(self) -> bool:
        """Whether the page says so."""
        return self.verdict.startswith("**")

    @property
    def model_text(self) -> str:
        """The model's number with unit and spread."""
        if math.isinf(self.model):
            return "never"
        digits = self.row.digits
        text = with_spread(self.model, self.spread, digits) if self.spread else number(self.model, digits)
        return f"{text} {self.row.unit}".rstrip()

    @property
    def paper_text(self) -> str:
        """The paper's number with its unit, or its words."""
        if self.row.paper is None:
            return self.row.claim or "–"
        text = f"{self.row.paper:g} {self.row.unit}".rstrip()
        return f"{text} ({self.row.claim})" if self.row.claim else text

    @property
    def error_text(self) -> str:
        """The error in percent, signed."""
        if self.error is None or math.isinf(self.error) or self.row.origin is Origin.CLOSED_FORM:
            return "–"
        return f"{signed(100.0 * self.error, 1)} %"

    @property
    def verdict(self) -> str:
        """How model and paper compare, in words."""
        words = self._comparison()
        return f"{words}; {self.row.note}" if self.row.note and words.startswith("**") else words

    def _comparison(self) -> str:
        if self.row.origin is Origin.TARGET:
            return "met" if self.as_wanted else "**missed**"
        if self.row.origin is Origin.CLOSED_FORM:
            return "agrees" if self.as_wanted else "**does not agree**"
        if self.row.holds is not None:
            return "as the paper says" if self.as_wanted else "**contradicts the paper**"
        if self.error is None:
            return "no figure in the paper"
        if math.isinf(self.error):
            return "**disagrees**"
        if abs(self.error) <= AGREES:
            return "agrees"
        side = "high" if self.error > 0.0 else "low"
        return f"close, {side}" if abs(self.error) <= CLOSE else f"**disagrees, too {side}**"


def read_rows(path: Path = PATH) -> dict[str, Row]:
    """What is known of all figures, by key."""
    tables = msgspec.toml.decode(path.read_bytes(), type=dict[str, dict[str, Row]])
    tables[AGAIN] = {
        name: msgspec.structs.replace(row, origin=Origin.HELD_BACK, listed=False)
        for name, row in tables["stride"].items()
    }
    return {f"{section}.{name}": row for section, rows in tables.items() for name, row in rows.items()}


def quantities_of(numbers: Numbers, rows: dict[str, Row]) -> list[Quantity]:
    """Figures with what an experiment gives."""
    pairs = {key: found if isinstance(found, tuple) else (found, 0.0) for key, found in numbers.items()}
    return [Quantity(key, rows[key], float(model), float(spread)) for key, (model, spread) in pairs.items()]
