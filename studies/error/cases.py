"""The cases: a pass of the drive in the plane and in space, the lift, two cantilevers, an incline."""

import math
from collections.abc import Sequence

import numpy as np

from magworm_gym import Recording, Scene
from studies.error.case import Axis, Case, Outcome
from studies.error.magnets import magnets
from studies.error.settings import Settings
from studies.kit.passes import AHEAD_M, HOLD_S, LOW_M, PLANE_M, RISE_S, middle_lift, under_middle
from studies.step_error import EVEN_FRICTION
from studies.turning.passes import Drive, outcome_of

MM = 1e3
PASS_S = 1.8
SPEED_M_S = 0.1
HEIGHTS_MM = np.linspace(-22.4, -21.6, 33)
STEPS_MS = (10.0, 5.0, 2.0, 1.0, 0.5)
EULER_MS = (5.0, 2.0, 1.0, 0.5, 0.2)
EXPLICIT_MS = (0.02, 0.01, 0.005)
MESHES = (2, 4, 8, 12)
ORDERS = (0, 1, 2, 3)
INTERVALS = (1, 2, 5, 10)
PRECISIONS = ("double", "single")
SINGLE_MS = (10.0, 5.0, 2.0, 1.0, 0.5)
"""Steps of the front in single precision [ms]."""
HELD = ((5.0, 2), (2.0, 2), (1.0, 2), (0.5, 2), (0.5, 5))
"""Steps [ms] of the front where wrenches act for several steps too, and for how many."""
ROD_STEPS_MS = (4.0, 2.0, 1.0, 0.5, 0.2, 0.1)
ROD_MESHES = (9, 18, 27, 54, 108)
SLOPE_DEG, SLOPE_FRICTION, GRAVITY_M_S2 = 60.0, 0.6, 9.81

PLANE_AXES = (
    Axis("step", [Settings(step) for step in STEPS_MS], Settings(0.05)),
    Axis("step", [Settings(step, integrator="euler") for step in EULER_MS], Settings(0.05)),
    Axis("elements", [Settings(0.2, mesh) for mesh in MESHES], Settings(0.2, 16)),
    Axis("order", [Settings(2.0, order=order) for order in ORDERS], Settings(2.0, order=6)),
)
INTERVAL_AXES = tuple(
    Axis("interval", [Settings(step, interval=held) for held in INTERVALS], Settings(step), costs=True)
    for step in (2.0, 0.5)
)
PRECISION_AXES = tuple(
    Axis("precision", [Settings(step, precision=one) for one in PRECISIONS], Settings(step), costs=True)
    for step in (5.0, 2.0, 1.0, 0.5)
)
PLANE_GRID = [Settings(step, mesh) for mesh in MESHES for step in STEPS_MS]
PLANE_REFERENCE, PLANE_CHECK = Settings(0.1, 16, 4), Settings(0.2, 12, 3)
"""Of the robot in the plane: what is varied, the front, the converged settings and coarser ones."""


def tracks(records: Sequence[Recording], axes: int) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Places of all magnets (R, T, M, axes) [m]."""
    return np.stack([record.magnet_poses[..., :axes] for record in records])


def crawl() -> Case:
    """A pass of the drive in the plane."""
    scenes = []
    for height_mm in HEIGHTS_MM:
        place = {"x_m": -AHEAD_M, "y_m": float(height_mm) / MM, "speed_m_s": SPEED_M_S}
        scenes.append(Scene.preset("paper-3").with_values({"drive.motion": {"kind": "constant", **place}}))
    return Case(
        name="crawl",
        title="A crawling pass",
        text="The drive passes `paper-3` at 100 mm/s, 33 times at heights from −22.4 to −21.6 mm. Stride:"
        " way of the centre; peak: greatest height of the middle magnet; pose: all three magnets over"
        " all time.",
        body="worm",
        scenes=scenes,
        duration_s=PASS_S,
        sample_s=0.02,
        read=read_crawl,
        axes=(*PLANE_AXES, *INTERVAL_AXES, *PRECISION_AXES),
        front=[
            *PLANE_GRID,
            *(Settings(step, 4, 1) for step in (5.0, 2.0)),
            *(Settings(step, 4, integrator="euler") for step in EULER_MS),
            *(Settings(step, mesh, interval=held) for mesh in MESHES for step, held in HELD),
            *(Settings(step, mesh, precision="single") for mesh in MESHES for step in SINGLE_MS),
        ],
        reference=PLANE_REFERENCE,
        check=PLANE_CHECK,
    )


def read_crawl(records: Sequence[Recording]) -> Outcome:
    """Stride [mm], peak [mm] and places of the magnets."""
    places = tracks(records, 2)
    peak = places[:, :, 1, 1].max(axis=1) - places[:, 0, 1, 1]
    stride = np.array([record.progress_m[-1] for record in records])
    return Outcome({"stride": MM * stride, "peak": MM * peak}, places)


def lift() -> Case:
    """The paper's first case."""
    scene = under_middle(Scene.preset("paper-3"), [0.0, RISE_S], [LOW_M, PLANE_M])
    return Case(
        name="lift",
        title="The lift",
        text="The paper's first case: the drive rises under the middle magnet in 0.5 s. Lift: height"
        " gained by that magnet after 0.8 s.",
        body="worm",
        scenes=[scene],
        duration_s=RISE_S + HOLD_S,
        sample_s=0.02,
        read=read_lift,
        axes=PLANE_AXES,
        front=PLANE_GRID,
        reference=PLANE_REFERENCE,
        check=PLANE_CHECK,
    )


def read_lift(records: Sequence[Recording]) -> Outcome:
    """Lift [mm] and places of the magnets."""
    lifts = np.array([middle_lift(record)[-1] for record in records])
    return Outcome({"lift": MM * lifts}, tracks(records, 2))


def cantilever() -> Case:
    """An undamped heavy cantilever let go from the horizontal."""
    scene = Scene.preset("cantilever").with_values({"material.damping_time_s": 0.0})
    return Case(
        name="cantilever",
        title="An undamped heavy cantilever",
        text="54 mm long, 10 × 4 mm, 100 kPa, 1070 kg/m³, undamped, let go from the horizontal: about two"
        " swings in the second that is run. Drop: how far the tip then is below the clamp, 11.76 mm by"
        " an independent discretisation of an extensible Kirchhoff rod; pose: distance of the tip from"
        " where it should be. Backward Euler damps a vibration of frequency ω like a retardation time of"
        " one step, ω Δt/2 a radian: that ruins an undamped rod, while the crawling robot's rubber has a"
        " retardation time as long of its own. Newmark's scheme, with a velocity that lags, damps in"
        " third order, and by a hundredth of a step where tension turns; the explicit one does not damp"
        " at all.",
        body="rod",
        scenes=[scene],
        duration_s=1.0,
        sample_s=0.02,
        read=read_cantilever,
        axes=(
            Axis("step", [Settings(step, 54) for step in ROD_STEPS_MS], Settings(0.02, 54)),
            Axis(
                "step", [Settings(step, 54, integrator="euler") for step in ROD_STEPS_MS], Settings(0.02, 54)
            ),
            Axis(
                "step",
                [Settings(step, 54, integrator="explicit") for step in EXPLICIT_MS],
                Settings(0.02, 54),
            ),
            Axis("elements", [Settings(0.05, mesh) for mesh in ROD_MESHES], Settings(0.05, 216)),
        ),
        front=[Settings(step, mesh) for mesh in ROD_MESHES for step in ROD_STEPS_MS],
        reference=Settings(0.02, 216),
        check=Settings(0.04, 108),
        ranked="pose",
    )


def read_cantilever(records: Sequence[Recording]) -> Outcome:
    """How far the tip is below the clamp [mm], and its place as a track of one instant."""
    tips = np.array([record.nodes[-1, -1] for record in records])
    return Outcome({"drop": -MM * tips[:, 1]}, tips[:, None, None, :])


def incline() -> Case:
    """A block that slides down an incline."""
    scene = Scene.preset("incline-block").with_values({"ground.incline_deg": SLOPE_DEG})
    slope = math.radians(SLOPE_DEG)
    acceleration = GRAVITY_M_S2 * (math.sin(slope) - SLOPE_FRICTION * math.cos(slope))
    return Case(
        name="incline",
        title="A block on an incline",
        text="`incline-block` slides for a second down 60°, with a friction of 0.6. Way: against ½ g (sin"
        " α − μ cos α) t².",
        body="rod",
        scenes=[scene],
        duration_s=1.0,
        sample_s=0.02,
        read=read_incline,
        axes=(
            Axis("step", [Settings(step, 8) for step in STEPS_MS], Settings(0.05, 8)),
            Axis("step", [Settings(step, 8, integrator="euler") for step in EULER_MS], Settings(0.05, 8)),
        ),
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


def turn() -> Case:
    """Passes beside the robot in space."""
    offsets, heights = (2.0, 3.0, 4.0), np.linspace(-22.3, -21.7, 8)
    drives = [
        Drive(3, offset_mm=offset, height_mm=float(height), friction=EVEN_FRICTION)
        for offset in offsets
        for height in heights
    ]
    steps, meshes = (5.0, 2.0, 1.0, 0.5), (2, 4, 8)
    return Case(
        name="turn",
        title="A pass beside the robot, in space",
        text="The drive passes 2, 3 and 4 mm beside the robot, 24 times, with a friction of 0.9 at rest"
        " and in motion: with the presets' friction, which falls as a foot slides, passes branch and"
        " no step of 0.5 ms or longer is converged (README, Speed). Stride and yaw; pose: all magnets"
        " over all time.",
        body="worm",
        scenes=[drive.scene() for drive in drives],
        duration_s=PASS_S,
        sample_s=0.02,
        read=read_turn,
        axes=(
            Axis("step", [Settings(step) for step in steps], Settings(0.1)),
            Axis("step", [Settings(step, integrator="euler") for step in steps], Settings(0.1)),
            Axis("elements", [Settings(0.5, mesh) for mesh in meshes], Settings(0.5, 12)),
            Axis("order", [Settings(2.0, order=order) for order in ORDERS], Settings(2.0, order=5)),
            *INTERVAL_AXES,
            *PRECISION_AXES,
        ),
        front=[
            *(Settings(step, mesh) for mesh in meshes for step in steps),
            *(Settings(step, mesh, interval=held) for mesh in meshes for step, held in HELD),
            *(Settings(step, mesh, precision="single") for mesh in meshes for step in steps),
        ],
        reference=Settings(0.2, 12, 3),
        check=Settings(0.5, 8, 3),
    )


def read_turn(records: Sequence[Recording]) -> Outcome:
    """Stride [mm], yaw [°] and places of the magnets."""
    found = [outcome_of(record) for record in records]
    figures = {
        "stride": np.array([one.stride_mm for one in found]),
        "yaw": np.array([one.yaw_deg for one in found]),
    }
    return Outcome(figures, tracks(records, 3))


CASES = {case.name: case for case in (crawl(), turn(), lift(), cantilever(), magnets(), incline())}
