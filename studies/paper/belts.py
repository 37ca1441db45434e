"""Continuous crawling over belts of drive magnets, against the speed of the belt."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, record_scenes
from magworm_gym.baselines import PAPER_PITCHES_M
from studies.paper.figures import BY_MAGNETS, PAPER, legend_above, panels
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import AHEAD_M, on_belt, robot
from studies.paper.section import Image, Section, table
from studies.paper.wording import COUNTS, higher_or_lower

Floats = NDArray[np.float64]

SPEEDS_MM_S = np.arange(20.0, 211.0, 10.0)
FIRST_PASSES, PASSES = 2, 8
SAMPLE_S = 0.01
STARTS = 3
PAPER_LENGTHS_S = {3: 0.36, 5: 0.40}
PAPER_FIVE_MM_S, PAPER_STRIDE_MM, PAPER_PITCH_M, PLATFORM_M_S = 38.8, 6.0, 0.170, 0.210
DRAGGED_MM_S = -1.0
"""Ours: a robot that is faster than this towards the tail is dragged by the belt."""


@dataclass(frozen=True)
class Curve:
    """Crawling speed against the speed of a belt.

    Attributes:
        speed: Mean over the starts (S,) [mm/s].
        spread: Standard deviation over the starts (S,) [mm/s].
        length: Length of the robot [mm].
    """

    speed: Floats
    spread: Floats
    length: float

    @property
    def best(self) -> int:
        """Index of the belt's best speed."""
        return int(self.speed.argmax())


def steady_speed_m_s(record: Recording, first_s: float, last_s: float) -> float:
    """Mean speed towards the head between two instants [m/s].

    Raises:
        RuntimeError: The simulation broke down; the sentence says why.
    """
    if record.broken is not None:
        raise RuntimeError(f"a simulation broke down: {record.broken}")
    step_s = record.time_s[1] - record.time_s[0]
    first, last = round(first_s / step_s), min(round(last_s / step_s), len(record.time_s) - 1)
    way = record.progress_m[last] - record.progress_m[first]
    return float(way / (record.time_s[last] - record.time_s[first]))


def measured_curve(magnets: int, pitch_m: float) -> Curve:
    """Curve of a robot on a belt, after the first passes."""
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
    return Curve(by_speed.mean(axis=1), by_speed.std(axis=1), MM * scene.body_length_m)


def belts_section() -> Section:
    """Runs both robots on both belts."""
    curves = {(n, pitch): measured_curve(n, pitch) for n in PAPER_LENGTHS_S for pitch in PAPER_PITCHES_M}
    return Section(
        title="Continuous crawling on belts",
        text=_text(curves),
        images=[
            Image(
                "belts",
                "Crawling speed against the speed of the belt. Black lines: the paper's highest speeds, "
                "which its own stride does not reach.",
                _figure(curves),
            )
        ],
        quantities=_quantities(curves),
        data={
            f"{n} magnets, {MM * pitch:g} mm": {"mm_s": c.speed.tolist(), "spread_mm_s": c.spread.tolist()}
            for (n, pitch), c in curves.items()
        }
        | {"belt_mm_s": SPEEDS_MM_S.tolist()},
    )


def _quantities(curves: dict[tuple[int, float], Curve]) -> list[Quantity]:
    found = []
    for (magnets, pitch), curve in curves.items():
        published = pitch == PAPER_PITCH_M
        found.append(
            Quantity(
                f"belt.best_{magnets}_{MM * pitch:.0f}",
                f"Belt of {MM * pitch:g} mm: {COUNTS[magnets]} magnets, highest speed",
                "L/s",
                float(curve.speed[curve.best] / curve.length),
                Origin.HELD_BACK if published else Origin.MODEL,
                paper=PAPER_LENGTHS_S[magnets] if published else None,
                spread=float(curve.spread[curve.best] / curve.length),
                digits=3,
                note="the paper's figure does not follow from its stride" if published else "",
            )
        )
    return found


def _text(curves: dict[tuple[int, float], Curve]) -> str:
    passes = PLATFORM_M_S / PAPER_PITCH_M
    needed = PAPER_FIVE_MM_S / passes
    lines = []
    for (magnets, pitch), curve in curves.items():
        best = curve.best
        per_pass = curve.speed[best] * MM * pitch / SPEEDS_MM_S[best]
        dragged = SPEEDS_MM_S[curve.speed < DRAGGED_MM_S]
        lines.append(
            [
                COUNTS[magnets],
                f"{MM * pitch:g} mm",
                f"{number(curve.speed[best], 1)} ± {number(curve.spread[best], 1)} mm/s",
                f"{number(curve.speed[best] / curve.length, 2)} L/s",
                f"{SPEEDS_MM_S[best]:g} mm/s",
                f"{number(per_pass, 1)} mm",
                ", ".join(f"{speed:g}" for speed in dragged) or "none",
            ]
        )
    header = [
        "magnets",
        "pitch",
        "highest speed",
        "body lengths",
        "belt at",
        "way a pass",
        "dragged backward at [mm/s]",
    ]
    own = curves[5, PAPER_PITCH_M]
    return (
        "The paper gives 0.36 body lengths/s for three and 0.40 (38.8 mm/s) for five magnets with a pitch "
        "of 170 mm. "
        f"This does not close: at most {1e3 * PLATFORM_M_S:g} mm/s and {MM * PAPER_PITCH_M:g} mm make "
        f"{passes:.2f} passes a "
        f"second, so 38.8 mm/s would need {needed:.0f} mm a pass, {needed / PAPER_STRIDE_MM:.0f} times the "
        "stride of about "
        f"{PAPER_STRIDE_MM:g} mm that the paper reports for the same robot. With that stride the belt gives "
        f"{passes * PAPER_STRIDE_MM:.1f} mm/s. The model, at most {number(own.speed[own.best], 1)} mm/s, is "
        f"{higher_or_lower(own.speed[own.best], passes * PAPER_STRIDE_MM)} than that and makes "
        f"{100.0 * own.speed[own.best] / PAPER_FIVE_MM_S:.0f} % of 38.8. Nothing here is tuned to these "
        f"figures. Means over {COUNTS[STARTS]} starts and {PASSES} passes after the first "
        f"{COUNTS[FIRST_PASSES]}; L is the body length.\n\n" + table(header, lines)
    )


def _published_length(magnets: int, curve: Curve) -> float:
    """Length by which the paper's speed is in mm/s: its own for five magnets, else the model's [mm]."""
    return PAPER_FIVE_MM_S / PAPER_LENGTHS_S[5] if magnets == 5 else curve.length


def _figure(curves: dict[tuple[int, float], Curve]) -> Any:
    figure, axes = panels(1, 2, (9.2, 3.7))
    for axis, normalised in zip(axes, (False, True), strict=True):
        for (magnets, pitch), curve in curves.items():
            scale = curve.length if normalised else 1.0
            style = (
                {"ls": "-", "marker": "o"}
                if pitch == PAPER_PITCH_M
                else {"ls": "--", "marker": "s", "mfc": "white"}
            )
            label = f"{COUNTS[magnets]} magnets, {MM * pitch:g} mm pitch"
            axis.errorbar(
                SPEEDS_MM_S,
                curve.speed / scale,
                curve.spread / scale,
                color=BY_MAGNETS[magnets],
                ms=3.5,
                lw=1.3,
                elinewidth=0.9,
                label=label,
                **style,
            )
        for magnets, lengths in PAPER_LENGTHS_S.items():
            scale = 1.0 if normalised else _published_length(magnets, curves[magnets, PAPER_PITCH_M])
            axis.axhline(lengths * scale, color=PAPER, lw=1.0, ls="--")
            axis.annotate(
                f"paper, {COUNTS[magnets]}",
                (22.0, lengths * scale),
                (0, 3),
                textcoords="offset points",
                fontsize=8,
            )
        axis.axhline(0.0, color=PAPER, lw=0.6)
        axis.set_xlim(0.0, SPEEDS_MM_S[-1] + 10.0)
        axis.set_xlabel("speed of the belt [mm/s]")
    axes[0].set_ylabel("crawling speed [mm/s]")
    axes[1].set_ylabel("crawling speed [body lengths/s]")
    legend_above(figure, axes[0], 4)
    return figure
