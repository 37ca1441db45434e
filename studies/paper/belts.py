"""Continuous crawling over belts of drive magnets, against the speed of the belt."""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from magworm_gym import Recording, record_scenes
from magworm_gym.baselines import PAPER_PITCHES_M
from studies.kit.figures import BY_MAGNETS, REFERENCE, legend_above, panels
from studies.kit.passes import AHEAD_M, MM, Floats, on_belt, robot, unbroken
from studies.kit.words import COUNTS
from studies.paper.experiment import Experiment, Numbers
from studies.paper.marks import PLATFORM_MM_S, WAYS, draw_spread, over_speed

SPEEDS_MM_S = np.arange(20.0, 211.0, 10.0)
FIRST_PASSES, PASSES = 2, 8
SAMPLE_S = 0.01
STARTS = 3
PAPER_LENGTHS_S = {3: 0.36, 5: 0.40}
PAPER_FIVE_MM_S, PAPER_STRIDE_MM, PAPER_PITCH_MM = 38.8, 6.0, 170.0
DRAGGED_MM_S = -1.0
"""Ours: a robot that is faster than this towards the tail is dragged by the belt."""


@dataclass(frozen=True)
class Belt:
    """Crawling speed of a robot against the speed of a belt.

    Attributes:
        magnets: Of the robot.
        pitch_mm: Of the belt [mm].
        length_mm: Length of the robot [mm].
        speed_mm_s: Mean over the starts (S,) [mm/s].
        spread_mm_s: Standard deviation over the starts (S,) [mm/s].
    """

    magnets: int
    pitch_mm: float
    length_mm: float
    speed_mm_s: Floats
    spread_mm_s: Floats

    @property
    def published(self) -> bool:
        """Whether the paper has a highest speed for it."""
        return self.pitch_mm == PAPER_PITCH_MM

    @property
    def best(self) -> int:
        """Index of the belt's best speed."""
        return int(self.speed_mm_s.argmax())

    @property
    def best_mm_s(self) -> float:
        """Highest crawling speed [mm/s]."""
        return float(self.speed_mm_s.max())

    @property
    def best_at(self) -> float:
        """Speed of the belt there [mm/s]."""
        return float(SPEEDS_MM_S[self.best])

    @property
    def dragged_at(self) -> list[float]:
        """Speeds of the belt at which it drags the robot [mm/s]."""
        return list(SPEEDS_MM_S[self.speed_mm_s < DRAGGED_MM_S])


@dataclass(frozen=True)
class Belts(Experiment):
    """Both robots on both belts."""

    name: ClassVar[str] = "belts"
    belts: list[Belt]

    @classmethod
    def measured(cls) -> "Belts":
        """Runs all belts."""
        return cls([measured_belt(n, pitch) for n in PAPER_LENGTHS_S for pitch in PAPER_PITCHES_M])

    @property
    def five(self) -> Belt:
        """Five magnets on the paper's belt."""
        return next(belt for belt in self.belts if belt.published and belt.magnets == 5)

    @property
    def words(self) -> dict[str, Any]:
        """What does not close in the paper's numbers."""
        passes = PLATFORM_MM_S / PAPER_PITCH_MM
        return {
            "passes_per_s": passes,
            "needed_mm": PAPER_FIVE_MM_S / passes,
            "needed_strides": PAPER_FIVE_MM_S / passes / PAPER_STRIDE_MM,
            "possible_mm_s": passes * PAPER_STRIDE_MM,
            "reached": self.five.best_mm_s / PAPER_FIVE_MM_S,
        }

    def numbers(self) -> Numbers:
        """Highest speeds in body lengths a second."""
        return {
            f"belt.best_{belt.magnets}_{belt.pitch_mm:.0f}": (
                belt.best_mm_s / belt.length_mm,
                belt.spread_mm_s[belt.best] / belt.length_mm,
            )
            for belt in self.belts
        }

    def figures(self) -> dict[str, Any]:
        """Speeds, and speeds in body lengths."""
        figure, axes = panels(1, 2, (9.2, 3.7))
        for axis, normalised in zip(axes, (False, True), strict=True):
            for belt in self.belts:
                scale = belt.length_mm if normalised else 1.0
                label = f"{COUNTS[belt.magnets]} magnets, {belt.pitch_mm:g} mm pitch"
                style = {"color": BY_MAGNETS[belt.magnets], "label": label, **WAYS[not belt.published]}
                draw_spread(axis, SPEEDS_MM_S, belt.speed_mm_s / scale, belt.spread_mm_s / scale, **style)
                if belt.published:
                    _mark_published(axis, belt, normalised)
            over_speed(axis, SPEEDS_MM_S[-1], "speed of the belt [mm/s]")
        axes[0].set_ylabel("crawling speed [mm/s]")
        axes[1].set_ylabel("crawling speed [body lengths/s]")
        legend_above(figure, axes[0], 4)
        return {"belts": figure}


def measured_belt(magnets: int, pitch_m: float) -> Belt:
    """A robot on a belt, after the first passes."""
    scene = robot(magnets)
    starts = [AHEAD_M + pitch_m * start / STARTS for start in range(STARTS)]
    count = 2 * math.ceil(0.3 / pitch_m) + 1
    cases = [(1e-3 * speed, ahead) for speed in SPEEDS_MM_S for ahead in starts]
    scenes = [on_belt(scene, speed, pitch_m, count=count, ahead_m=ahead) for speed, ahead in cases]
    spans = [
        (FIRST_PASSES * pitch_m / speed, (FIRST_PASSES + PASSES) * pitch_m / speed) for speed, _ in cases
    ]
    durations = [SAMPLE_S * math.ceil(last / SAMPLE_S) for _, last in spans]
    records = record_scenes(scenes, durations, SAMPLE_S, nodes=False)
    speeds = [MM * steady_speed_m_s(record, *span) for record, span in zip(records, spans, strict=True)]
    by_speed = np.array(speeds).reshape(len(SPEEDS_MM_S), STARTS)
    sizes = (magnets, MM * pitch_m, MM * scene.body_length_m)
    return Belt(*sizes, by_speed.mean(axis=1), by_speed.std(axis=1))


def steady_speed_m_s(record: Recording, first_s: float, last_s: float) -> float:
    """Mean speed towards the head between two instants [m/s].

    Raises:
        RuntimeError: The simulation broke down; the sentence says why.
    """
    step_s = unbroken(record).time_s[1] - record.time_s[0]
    first, last = round(first_s / step_s), min(round(last_s / step_s), len(record.time_s) - 1)
    way = record.progress_m[last] - record.progress_m[first]
    return float(way / (record.time_s[last] - record.time_s[first]))


def _mark_published(axis: Any, belt: Belt, normalised: bool) -> None:
    """The paper's speed; in mm/s by its own length of five magnets, else by the model's."""
    lengths = PAPER_LENGTHS_S[belt.magnets]
    length_mm = PAPER_FIVE_MM_S / lengths if belt.magnets == 5 else belt.length_mm
    height = lengths if normalised else lengths * length_mm
    axis.axhline(height, color=REFERENCE, lw=1.0, ls="--")
    words = f"paper, {COUNTS[belt.magnets]}"
    axis.annotate(words, (22.0, height), (0, 3), textcoords="offset points", fontsize=8)
