"""Body magnets of several sizes, directions and places: the simulator's wrench against magpylib's field."""

from typing import Any

import numpy as np
import pytest
from charged_faces import Floats, face_wrench

from magworm_gym import Batch, Scene

magpylib = pytest.importorskip("magpylib", reason="the extra peers is not installed")
Rotation = pytest.importorskip("scipy.spatial.transform").Rotation

STEPS = 60
"""Control steps of the trajectory, in which the drive goes past."""


def magnet(size_m: tuple[float, float, float], **more: float) -> dict[str, float]:
    length, height, width = size_m
    rest = {"remanence_t": 1.22, "density_kg_m3": 7500.0}
    return {"length_m": length, "height_m": height, "width_m": width, **rest, **more}


def robot(dimensions: int, order: int) -> Scene:
    """Four feet with magnets of three sizes and four directions, two of them beside the middle.

    The drive alone acts on them: pairs of the body's magnets choose their order themselves.
    """
    space = dimensions == 3
    small, long, tall = (0.006, 0.002, 0.007), (0.009, 0.0015, 0.006), (0.004, 0.004, 0.005)
    magnets = [
        magnet(small),
        magnet(long, angle_deg=180.0, up_m=-0.001, aside_deg=25.0 * space),
        magnet(tall, angle_deg=90.0, along_m=0.002),
        magnet(small, angle_deg=-130.0, up_m=0.0015, aside_deg=-40.0 * space, aside_m=0.001 * space),
    ]
    foot = {"length_m": 0.014, "thickness_m": 0.007, "width_m": 0.0113, "foot": True, "elements": 1}
    bridge = {"length_m": 0.006, "thickness_m": 0.004, "width_m": 0.0113, "elements": 4}
    segments: list[dict[str, Any]] = []
    for one in magnets:
        segments += [{**foot, "magnet": one}, bridge]
    motion = {"kind": "constant", "x_m": -0.01, "y_m": -0.022, "speed_m_s": 0.07}
    beside = {"z_m": 0.004, "yaw_deg": 20.0} if space else {}
    return Scene.preset("paper-4").with_values(
        {
            "magnet": None,
            "body": {"kind": "segments", "segment": segments[:-1]},
            "dimensions": dimensions,
            "drive.motion": {**motion, **beside},
            "magnetic_terms.mutual": False,
            "solver.quadrature_order": order,
        }
    )


def poses(batch: Batch) -> tuple[Floats, Floats]:
    """Middle (M, 3) [m] and axes (M, 3, 3) of each body."""
    rows = batch.magnet_poses()[0]
    if rows.shape[1] == 3:
        turns = Rotation.from_rotvec(rows[:, 2:] * np.array([0.0, 0.0, 1.0]))
        return np.column_stack([rows[:, :2], np.zeros(len(rows))]), turns.as_matrix()
    return rows[:, :3], Rotation.from_quat(rows[:, [4, 5, 6, 3]]).as_matrix()


def reference(batch: Batch) -> Floats:
    """Force and torque about the middle of its body on each magnet (M, 6)."""
    geometry = batch.scene.geometry
    length, height = geometry["drive_size_m"]
    drive = batch.drive_positions()[0, 0]
    yaw = drive[3] if len(drive) > 3 else 0.0
    source = magpylib.magnet.Cuboid(
        dimension=(length, height, geometry["drive_width_m"]),
        polarization=(0.0, 1.22, 0.0),
        position=(drive[0], drive[1], drive[2] if len(drive) > 2 else 0.0),
        orientation=Rotation.from_rotvec((0.0, yaw, 0.0)),
    )
    wrenches = []
    for body, (middle, axes) in enumerate(zip(*poses(batch), strict=True)):
        arm = axes @ geometry["magnet_offset_m"][body]
        remanence = 1.22 * np.asarray(geometry["magnet_direction"][body])
        size = np.asarray(geometry["magnet_size_m"][body])
        wrench = face_wrench(source, size, remanence, middle + arm, axes)
        wrench[3:] += np.cross(arm, wrench[:3])
        wrenches.append(wrench)
    return np.array(wrenches)


def errors(dimensions: int, order: int) -> tuple[float, float]:
    """Greatest error of a force, and of a torque by the length of a magnet, as parts of the force."""
    batch = Batch(robot(dimensions, order), 1)
    batch.reset(np.ones(1, np.bool_), np.array([3], np.uint64), np.zeros(1, np.uint64))
    acting = [0, 1, 5] if dimensions == 2 else list(range(6))
    forces, torques = [], []
    for _ in range(STEPS):
        batch.advance(0.02)
        exact, found = reference(batch), np.zeros((4, 6))
        found[:, acting] = batch.magnet_wrenches()[0]
        of_force = np.linalg.norm(exact[:, :3], axis=1)
        wrong = found - exact
        if dimensions == 2:
            wrong[:, [2, 3, 4]] = 0.0
        forces.append(np.linalg.norm(wrong[:, :3], axis=1) / of_force)
        torques.append(np.linalg.norm(wrong[:, 3:], axis=1) / (of_force * 0.006))
    assert (batch.status() == 0).all()
    return float(np.max(forces)), float(np.max(torques))


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize(
    ("order", "least", "force_within", "torque_within"), [(8, 0.0, 1e-7, 1e-7), (2, 1e-7, 1e-3, 4e-3)]
)
def test_wrenches_along_a_trajectory_are_those_of_magpylib(
    dimensions: int, order: int, least: float, force_within: float, torque_within: float
) -> None:
    """Order 2 is that of the presets, and is told from order 8."""
    force, torque = errors(dimensions, order)
    print(f"{dimensions} dimensions, order {order}: force and torque within {force:.1e}, {torque:.1e} of |F|")
    assert least < force < force_within and torque < torque_within
