"""Checkpoints of a training that are complete or absent, and hold nothing that could be run.

Each is one file of the safetensors format; what is no array stands as JSON in its header. Its name is the
number of steps and a checksum of the content, so that damage is seen.
"""

import json
import re
import sys
from hashlib import blake2b
from pathlib import Path
from typing import Any

import numpy as np
import torch
from safetensors import safe_open
from safetensors.numpy import save

from magworm_gym.atomic_files import replace_file

KEPT = 2
ARRAY, BYTES = "array", "bytes"
"""Keys that stand for an array or for bytes in the JSON, with their name in the file."""
NAME = re.compile(r"(\d{12})-([0-9a-f]{32})\.safetensors")

Tree = dict[str, Any]
"""Numbers, text, None, bytes, arrays, tensors (which are read as arrays), and lists and dicts of them."""


def save_checkpoint(folder: Path, steps: int, state: Tree) -> None:
    """Writes a checkpoint and drops the oldest.

    Args:
        folder: Folder of all checkpoints of one seed.
        steps: Environment steps so far.
        state: What to keep.
    """
    arrays: dict[str, np.ndarray[Any, Any]] = {}
    plain = _split(state, "", arrays)
    content = save(arrays, {"state": json.dumps(plain)})
    folder.mkdir(parents=True, exist_ok=True)
    with replace_file(folder / f"{steps:012d}-{_checksum(content)}.safetensors") as part:
        part.write_bytes(content)
    for old in checkpoints(folder)[:-KEPT]:
        old.unlink()


def checkpoints(folder: Path) -> list[Path]:
    """Checkpoints in a folder, fewest steps first. Unfinished ones have other names."""
    return sorted(path for path in folder.glob("*.safetensors") if NAME.fullmatch(path.name))


def newest_checkpoint(folder: Path) -> Tree | None:
    """Reads the newest checkpoint that is whole; damaged ones are named on standard error and removed."""
    for path in reversed(checkpoints(folder)):
        content = path.read_bytes()
        if path.stem.endswith(_checksum(content)):
            return _read(path)
        path.unlink()
        print(f"{path} is damaged: the training goes on from what was kept before it", file=sys.stderr)
    return None


def _read(path: Path) -> Tree:
    with safe_open(path, "numpy") as file:
        arrays = {name: file.get_tensor(name) for name in file.keys()}
        tree: Tree = _joined(json.loads(file.metadata()["state"]), arrays)
    return tree


def _checksum(content: bytes) -> str:
    return blake2b(content, digest_size=16).hexdigest()


def _split(tree: Any, name: str, arrays: dict[str, np.ndarray[Any, Any]]) -> Any:
    """The tree with names in place of its arrays, which are put aside."""
    if isinstance(tree, (np.ndarray, torch.Tensor)):
        arrays[name] = np.asarray(tree)
        return {ARRAY: name}
    if isinstance(tree, bytes):
        arrays[name] = np.frombuffer(tree, np.uint8)
        return {BYTES: name}
    if isinstance(tree, dict):
        return {key: _split(value, f"{name}/{key}", arrays) for key, value in tree.items()}
    if isinstance(tree, (list, tuple)):
        return [_split(value, f"{name}/{at}", arrays) for at, value in enumerate(tree)]
    return tree


def _joined(plain: Any, arrays: dict[str, np.ndarray[Any, Any]]) -> Any:
    """The tree with its arrays again."""
    if isinstance(plain, dict):
        if plain.keys() == {ARRAY}:
            return arrays[plain[ARRAY]]
        if plain.keys() == {BYTES}:
            return arrays[plain[BYTES]].tobytes()
        return {key: _joined(value, arrays) for key, value in plain.items()}
    return [_joined(value, arrays) for value in plain] if isinstance(plain, list) else plain
