"""Shapes of the robot during one pass, in the paper's four stages, and what it says of each."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, record_scenes
from studies.paper.feet import OFF_GROUND_M, sole_heights
from studies.paper.figures import panels
from studies.paper.loads import magnetic_loads
from studies.paper.quantity import Origin, Quantity, model_text, number
from studies.paper.robot_picture import MM, draw_drive, draw_ground, draw_robot
from studies.paper.scenes import PASS_S, one_pass, robot
from studies.paper.section import Image, Section, table
from studies.paper.stages import NAMES, spans

Floats = NDArray[np.float64]

SAMPLE_S = 0.002
PICTURES = ((0.66, 0.97), (0.35, 0.85), (0.15, 0.70), (0.06, 0.40))
"""Instants that are drawn, as shares of each stage's duration."""
ABOVE = (1e-9, np.inf)
BELOW = (-np.inf, -1e-9)
HEAD, MIDDLE, TAIL = range(3)


@dataclass(frozen=True)
class Pass:
    """One recorded pass.

    Attributes:
        scene: The robot and its drive.
        record: Its recording.
        force: Magnetic forces (T, 3, 2) [N].
        torque: Magnetic torques (T, 3), anticlockwise [N·m].
        soles: Heights of both ends of each foot (T, 3, 2) [m].
        stages: Samples of each stage.
    """

    scene: Scene
    record: Recording
    force: Floats
    torque: Floats
    soles: Floats
    stages: list[slice]


def recorded_pass(scene: Scene) -> Pass:
    """Records the paper's pass of a robot with three magnets."""
    moving = one_pass(scene)
    (record,) = record_scenes([moving], PASS_S, SAMPLE_S)
    force, torque = magnetic_loads(moving, record)
    return Pass(moving, record, force, torque, sole_heights(moving, record), spans(record))


def morphology_section() -> Section:
    """Runs the pass, draws it and checks what the paper says of each stage."""
    walk = recorded_pass(robot(3))
    checks = _stage_one(walk) + _stage_two(walk) + _stage_three(walk) + _stage_four(walk)
    times = ", ".join(
        f"{name} until {number(float(walk.record.time_s[span.stop - 1]), 2)} s"
        for name, span in zip(NAMES, walk.stages, strict=True)
    )
    rows = [[q.what, q.claim, model_text(q), "yes" if q.as_claimed else "**no**"] for q in checks]
    text = (
        "The drive starts 50 mm ahead of the head end and moves at 100 mm/s for 1.5 s. The stages follow "
        "the place of the drive: I ahead of the first magnet, II and III ahead of and behind the middle "
        f"one, IV behind the last ({times}). Torques and forces are those of the drive at the recorded "
        "poses; anticlockwise is positive with the head on the left.\n\n"
        + table(["what", "paper", "model", "agrees"], rows)
        + "\n\n"
        + _text(walk)
    )
    image = Image(
        "morphology", "One pass, two instants of each stage; the head is on the left.", _figure(walk)
    )
    return Section("Crawling morphology in four stages", text, [image], [_summary(checks), *checks])


def _summary(checks: list[Quantity]) -> Quantity:
    """How many of the paper's statements hold."""
    kept = sum(check.as_claimed for check in checks)
    return Quantity(
        "stages.statements",
        f"Stages: statements of the paper that hold, of {len(checks)}",
        "",
        kept,
        Origin.HELD_BACK,
        claim=f"all {len(checks)}",
        holds=(len(checks), len(checks)),
        digits=0,
        note="which, see its section" if kept < len(checks) else "",
    )


def _check(key: str, what: str, unit: str, model: float, claim: str, holds: tuple[float, float]) -> Quantity:
    """One statement of the paper about a stage."""
    return Quantity(
        f"stages.{key}", what, unit, float(model), Origin.HELD_BACK, claim=claim, holds=holds, listed=False
    )


def _stage_one(walk: Pass) -> list[Quantity]:
    span = walk.stages[0]
    toe = walk.soles[span, HEAD, 0]
    top = int(toe.argmax())
    return [
        _check(
            "front_torque",
            "I: torque on the first magnet when its foot is highest",
            "mN·m",
            1e3 * walk.torque[span, HEAD][top],
            "clockwise (below 0)",
            BELOW,
        ),
        _check(
            "front_lift",
            "I: lift of the anterior foot's toe",
            "mm",
            MM * toe.max(),
            "lifted slightly (read as 0.1 to 2 mm)",
            (0.1, 2.0),
        ),
        _check(
            "front_anchor",
            "I: vertical force on the first magnet at the end",
            "N",
            walk.force[span, HEAD, 1][-1],
            "anchored by attraction (below 0)",
            BELOW,
        ),
    ]


def _stage_two(walk: Pass) -> list[Quantity]:
    span = walk.stages[1]
    third = slice(span.start, span.start + (span.stop - span.start) // 3)
    line, poses = walk.record.nodes[third], walk.record.magnet_poses[third]
    crest = np.take_along_axis(line[..., 0], line[..., 1].argmax(axis=1)[:, None], axis=1)[:, 0]
    place = (crest - poses[:, MIDDLE, 0]) / (poses[:, TAIL, 0] - poses[:, MIDDLE, 0])
    torque = 1e3 * walk.torque[span].mean(axis=0)
    return [
        _check(
            "wave",
            "II: crest of the wave in the first third, from magnet 2 (0) to magnet 3 (1)",
            "",
            place.mean(),
            "between second and third (0 to 1)",
            (0.0, 1.0),
        ),
        _check(
            "middle_torque",
            "II: mean torque on the second magnet",
            "mN·m",
            torque[MIDDLE],
            "counterclockwise (above 0)",
            ABOVE,
        ),
        _check(
            "rear_torque",
            "II: mean torque on the third magnet",
            "mN·m",
            torque[TAIL],
            "clockwise (below 0)",
            BELOW,
        ),
    ]


def _stage_three(walk: Pass) -> list[Quantity]:
    height = walk.record.magnet_poses[:, MIDDLE, 1]
    top = int(height.argmax())
    apart = walk.record.magnet_poses[:, TAIL, 0] - walk.record.magnet_poses[:, HEAD, 0]
    over = walk.record.drive_positions[top, 0, 0] - walk.record.magnet_poses[top, MIDDLE, 0]
    return [
        _check(
            "peak_force",
            "II/III: vertical force on the middle magnet at the peak",
            "N",
            walk.force[top, MIDDLE, 1],
            "repelled (above 0)",
            ABOVE,
        ),
        _check(
            "peak_place",
            "II/III: drive behind the middle magnet at the peak by",
            "mm",
            MM * over,
            "at the middle magnet (read as within 10 mm)",
            (-10.0, 10.0),
        ),
        _check(
            "drawn",
            "II/III: outer feet drawn towards each other at the peak by",
            "mm",
            MM * (apart[0] - apart[top]),
            "dragged toward the center (above 0)",
            ABOVE,
        ),
    ]


def _stage_four(walk: Pass) -> list[Quantity]:
    record, span = walk.record, walk.stages[3]
    top = int(record.magnet_poses[:, MIDDLE, 1].argmax())
    end = record.magnet_poses[-1, :, 0]
    moved = MM * (record.magnet_poses[top, :, 0] - end)
    return [
        _check(
            "rear_anchor",
            "IV: vertical force on the third magnet at the beginning",
            "N",
            walk.force[span, TAIL, 1][0],
            "anchored by attraction (below 0)",
            BELOW,
        ),
        _check(
            "head_push",
            "III/IV: head moves forward while the robot flattens by",
            "mm",
            moved[HEAD],
            "pushed forward (above 0)",
            ABOVE,
        ),
        _check(
            "rear_slip",
            "III/IV: tail slides backward meanwhile by",
            "mm",
            -moved[TAIL],
            "does not slide (read as below 0.5 mm)",
            (-np.inf, 0.5),
        ),
        _check(
            "rear_lift",
            "lift of the posterior foot's heel over the pass",
            "mm",
            MM * walk.soles[:, TAIL, 1].max(),
            "lifted slightly (read as 0.1 to 2 mm)",
            (0.1, 2.0),
        ),
    ]


def _text(walk: Pass) -> str:
    tilt = np.degrees(np.abs(walk.record.magnet_poses[..., 2]).max(axis=0))
    grounded = MM * walk.soles.min(axis=(1, 2)).max()
    flight = (
        f"the whole robot leaves the ground by {number(grounded, 2)} mm"
        if grounded > MM * OFF_GROUND_M
        else "at every instant at least one edge of a foot is on the ground"
    )
    return (
        f"The feet tilt by up to {tilt[HEAD]:.0f}°, {tilt[MIDDLE]:.0f}° and {tilt[TAIL]:.0f}° and stand on "
        f"their edges while they do, the edge contact that the paper mentions; {flight}."
    )


def _figure(walk: Pass) -> Any:
    figure, axes = panels(len(NAMES), 2, (9.2, 7.4), sharex=True, sharey=True)
    for row, (name, span, shares) in enumerate(zip(NAMES, walk.stages, PICTURES, strict=True)):
        for axis, share in zip(axes[row], shares, strict=True):
            sample = span.start + round(share * (span.stop - 1 - span.start))
            draw_ground(axis)
            draw_drive(axis, walk.scene, walk.record, sample)
            draw_robot(axis, walk.scene, walk.record, sample)
            axis.set_title(f"stage {name}, {walk.record.time_s[sample]:.2f} s", fontsize=9)
            axis.set_xlim(-30.0, 90.0)
            axis.set_ylim(-26.0, 20.0)
            axis.set_aspect("equal")
        axes[row, 0].set_ylabel("y [mm]")
    for axis in axes[-1]:
        axis.set_xlabel("x [mm]")
    return figure
