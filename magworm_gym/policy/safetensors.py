"""Arrays in the safetensors format: a header in JSON, then the numbers, and nothing that could run.

The format: eight bytes with the length of the header; the header, which gives each array its type, shape and
place; the arrays end to end, little-endian. See https://huggingface.co/docs/safetensors.
"""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import shown
from magworm_gym.policy.mistake import PolicyError

TYPE = "F32"
"""The type of all numbers, of those that the format has."""
SINGLE = np.dtype("<f4")
Singles = NDArray[np.float32]

LENGTH_BYTES = 8
ALIGNMENT = 8
LARGEST_FILE_BYTES = 2**28


def write_tensors(path: Path, tensors: Mapping[str, Singles]) -> None:
    """Writes arrays by name."""
    header, begin = {}, 0
    for name, values in tensors.items():
        end = begin + values.nbytes
        header[name] = {"dtype": TYPE, "shape": values.shape, "data_offsets": [begin, end]}
        begin = end
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % ALIGNMENT)
    length = len(text).to_bytes(LENGTH_BYTES, "little")
    path.write_bytes(
        b"".join([length, text, *(values.astype(SINGLE).tobytes() for values in tensors.values())])
    )


def read_tensors(path: Path) -> dict[str, Singles]:
    """Reads arrays by name.

    Raises:
        PolicyError: The file is missing, too large or damaged, or has numbers of another type.
    """
    try:
        if path.stat().st_size > LARGEST_FILE_BYTES:
            raise PolicyError(f"{path} is larger than {LARGEST_FILE_BYTES >> 20} MiB; no policy is")
        content = path.read_bytes()
    except OSError as error:
        raise PolicyError(f"{path} cannot be read: {error.strerror}") from None
    start = LENGTH_BYTES + int.from_bytes(content[:LENGTH_BYTES], "little")
    if len(content) < max(start, LENGTH_BYTES):
        raise PolicyError(f"{path} is damaged: it ends within its header")
    try:
        header = json.loads(content[LENGTH_BYTES:start], object_pairs_hook=_once)
        header.pop("__metadata__", None)
        entries = sorted(header.items(), key=lambda entry: entry[1]["data_offsets"])
        return dict(_arrays(entries, memoryview(content)[start:]))
    except (AttributeError, KeyError, TypeError, ValueError, RecursionError) as error:
        raise PolicyError(f"{path} is damaged: {_reason(error)}") from None


def _arrays(entries: list[tuple[str, Any]], numbers: memoryview) -> list[tuple[str, Singles]]:
    """The arrays of a header's entries, which must lie end to end and fill the file."""
    arrays, place = [], 0
    for name, entry in entries:
        kind, shape = entry["dtype"], entry["shape"]
        if kind != TYPE:
            raise ValueError(f"{shown(name)} has numbers of type {shown(kind)}; allowed: {TYPE!r}")
        if not all(type(size) is int and size >= 0 for size in shape):
            raise ValueError(f"{shown(name)} has the shape {shown(shape)}; allowed: whole numbers from 0 on")
        end = place + SINGLE.itemsize * math.prod(shape)
        if entry["data_offsets"] != [place, end] or end > len(numbers):
            raise ValueError(f"{shown(name)} does not lie where its shape and the arrays before it put it")
        arrays.append((name, np.frombuffer(numbers[place:end], SINGLE).reshape(shape)))
        place = end
    if place != len(numbers):
        raise ValueError(f"{len(numbers) - place} bytes after the last array")
    return arrays


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        raise ValueError("a name stands twice in its header")
    return table


def _reason(error: Exception) -> str:
    """What is wrong, where this file has said it; else that the header is none."""
    own = type(error) is ValueError
    return str(error) if own else "its header is not that of a safetensors file"
