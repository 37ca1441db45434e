"""Strides of a robot that carries a load, spread evenly over its body.

The paper's robot carries 75 % of its weight on a tail that is folded forward and locks to a body magnet. Here
the body is heavier by the load and as stiff as before: what weight and inertia do, not what their place does.
"""

from dataclasses import dataclass
from typing import Any, ClassVar

from studies.kit.figures import REFERENCE, legend_beside, panels
from studies.kit.passes import robot
from studies.kit.words import with_spread
from studies.paper.experiment import Experiment, Numbers
from studies.paper.passes import Strides, Walk, measured_strides

LOADS_PERCENT = (0.0, 25.0, 50.0, 75.0, 100.0, 150.0, 200.0, 300.0)
PAPER_PERCENT = 75.0
SPEEDS_MM_S = (50.0, 80.0, 110.0, 150.0, 210.0)


@dataclass(frozen=True)
class Load(Experiment):
    """The robot with three magnets under every load at every speed.

    Attributes:
        strides: Its strides (loads, speeds).
    """

    name: ClassVar[str] = "load"
    strides: Strides

    @classmethod
    def measured(cls) -> "Load":
        """Runs all loads."""
        scenes = [robot(3).with_values({"reset.vary": [_heavier(load)]}) for load in LOADS_PERCENT]
        strides = measured_strides([Walk(scene, speed) for scene in scenes for speed in SPEEDS_MM_S])
        return cls(strides.reshaped(len(scenes), len(SPEEDS_MM_S)))

    def numbers(self) -> Numbers:
        """At how many speeds it crawls with the paper's load."""
        return {"load.crawls": self.strides[LOADS_PERCENT.index(PAPER_PERCENT)].crawls.sum()}

    @property
    def head(self) -> list[str]:
        """Of the table."""
        return ["load, % of the weight", *(f"{speed:g} mm/s" for speed in SPEEDS_MM_S)]

    @property
    def rows(self) -> list[list[str]]:
        """Of the table, a load each; in brackets where the robot does not crawl."""
        rows = []
        for load, mean, spread, crawls in zip(
            LOADS_PERCENT, self.strides.mean_mm, self.strides.spread_mm, self.strides.crawls, strict=True
        ):
            texts = [with_spread(*both) for both in zip(mean, spread, strict=True)]
            cells = [text if fit else f"({text})" for text, fit in zip(texts, crawls, strict=True)]
            rows.append([f"{load:g}", *cells])
        return rows

    def figures(self) -> dict[str, Any]:
        """Strides against the load."""
        figure, axes = panels(1, 1, (6.0, 3.6))
        for speed, means in zip(SPEEDS_MM_S, self.strides.mean_mm.T, strict=True):
            axes.plot(LOADS_PERCENT, means, "o-", label=f"{speed:g} mm/s")
        axes.axvline(PAPER_PERCENT, color=REFERENCE, lw=0.8, ls=":")
        axes.set(xlabel="load [% of the weight]", ylabel="stride [mm]")
        legend_beside(axes)
        return {"load": figure}


def _heavier(load_percent: float) -> dict[str, Any]:
    """What makes every mass of a robot, and with it its weight, greater by a load."""
    factor = 1.0 + load_percent / 100.0
    return {"parameter": "mass", "low": factor, "high": factor}
