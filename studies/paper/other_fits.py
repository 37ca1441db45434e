"""What robots predict that fit the paper's experiment about as well as the preset.

A dozen figures do not pin down fourteen parameters. The identification found a whole set of robots that fit:
where predictions agree over that set, the figures decide them; where they part, the choice of robot does.
"""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Scene
from studies.paper.passes import Walk, measured_strides
from studies.paper.quantity import number
from studies.paper.robot_picture import MM
from studies.paper.scenes import ROBOT, robot
from studies.paper.section import Section, table
from studies.paper.wording import COUNTS

Floats = NDArray[np.float64]

OTHERS = Path(__file__).parents[1] / "identification" / "others" / "paper-joint.json"
SPEEDS_MM_S = (50.0, 110.0, 150.0, 210.0)
ROBOTS = (3, 4, 5)


def other_fits_section() -> Section:
    """Runs the preset and the other robots at a few speeds, with three, four and five magnets."""
    others = json.loads(OTHERS.read_text(encoding="utf-8"))
    scenes = [robot(3), *(robot(3).with_values(each["values"]) for each in others)]
    names = [f"`{ROBOT}`", *(f"loss {each['loss']:.2g}" for each in others)]
    strides = _strides(scenes)
    header = ["robot", *(f"{COUNTS[count]}, {v:g} mm/s" for count in ROBOTS for v in SPEEDS_MM_S)]
    cells = strides.reshape(len(scenes), -1)
    rows = [[name, *(number(stride, 2) for stride in row)] for name, row in zip(names, cells, strict=True)]
    rows.append(["greatest less smallest", *(number(each, 2) for each in np.ptp(cells, axis=0))])
    text = (
        f"Strides in mm of `{ROBOT}` and of {len(others)} robots that [the identification]"
        "(identification/paper-joint.md) found to fit about as well, as unlike each other as its exploration "
        "reached, averaged as above; four magnets forward. "
        f"{_agreement(strides)}\n\n{table(header, rows)}"
    )
    data = {"speed_mm_s": list(SPEEDS_MM_S), "magnets": list(ROBOTS), "stride_mm": strides.tolist()}
    return Section("Robots that fit about as well", text, data=data)


def _strides(scenes: Sequence[Scene]) -> Floats:
    """Strides (robots, magnets, speeds) [mm]."""
    walks = [
        Walk(scene.with_values({"body.magnets": count}), 1e-3 * speed)
        for scene in scenes
        for count in ROBOTS
        for speed in SPEEDS_MM_S
    ]
    means = [MM * stride.mean_m for stride in measured_strides(walks)]
    return np.array(means).reshape(len(scenes), len(ROBOTS), len(SPEEDS_MM_S))


def _agreement(strides: Floats) -> str:
    """Of how many robots the paper's statements on speed hold, in words."""
    three, four, five = np.moveaxis(strides, 1, 0)
    slow, peak, crossing, fastest = range(len(SPEEDS_MM_S))
    statements = {
        "three magnets are slower at 210 mm/s than at 110": three[:, fastest] < three[:, peak],
        "four are": four[:, fastest] < four[:, peak],
        "five magnets are faster at 210 mm/s than at 110": five[:, fastest] > five[:, peak],
        "three magnets beat five at 110 mm/s": three[:, peak] > five[:, peak],
        "five beat three at 150 mm/s": five[:, crossing] > three[:, crossing],
        "five beat three at 210 mm/s": five[:, fastest] > three[:, fastest],
        "three, four and five differ by less than a quarter at 50 mm/s": np.ptp(strides[:, :, slow], axis=1)
        < 0.25 * strides[:, :, slow].min(axis=1),
    }
    words = [f"{what} with {int(holds.sum())}" for what, holds in statements.items()]
    return f"Of these {len(strides)} robots, {'; '.join(words)}."
