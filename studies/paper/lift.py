"""The paper's first case: the drive rises under the middle magnet, and the robot arches."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, record_scenes
from studies.paper.figures import BLUE, BY_PLACE, ORANGE, PAPER, TEAL, legend_beside, panels, paper_mark
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM, draw_drive, draw_ground, draw_robot
from studies.paper.scenes import PLANE_M, ROBOT, SIMULATION, robot, under_middle
from studies.paper.section import Image, Section

Floats = NDArray[np.float64]

LOW_M = -0.052
"""Paper: where the drive starts."""
RISE_S, HOLD_S = 0.5, 0.3
"""Paper: rise and hold."""
PAPER_LIFT_MM = 7.7
"""Paper: about 1/7 of the body length, 54 mm."""
SAMPLE_S = 0.002

HEIGHTS_M = np.linspace(LOW_M, PLANE_M, 13)
REST_S = 2.0
SLOW_S = 30.0
SLOW_SAMPLE_S = 0.05
SHOWN_S = (0.0, 0.3, 0.4, 0.8)


def middle_lift(recording: Recording) -> Floats:
    """Height gained by the middle magnet (T,) [m]."""
    height = recording.magnet_poses[:, recording.magnet_poses.shape[1] // 2, 1]
    return np.asarray(height - height[0])


def mirror_error(recording: Recording) -> float:
    """Greatest distance of the tail half from the mirrored head half of the centre line [m]."""
    middle = recording.nodes[:1, [0, -1], 0].mean(axis=1)
    mirrored = recording.nodes[:, ::-1] * (-1.0, 1.0)
    mirrored[..., 0] += 2.0 * middle
    return float(np.linalg.norm(mirrored - recording.nodes, axis=-1).max())


def lift_section() -> Section:
    """Runs the case and the sweeps over the height of the drive."""
    robot3 = robot(3, SIMULATION)
    measured = under_middle(robot(3), [0.0, RISE_S], [LOW_M, PLANE_M])
    case = under_middle(robot3, [0.0, RISE_S], [LOW_M, PLANE_M])
    held = [under_middle(robot3, [0.0, RISE_S], [LOW_M, height]) for height in HEIGHTS_M]
    slow = under_middle(robot3, [0.0, SLOW_S, 2.0 * SLOW_S], [LOW_M, PLANE_M, LOW_M])
    record, other = record_scenes([case, measured], RISE_S + HOLD_S, SAMPLE_S)
    *settled, both_ways = record_scenes(
        [*held, slow], [RISE_S + REST_S] * len(held) + [2.0 * SLOW_S], SLOW_SAMPLE_S, nodes=False
    )
    equilibrium = np.array([middle_lift(run)[-1] for run in settled])
    return Section(
        title="Case 1: the drive rises under the middle magnet",
        text=_text(record, equilibrium, both_ways),
        images=[
            Image("lift-postures", "Postures while the drive rises and stands.", _postures(case, record)),
            Image(
                "lift",
                "Left: lift of the middle magnet and displacement of both ends (positive towards the "
                "tail). Right: lift at rest against the height of the drive.",
                _curves(record, equilibrium, both_ways),
            ),
        ],
        quantities=[*_quantities(record), _of_the_robot(other)],
        data={"height_m": HEIGHTS_M.tolist(), "lift_at_rest_m": equilibrium.tolist()},
    )


def _end_slides(record: Recording) -> Floats:
    """Displacement of head and tail end along x (T, 2) [m]."""
    ends = record.nodes[:, [0, -1], 0]
    return np.asarray(ends - ends[0])


def _quantities(record: Recording) -> list[Quantity]:
    lift = MM * middle_lift(record)
    slides = MM * _end_slides(record)[-1]
    inward = 0.5 * float(slides[0] - slides[1])
    error = 100.0 * MM * mirror_error(record) / lift[-1]
    return [
        Quantity(
            "lift.final",
            "Case 1: lift of the middle, drive at −22 mm",
            "mm",
            lift[-1],
            Origin.TARGET,
            paper=PAPER_LIFT_MM,
            claim="1/7 of 54 mm",
        ),
        Quantity(
            "lift.mirror",
            "Case 1: error of the mirror symmetry, of the lift",
            "%",
            error,
            Origin.HELD_BACK,
            claim="symmetric (read as below 1 %)",
            holds=(0.0, 1.0),
        ),
        Quantity(
            "lift.slide",
            "Case 1: each end slides towards the middle by",
            "mm",
            inward,
            Origin.HELD_BACK,
            claim="slides towards the centre (above 0)",
            holds=(1e-9, np.inf),
        ),
    ]


def _of_the_robot(record: Recording) -> Quantity:
    """The lift of the robot that was identified from the experiment."""
    return Quantity(
        "lift.robot",
        f"Case 1: lift of the middle, `{ROBOT}`",
        "mm",
        MM * float(middle_lift(record)[-1]),
        Origin.HELD_BACK,
        paper=PAPER_LIFT_MM,
    )


def _text(record: Recording, equilibrium: Floats, both_ways: Recording) -> str:
    lift, slides = MM * middle_lift(record), MM * _end_slides(record)
    fall = float(lift.max() - lift[-1])
    overshoot = f" after an overshoot of {number(fall, 2)} mm" if fall > 0.02 else ""
    at_rest = record.time_s >= RISE_S
    drift = float(np.ptp(lift[at_rest][-25:]))
    slow = MM * middle_lift(both_ways)
    half = len(slow) // 2
    apart = float(np.abs(slow[: half + 1] - slow[half:][::-1]).max())
    return (
        f"The drive rises from −52 to −22 mm in {RISE_S:g} s and stands for {HOLD_S:g} s. The middle magnet "
        f"ends {number(lift[-1], 2)} mm higher{overshoot}; within the last 50 ms it moves by "
        f"{number(drift, 3)} mm. The head end slides by {number(slides[-1, 0], 2)} mm, the tail end by "
        f"{number(slides[-1, 1], 2)} mm, counted towards the tail. The two halves of the centre line are "
        f"mirror images within {max(1, 1e9 * mirror_error(record)):.0f} nm. The paper calls −22 mm suitable "
        f"because the lift is then about a seventh of the body length; here it is 1/{54.0 / lift[-1]:.1f} of "
        f"it.\n\nOf the lift at rest there is no single curve: friction holds the feet. Raised in {RISE_S:g} "
        f"s and left for {REST_S:g} s, the robot at −22 mm stands at {number(MM * equilibrium[-1], 2)} mm; "
        f"raised over {SLOW_S:g} s at {number(slow[half], 2)} mm. Raised and lowered slowly, the lifts at "
        f"equal height differ by up to {number(apart, 2)} mm."
    )


def _postures(case: Scene, record: Recording) -> Any:
    figure, axes = panels(1, len(SHOWN_S), (9.2, 2.3), sharex=True, sharey=True)
    for axis, time_s in zip(axes, SHOWN_S, strict=True):
        sample = round(time_s / SAMPLE_S)
        draw_ground(axis)
        draw_drive(axis, case, record, sample)
        draw_robot(axis, case, record, sample)
        height = MM * float(record.drive_positions[sample, 0, 1])
        axis.set_title(f"{time_s:g} s, drive at {number(height, 0)} mm", fontsize=9)
        axis.set_xlim(-10.0, 64.0)
        axis.set_ylim(-56.0, 20.0)
        axis.set_aspect("equal")
        axis.set_xlabel("x [mm]")
    axes[0].set_ylabel("y [mm]")
    return figure


def _curves(record: Recording, equilibrium: Floats, both_ways: Recording) -> Any:
    figure, (left, right) = panels(1, 2, (9.2, 3.5))
    slides = MM * _end_slides(record)
    left.plot(record.time_s, MM * middle_lift(record), color=BY_PLACE["middle"], label="lift of the middle")
    left.plot(record.time_s, slides[:, 0], color=BY_PLACE["head"], label="head end, x")
    left.plot(record.time_s, slides[:, 1], color=BY_PLACE["tail"], label="tail end, x")
    left.axhline(PAPER_LIFT_MM, color=PAPER, ls="--", lw=1.0, label="paper: lift ≈ L/7")
    left.axvline(RISE_S, color=PAPER, lw=0.6, ls=":")
    left.set_xlabel("time [s]")
    left.set_ylabel("displacement [mm]")
    left.set_ylim(top=12.0)
    legend_beside(left, "upper left")
    slow, heights = MM * middle_lift(both_ways), MM * both_ways.drive_positions[:, 0, 1]
    half = len(slow) // 2
    right.plot(heights[: half + 1], slow[: half + 1], color=TEAL, label="slowly raised")
    right.plot(heights[half:], slow[half:], color=BLUE, label="slowly lowered")
    right.plot(MM * HEIGHTS_M, MM * equilibrium, "o", color=ORANGE, label="raised in 0.5 s, at rest")
    paper_mark(right, MM * PLANE_M, PAPER_LIFT_MM, "paper")
    right.set_xlabel("height of the drive [mm]")
    right.set_ylabel("lift of the middle [mm]")
    legend_beside(right, "upper left")
    return figure
