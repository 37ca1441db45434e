"""Infos in the form of Gymnasium's vector environments: arrays of length N beside masks."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch

Flags = NDArray[np.bool_]
Infos = dict[str, Any]


def add(infos: Infos, key: str, values: NDArray[Any], mask: Flags) -> None:
    """Adds values (N, …) where mask (N,) is set; where a key holds for no environment they are 0 or None."""
    before = infos.get(key)
    if before is None and mask.all():  # a step in which no episode ends: most of them
        infos[key], infos[f"_{key}"] = values.copy(), mask.copy()
        return
    if before is None:
        before = (np.empty if values.dtype == np.object_ else np.zeros)(values.shape, values.dtype)
        infos[f"_{key}"] = np.zeros(len(mask), np.bool_)
    infos[key] = before
    if mask.any():
        infos[key] = np.where(mask.reshape(-1, *(1,) * (values.ndim - 1)), values, before)
        infos[f"_{key}"] = mask | infos[f"_{key}"]


def rows(observations: NDArray[Any]) -> NDArray[np.object_]:
    """The observations (N, O) as N objects, each with its own memory."""
    separate = np.empty(len(observations), np.object_)
    separate[:] = [row.copy() for row in observations]
    return separate


def reasons(status: NDArray[np.uint8]) -> NDArray[np.object_]:
    """Why each environment broke, in words (N,); None where it runs."""
    texts = np.empty(len(status), np.object_)  # all None
    for i in np.flatnonzero(status).tolist():
        texts[i] = Batch.status_text(int(status[i]))
    return texts


def info_of(infos: Infos, i: int) -> Infos:
    """The info of environment i, with plain numbers in place of arrays and masks."""
    names = [key for key in infos if not key.startswith("_") and infos[f"_{key}"][i]]
    return {key: _plain(infos[key], i) for key in names}


def _plain(values: Any, i: int) -> Any:
    if isinstance(values, dict):
        return info_of(values, i)
    return values[i].item() if isinstance(values[i], np.generic) else values[i]
