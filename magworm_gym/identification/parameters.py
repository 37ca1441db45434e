"""Parameters that are fitted, as points of a unit cube."""

from collections.abc import Sequence
from math import exp, log
from typing import Literal

import numpy as np

from magworm_gym.documents import Number, Table, Text
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.recording import Floats


class Bounds(Table, frozen=True):
    """Between which values a parameter is fitted.

    Attributes:
        low: Lower bound, in the field's unit; of the ratio where ``times`` is given [1].
        high: Upper bound.
        scale: ``"log"`` where equal ratios count as equal distances.
        times: Path of another parameter; the field is then the fitted ratio times that one.
    """

    low: Number
    high: Number
    scale: Literal["linear", "log"] = "linear"
    times: Text | None = None

    def __post_init__(self) -> None:
        """Refuses bounds in the wrong order, and logarithms of what is not positive."""
        if self.low >= self.high:
            raise ValueError(f"low is {self.low!r}; allowed: a number less than high = {self.high:g}")
        if self.scale == "log" and self.low <= 0.0:
            raise ValueError(f'low is {self.low!r}; allowed: a number greater than 0 where scale = "log"')


class Parameter(Bounds, frozen=True, kw_only=True):
    """A field of the scene that is fitted.

    Attributes:
        path: Dotted path of the field.
    """

    path: str

    @property
    def label(self) -> str:
        """The path, or the ratio of two paths."""
        return self.path if self.times is None else f"{self.path} / {self.times}"

    def value(self, unit: float) -> float:
        """Value at a coordinate of the unit cube."""
        if self.scale == "log":
            return min(max(exp(log(self.low) + unit * log(self.high / self.low)), self.low), self.high)
        return min(max(self.low + unit * (self.high - self.low), self.low), self.high)

    def unit(self, value: float) -> float:
        """Coordinate in the unit cube of a value; beyond 0 to 1 where it is out of bounds."""
        if self.scale == "log":
            return log(max(value, 1e-300) / self.low) / log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


class ParameterSpace:
    """The unit cube of P parameters.

    Args:
        parameters: The parameters; one with ``times`` names one without.

    Raises:
        ProblemError: None at all, one twice, or a ratio to what is not fitted.
    """

    def __init__(self, parameters: Sequence[Parameter]) -> None:
        if not parameters:
            raise ProblemError("parameters is empty; allowed: at least one field with low and high")
        plain = {parameter.path for parameter in parameters if parameter.times is None}
        paths = [parameter.path for parameter in parameters]
        for parameter in parameters:
            if paths.count(parameter.path) > 1:
                raise ProblemError(f"parameters has {parameter.path!r} twice; allowed: once")
            if parameter.times is not None and parameter.times not in plain:
                raise ProblemError(
                    f"parameters.{parameter.path}.times is {parameter.times!r}; allowed: another "
                    f"parameter that is no ratio itself ({', '.join(sorted(plain)) or 'there is none'})"
                )
        self.parameters = tuple(parameters)

    def __len__(self) -> int:
        return len(self.parameters)

    def fitted(self, unit: Floats) -> Floats:
        """Fitted numbers (P,) at a point of the cube (P,): field values, or ratios."""
        return np.array([p.value(float(u)) for p, u in zip(self.parameters, unit, strict=True)])

    def scene_values(self, unit: Floats) -> dict[str, float]:
        """Path of a field → its value at a point of the cube (P,)."""
        fitted = dict(zip((p.path for p in self.parameters), self.fitted(unit).tolist(), strict=True))
        return {p.path: fitted[p.path] * (fitted[p.times] if p.times else 1.0) for p in self.parameters}

    def unit_of(self, values: dict[str, float]) -> Floats:
        """Point of the cube (P,) nearest to field values; 0.5 where a field has none."""
        unit = np.full(len(self), 0.5)
        for at, parameter in enumerate(self.parameters):
            value = values.get(parameter.path)
            if value is not None and parameter.times is not None:
                other = values.get(parameter.times)
                value = value / other if other else None
            if value is not None:
                unit[at] = min(max(parameter.unit(value), 0.0), 1.0)
        return unit
