"""Mirror symmetry: a pass from the other side is the mirrored pass of a symmetric robot."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, record_scenes
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import AHEAD_M, PASS_SPEED_M_S, one_pass, robot
from studies.paper.section import Section, table
from studies.paper.wording import COUNTS

Floats = NDArray[np.float64]

SPEEDS_M_S = (0.050, PASS_SPEED_M_S, 0.210)
SAMPLE_S = 0.002
TOLERABLE_M = 10e-6
PARTED_M = 1e-7


@dataclass(frozen=True)
class Both:
    """A pass and its mirror image.

    Attributes:
        magnets: Number of magnets of the robot.
        speed_m_s: Speed of the drive [m/s].
        stride_m: Stride of the pass from the head [m].
        apart_m: Distance of its centre line from the other's mirror image over time (T,) [m].
    """

    magnets: int
    speed_m_s: float
    stride_m: float
    apart_m: Floats

    @property
    def worst_m(self) -> float:
        """Greatest distance [m]."""
        return float(self.apart_m.max())


def apart_m(there: Recording, mirrored: Recording, length_m: float) -> Floats:
    """Greatest distance of a node of the centre line from the other's mirror image (T,) [m].

    Args:
        there: Pass from the head.
        mirrored: Pass from the tail.
        length_m: Length of the robot, which starts with its head end at 0.
    """
    image = mirrored.nodes[:, ::-1] * (-1.0, 1.0) + (length_m, 0.0)
    return np.asarray(np.linalg.norm(image - there.nodes, axis=-1).max(axis=1))


def mirror_section() -> Section:
    """Runs both passes for both symmetric robots."""
    found = [_both_ways(count, speed) for count in (3, 5) for speed in SPEEDS_M_S]
    worst = max(found, key=lambda both: both.worst_m)
    quantities = [_required(both) for both in found if both.speed_m_s == PASS_SPEED_M_S]
    quantities.append(
        Quantity(
            "mirror.worst",
            "Mirrored pass, 3 and 5 magnets, 50 to 210 mm/s: greatest distance",
            "µm",
            1e6 * worst.worst_m,
            Origin.MODEL,
            note="see the end of the page" if worst.worst_m > TOLERABLE_M else "",
            digits=1,
        )
    )
    return Section("Mirror symmetry", _text(found, worst), [], quantities)


def distance_text(error_m: float) -> str:
    """A distance; below a nanometre it is only said that it is: its digits are round-off."""
    return "below 1 nm" if error_m < 1e-9 else f"{number(1e6 * error_m, 2 if error_m < 1e-6 else 0)} µm"


def _required(both: Both) -> Quantity:
    return Quantity(
        f"mirror.{COUNTS[both.magnets]}",
        f"Mirrored pass, {COUNTS[both.magnets]} magnets, 100 mm/s: distance of shapes",
        "µm",
        1e6 * both.worst_m,
        Origin.CLOSED_FORM,
        claim="0, by symmetry",
        digits=1,
    )


def _text(found: list[Both], worst: Both) -> str:
    rows = [
        [
            COUNTS[both.magnets],
            f"{MM * both.speed_m_s:g} mm/s",
            f"{number(MM * both.stride_m, 2)} mm",
            distance_text(both.worst_m),
        ]
        for both in found
    ]
    apart = f" {_parting(worst)}" if worst.worst_m > TOLERABLE_M else ""
    return (
        "With an odd number of magnets the robot is its own mirror image. A drive that comes from beyond "
        "the tail must then give the mirrored motion, up to the tolerance of the contact solve and to "
        "round-off, as sums are taken from the head on. The table gives the greatest distance between the "
        f"centre line and the mirrored one over the whole pass.{apart}\n\n"
        + table(["magnets", "drive", "stride", "distance"], rows)
    )


def _parting(worst: Both) -> str:
    """Where the motions of the worst pair part."""
    first = int((worst.apart_m > PARTED_M).argmax())
    before, after = (distance_text(float(worst.apart_m[sample])) for sample in (first - 1, first))
    return (
        f"The greatest, with {COUNTS[worst.magnets]} magnets at {MM * worst.speed_m_s:g} mm/s, is more than "
        f"that. After {SAMPLE_S * (first - 1):.3f} s the two motions are {before} apart, one solver step "
        f"later {after}: what differs arises in single steps, as from a contact that is resolved otherwise "
        "in the mirror, and stick and slip carry it on. It is an error of the program, not a property of "
        "the robot."
    )


def _both_ways(magnets: int, speed_m_s: float) -> Both:
    scene = robot(magnets)
    time_s = (scene.body_length_m + 2.0 * AHEAD_M) / speed_m_s
    pair = [one_pass(scene, speed_m_s), one_pass(scene, speed_m_s, backward=True)]
    there, mirrored = record_scenes(pair, round(time_s / SAMPLE_S) * SAMPLE_S, SAMPLE_S)
    apart = apart_m(there, mirrored, scene.body_length_m)
    return Both(magnets, speed_m_s, float(there.progress_m[-1]), apart)
