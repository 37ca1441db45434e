"""The results as tables of comma-separated values."""

import csv
import math
from collections.abc import Sequence
from io import StringIO

from studies.stability.cases import Outcome
from studies.stability.energy import Swing
from studies.stability.limits import Limit
from studies.stability.starts import StartCase


def outcomes_csv(outcomes: Sequence[Outcome]) -> str:
    """One row a case, of one axis or of two; what has no value is empty."""
    head = ["body", "dimensions", "integrator", "axis", "value", "second_axis", "second_value"]
    rows: list[Sequence[object]] = [[*head, "verdict", "error", "sentence"]]
    for outcome in outcomes:
        case = outcome.case
        settings = [part for axis, value in case.settings for part in (axis.title, f"{value:g}")]
        settings += [""] * (4 - len(settings))
        rows.append(
            [
                case.body,
                case.dimensions,
                case.integrator,
                *settings,
                outcome.verdict,
                _number(outcome.error),
                outcome.sentence,
            ]
        )
    return _text(rows)


def starts_csv(outcomes: Sequence[Outcome]) -> str:
    """One row a bent start under a scheme; what has no value is empty."""
    head = ["body", "dimensions", "start", "integrator", "step_s", "verdict", "error", "sentence"]
    rows: list[Sequence[object]] = [head]
    for outcome in outcomes:
        case = outcome.case
        assert isinstance(case, StartCase)
        scheme = [case.start, case.integrator, f"{case.step_s:g}"]
        found = [outcome.verdict, _number(outcome.error), outcome.sentence]
        rows.append([case.body, case.dimensions, *scheme, *found])
    return _text(rows)


def limits_csv(limits: Sequence[Limit]) -> str:
    """One row a rod, in the plane or in space."""
    rows: list[Sequence[object]] = [["rod", "dimensions", "predicted_s", "found_s", "reason"]]
    for one in limits:
        found = [_number(one.predicted_s), _number(one.found_s)]
        rows.append([one.name, one.dimensions, *found, one.reason])
    return _text(rows)


def energy_csv(swings: Sequence[Swing]) -> str:
    """One row a rod that swings; energies are over weight times length, empty where the scene is refused."""
    names = ["gain", "visible_gain", "lost"]
    rows: list[Sequence[object]] = [
        ["motion", "integrator", "youngs_modulus_pa", "step_ms", *names, "broken"]
    ]
    for one in swings:
        energies = [_number(value) for value in (one.gain, one.visible, one.lost)]
        scene = [one.motion, one.integrator, f"{one.stiffness_pa:g}", f"{one.step_ms:g}"]
        rows.append([*scene, *energies, one.broken or ""])
    return _text(rows)


def _number(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.4g}"


def _text(rows: Sequence[Sequence[object]]) -> str:
    written = StringIO()
    csv.writer(written, lineterminator="\n").writerows(rows)
    return written.getvalue()
