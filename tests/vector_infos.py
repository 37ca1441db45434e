"""Infos of the native vector environment, to compare with those that Gymnasium puts together."""

from typing import Any

import numpy as np


def told(infos: dict[str, Any]) -> dict[str, Any]:
    """Infos without the keys that hold for no environment: Gymnasium leaves these out."""
    kept = {key: values for key, values in infos.items() if np.any(infos[f"_{key.lstrip('_')}"])}
    return {key: told(values) if isinstance(values, dict) else values for key, values in kept.items()}
