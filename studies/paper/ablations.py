"""The paper's pass with one component of the magnetic load at a time."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from magworm_gym import Scene, record_scenes
from studies.kit.figures import BLUE, INK, ORANGE, RED, REFERENCE, legend_above, panels
from studies.kit.passes import MM, PASS_S, SIMULATION, Floats, one_pass, robot
from studies.paper.experiment import Experiment, Numbers

SAMPLE_S = 0.01
TAIL = 2
COMPONENTS = ("horizontal_force", "vertical_force", "torque")
COLOURS = {"all": INK, "horizontal force": RED, "vertical force": BLUE, "torque": ORANGE}
DRAGGED_MM = 1.0
"""Ours: a robot that ends further than this towards the tail was dragged by the drive."""


@dataclass(frozen=True)
class Ablations(Experiment):
    """The pass whole and with each component alone.

    Attributes:
        time_s: Instants (T,) [s].
        ways_mm: Way of the third magnet towards the head (T,) [mm], by component.
    """

    name: ClassVar[str] = "ablations"
    time_s: Floats
    ways_mm: dict[str, Floats]

    @classmethod
    def measured(cls) -> "Ablations":
        """Runs the pass four times."""
        whole = robot(3, SIMULATION)
        scenes = [whole, *(only(whole, component) for component in COMPONENTS)]
        records = record_scenes([one_pass(scene) for scene in scenes], PASS_S, SAMPLE_S, nodes=False)
        tails = [record.magnet_poses[:, TAIL, 0] for record in records]
        ways = [MM * (tail[0] - tail) for tail in tails]
        return cls(records[0].time_s, dict(zip(COLOURS, ways, strict=True)))

    @property
    def ends_mm(self) -> dict[str, float]:
        """The ways at the end of the pass [mm]."""
        return {name: float(way[-1]) for name, way in self.ways_mm.items()}

    @property
    def alone_mm(self) -> dict[str, float]:
        """Those of one component [mm]."""
        return {name: end for name, end in self.ends_mm.items() if name != "all"}

    @property
    def dragged(self) -> bool:
        """Whether the horizontal force alone takes the robot along with the drive."""
        return self.ends_mm["horizontal force"] < -DRAGGED_MM

    def numbers(self) -> Numbers:
        """Ways, and what the vertical force does beyond the torque."""
        ends = self.ends_mm
        return {
            "ablation.horizontal": ends["horizontal force"],
            "ablation.torque": ends["torque"],
            "ablation.vertical": ends["vertical force"] - ends["torque"],
        }

    def figures(self) -> dict[str, Any]:
        """Ways over time, all and enlarged."""
        figure, axes = panels(1, 2, (9.2, 3.5))
        for axis in axes:
            for name, way in self.ways_mm.items():
                label = "all components" if name == "all" else f"{name} only"
                axis.plot(self.time_s, way, color=COLOURS[name], label=label)
            axis.axhline(0.0, color=REFERENCE, lw=0.6)
            axis.set_xlim(0.0, PASS_S)
            axis.set_xticks(np.arange(0.0, PASS_S + 0.1, 0.25))
            axis.set(xlabel="time [s]", ylabel="third magnet towards the head [mm]")
        inside = [np.clip(end, -4.0, 10.0) for end in self.ends_mm.values()]
        axes[1].set_ylim(min(-4.0, *inside) - 1.0, max(6.0, *inside) + 2.0)
        legend_above(figure, axes[0], 4)
        return {"ablations": figure}


def only(scene: Scene, component: str) -> Scene:
    """The same robot with one of :data:`COMPONENTS` acting and the others switched off."""
    return scene.with_values({f"magnetic_terms.{name}": name == component for name in COMPONENTS})
