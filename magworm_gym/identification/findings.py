"""What the search says about each parameter, in numbers and in words."""

from dataclasses import dataclass

import numpy as np

from magworm_gym.identification.identifiability import RUGGED, Sensitivity
from magworm_gym.identification.parameters import Parameter, ParameterSpace
from magworm_gym.identification.search import Evolution
from magworm_gym.recording import Floats

OPEN = 0.5
"""Part of the bounds that fits as well from which on a parameter counts as not identifiable [1]."""

LOOSE = 0.2
"""Part of the bounds that fits as well from which on a parameter counts as weakly identified [1]."""

AT_BOUND = 0.01
"""Distance from a bound that counts as on it, as a part of the bounds [1]."""

NORMAL_95 = 1.96
"""Half the 95 % interval of a normal distribution in standard deviations [1]."""

TIED = 0.7
"""Correlation, among what fits as well, from which on parameters count as tied to each other [1]."""


@dataclass(frozen=True)
class Finding:
    """One parameter.

    Attributes:
        parameter: The parameter.
        best: Its best value, in the field's unit, or as a ratio.
        field_value: The field's value; the same unless it is a ratio.
        restarts: Best value of each evolution that fits about as well as the best.
        fits_from: Least value that fits about as well.
        fits_to: Greatest value that fits about as well.
        part_of_bounds: That range as a part of the bounds [1].
        std_joint: Standard deviation from the Jacobian, as a part of the bounds [1].
        std_alone: The same with all other parameters known [1].
        derivative_disagreement: Relative difference of the derivatives at two steps [1].
        on_bound: ``"lower"`` or ``"upper"`` where it lies on a bound.
        tied_to: Labels of the parameters that have to follow when it changes.
    """

    parameter: Parameter
    best: float
    field_value: float
    restarts: Floats
    fits_from: float
    fits_to: float
    part_of_bounds: float
    std_joint: float
    std_alone: float
    derivative_disagreement: float
    on_bound: str | None
    tied_to: tuple[str, ...]

    @property
    def verdict(self) -> str:
        """``"identified"``, ``"weakly identified"`` or ``"not identifiable"``."""
        part = max(self.part_of_bounds, self.linear_part)
        if part >= OPEN:
            return "not identifiable"
        return "weakly identified" if part >= LOOSE else "identified"

    @property
    def linear_part(self) -> float:
        """What the range may have missed because other parameters must follow, as a part of the bounds [1].

        The 95 % interval of the linearised model, at most 1; 0 where the parameter has little influence by
        itself, since the search looks all along its axis.
        """
        alone, joint = 2.0 * NORMAL_95 * self.std_alone, 2.0 * NORMAL_95 * self.std_joint
        return min(1.0, joint) if alone < OPEN and not np.isnan(joint) else 0.0

    @property
    def half_range(self) -> float:
        """Half the range of what fits about as well, in the unit of ``best``."""
        return (self.fits_to - self.fits_from) / 2.0

    def sentences(self) -> list[str]:
        """What there is to say about it."""
        follow = f", together with other values of {' and '.join(self.tied_to)}" if self.tied_to else ""
        span = f"{self.fits_from:.4g} to {self.fits_to:.4g}"
        if self.linear_part >= OPEN > self.part_of_bounds:
            said = (
                f"{self.verdict} from these data: others can make up for a change of it; values found reach"
            )
            return [f"{said} from {span}", *self._remarks()]
        said = {
            "not identifiable": "not identifiable from these data: "
            f"any value from {span} fits as well{follow}",
            "weakly identified": f"weakly identified: values from {span} fit as well{follow}",
            "identified": f"identified: {span} fits as well{follow}",
        }[self.verdict]
        return [said, *self._remarks()]

    def _remarks(self) -> list[str]:
        more = []
        if self.on_bound:
            more.append(
                f"lies on its {self.on_bound} bound: the data may want it beyond, or it makes up for what "
                "the model lacks"
            )
        if self.derivative_disagreement > RUGGED:
            more.append("rugged: its derivatives at two steps disagree, so trust the range more than them")
        elif np.isnan(self.derivative_disagreement):
            more.append("no neighbour of the best value can be simulated, so derivatives are missing")
        return more


def findings(
    space: ParameterSpace,
    best: Floats,
    evolutions: list[Evolution],
    fitting: Floats,
    limit: float,
    sensed: Sensitivity,
) -> list[Finding]:
    """Puts together what is known of each parameter.

    Args:
        space: The parameters.
        best: The best point of the cube (P,).
        evolutions: The evolutions.
        fitting: Points that fit about as well as the best (K, P), the best among them.
        limit: Loss up to which a candidate fits about as well [1].
        sensed: Derivatives at the best point.
    """
    values = space.scene_values(best)
    ended = [evolution.best for evolution in evolutions if evolution.loss <= limit] or [best]
    low, high = fitting.min(axis=0), fitting.max(axis=0)
    found = []
    for at, parameter in enumerate(space.parameters):
        found.append(
            Finding(
                parameter=parameter,
                best=parameter.value(float(best[at])),
                field_value=values[parameter.path],
                restarts=np.array([parameter.value(float(unit[at])) for unit in ended]),
                fits_from=parameter.value(float(low[at])),
                fits_to=parameter.value(float(high[at])),
                part_of_bounds=float(high[at] - low[at]),
                std_joint=float(sensed.deviations[at]),
                std_alone=float(sensed.alone[at]),
                derivative_disagreement=float(sensed.disagreement[at]),
                on_bound="lower" if best[at] < AT_BOUND else "upper" if best[at] > 1.0 - AT_BOUND else None,
                tied_to=_tied(space, fitting, at) if high[at] - low[at] >= LOOSE else (),
            )
        )
    return found


def _tied(space: ParameterSpace, fitting: Floats, at: int) -> tuple[str, ...]:
    """Labels of the parameters that change with one among what fits as well."""
    if len(fitting) < 3 * len(space):
        return ()
    moving = np.ptp(fitting, axis=0) > LOOSE
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = np.nan_to_num(np.corrcoef(fitting, rowvar=False).reshape(len(space), -1))
    return tuple(
        other.label
        for index, other in enumerate(space.parameters)
        if index != at and moving[index] and abs(correlation[at, index]) > TIED
    )
