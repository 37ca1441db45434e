"""The paper's pass with one component of the magnetic load at a time."""

from typing import Any

import numpy as np

from magworm_gym import Recording, record_scenes
from studies.paper.figures import BLUE, INK, ORANGE, PAPER, RED, legend_above, panels
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import FORCES, PASS_S, SIMULATION, one_pass, only, robot
from studies.paper.section import Image, Section
from studies.paper.wording import ranking

SAMPLE_S = 0.002
TAIL = 2
NAMES = {"horizontal_force": "horizontal force", "vertical_force": "vertical force", "torque": "torque"}
COLOURS = {"all": INK, "horizontal force": RED, "vertical force": BLUE, "torque": ORANGE}
DRAGGED_MM = 1.0
"""Ours: a robot that ends further than this towards the tail was dragged by the drive."""


def ablations_section() -> Section:
    """Runs the pass whole and with each component alone."""
    whole = robot(3, SIMULATION)
    scenes = {"all": whole} | {NAMES[force]: only(whole, force) for force in FORCES}
    runs = record_scenes([one_pass(scene) for scene in scenes.values()], PASS_S, SAMPLE_S, nodes=False)
    records = dict(zip(scenes, runs, strict=True))
    ways = {name: _tail_way_mm(record) for name, record in records.items()}
    return Section(
        title="One component of the magnetic load at a time",
        text=_text(ways),
        images=[
            Image(
                "ablations",
                "Way of the third magnet towards the head with one component alone. Left: all; right: the "
                "same, enlarged.",
                _figure(records),
            )
        ],
        quantities=_quantities(ways),
        data={"way_mm": ways},
    )


def _tail_way_mm(record: Recording) -> float:
    """Way of the third magnet towards the head at the end [mm]."""
    return MM * float(record.magnet_poses[0, TAIL, 0] - record.magnet_poses[-1, TAIL, 0])


def _quantities(ways: dict[str, float]) -> list[Quantity]:
    vertical, torque = ways["vertical force"], ways["torque"]
    return [
        Quantity(
            "ablation.horizontal",
            "Third magnet forward, horizontal force only",
            "mm",
            ways["horizontal force"],
            Origin.TARGET,
            claim="not obvious",
        ),
        Quantity(
            "ablation.torque",
            "Third magnet forward, torque only",
            "mm",
            torque,
            Origin.TARGET,
            claim="contributes (above 0)",
        ),
        Quantity(
            "ablation.vertical",
            "… vertical force only, beyond torque only",
            "mm",
            vertical - torque,
            Origin.TARGET,
            claim="vertical contributes most (above 0)",
        ),
    ]


def _text(ways: dict[str, float]) -> str:
    single = {name: way for name, way in ways.items() if name != "all"}
    horizontal = single["horizontal force"]
    dragged = (
        f" The horizontal force alone drags the robot {number(-horizontal, 1)} mm along with the drive, "
        "where the paper "
        'calls the displacement "not obvious".'
        if horizontal < -DRAGGED_MM
        else f" The horizontal force alone moves it by {number(horizontal, 2)} mm."
    )
    listing = ", ".join(f"{name} {number(way, 2)} mm" for name, way in ways.items())
    order = ranking(single)
    paper = "vertical force > torque > horizontal force"
    agreement = "which is the paper's order" if order == paper else f"the paper's order is {paper}"
    return (
        f"Way of the third magnet towards the head at the end of the pass: {listing}. The order is {order}; "
        f"{agreement}.{dragged}"
    )


def _figure(records: dict[str, Recording]) -> Any:
    figure, axes = panels(1, 2, (9.2, 3.5))
    for axis in axes:
        for name, record in records.items():
            way = MM * (record.magnet_poses[0, TAIL, 0] - record.magnet_poses[:, TAIL, 0])
            label = "all components" if name == "all" else f"{name} only"
            axis.plot(record.time_s, way, color=COLOURS[name], label=label)
        axis.axhline(0.0, color=PAPER, lw=0.6)
        axis.set_xlim(0.0, PASS_S)
        axis.set_xticks(np.arange(0.0, PASS_S + 0.1, 0.25))
        axis.set_xlabel("time [s]")
        axis.set_ylabel("third magnet towards the head [mm]")
    inside = [np.clip(_tail_way_mm(record), -4.0, 10.0) for record in records.values()]
    axes[1].set_ylim(min(-4.0, *inside) - 1.0, max(6.0, *inside) + 2.0)
    legend_above(figure, axes[0], 4)
    return figure
