"""What robots predict that fit the paper's experiment about as well as the preset.

A dozen figures do not pin down fourteen parameters. The identification found a whole set of robots that fit:
where predictions agree over that set, the figures decide them; where they part, the choice of robot does.
"""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np

from studies.kit.passes import ROBOT, Floats, robot
from studies.kit.words import COUNTS, number
from studies.paper.experiment import Experiment, Numbers
from studies.paper.passes import Walk, measured_strides

OTHERS = Path(__file__).parents[1] / "identification" / "others" / "paper-joint.json"
SPEEDS_MM_S = (50.0, 110.0, 150.0, 210.0)
ROBOTS = (3, 4, 5)


@dataclass(frozen=True)
class OtherFits(Experiment):
    """The preset and the other robots at a few speeds, with three, four and five magnets.

    Attributes:
        losses: How well each of the others fits.
        stride_mm: Strides (robots, magnets, speeds) [mm]; the preset comes first.
    """

    name: ClassVar[str] = "other-fits"
    losses: list[float]
    stride_mm: Floats

    @classmethod
    def measured(cls) -> "OtherFits":
        """Runs all robots at all speeds."""
        others = json.loads(OTHERS.read_text(encoding="utf-8"))
        scenes = [robot(3), *(robot(3).with_values(each["values"]) for each in others)]
        walks = [
            Walk(scene.with_values({"body.magnets": count}), speed)
            for scene in scenes
            for count in ROBOTS
            for speed in SPEEDS_MM_S
        ]
        means = measured_strides(walks).mean_mm
        return cls([each["loss"] for each in others], means.reshape(len(scenes), len(ROBOTS), -1))

    def numbers(self) -> Numbers:
        """None."""
        return {}

    @property
    def head(self) -> list[str]:
        """Of the table."""
        return ["robot", *(f"{COUNTS[count]}, {v:g} mm/s" for count in ROBOTS for v in SPEEDS_MM_S)]

    @property
    def rows(self) -> list[list[str]]:
        """Of the table: a robot each, and by how much they differ."""
        names = [f"`{ROBOT}`", *(f"loss {loss:.2g}" for loss in self.losses), "greatest less smallest"]
        cells = self.stride_mm.reshape(len(self.stride_mm), -1)
        lines = [*cells, np.ptp(cells, axis=0)]
        return [[name, *(number(stride) for stride in line)] for name, line in zip(names, lines, strict=True)]

    @property
    def agreeing(self) -> dict[str, int]:
        """Statements of the paper on speed, each with the number of robots of which it holds."""
        three, four, five = np.moveaxis(self.stride_mm, 1, 0)
        slow, peak, crossing, fastest = range(len(SPEEDS_MM_S))
        each = self.stride_mm[:, :, slow]
        statements = {
            "three magnets are slower at 210 mm/s than at 110": three[:, fastest] < three[:, peak],
            "four magnets are slower at 210 mm/s than at 110": four[:, fastest] < four[:, peak],
            "five magnets are faster at 210 mm/s than at 110": five[:, fastest] > five[:, peak],
            "three magnets beat five at 110 mm/s": three[:, peak] > five[:, peak],
            "five beat three at 150 mm/s": five[:, crossing] > three[:, crossing],
            "five beat three at 210 mm/s": five[:, fastest] > three[:, fastest],
            "three, four and five differ by less than a quarter at 50 mm/s": np.ptp(each, axis=1)
            < 0.25 * each.min(axis=1),
        }
        return {what: int(holds.sum()) for what, holds in statements.items()}
