"""States as bytes: named arrays in NumPy's own format, without pickle."""

import io
import zipfile
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray


def pack(fields: Mapping[str, NDArray[Any]]) -> bytes:
    """Writes named arrays; equal arrays give equal bytes."""
    buffer = io.BytesIO()
    np.savez(buffer, allow_pickle=False, **fields)
    return buffer.getvalue()


def unpack(state: bytes, like: Mapping[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Reads named arrays.

    Args:
        state: What :func:`pack` returned.
        like: Arrays with the names that are wanted. The shapes of numbers in more than
            zero dimensions must be equal, except of raw bytes (uint8).

    Raises:
        ValueError: The bytes hold something else.
    """
    try:
        with np.load(io.BytesIO(state), allow_pickle=False) as archive:
            fields = {name: archive[name] for name in archive.files}
    except (OSError, ValueError, EOFError, TypeError, zipfile.BadZipFile) as error:
        raise ValueError("the state cannot be read: it is not one that get_state() returned") from error
    if fields.keys() != like.keys():
        raise ValueError(f"the state has the fields {sorted(fields)}; expected {sorted(like)}")
    for name, array in like.items():
        found = fields[name]
        same_kind = found.dtype.kind == array.dtype.kind and found.ndim == array.ndim
        if not same_kind or (array.dtype != np.uint8 and found.shape != array.shape):
            raise ValueError(f"the state has {name} of shape {found.shape}; expected {array.shape}")
    return fields
