"""Fields of cuboid magnets and the wrenches between them, vectorised over points and poses.

Lengths in metres, magnetisations as remanence vectors μ0·M in tesla, unit permeability.

Source: closed-form field of a uniformly charged rectangle (Yang et al., Supercond. Sci. Technol. 3
(1990) 591; Akoun & Yonnet, IEEE Trans. Magn. 20 (1984) 1962), and for the wrench the charge model:
σ = n·M on every charged face of the body magnet, F = ∬ σ B dS, T = ∬ σ r × B dS, integrated by
Gauss–Legendre quadrature.
"""

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magworm_gym import _magworm
from magworm_gym.arguments import choice, numbers, shown, whole

ALONG_HEIGHT_T = (0.0, 0.0, 1.22)
"""The magnets of the MagWorm paper: 1.22 T along the height."""

MODELS = ("cuboid", "dipole")
MAX_ORDER = 10


def field(
    size_m: Sequence[float], points_m: ArrayLike, magnetisation_t: ArrayLike = ALONG_HEIGHT_T
) -> NDArray[np.float64]:
    """Magnetic flux density of a cuboid magnet at the origin, its edges along the axes.

    Inside the magnet this is B, magnetisation included; on a face it is the limit from outside. On
    an edge the field of the model is infinite: a large, finite value is returned.

    Args:
        size_m: Edges along x, y, z [m].
        points_m: Points (..., 3) [m].
        magnetisation_t: Remanence vector (..., 3) [T], broadcast against the points.

    Returns:
        Flux density (..., 3) [T] in the frame of the magnet. Within a few sizes of the magnet it
        agrees with magpylib to a relative 1e-12, also on the extensions of edges and faces.

    Raises:
        ValueError: A size that is not positive, a value that is not finite, or shapes that do not fit.
    """
    points, magnetisation = _vectors(points_m=(points_m, 3), magnetisation_t=(magnetisation_t, 3))
    flux = _magworm.cuboid_field(_size("size_m", size_m), _table(magnetisation), _table(points))
    return flux.reshape(points.shape)


def wrench(
    drive_size_m: Sequence[float],
    body_size_m: Sequence[float],
    position_m: ArrayLike,
    quaternion_wxyz: ArrayLike,
    *,
    drive_magnetisation_t: ArrayLike = ALONG_HEIGHT_T,
    body_magnetisation_t: ArrayLike = ALONG_HEIGHT_T,
    order: int = 5,
    model: Literal["cuboid", "dipole"] = "cuboid",
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Force and torque of a drive magnet at the origin, its edges along the axes, on a body magnet.

    Args:
        drive_size_m: Edges of the drive magnet along x, y, z [m].
        body_size_m: Edges of the body magnet along its own x, y, z [m].
        position_m: Centres of the body magnet (..., 3) [m].
        quaternion_wxyz: Its orientations (..., 4): the rotation from its own frame to the drive's.
            Normalised here.
        drive_magnetisation_t: Remanence vector of the drive (..., 3) [T], in its own frame.
        body_magnetisation_t: Remanence vector of the body magnet (..., 3) [T], in its own frame.
            Every face that it charges counts.
        order: Gauss–Legendre points along each edge of a charged face, 1 to 10; faces that are
            nearer to the drive than they are long are cut into panels of so many points each.
            Order 5 keeps forces and torques of the reference table to 1e-7.
        model: "cuboid", or "dipole": both magnets as point dipoles, good far away only.

    The leading axes of positions, orientations and magnetisations are broadcast against each other.

    Returns:
        Force (..., 3) [N] and torque about the centre of the body magnet (..., 3) [N·m], both in
        the frame of the drive.

    Raises:
        ValueError: A size that is not positive, an order out of range, a quaternion of length 0, a
            value that is not finite, an unknown model, or shapes that do not fit.
    """
    choice("model", model, MODELS)
    if whole(order) not in range(1, MAX_ORDER + 1):
        raise ValueError(f"order is {shown(order)}; allowed: 1 to {MAX_ORDER}")
    position, quaternion, drive, body = _vectors(
        position_m=(position_m, 3),
        quaternion_wxyz=(quaternion_wxyz, 4),
        drive_magnetisation_t=(drive_magnetisation_t, 3),
        body_magnetisation_t=(body_magnetisation_t, 3),
    )
    length = np.linalg.norm(quaternion, axis=-1, keepdims=True)
    if (length == 0.0).any():
        raise ValueError("quaternion_wxyz has length 0; a rotation is needed")
    force, torque = _magworm.cuboid_wrench(
        _size("drive_size_m", drive_size_m),
        _size("body_size_m", body_size_m),
        _table(position),
        _table(quaternion / length),
        _table(drive),
        _table(body),
        order,
        model,
    )
    return force.reshape(position.shape), torque.reshape(position.shape)


def _vectors(**given: tuple[ArrayLike, int]) -> list[NDArray[np.float64]]:
    """Checks the last axis of each argument and broadcasts all others against each other."""
    arrays = {}
    for name, (value, length) in given.items():
        array = numbers(value)
        if array is None:
            raise ValueError(f"{name} is {shown(value)}; it must be numbers, (..., {length})")
        arrays[name] = array
        if arrays[name].shape[-1:] != (length,):
            raise ValueError(
                f"{name} has shape {arrays[name].shape}; its last axis must have length {length}"
            )
        if not np.isfinite(arrays[name]).all():
            raise ValueError(f"{name} has a value that is not finite")
    try:
        shape = np.broadcast_shapes(*(array.shape[:-1] for array in arrays.values()))
    except ValueError as error:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ValueError(f"leading axes do not fit together: {shapes}") from error
    return [np.broadcast_to(array, (*shape, array.shape[-1])) for array in arrays.values()]


def _table(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Vectors (..., C) as a contiguous table (P, C)."""
    return np.ascontiguousarray(vectors.reshape(-1, vectors.shape[-1]))


def _size(name: str, size_m: Sequence[float]) -> NDArray[np.float64]:
    edges = numbers(size_m)
    if edges is None or edges.shape != (3,) or not (np.isfinite(edges) & (edges > 0.0)).all():
        raise ValueError(f"{name} is {shown(size_m)}; it must be three positive lengths")
    return edges
