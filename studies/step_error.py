"""What a pass of the drive gives at steps of the solver against much shorter ones.

Stick and slip make a single pass rugged: where rounding decides which foot slips first, some passes come
out differently. So many neighbouring passes are run, and three figures told: the error of their mean with its
standard error, and the median of the errors of single passes.
"""

import statistics
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Scene, record_scenes
from studies.paper.scenes import AHEAD_M
from studies.turning.passes import MM, SAMPLE_S, Drive, outcomes

Floats = NDArray[np.float64]

HEIGHTS_MM = tuple(-22.0 + 0.1 * k for k in range(-4, 5))
OFFSETS_MM = (2.0, 2.5, 3.0, 3.5, 4.0)
STEPS_MS = (5.0, 2.0, 1.0, 0.5)
SHORT_MS = 0.05
CHECK_MS = 0.0625
"""The next longer step that divides 10 ms: how far the reference itself is converged."""
SPEED_M_S = 0.1
PASS_S = 1.8
EVEN_FRICTION = 0.9
"""Between the preset's coefficients at rest and in motion."""


@dataclass(frozen=True)
class Error:
    """Difference from the reference, as parts of the reference's mean.

    Attributes:
        step_ms: Step [ms].
        mean: That of the mean over all passes.
        uncertainty: Its standard error.
        median: Median of the absolute differences of single passes.
    """

    step_ms: float
    mean: float
    uncertainty: float
    median: float

    def text(self) -> str:
        """As a line of the report."""
        return (
            f"{self.step_ms:g} ms: {100 * self.mean:+.2f} ± {100 * self.uncertainty:.2f} % of the mean,"
            f" {100 * self.median:.2f} % of a pass"
        )


@dataclass(frozen=True)
class Converged:
    """A figure of many passes, and its errors at several steps.

    Attributes:
        passes: How many.
        value: Mean at the shortest step.
        errors: At longer steps; the last is that of a step hardly longer.
    """

    passes: int
    value: float
    errors: tuple[Error, ...]

    def lines(self, name: str, unit: str) -> list[str]:
        """As lines of the report."""
        head = f"{name}, mean of {self.passes} passes: {self.value:.3f} {unit} at {SHORT_MS:g} ms"
        return [head, *(f"  {error.text()}" for error in self.errors)]

    def data(self) -> dict[str, Any]:
        """As JSON."""
        return asdict(self)


def strides_mm(scene: str, step_ms: float) -> Floats:
    """Strides of passes in the plane, one for each height [mm]."""
    scenes = []
    for height_mm in HEIGHTS_MM:
        motion = {
            "kind": "constant",
            "x_m": -AHEAD_M,
            "y_m": height_mm / MM,
            "speed_m_s": SPEED_M_S,
        }
        changes = {"drive.motion": motion, "solver.step_s": step_ms / MM}
        scenes.append(Scene.preset(scene).with_values(changes))
    records = record_scenes(scenes, PASS_S, SAMPLE_S, nodes=False)
    return np.array([MM * record.progress_m[-1] for record in records])


def strides_and_yaws(step_ms: float, friction: float | None) -> tuple[Floats, Floats]:
    """Strides [mm] and yaws [°] of passes beside the robot in space, one for each offset and height."""
    drives = [
        Drive(3, offset_mm=offset, height_mm=height, step_ms=step_ms, friction=friction)
        for offset in OFFSETS_MM
        for height in HEIGHTS_MM
    ]
    found = outcomes(drives)
    return np.array([one.stride_mm for one in found]), np.array([one.yaw_deg for one in found])


def converged(at: Sequence[Floats], reference: Floats, steps_ms: Sequence[float]) -> Converged:
    """Errors of passes at several steps against the same passes at a short one."""
    value = float(reference.mean())
    errors = []
    for found, step_ms in zip(at, steps_ms, strict=True):
        off = (found - reference) / value
        spread = statistics.stdev(off) / len(off) ** 0.5
        errors.append(Error(step_ms, float(off.mean()), spread, float(np.median(np.abs(off)))))
    return Converged(len(reference), value, tuple(errors))


def plane(scene: str) -> Converged:
    """Stride in the plane [mm]."""
    steps = (*STEPS_MS, CHECK_MS)
    return converged([strides_mm(scene, step) for step in steps], strides_mm(scene, SHORT_MS), steps)


def space(friction: float | None = None) -> tuple[Converged, Converged]:
    """Stride [mm] and yaw [°] of three magnets in space. `friction`: as of a `Drive`."""
    steps = (*STEPS_MS, CHECK_MS)
    strides, yaws = zip(*(strides_and_yaws(step, friction) for step in (*steps, SHORT_MS)), strict=True)
    return converged(strides[:-1], strides[-1], steps), converged(yaws[:-1], yaws[-1], steps)
