"""Fields and wrenches against tables and other programs."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from charged_faces import face_wrench

from magworm_gym.magnet import field, wrench

TABLE = Path(__file__).parent / "data" / "magnet_reference.csv"


def columns(table: Any, *names: str) -> np.ndarray:
    return np.stack([table[name] for name in names], axis=-1)


def rows() -> list[Any]:
    return list(np.genfromtxt(TABLE, delimiter=",", names=True))


def wrench_of(row: Any, **kwargs: Any) -> tuple[np.ndarray, np.ndarray]:
    return wrench(
        columns(row, "drive_x_m", "drive_y_m", "drive_z_m"),
        columns(row, "body_x_m", "body_y_m", "body_z_m"),
        columns(row, "pos_x_m", "pos_y_m", "pos_z_m"),
        columns(row, "qw", "qx", "qy", "qz"),
        drive_magnetisation_t=row["Br_drive_T"] * columns(row, "drive_mag_x", "drive_mag_y", "drive_mag_z"),
        body_magnetisation_t=row["Br_body_T"] * columns(row, "body_mag_x", "body_mag_y", "body_mag_z"),
        **kwargs,
    )


def relative_error(found: np.ndarray, expected: np.ndarray) -> float:
    """Of the vector; one that vanishes by symmetry counts as 1e-6, a thousandth of the others."""
    return float(np.linalg.norm(found - expected) / max(np.linalg.norm(expected), 1e-6))


@pytest.mark.parametrize(("order", "tolerance"), [(3, 5e-4), (5, 1e-6), (10, 1e-9)])
@pytest.mark.parametrize("row", rows(), ids=[f"row{number}" for number in range(len(rows()))])
def test_validates_wrench_against_the_table(row: Any, order: int, tolerance: float) -> None:
    force_n, torque_n_m = wrench_of(row, order=order)
    assert relative_error(force_n, columns(row, "Fx_N", "Fy_N", "Fz_N")) <= tolerance
    assert relative_error(torque_n_m, columns(row, "Tx_Nm", "Ty_Nm", "Tz_Nm")) <= tolerance


def test_validates_wrench_of_the_whole_table_at_once() -> None:
    """Poses are vectorised; sizes are one pair per call."""
    table = np.genfromtxt(TABLE, delimiter=",", names=True)
    names = ("drive_x_m", "drive_y_m", "drive_z_m", "body_x_m", "body_y_m", "body_z_m")
    for sizes in np.unique(columns(table, *names), axis=0):
        poses = table[(columns(table, *names) == sizes).all(axis=1)]
        body_t = poses["Br_body_T"][:, None] * columns(poses, "body_mag_x", "body_mag_y", "body_mag_z")
        force_n, torque_n_m = wrench(
            sizes[:3],
            sizes[3:],
            columns(poses, "pos_x_m", "pos_y_m", "pos_z_m"),
            columns(poses, "qw", "qx", "qy", "qz"),
            body_magnetisation_t=body_t,
        )
        for i, row in enumerate(poses):
            one = wrench_of(row)
            np.testing.assert_array_equal(force_n[i], one[0])
            np.testing.assert_array_equal(torque_n_m[i], one[1])


def points_around(size_m: np.ndarray, count: int) -> np.ndarray:
    """Points outside a cuboid: half of them on extensions of its edges and faces."""
    random = np.random.default_rng(0)
    points = random.uniform(-3.0, 3.0, (count, 3)) * size_m
    half = count // 2
    # Extensions of faces: one coordinate of the surface; of edges: two.
    for i in range(half):
        chosen = random.permutation(3)[: 1 + i % 2]
        points[i, chosen] = random.choice([-0.5, 0.5], len(chosen)) * size_m[chosen]
        free = random.choice(np.setdiff1d(range(3), chosen))
        points[i, free] = random.choice([-1, 1]) * random.uniform(0.55, 3.0) * size_m[free]
    inside = (np.abs(points) <= 0.5 * size_m).all(axis=1)
    points[inside] *= 10.0
    return points


@pytest.mark.parametrize("magnetisation_t", [(0.0, 0.0, 1.22), (0.4, -0.7, 0.9)])
def test_validates_field_against_magpylib(magnetisation_t: tuple[float, float, float]) -> None:
    magpylib = pytest.importorskip("magpylib")
    size_m = np.array([0.040, 0.025, 0.004])
    points_m = points_around(size_m, 1000)
    expected_t = magpylib.magnet.Cuboid(dimension=tuple(size_m), polarization=magnetisation_t).getB(points_m)
    found_t = field(size_m, points_m, magnetisation_t)
    error = np.linalg.norm(found_t - expected_t, axis=1) / np.linalg.norm(expected_t, axis=1)
    assert error.max() <= 1e-12


FLAT = ((0.02, 0.02, 0.002), (0.02, 0.02, 0.002))
CUBES = ((0.01, 0.01, 0.01), (0.01, 0.01, 0.01))
TURNED = (0.9, 0.1, -0.3, 0.2)


@pytest.mark.parametrize("far", [3e1, 1e2, 1e4, 1e5, 1e6, 1e20])
@pytest.mark.parametrize("sizes", [CUBES, ((0.04, 0.03, 0.004), (0.008, 0.01, 0.002))])
def test_far_magnets_are_dipoles(sizes: Any, far: float) -> None:
    """The next multipole is smaller by the square of the distance."""
    along = np.array([0.3, 0.1, 1.0]) / np.linalg.norm([0.3, 0.1, 1.0])
    place_m = far * max(sizes[0]) * along
    allowed = max(1.0 / far**2, 1e-14)
    moment_t_m3 = np.array([0.0, 0.0, 1.22 * np.prod(sizes[0])])
    dipole_t = (3.0 * along * (along @ moment_t_m3) - moment_t_m3) / (4.0 * np.pi)
    dipole_t /= np.linalg.norm(place_m) ** 3
    error = np.linalg.norm(field(sizes[0], place_m) - dipole_t) / np.linalg.norm(dipole_t)
    assert error <= allowed
    cuboids, dipoles = (wrench(*sizes, place_m, TURNED, model=model) for model in ("cuboid", "dipole"))
    for exact, point in zip(cuboids, dipoles, strict=True):
        assert np.linalg.norm(exact - point) <= 3.0 * allowed * np.linalg.norm(point)


@pytest.mark.parametrize(
    ("drive_m", "body_m", "pull_n"),
    [
        (*FLAT, 38.824),
        (*CUBES, 48.192),
        ((0.04, 0.03, 0.004), (0.04, 0.03, 0.002), 94.768),
        ((0.01, 0.01, 0.01), (0.004, 0.004, 0.002), 3.0744),
        ((0.004, 0.004, 0.002), (0.01, 0.01, 0.01), 3.0744),
    ],
)
def test_validates_the_pull_of_touching_magnets(drive_m: Any, body_m: Any, pull_n: float) -> None:
    """Closed form of Akoun and Yonnet (1984) at a gap of 1 pm, in any of the six directions."""
    for axis in range(3):
        along = np.roll([0.0, 0.0, 1.22], axis + 1)
        for side in (-1.0, 1.0):
            sizes = (np.roll(drive_m, axis + 1), np.roll(body_m, axis + 1))
            place_m = side * 0.5 * (drive_m[2] + body_m[2]) * along / 1.22
            force_n, torque_n_m = wrench(
                *sizes, place_m, (1, 0, 0, 0), drive_magnetisation_t=along, body_magnetisation_t=along
            )
            np.testing.assert_allclose(force_n, -side * pull_n * along / 1.22, rtol=3e-5, atol=1e-9)
            np.testing.assert_allclose(torque_n_m, 0.0, atol=1e-9)


@pytest.mark.parametrize("gap_m", [1e-4, 1e-3])
@pytest.mark.parametrize(
    "tilt_rad", [(0.0, 0.0, 0.0), (0.0, 0.05, 0.0), (0.08, 0.03, 0.5)], ids=["flat", "tilted", "turned"]
)
def test_validates_near_magnets_against_magpylib(gap_m: float, tilt_rad: Any) -> None:
    """Shifted, with any magnetisation; the lowest corner is the gap above the drive."""
    magpylib = pytest.importorskip("magpylib")
    rotation = pytest.importorskip("scipy.spatial.transform").Rotation.from_rotvec(tilt_rad)
    turn, (drive_m, body_m) = rotation.as_matrix(), ((0.02, 0.015, 0.003), (0.012, 0.01, 0.002))
    drive_t, body_t = np.array([0.2, -0.3, 1.2]), np.array([-0.4, 0.3, 1.0])
    drive = magpylib.magnet.Cuboid(dimension=drive_m, polarization=drive_t)
    height = 0.5 * drive_m[2] + gap_m + np.abs(turn[2]) @ body_m / 2.0
    place_m = np.array([0.0063, -0.0021, height])
    exact_n, exact_n_m = np.split(face_wrench(drive, np.array(body_m), body_t, place_m, turn, panels=16), 2)
    x, y, z, w = rotation.as_quat()
    force_n, torque_n_m = wrench(
        drive_m, body_m, place_m, (w, x, y, z), drive_magnetisation_t=drive_t, body_magnetisation_t=body_t
    )
    assert np.linalg.norm(force_n - exact_n) <= 2e-5 * np.linalg.norm(exact_n)
    assert np.linalg.norm(torque_n_m - exact_n_m) <= 2e-5 * np.linalg.norm(exact_n_m)


def test_forces_do_not_jump_where_magnets_meet() -> None:
    """Shifted, flat and tilted: from contact to 1 nm the force changes by less than a millionth of itself."""
    for tilt in (0.0, 0.03):
        turn = (np.cos(0.5 * tilt), np.sin(0.5 * tilt), 0.0, 0.0)
        reach = 0.5 * (0.002 * np.cos(tilt) + 0.02 * np.sin(tilt))
        places_m = np.array([[0.003, 0.001, 0.001 + reach + gap_m] for gap_m in (0.0, 1e-12, 1e-9)])
        force_n, torque_n_m = wrench(*FLAT, places_m, turn)
        np.testing.assert_allclose(force_n - force_n[0], 0.0, atol=1e-5 * np.linalg.norm(force_n[0]))
        np.testing.assert_allclose(torque_n_m - torque_n_m[0], 0.0, atol=1e-5 * np.linalg.norm(torque_n_m[0]))


@pytest.mark.parametrize("length", [5e-324, 1e-200, 1e-3, 7.0, 1e200, 1.7e308])
def test_quaternions_of_any_length_are_rotations(length: float) -> None:
    axis = np.array([0.5, -0.25, 0.5, 0.125]) if length > 1e-300 else np.array([1.0, 0.0, -1.0, 0.0])
    found = wrench(*FLAT, (0.0, 0.0, 0.03), length * axis)
    exact = wrench(*FLAT, (0.0, 0.0, 0.03), axis)
    np.testing.assert_allclose(found, exact, rtol=1e-13, atol=1e-18)


def test_field_broadcasts() -> None:
    points_m = np.random.default_rng(0).uniform(0.02, 0.05, (4, 1, 3))
    magnetisations_t = np.eye(3)
    flux_t = field((0.01, 0.02, 0.005), points_m, magnetisations_t)
    assert flux_t.shape == (4, 3, 3)
    np.testing.assert_array_equal(
        flux_t[2, 1], field((0.01, 0.02, 0.005), points_m[2, 0], magnetisations_t[1])
    )
    # The field is linear in the magnetisation.
    np.testing.assert_allclose(
        flux_t.sum(axis=1), field((0.01, 0.02, 0.005), points_m[:, 0], (1, 1, 1)), atol=1e-15
    )


def test_wrench_broadcasts() -> None:
    sizes = ((0.04, 0.02, 0.01), (0.01, 0.01, 0.003))
    positions_m = np.random.default_rng(1).uniform(0.025, 0.05, (5, 1, 3))
    quaternions = np.array([[1.0, 0.0, 0.0, 0.0], [2.0, 0.0, 2.0, 0.0]])
    force_n, torque_n_m = wrench(*sizes, positions_m, quaternions)
    assert force_n.shape == torque_n_m.shape == (5, 2, 3)
    # A quaternion of any length is the same rotation.
    one = wrench(*sizes, positions_m[3, 0], quaternions[1] / np.sqrt(8.0))
    np.testing.assert_allclose(force_n[3, 1], one[0], rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(torque_n_m[3, 1], one[1], rtol=1e-12, atol=1e-15)


def test_dipoles_are_good_far_away_only() -> None:
    sizes = ((0.02, 0.02, 0.01), (0.01, 0.01, 0.003))
    pose = (np.array([[0.0, 0.0, 0.02], [0.05, 0.02, 0.3]]), (0.9, 0.1, 0.3, 0.2))
    exact_n, exact_n_m = wrench(*sizes, *pose)
    dipole_n, dipole_n_m = wrench(*sizes, *pose, model="dipole")
    error = np.linalg.norm(dipole_n - exact_n, axis=1) / np.linalg.norm(exact_n, axis=1)
    assert error[0] > 0.05
    assert error[1] < 5e-3
    np.testing.assert_allclose(dipole_n_m[1], exact_n_m[1], rtol=2e-2)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"position_m": (0.0, 0.0, 0.0019)},
            r"position_m is \[.* 0\.0019\] m: .*overlap by 1\.000e-4 m",
        ),
        (
            {"position_m": [(0, 0, 1), (0, 0, 0), (0, 0, 1)]},
            r"position_m\[1\] is .*overlap.*stand apart",
        ),
        ({"position_m": (0, 0, 0), "model": "dipole"}, r"position_m is .*dipoles"),
        ({"position_m": [(0, 0, 1), (0, 0, 1e-99)], "model": "dipole"}, r"position_m\[1\] is .*dipoles"),
        (
            {"position_m": np.full((2, 1, 3), 0.1), "quaternion_wxyz": [(1, 0, 0, 0), (0, 0, 0, 0)]},
            r"quaternion_wxyz\[0, 1\] is \[0\.0, 0\.0, 0\.0, 0\.0\]; allowed: any rotation",
        ),
        ({"quaternion_wxyz": [(1, 0, 0, 0), (np.inf, 0, 0, 0)]}, r"quaternion_wxyz\[1\] is .*finite"),
        ({"drive_size_m": (0.1, 0.1)}, "drive_size_m"),
        ({"body_size_m": (0.1, 0.1, 0.0)}, "body_size_m"),
        ({"position_m": (0.1, 0.1)}, "position_m.*3"),
        ({"position_m": (0.1, 0.1, np.nan)}, "position_m.*finite"),
        ({"quaternion_wxyz": (0.0, 0.0, 0.0, 0.0)}, "quaternion_wxyz"),
        ({"quaternion_wxyz": (1.0, 0.0, 0.0)}, "quaternion_wxyz.*4"),
        ({"drive_magnetisation_t": np.ones((2, 3)), "position_m": np.ones((3, 3))}, "do not fit"),
        ({"order": 0}, "order is 0"),
        ({"order": 11}, "allowed: 1 to 10"),
        ({"model": "sphere"}, "sphere.*cuboid.*dipole"),
    ],
)
def test_bad_arguments_are_named(change: dict[str, Any], message: str) -> None:
    arguments: dict[str, Any] = {
        "drive_size_m": FLAT[0],
        "body_size_m": FLAT[1],
        "position_m": (0.0, 0.0, 0.03),
        "quaternion_wxyz": (1.0, 0.0, 0.0, 0.0),
    }
    with pytest.raises(ValueError, match=message):
        wrench(**{**arguments, **change})
