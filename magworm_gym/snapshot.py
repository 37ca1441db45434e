"""States as bytes: named arrays behind a checksum, checked whole before anything is set."""

from __future__ import annotations

import json
from collections.abc import Mapping
from hashlib import blake2b
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

MAGIC = b"MAGWENV3"
OLDER = (b"PK\x03\x04", b"MAGWENV2")
"""What states of older layouts began with."""
WORD = 8
HEAD = 3 * WORD
"""Magic, checksum of all that follows it, length of the list of arrays."""

Array = NDArray[Any]


class Limits(NamedTuple):
    """What the numbers of an array may be."""

    low: float
    high: float
    missing: bool = False
    """Whether NaN is allowed too."""


FINITE = Limits(-1e9, 1e9)
"""Of numbers without limits of their own."""
COUNT = Limits(0, 2**53)


def pack(fields: Mapping[str, Array]) -> bytes:
    """Writes named arrays; equal arrays give equal bytes."""
    names = json.dumps([[name, array.dtype.str, array.shape] for name, array in fields.items()]).encode()
    body = b"".join([len(names).to_bytes(WORD, "little"), names, *(a.tobytes() for a in fields.values())])
    return MAGIC + _checksum(body) + body


def unpack(state: bytes, like: Mapping[str, Array], limits: Mapping[str, Limits]) -> dict[str, Array]:
    """Reads named arrays.

    Args:
        state: What :func:`pack` returned.
        like: Arrays with the names, kinds and shapes that are wanted; raw bytes (uint8) may be of
            another length.
        limits: What numbers may be, by name; :data:`FINITE` for the others.

    Raises:
        ValueError: The bytes hold something else.
    """
    found, body = _read(state)
    if [one[0] for one in found] != list(like):
        raise ValueError(f"the state has the fields {[one[0] for one in found]}; allowed: {list(like)}")
    fields = {}
    for (name, kind, shape), array in zip(found, like.values(), strict=True):
        raw = array.dtype == np.uint8 and len(shape) == 1
        if kind != array.dtype.str or not (raw or shape == list(array.shape)):
            wanted = f"{array.dtype.str!r} of shape {list(array.shape)}"
            raise ValueError(f"the state has {name} as {kind!r} of shape {shape}; allowed: {wanted}")
        size = array.dtype.itemsize * int(np.prod(shape, dtype=object))
        if size > len(body):
            raise ValueError(f"the state is cut short in {name}")
        fields[name] = np.frombuffer(body[:size], np.uint8).copy()
        body = body[size:]
        if array.dtype != np.uint8:
            fields[name] = _numbers(name, fields[name], array, limits.get(name, FINITE))
    if body:
        raise ValueError(f"the state has {len(body)} bytes too many")
    return fields


def _read(state: bytes) -> tuple[list[tuple[str, str, list[int]]], bytes]:
    """Names, kinds and shapes of the arrays, and their bytes one after the other."""
    if not isinstance(state, (bytes, bytearray, memoryview)):
        raise ValueError(f"the state is a {type(state).__name__}; allowed: bytes that get_state() returned")
    state = bytes(state)
    if state.startswith(OLDER):
        raise ValueError("the state has the layout of an older version; allowed: MAGWENV3")
    if len(state) < HEAD or not state.startswith(MAGIC):
        raise ValueError("the state cannot be read: it is not one that get_state() returned")
    body = state[2 * WORD :]
    if state[WORD : 2 * WORD] != _checksum(body):
        raise ValueError("the state is damaged: its checksum does not fit")
    length = int.from_bytes(body[:WORD], "little")
    try:
        found = [
            (str(name), str(kind), list(shape)) for name, kind, shape in json.loads(body[WORD:][:length])
        ]
        whole = all(type(size) is int and 0 <= size < 2**48 for _, _, shape in found for size in shape)
    except (ValueError, TypeError, RecursionError):
        whole = False
    if not whole:
        raise ValueError("the state is damaged: its list of arrays cannot be read")
    return found, body[WORD + length :]


def _numbers(name: str, raw: NDArray[np.uint8], like: Array, limits: Limits) -> Array:
    """Numbers of an array, none beyond its limits."""
    if like.dtype == np.bool_:
        if (raw > 1).any():
            raise ValueError(f"{_of(name, (raw > 1).reshape(like.shape))} is neither False nor True")
        return raw.astype(np.bool_).reshape(like.shape)
    values = raw.view(like.dtype).reshape(like.shape)
    if like.dtype.kind in "US":
        return values
    allowed = (values >= limits.low) & (values <= limits.high)
    if limits.missing:
        allowed |= np.isnan(values)
    if not allowed.all():
        value = values[~allowed].flat[0]
        raise ValueError(f"{_of(name, ~allowed)} is {value}; allowed: {limits.low:g} to {limits.high:g}")
    return values


def _of(name: str, wrong: NDArray[np.bool_]) -> str:
    """Names the first number of an array (N, …) that is wrong."""
    environment = int(np.argwhere(wrong)[0][0]) if wrong.ndim else 0
    return f"{name} of environment {environment} in the state"


def _checksum(body: bytes) -> bytes:
    return blake2b(body, digest_size=WORD).digest()
