"""The HDF5 files of DeepLabCut: tables of pandas, read without it and without running what they pickle."""

import io
import pickle
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from magworm_gym.identification.mistake import ProblemError
from magworm_gym.recording import Floats

SIGNATURE = b"\x89HDF\r\n\x1a\n"

Label = tuple[str, str, str]
"""What stands in a column: individual, which may be empty, body part and coordinate."""
Frame = tuple[str, float]
"""Where the number of a frame stands and how it is written there, and the number."""

AS_CSV = "its tracks as CSV (deeplabcut.analyze_videos_converth5_to_csv)"


def is_hdf5(path: Path) -> bool:
    """Whether a file is there and begins as HDF5 does."""
    try:
        with path.open("rb") as file:
            return file.read(len(SIGNATURE)) == SIGNATURE
    except OSError:
        return False


def read_hdf5(path: Path) -> tuple[list[Label], list[Frame], Floats]:
    """Reads what ``DataFrame.to_hdf`` wrote, in the format "table" or "fixed".

    Returns:
        Labels of the columns (K,), frames (F,), and values (F, K).

    Raises:
        ImportError: The library h5py is missing; says the extra to install.
        ProblemError: A file of another form.
    """
    try:
        import h5py
    except ImportError as error:
        raise ImportError(
            f"{path} is HDF5, which needs the library h5py: pip install 'magworm-gym[h5]'; or give {AS_CSV}."
        ) from error
    try:
        with h5py.File(path) as file:
            (group,) = file.values()
            names, index, values = _of_table(group["table"]) if "table" in group else _of_arrays(group)
        labels = [_label(*map(str, name)) for name in names]
        frames = [
            (f"row {at}, the index is {number:.12g}", float(number)) for at, number in enumerate(index, 1)
        ]
        values = np.asarray(values, np.float64)
        if values.shape != (len(frames), len(labels)):
            raise ValueError("sizes differ")
    except Exception as error:  # what a damaged or another file makes h5py, NumPy and pickle raise has no end
        raise ProblemError(
            f"{path} is HDF5, but no table of tracks can be read from it; allowed: the file that DeepLabCut "
            f"writes, or {AS_CSV}"
        ) from error
    return labels, frames, values


def _label(_: str, *names: str) -> Label:
    """The label of a column: scorer, perhaps individual, part, coordinate."""
    *individual, part, coordinate = names
    return "".join(individual), part, coordinate


def _of_table(table: Any) -> tuple[list[tuple[str, ...]], Any, Any]:
    """Names of columns, index and values of the format "table"."""
    rows = table[:]
    blocks = [name for name in rows.dtype.names if name.startswith("values_block_")]
    names = [name for block in blocks for name in _unpickled(table.attrs[f"{block}_kind"])]
    return names, rows["index"], np.hstack([rows[block].reshape(len(rows), -1) for block in blocks])


def _of_arrays(group: Any) -> tuple[list[tuple[str, ...]], Any, Any]:
    """Names of columns, index and values of the format "fixed"."""
    levels = range(int(group.attrs["block0_items_nlevels"]))
    texts = [
        np.char.decode(group[f"block0_items_level{at}"][:], "utf-8")[group[f"block0_items_label{at}"][:]]
        for at in levels
    ]
    return (
        list(zip(*(text.tolist() for text in texts), strict=True)),
        group["axis1"][:],
        group["block0_values"][:],
    )


class _Plain(pickle.Unpickler):
    """Unpickles lists, tuples, texts and numbers alone: nothing in them can run."""

    def find_class(self, module: str, name: str) -> NoReturn:
        """Refuses whatever is more than plain."""
        raise pickle.UnpicklingError(f"{module}.{name} is no plain value")


def _unpickled(raw: bytes) -> Any:
    return _Plain(io.BytesIO(raw)).load()
