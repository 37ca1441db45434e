"""What robots predict that meet the identification's targets about as well as the preset.

Five figures do not pin down thirteen parameters. Each restart of the identification ended with another set;
where their predictions agree, the targets decide them, where they part, the choice of the set does.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from studies.paper.passes import Walk, measured_strides
from studies.paper.quantity import number
from studies.paper.robot_picture import MM
from studies.paper.scenes import SIMULATION, robot
from studies.paper.section import Section, table

RESTARTS = Path(__file__).parents[1] / "identification" / "restarts" / f"{SIMULATION}.json"
SPEEDS_MM_S = (50.0, 110.0, 150.0, 210.0)
ROBOTS = (3, 5)


def other_fits_section() -> Section:
    """Runs robots with three and five magnets and the parameters of every restart at a few speeds."""
    restarts = json.loads(RESTARTS.read_text(encoding="utf-8"))
    sets: list[tuple[str, dict[str, Any]]] = [("the preset", {})]
    sets += [
        (f"restart {at}, loss {each['loss']:.3g}", each["values"])
        for at, each in enumerate(restarts, start=1)
    ]
    strides = _strides([values for _, values in sets])
    header = ["parameters", *(f"{count} magnets, {v:g} mm/s" for count in ROBOTS for v in SPEEDS_MM_S)]
    rows = [
        [name, *(number(stride, 2) for stride in row)]
        for (name, _), row in zip(sets, strides.reshape(len(sets), -1), strict=True)
    ]
    text = (
        f"Strides in mm with the parameters of each of the {len(restarts)} restarts of the identification "
        "([their values and how well they fit](identification/paper-3.md)), averaged as above. "
        f"{_agreement(strides)}\n\n{table(header, rows)}"
    )
    data = {"speed_mm_s": list(SPEEDS_MM_S), "magnets": list(ROBOTS), "stride_mm": strides.tolist()}
    return Section("Robots that fit about as well", text, data=data)


def _strides(sets: list[dict[str, Any]]) -> NDArray[np.float64]:
    """Strides (sets, robots, speeds) [mm]."""
    walks = [
        Walk(robot(count).with_values(values), 1e-3 * speed)
        for values in sets
        for count in ROBOTS
        for speed in SPEEDS_MM_S
    ]
    means = [MM * stride.mean_m for stride in measured_strides(walks)]
    return np.array(means).reshape(len(sets), len(ROBOTS), len(SPEEDS_MM_S))


def _agreement(strides: NDArray[np.float64]) -> str:
    """Of how many sets the paper's statements on speed hold, in words."""
    three, five = strides[:, 0], strides[:, 1]
    peak, crossing, fastest = (SPEEDS_MM_S.index(speed) for speed in (110.0, 150.0, 210.0))
    statements = {
        "three magnets are slower at 210 mm/s than at 110": three[:, fastest] < three[:, peak],
        "five magnets are faster at 210 mm/s than at 50": five[:, fastest] > five[:, 0],
        "three magnets beat five at 110 mm/s": three[:, peak] > five[:, peak],
        "five beat three at 210 mm/s": five[:, fastest] > three[:, fastest],
        "five beat three at 150 mm/s already": five[:, crossing] > three[:, crossing],
    }
    words = [f"{what} with {int(holds.sum())}" for what, holds in statements.items()]
    return f"Of these {len(strides)} sets, {'; '.join(words)}."
