"""Fields and wrenches against tables and other programs."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

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


def test_field_far_away_is_a_dipole_s() -> None:
    size_m, distance_m = np.array([0.01, 0.01, 0.01]), 1.0
    moment_t_m3 = 1.22 * size_m.prod() / (4.0 * np.pi)
    np.testing.assert_allclose(
        field(size_m, [0.0, 0.0, distance_m]), [0.0, 0.0, 2.0 * moment_t_m3], rtol=1e-6, atol=1e-16
    )


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
        ({"drive_size_m": (0.1, 0.1)}, "drive_size_m"),
        ({"body_size_m": (0.1, 0.1, 0.0)}, "body_size_m"),
        ({"position_m": (0.1, 0.1)}, "position_m.*3"),
        ({"position_m": (0.1, 0.1, np.nan)}, "position_m.*finite"),
        ({"quaternion_wxyz": (0.0, 0.0, 0.0, 0.0)}, "quaternion_wxyz"),
        ({"quaternion_wxyz": (1.0, 0.0, 0.0)}, "quaternion_wxyz.*4"),
        ({"drive_magnetisation_t": np.ones((2, 3)), "position_m": np.ones((3, 3))}, "do not fit"),
        ({"order": 0}, "order is 0"),
        ({"order": 11}, "allowed: 1 to 10"),
        ({"model": "sphere"}, "sphere.*cuboid, dipole"),
    ],
)
def test_bad_arguments_are_named(change: dict[str, Any], message: str) -> None:
    arguments: dict[str, Any] = {
        "drive_size_m": (0.04, 0.04, 0.02),
        "body_size_m": (0.01, 0.01, 0.003),
        "position_m": (0.0, 0.0, 0.03),
        "quaternion_wxyz": (1.0, 0.0, 0.0, 0.0),
    }
    with pytest.raises(ValueError, match=message):
        wrench(**{**arguments, **change})
