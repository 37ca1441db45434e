"""The cases: a pass of the drive in the plane and in space, the lift, two cantilevers, an incline."""

import math
from collections.abc import Sequence

import numpy as np

from magworm_gym import Recording, Scene
from studies.error.case import Axis, Case, Outcome
from studies.error.magnets import magnets
from studies.error.settings import Settings
from studies.kit.passes import (
    AHEAD_M,
    HOLD_S,
    LOW_M,
    MM,
    PASS_SPEED_M_S,
    PLANE_M,
    RISE_S,
    Floats,
    middle_lift,
    steady,
    under_middle,
)
from studies.turning.passes import Drive, outcome_of

PASS_S = 1.8
SAMPLE_S = 0.02
HEIGHTS_MM = np.linspace(-22.4, -21.6, 33)
SIDE_HEIGHTS_MM, OFFSETS_MM = np.linspace(-22.3, -21.7, 8), (2.0, 3.0, 4.0)
EVEN_FRICTION = 0.9
"""Between the preset's coefficients at rest and in motion."""
SLOPE_DEG, SLOPE_FRICTION, GRAVITY_M_S2 = 60.0, 0.6, 9.81

STEPS_MS, EULER_MS = (10.0, 5.0, 2.0, 1.0, 0.5), (5.0, 2.0, 1.0, 0.5, 0.2)
SPACE_STEPS_MS = (5.0, 2.0, 1.0, 0.5)
MESHES, SPACE_MESHES = (2, 4, 8, 12), (2, 4, 8)
ORDERS = (0, 1, 2, 3)
HELD = ((5.0, 2), (2.0, 2), (1.0, 2), (0.5, 2), (0.5, 5))
"""Steps [ms] of the front where wrenches act for several steps too, and for how many."""
ROD_STEPS_MS, EXPLICIT_MS = (4.0, 2.0, 1.0, 0.5, 0.2, 0.1), (0.02, 0.01, 0.005)
ROD_MESHES = (9, 18, 27, 54, 108)

COST_AXES = (
    *(
        Axis(
            "interval", [Settings(step, interval=held) for held in (1, 2, 5, 10)], Settings(step), costs=True
        )
        for step in (2.0, 0.5)
    ),
    *(
        Axis(
            "precision", [Settings(step, precision=one) for one in ("double", "single")], Settings(step), True
        )
        for step in (5.0, 2.0, 1.0, 0.5)
    ),
)
PLANE_AXES = (
    Axis("step", [Settings(step) for step in STEPS_MS], Settings(0.05)),
    Axis("step", [Settings(step, integrator="euler") for step in EULER_MS], Settings(0.05)),
    Axis("elements", [Settings(0.2, mesh) for mesh in MESHES], Settings(0.2, 16)),
    Axis("order", [Settings(2.0, order=order) for order in ORDERS], Settings(2.0, order=6)),
)
SPACE_AXES = (
    Axis("step", [Settings(step) for step in SPACE_STEPS_MS], Settings(0.1)),
    Axis("step", [Settings(step, integrator="euler") for step in SPACE_STEPS_MS], Settings(0.1)),
    Axis("elements", [Settings(0.5, mesh) for mesh in SPACE_MESHES], Settings(0.5, 12)),
    Axis("order", [Settings(2.0, order=order) for order in ORDERS], Settings(2.0, order=5)),
)


def crawl() -> Case:
    """A pass of the drive in the plane."""
    return Case(
        name="crawl",
        title="A crawling pass",
        body="worm",
        scenes=passes_below(),
        duration_s=PASS_S,
        sample_s=SAMPLE_S,
        read=read_crawl,
        axes=(*PLANE_AXES, *COST_AXES),
        ranked="stride",
        front=[
            *plane_front(),
            *(Settings(step, 4, 1) for step in (5.0, 2.0)),
            *(Settings(step, 4, integrator="euler") for step in EULER_MS),
            *(Settings(step, mesh, interval=held) for mesh in MESHES for step, held in HELD),
            *(Settings(step, mesh, precision="single") for mesh in MESHES for step in STEPS_MS),
        ],
        reference=Settings(0.1, 16, 4),
        check=Settings(0.2, 12, 3),
    )


def passes_below(place_m: float = 0.0) -> list[Scene]:
    """Passes of the drive at neighbouring heights beneath a robot that starts at some place along x."""
    robot = Scene.preset("paper-3").with_values({"start.x_m": place_m})
    motions = [steady(place_m - AHEAD_M, float(height) / MM, PASS_SPEED_M_S) for height in HEIGHTS_MM]
    return [robot.with_values({"drive.motion": motion}) for motion in motions]


def plane_front() -> list[Settings]:
    """Steps and meshes of the robot in the plane."""
    return [Settings(step, mesh) for mesh in MESHES for step in STEPS_MS]


def read_crawl(records: Sequence[Recording]) -> Outcome:
    """Stride [mm], peak of the middle magnet [mm] and places of the magnets."""
    places = tracks(records, 2)
    peak = places[:, :, 1, 1].max(axis=1) - places[:, 0, 1, 1]
    stride = np.array([record.progress_m[-1] for record in records])
    return Outcome({"stride": MM * stride, "peak": MM * peak}, places)


def tracks(records: Sequence[Recording], axes: int) -> Floats:
    """Places of all magnets (R, T, M, axes) [m]."""
    return np.stack([record.magnet_poses[..., :axes] for record in records])


def turn() -> Case:
    """Passes beside the robot in space, with a friction that does not fall as a foot begins to slide."""
    return Case(
        name="turn",
        title="A pass beside the robot, in space",
        body="worm",
        scenes=passes_beside(EVEN_FRICTION),
        duration_s=PASS_S,
        sample_s=SAMPLE_S,
        read=read_turn,
        axes=(*SPACE_AXES, *COST_AXES),
        ranked="stride",
        front=[
            *(Settings(step, mesh) for mesh in SPACE_MESHES for step in SPACE_STEPS_MS),
            *(Settings(step, mesh, interval=held) for mesh in SPACE_MESHES for step, held in HELD),
            *(Settings(step, mesh, precision="single") for mesh in SPACE_MESHES for step in SPACE_STEPS_MS),
        ],
        reference=Settings(0.2, 12, 3),
        check=Settings(0.5, 8, 3),
    )


def turn_slipping() -> Case:
    """The same with the preset's friction, which falls."""
    return Case(
        name="turn-slipping",
        title="The same with friction that falls",
        body="worm",
        scenes=passes_beside(None),
        duration_s=PASS_S,
        sample_s=SAMPLE_S,
        read=read_turn,
        axes=SPACE_AXES[:1],
        ranked="stride",
        front=[],
        reference=Settings(0.1),
        check=Settings(0.2),
    )


def passes_beside(friction: float | None) -> list[Scene]:
    """Passes of the drive at several offsets and neighbouring heights. `friction`: as of a `Drive`."""
    return [
        Drive(3, offset_mm=offset, height_mm=float(height), friction=friction).scene()
        for offset in OFFSETS_MM
        for height in SIDE_HEIGHTS_MM
    ]


def read_turn(records: Sequence[Recording]) -> Outcome:
    """Stride [mm], yaw [°] and places of the magnets."""
    found = [outcome_of(record) for record in records]
    stride, yaw = np.array([[one.stride_mm, one.turn_deg] for one in found]).T
    return Outcome({"stride": stride, "yaw": yaw}, tracks(records, 3))


def lift() -> Case:
    """The paper's first case."""
    return Case(
        name="lift",
        title="The lift",
        body="worm",
        scenes=[under_middle(Scene.preset("paper-3"), [0.0, RISE_S], [LOW_M, PLANE_M])],
        duration_s=RISE_S + HOLD_S,
        sample_s=SAMPLE_S,
        read=read_lift,
        axes=PLANE_AXES,
        ranked="lift",
        front=plane_front(),
        reference=Settings(0.1, 16, 4),
        check=Settings(0.2, 12, 3),
    )


def read_lift(records: Sequence[Recording]) -> Outcome:
    """Lift of the middle magnet [mm] and places of the magnets."""
    lifts = np.array([middle_lift(record)[-1] for record in records])
    return Outcome({"lift": MM * lifts}, tracks(records, 2))


def cantilever() -> Case:
    """An undamped heavy cantilever let go from the horizontal."""
    settled = Settings(0.02, 54)
    return Case(
        name="cantilever",
        title="An undamped heavy cantilever",
        body="rod",
        scenes=[Scene.preset("cantilever").with_values({"material.damping_time_s": 0.0})],
        duration_s=1.0,
        sample_s=SAMPLE_S,
        read=read_cantilever,
        axes=(
            Axis("step", [Settings(step, 54) for step in ROD_STEPS_MS], settled),
            Axis("step", [Settings(step, 54, integrator="euler") for step in ROD_STEPS_MS], settled),
            Axis("step", [Settings(step, 54, integrator="explicit") for step in EXPLICIT_MS], settled),
            Axis("elements", [Settings(0.05, mesh) for mesh in ROD_MESHES], Settings(0.05, 216)),
        ),
        ranked="pose",
        front=[Settings(step, mesh) for mesh in ROD_MESHES for step in ROD_STEPS_MS],
        reference=Settings(0.02, 216),
        check=Settings(0.04, 108),
    )


def read_cantilever(records: Sequence[Recording]) -> Outcome:
    """How far the tip is below the clamp [mm], and its place as a track of one instant."""
    tips = np.array([record.nodes[-1, -1] for record in records])
    return Outcome({"drop": -MM * tips[:, 1]}, tips[:, None, None, :])


def incline() -> Case:
    """A block that slides down an incline."""
    slope = math.radians(SLOPE_DEG)
    acceleration = GRAVITY_M_S2 * (math.sin(slope) - SLOPE_FRICTION * math.cos(slope))
    return Case(
        name="incline",
        title="A block on an incline",
        body="rod",
        scenes=[Scene.preset("incline-block").with_values({"ground.incline_deg": SLOPE_DEG})],
        duration_s=1.0,
        sample_s=SAMPLE_S,
        read=read_incline,
        axes=(
            Axis("step", [Settings(step, 8) for step in STEPS_MS], Settings(0.05, 8)),
            Axis("step", [Settings(step, 8, integrator="euler") for step in EULER_MS], Settings(0.05, 8)),
        ),
        ranked="way",
        front=[Settings(step, 8) for step in STEPS_MS],
        reference=Settings(0.05, 8),
        check=Settings(0.1, 8),
        exact={"way": MM * acceleration / 2.0},
    )


def read_incline(records: Sequence[Recording]) -> Outcome:
    """Way of the block's centre [mm]."""
    centres = [record.nodes.mean(axis=1) for record in records]
    way = np.array([float(np.linalg.norm(centre[-1] - centre[0])) for centre in centres])
    return Outcome({"way": MM * way}, None)


CASES = {
    case.name: case for case in (crawl(), turn(), turn_slipping(), lift(), cantilever(), magnets(), incline())
}
