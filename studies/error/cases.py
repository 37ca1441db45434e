"""The cases: a pass of the drive in the plane and in space, the lift, two cantilevers, an incline."""

import math
from collections.abc import Sequence
from itertools import product

import numpy as np

from magworm_gym import Recording, Scene
from studies.error import magnets
from studies.error.case import Axis, Case, Outcome
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
HEIGHTS_MM = np.linspace(-22.4, -21.6, 33)
SIDE_HEIGHTS_MM, OFFSETS_MM = np.linspace(-22.3, -21.7, 8), (2.0, 3.0, 4.0)
EVEN_FRICTION = 0.9
"""Between the preset's coefficients at rest and in motion."""
SLOPE_DEG, SLOPE_FRICTION, GRAVITY_M_S2 = 60.0, 0.6, 9.81

STEPS_MS, EULER_MS = (10.0, 5.0, 2.0, 1.0, 0.5), (5.0, 2.0, 1.0, 0.5, 0.2)
SPACE_STEPS_MS = STEPS_MS[1:]
MESHES, SPACE_MESHES = (2, 4, 8, 12), (2, 4, 8)
ORDERS = (0, 1, 2, 3)
HELD = ((5.0, 2), (2.0, 2), (1.0, 2), (0.5, 2), (0.5, 5))
"""Steps [ms] of the front where wrenches act for several steps too, and for how many."""
ROD_STEPS_MS, EXPLICIT_MS = (4.0, 2.0, 1.0, 0.5, 0.2, 0.1), (0.02, 0.01, 0.005)
ROD_MESHES = (9, 18, 27, 54, 108)


def passes_below(place_m: float = 0.0) -> list[Scene]:
    """Passes of the drive at neighbouring heights beneath a robot that starts at some place along x."""
    robot = Scene.preset("paper-3").with_values({"start.x_m": place_m})
    motions = [steady(place_m - AHEAD_M, float(height) / MM, PASS_SPEED_M_S) for height in HEIGHTS_MM]
    return [robot.with_values({"drive.motion": motion}) for motion in motions]


def passes_beside(friction: float | None) -> list[Scene]:
    """Passes of the drive at several offsets and neighbouring heights. `friction`: as of a `Drive`."""
    return [
        Drive(3, offset_mm=offset, height_mm=float(height), friction=friction).scene()
        for offset, height in product(OFFSETS_MM, SIDE_HEIGHTS_MM)
    ]


def tracks(records: Sequence[Recording], axes: int) -> Floats:
    """Places of all magnets (R, T, M, axes) [m]."""
    return np.stack([record.magnet_poses[..., :axes] for record in records])


def read_crawl(records: Sequence[Recording]) -> Outcome:
    """Stride [mm], peak of the middle magnet [mm] and places of the magnets."""
    places = tracks(records, 2)
    peak = places[:, :, 1, 1].max(axis=1) - places[:, 0, 1, 1]
    stride = np.array([record.progress_m[-1] for record in records])
    return Outcome({"stride": MM * stride, "peak": MM * peak}, places)


def read_turn(records: Sequence[Recording]) -> Outcome:
    """Stride [mm], yaw [°] and places of the magnets."""
    found = [outcome_of(record) for record in records]
    stride, yaw = np.array([[one.stride_mm, one.turn_deg] for one in found]).T
    return Outcome({"stride": stride, "yaw": yaw}, tracks(records, 3))


def read_lift(records: Sequence[Recording]) -> Outcome:
    """Lift of the middle magnet [mm] and places of the magnets."""
    lifts = np.array([middle_lift(record)[-1] for record in records])
    return Outcome({"lift": MM * lifts}, tracks(records, 2))


def read_cantilever(records: Sequence[Recording]) -> Outcome:
    """How far the tip is below the clamp [mm], and its place as a track of one instant."""
    tips = np.array([record.nodes[-1, -1] for record in records])
    return Outcome({"drop": -MM * tips[:, 1]}, tips[:, None, None, :])


def read_magnets(records: Sequence[Recording]) -> Outcome:
    """Height of the tip's magnet at the end [mm], and places of both."""
    places = tracks(records, 2)
    return Outcome({"height": MM * places[:, -1, -1, 1]}, places)


def read_incline(records: Sequence[Recording]) -> Outcome:
    """Way of the block's centre [mm]."""
    centres = [record.nodes.mean(axis=1) for record in records]
    way = np.array([float(np.linalg.norm(centre[-1] - centre[0])) for centre in centres])
    return Outcome({"way": MM * way}, None)


def slid_mm() -> float:
    """Way of the block in a second, ½ g (sin α − μ cos α) t² [mm]."""
    slope = math.radians(SLOPE_DEG)
    return MM * GRAVITY_M_S2 * (math.sin(slope) - SLOPE_FRICTION * math.cos(slope)) / 2.0


def along_steps(scheme: str, steps_ms: Sequence[float], reference: Settings) -> Axis:
    """An axis of steps with one scheme, on the reference's mesh."""
    values = [Settings(step, reference.elements, integrator=scheme) for step in steps_ms]
    return Axis("step", values, reference)


def grid(steps_ms: Sequence[float], meshes: Sequence[int], precision: str = "double") -> list[Settings]:
    """All steps on all meshes."""
    return [Settings(step, mesh, precision=precision) for mesh in meshes for step in steps_ms]


def held_grid(meshes: Sequence[int]) -> list[Settings]:
    """Steps on all meshes where wrenches act for several of them."""
    return [Settings(step, mesh, interval=held) for mesh in meshes for step, held in HELD]


def cost_axes() -> list[Axis]:
    """How long a wrench acts, and precision, both with what they cost."""
    axes = []
    for step in (2.0, 0.5):
        held = [Settings(step, interval=steps) for steps in (1, 2, 5, 10)]
        axes.append(Axis("interval", held, Settings(step), costs=True))
    for step in SPACE_STEPS_MS:
        both = [Settings(step, precision=one) for one in ("double", "single")]
        axes.append(Axis("precision", both, Settings(step), costs=True))
    return axes


PLANE_AXES = [
    along_steps("newmark", STEPS_MS, Settings(0.05)),
    along_steps("euler", EULER_MS, Settings(0.05)),
    Axis("elements", grid([0.2], MESHES), Settings(0.2, 16)),
    Axis("order", [Settings(2.0, order=order) for order in ORDERS], Settings(2.0, order=6)),
]
SPACE_AXES = [
    along_steps("newmark", SPACE_STEPS_MS, Settings(0.1)),
    along_steps("euler", SPACE_STEPS_MS, Settings(0.1)),
    Axis("elements", grid([0.5], SPACE_MESHES), Settings(0.5, 12)),
    Axis("order", [Settings(2.0, order=order) for order in ORDERS], Settings(2.0, order=5)),
]
CRAWL = Case(
    name="crawl",
    title="A crawling pass",
    body="worm",
    scenes=passes_below(),
    duration_s=PASS_S,
    read=read_crawl,
    axes=[*PLANE_AXES, *cost_axes()],
    ranked="stride",
    front=[
        *grid(STEPS_MS, MESHES),
        *(Settings(step, 4, 1) for step in (5.0, 2.0)),
        *(Settings(step, 4, integrator="euler") for step in EULER_MS),
        *held_grid(MESHES),
        *grid(STEPS_MS, MESHES, "single"),
    ],
    reference=Settings(0.1, 16, 4),
    check=Settings(0.2, 12, 3),
)
TURN = Case(
    name="turn",
    title="A pass beside the robot, in space",
    body="worm",
    scenes=passes_beside(EVEN_FRICTION),
    duration_s=PASS_S,
    read=read_turn,
    axes=[*SPACE_AXES, *cost_axes()],
    ranked="stride",
    front=[
        *grid(SPACE_STEPS_MS, SPACE_MESHES),
        *held_grid(SPACE_MESHES),
        *grid(SPACE_STEPS_MS, SPACE_MESHES, "single"),
    ],
    reference=Settings(0.2, 12, 3),
    check=Settings(0.5, 8, 3),
)
TURN_SLIPPING = Case(
    name="turn-slipping",
    title="The same with friction that falls",
    body="worm",
    scenes=passes_beside(None),
    duration_s=PASS_S,
    read=read_turn,
    axes=SPACE_AXES[:1],
    ranked="stride",
    front=[],
    reference=Settings(0.1),
    check=Settings(0.2),
)
LIFT = Case(
    name="lift",
    title="The lift",
    body="worm",
    scenes=[under_middle(Scene.preset("paper-3"), [0.0, RISE_S], [LOW_M, PLANE_M])],
    duration_s=RISE_S + HOLD_S,
    read=read_lift,
    axes=PLANE_AXES,
    ranked="lift",
    front=grid(STEPS_MS, MESHES),
    reference=Settings(0.1, 16, 4),
    check=Settings(0.2, 12, 3),
)
CANTILEVER = Case(
    name="cantilever",
    title="An undamped heavy cantilever",
    body="rod",
    scenes=[Scene.preset("cantilever").with_values({"material.damping_time_s": 0.0})],
    duration_s=1.0,
    read=read_cantilever,
    axes=[
        along_steps("newmark", ROD_STEPS_MS, Settings(0.02, 54)),
        along_steps("euler", ROD_STEPS_MS, Settings(0.02, 54)),
        along_steps("explicit", EXPLICIT_MS, Settings(0.02, 54)),
        Axis("elements", grid([0.05], ROD_MESHES), Settings(0.05, 216)),
    ],
    ranked="pose",
    front=grid(ROD_STEPS_MS, ROD_MESHES),
    reference=Settings(0.02, 216),
    check=Settings(0.04, 108),
)
MAGNETS = Case(
    name="magnets",
    title="An undamped cantilever with magnets",
    body="rod",
    scenes=[magnets.scene()],
    duration_s=magnets.DURATION_S,
    read=read_magnets,
    axes=[
        along_steps("newmark", ROD_STEPS_MS, Settings(0.02, 54)),
        along_steps("euler", ROD_STEPS_MS, Settings(0.02, 54)),
        Axis("elements", grid([0.05], ROD_MESHES), Settings(0.05, 216)),
        Axis("order", [Settings(1.0, 54, order) for order in ORDERS], Settings(1.0, 54, 6)),
    ],
    ranked="pose",
    front=grid(ROD_STEPS_MS, ROD_MESHES[:-1]),
    reference=Settings(0.02, 216, 4),
    check=Settings(0.04, 108, 3),
)
INCLINE = Case(
    name="incline",
    title="A block on an incline",
    body="rod",
    scenes=[Scene.preset("incline-block").with_values({"ground.incline_deg": SLOPE_DEG})],
    duration_s=1.0,
    read=read_incline,
    axes=[
        along_steps("newmark", STEPS_MS, Settings(0.05, 8)),
        along_steps("euler", EULER_MS, Settings(0.05, 8)),
    ],
    ranked="way",
    front=grid(STEPS_MS, [8]),
    reference=Settings(0.05, 8),
    check=Settings(0.1, 8),
    exact={"way": slid_mm()},
)
CASES = {case.name: case for case in (CRAWL, TURN, TURN_SLIPPING, LIFT, CANTILEVER, MAGNETS, INCLINE)}
