"""Mirror symmetry: a pass from the other side is the mirrored pass of a symmetric robot."""

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import AHEAD_M, PASS_SPEED_M_S, one_pass, robot
from studies.paper.section import Section, table
from studies.paper.wording import COUNTS

SPEEDS_M_S = (0.050, PASS_SPEED_M_S, 0.210)
SAMPLE_S = 0.002
TOLERABLE_M = 10e-6


def apart_m(there: Recording, mirrored: Recording, length_m: float) -> float:
    """Greatest distance of the centre line from the other's mirror image, at any instant [m].

    Args:
        there: Pass from the head.
        mirrored: Pass from the tail.
        length_m: Length of the robot, which starts with its head end at 0.
    """
    image = mirrored.nodes[:, ::-1] * (-1.0, 1.0) + (length_m, 0.0)
    return float(np.linalg.norm(image - there.nodes, axis=-1).max())


def mirror_section() -> Section:
    """Runs both passes for both symmetric robots."""
    rows, quantities, worst = [], [], 0.0
    for count in (3, 5):
        scene = robot(count)
        for speed in SPEEDS_M_S:
            error, stride = _both_ways(scene, speed)
            worst = max(worst, error)
            rows.append(
                [COUNTS[count], f"{MM * speed:g} mm/s", f"{number(MM * stride, 2)} mm", distance_text(error)]
            )
            if speed == PASS_SPEED_M_S:
                quantities.append(_required(count, error))
    quantities.append(
        Quantity(
            "mirror.worst",
            "Mirrored pass, 3 and 5 magnets, 50 to 210 mm/s: greatest distance",
            "µm",
            1e6 * worst,
            Origin.MODEL,
            note="see the end of the page" if worst > TOLERABLE_M else "",
            digits=1,
        )
    )
    return Section("Mirror symmetry", _text(rows, worst), [], quantities)


def distance_text(error_m: float) -> str:
    """A distance; below a nanometre it is only said that it is: its digits are round-off."""
    return "below 1 nm" if error_m < 1e-9 else f"{number(1e6 * error_m, 2 if error_m < 1e-6 else 0)} µm"


def _required(count: int, error_m: float) -> Quantity:
    return Quantity(
        f"mirror.{COUNTS[count]}",
        f"Mirrored pass, {COUNTS[count]} magnets, 100 mm/s: distance of shapes",
        "µm",
        1e6 * error_m,
        Origin.CLOSED_FORM,
        claim="0, by symmetry",
        digits=1,
    )


def _text(rows: list[list[str]], worst_m: float) -> str:
    apart = (
        f" The greatest, {distance_text(worst_m)}, is more than that. The mirrored motions then agree up to "
        "one "
        "solver step and part in it, where a contact changes: an ambiguity of the contact solve, not a "
        "property of "
        "the robot."
        if worst_m > TOLERABLE_M
        else ""
    )
    return (
        "With an odd number of magnets the robot is its own mirror image. A drive that comes from beyond the "
        "tail "
        "must then give the mirrored motion, up to the tolerance of the contact solve and to round-off, as "
        "sums are "
        "taken from the head on. The table gives the greatest distance between the centre line and the "
        "mirrored one "
        f"over the whole pass.{apart}\n\n" + table(["magnets", "drive", "stride", "distance"], rows)
    )


def _both_ways(scene: Scene, speed_m_s: float) -> tuple[float, float]:
    """Distance of the mirrored passes, and the stride [m]."""
    time_s = (scene.body_length_m + 2.0 * AHEAD_M) / speed_m_s
    pair = [one_pass(scene, speed_m_s), one_pass(scene, speed_m_s, backward=True)]
    there, mirrored = record_scenes(pair, round(time_s / SAMPLE_S) * SAMPLE_S, SAMPLE_S)
    return apart_m(there, mirrored, scene.body_length_m), float(there.progress_m[-1])
