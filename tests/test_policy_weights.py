"""Weights of policies: damaged files, layers that do not fit, other readers of the format."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawn_policies import drawn

from magworm_gym import MagWormVectorEnv, PolicyError, load_policy, save_policy
from magworm_gym.policy.safetensors import read_tensors, write_tensors


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    save_policy(tmp_path / "policy", drawn(MagWormVectorEnv(1)))
    return tmp_path / "policy"


def safetensors(header: Any, body: bytes = b"", length: int | None = None) -> bytes:
    text = header if isinstance(header, bytes) else json.dumps(header).encode()
    return (len(text) if length is None else length).to_bytes(8, "little") + text + body


ENTRY = {"dtype": "F32", "shape": [2], "data_offsets": [0, 8]}


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x01\x02",
        safetensors({}, length=1),
        safetensors({}, length=2**63),
        safetensors(b"{", b""),
        safetensors([]),
        safetensors(b"[" * 100_000),
        safetensors({"a": 3}),
        safetensors({"a": {}}),
        safetensors({"a": ENTRY}, bytes(7)),
        safetensors({"a": ENTRY}, bytes(9)),
        safetensors({"a": {**ENTRY, "data_offsets": [4, 12]}}, bytes(12)),
        safetensors({"a": {**ENTRY, "data_offsets": [0, 4]}}, bytes(4)),
        safetensors({"a": {**ENTRY, "data_offsets": [8, 0]}}, bytes(8)),
        safetensors({"a": {**ENTRY, "data_offsets": 3}}, bytes(8)),
        safetensors({"a": ENTRY, "b": ENTRY}, bytes(8)),
        safetensors({"a": {**ENTRY, "shape": [-2]}}, bytes(8)),
        safetensors({"a": {**ENTRY, "shape": [2.0]}}, bytes(8)),
        safetensors({"a": {**ENTRY, "shape": [True, 2]}}, bytes(8)),
        safetensors({"a": {**ENTRY, "shape": 2}}, bytes(8)),
        safetensors({"a": {**ENTRY, "shape": [2**62, 2**62]}}, bytes(8)),
        safetensors({"a": {**ENTRY, "dtype": "O"}}, bytes(8)),
        safetensors({"a": {**ENTRY, "dtype": ["F32"]}}, bytes(8)),
        safetensors(b'{"a": %s, "a": %s}' % ((json.dumps(ENTRY).encode(),) * 2), bytes(8)),
        b"PK\x03\x04" + bytes(60),
    ],
)
def test_weights_that_are_none_are_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "weights.safetensors"
    path.write_bytes(content)
    with pytest.raises(PolicyError, match="is damaged: "):
        read_tensors(path)


def test_any_byte_of_the_header_may_be_damaged(folder: Path) -> None:
    path = folder / "weights.safetensors"
    kept = path.read_bytes()
    generator = np.random.default_rng(0)
    for place in generator.integers(0, 600, 200):
        damaged = bytearray(kept)
        damaged[place] ^= int(generator.integers(1, 256))
        path.write_bytes(damaged)
        try:
            load_policy(folder)
        except PolicyError:
            continue
        # A space that pads the header, or a digit that JSON reads the same.
        assert json.loads(kept[8 : 8 + int.from_bytes(kept[:8], "little")]) == json.loads(
            damaged[8 : 8 + int.from_bytes(damaged[:8], "little")]
        )


@pytest.mark.parametrize(
    "tensors",
    [
        {},
        {"0.weight": np.zeros((3, 25), np.float32)},
        {"0.weight": np.zeros((3, 25), np.float32), "0.bias": np.zeros(4, np.float32)},
        {"0.weight": np.zeros((3, 24), np.float32), "0.bias": np.zeros(3, np.float32)},
        {"0.weight": np.zeros((3, 25), np.float32), "0.bias": np.full(3, np.nan, np.float32)},
        {"1.weight": np.zeros((3, 25), np.float32), "1.bias": np.zeros(3, np.float32)},
        {
            "0.weight": np.zeros((8, 25), np.float32),
            "0.bias": np.zeros(8, np.float32),
            "1.weight": np.zeros((3, 9), np.float32),
            "1.bias": np.zeros(3, np.float32),
        },
    ],
)
def test_layers_that_do_not_fit_are_refused(tensors: dict[str, Any], folder: Path) -> None:
    write_tensors(folder / "weights.safetensors", tensors)
    with pytest.raises(PolicyError, match="allowed"):
        load_policy(folder)


def test_weights_are_what_another_reader_of_the_format_finds(folder: Path) -> None:
    numpy_reader = pytest.importorskip("safetensors.numpy")
    path = folder / "weights.safetensors"
    own, other = read_tensors(path), numpy_reader.load_file(path)
    assert own.keys() == other.keys() and all(np.array_equal(own[name], other[name]) for name in own)
    numpy_reader.save_file(other, path, metadata={"format": "pt"})
    assert all(np.array_equal(own[name], values) for name, values in read_tensors(path).items())
