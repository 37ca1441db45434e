"""Displacements of the three magnets during the paper's pass, and the presets behind them."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, record_scenes
from studies.paper.figures import BY_PLACE, PAPER, legend_above, panels
from studies.paper.lift import middle_lift
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import PASS_S, ROBOT, SIMULATION, one_pass, robot, values_of
from studies.paper.section import Image, Section, table

Floats = NDArray[np.float64]

SAMPLE_S = 0.002
PAPER_SIMULATION_MM = {"peak": 9.07, "stride": 3.48}
PAPER_EXPERIMENT_MM = {"peak": 8.30, "stride": 4.17}


def displacements_section() -> Section:
    """Runs the pass with each preset for three magnets."""
    scenes = {family: one_pass(robot(3, family)) for family in (ROBOT, SIMULATION)}
    runs = record_scenes(list(scenes.values()), PASS_S, SAMPLE_S)
    records = dict(zip(scenes, runs, strict=True))
    quantities = _quantities("experiment", "experiment", records[ROBOT], PAPER_EXPERIMENT_MM)
    quantities += _quantities("pass", "simulation", records[SIMULATION], PAPER_SIMULATION_MM)
    return Section(
        title="Displacements of the magnets",
        text=_text(records, scenes),
        images=[
            Image(
                "displacements",
                "Left: height gained; right: way towards the head. Dashed and dotted: the paper's peak of "
                "the middle and its way forward.",
                _figure(records),
            )
        ],
        quantities=quantities,
    )


def peak_mm(record: Recording) -> float:
    """Greatest lift of the middle magnet [mm]."""
    return MM * float(middle_lift(record).max())


def stride_mm(record: Recording) -> float:
    """Way of the robot's centre towards its head [mm]."""
    return MM * float(record.progress_m[-1])


def _quantities(key: str, source: str, record: Recording, paper: dict[str, float]) -> list[Quantity]:
    return [
        Quantity(
            f"{key}.peak",
            f"Pass: peak of the middle magnet, paper's {source}",
            "mm",
            peak_mm(record),
            Origin.TARGET,
            paper=paper["peak"],
        ),
        Quantity(
            f"{key}.stride",
            f"Pass: way forward, paper's {source}",
            "mm",
            stride_mm(record),
            Origin.TARGET,
            paper=paper["stride"],
        ),
    ]


def _text(records: dict[str, Recording], scenes: dict[str, Scene]) -> str:
    paragraphs = []
    for family, record in records.items():
        gained = MM * (record.magnet_poses[0, :, 0] - record.magnet_poses[-1, :, 0])
        each = ", ".join(number(float(way), 2) for way in gained)
        spread = float(np.ptp(gained))
        paragraphs.append(
            f"`{family}`: the middle magnet rises by {number(peak_mm(record), 2)} mm; the robot's centre, "
            f"the mean of its magnets, ends {number(stride_mm(record), 2)} mm ahead. The magnets end {each} "
            f"mm ahead (head, middle, tail): they differ by {number(spread, 2)} mm, a change of length that "
            "friction holds."
        )
    paragraphs.append(
        f"`{ROBOT}` is identified from the paper's experiment, `{SIMULATION}` from its simulation, whose "
        "model has no forces between the robot's own magnets. They differ in:\n\n"
        + table(["value", ROBOT, SIMULATION], differing(scenes[ROBOT], scenes[SIMULATION]))
    )
    return "\n\n".join(paragraphs)


def differing(first: Scene, second: Scene) -> list[list[str]]:
    """Rows of path and both values for what differs between two scenes, names left out."""
    one, other = _flat(values_of(first)), _flat(values_of(second))
    paths = [path for path in {**one, **other} if path != "name" and one.get(path) != other.get(path)]
    return [[f"`{path}`", _plain(one.get(path)), _plain(other.get(path))] for path in paths]


def _flat(values: dict[str, Any], before: str = "") -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in values.items():
        if isinstance(value, dict):
            found |= _flat(value, f"{before}{name}.")
        else:
            found[before + name] = value
    return found


def _plain(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else "–" if value is None else str(value)


def _figure(records: dict[str, Recording]) -> Any:
    figure, rows = panels(len(records), 2, (9.2, 3.4 * len(records)), sharex=True, squeeze=False)
    for (family, record), (left, right) in zip(records.items(), rows, strict=True):
        moved = MM * (record.magnet_poses[..., :2] - record.magnet_poses[0, :, :2])
        for place, (name, shade) in enumerate(BY_PLACE.items()):
            left.plot(record.time_s, moved[:, place, 1], color=shade, label=f"{name} magnet")
            right.plot(record.time_s, -moved[:, place, 0], color=shade)
        sources = ((PAPER_SIMULATION_MM, "--", "simulation"), (PAPER_EXPERIMENT_MM, ":", "experiment"))
        for paper, style, source in sources:
            left.axhline(paper["peak"], color=PAPER, ls=style, lw=1.0, label=f"paper, {source}")
            right.axhline(paper["stride"], color=PAPER, ls=style, lw=1.0)
        left.set_ylabel(f"height gained [mm]\n{family}")
        right.set_ylabel("way towards the head [mm]")
        for axis in (left, right):
            axis.set_xlim(0.0, PASS_S)
            axis.set_xticks(np.arange(0.0, PASS_S + 0.1, 0.25))
    legend_above(figure, rows[0, 0], 5)
    for axis in rows[-1]:
        axis.set_xlabel("time [s]")
    return figure
