"""Every combination of some settings of a drive, measured in one batch."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene
from magworm_gym.baselines.runner import Controller, Runner
from magworm_gym.baselines.trial import Trial

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Sweep:
    """Crawling speed against the settings of a drive.

    Attributes:
        axes: Values of each setting by its name.
        speed_m_s: Crawling speed (…, starts) [m/s]: an axis for each setting, in their order.
    """

    axes: dict[str, Floats]
    speed_m_s: Floats

    @property
    def best(self) -> dict[str, float]:
        """The settings with the greatest mean speed."""
        mean = self.speed_m_s.mean(axis=-1)
        at = np.unravel_index(mean.argmax(), mean.shape)
        return {name: float(values[i]) for (name, values), i in zip(self.axes.items(), at, strict=True)}

    def along(self, name: str) -> Floats:
        """Values of a setting, and the greatest mean speed [m/s] at each of them (S, 2)."""
        mean = np.moveaxis(self.speed_m_s.mean(axis=-1), list(self.axes).index(name), 0)
        return np.stack([self.axes[name], mean.reshape(len(mean), -1).max(axis=1)], axis=1)


def sweep(
    scene: Scene,
    drive: Callable[..., Controller],
    axes: Mapping[str, Sequence[float] | Floats],
    trial: Trial,
    *,
    starts: int = 2,
    removed: Sequence[int] | None = None,
    seed: int = 0,
) -> Sweep:
    """Measures every combination of settings.

    Args:
        scene: Scene with a controlled drive.
        drive: Makes a controller of arrays (N,), the settings by name.
        axes: Values of each setting by its name.
        trial: How a speed is measured.
        starts: Seeds for each combination; the scene draws the start from the seed.
        removed: Magnets taken out; None for those that the scene lacks.
        seed: First seed.

    Raises:
        ValueError: The scene has no controlled drive.
    """
    values = {name: np.asarray(axis, np.float64) for name, axis in axes.items()}
    shape = (*(len(axis) for axis in values.values()), starts)
    *at, number = (index.ravel() for index in np.indices(shape))
    settings = {name: axis[i] for (name, axis), i in zip(values.items(), at, strict=True)}
    worms = Runner(scene, number.size, removed)
    return Sweep(values, trial.speed_m_s(worms, number + seed, drive(**settings)).reshape(shape))
