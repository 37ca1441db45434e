"""The planar presets in space: the same scenes with a third dimension, beside the plane."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.passes import HOLD_S, LOW_M, MM, PASS_S, PLANE_M, RISE_S, one_pass, under_middle, values_of
from studies.turning.passes import rolls_deg

PRESETS = ("paper-3", "paper-4", "paper-5")
BELT, BELT_PERIOD_S = "belt-125", 1.25
ASIDE_MM = 0.01
"""Ours: a drive that is not quite on the line; on it nothing rolls, stable or not."""
SAMPLE_S = 0.002
WITHIN = 0.01


@dataclass(frozen=True)
class Comparison:
    """One figure of one preset in the plane and in space."""

    preset: str  # its name
    case: str  # "lift", "pass" or "belt"
    figure: str  # "lift", "peak" or "stride"
    plane_mm: float  # in the plane [mm]
    space_mm: float  # in space, drive on the line [mm]
    apart_mm: float  # greatest distance of a magnet from its planar place at any time [mm]
    roll_deg: float  # greatest roll of any foot at any time, drive on the line [°]
    aside_mm: float  # the figure with the drive 0.01 mm beside the line [mm]
    aside_roll_deg: float  # greatest roll then [°]

    @property
    def difference(self) -> float:
        """Space over plane, less 1."""
        return self.space_mm / self.plane_mm - 1.0

    @property
    def agrees(self) -> bool:
        """Whether space and plane are within 1 % of each other."""
        return abs(self.difference) <= WITHIN


def comparisons() -> list[Comparison]:
    """Runs all cases in the plane, in space, and in space with the drive beside the line."""
    cases = []
    for preset in PRESETS:
        scene = Scene.preset(preset)
        lift = under_middle(scene, [0.0, RISE_S], [LOW_M, PLANE_M])
        cases += [(preset, "lift", lift, RISE_S + HOLD_S), (preset, "pass", one_pass(scene), PASS_S)]
    cases.append((BELT, "belt", Scene.preset(BELT), BELT_PERIOD_S))
    found = []
    for preset, case, flat, duration_s in cases:
        scenes = [flat, in_space(flat, 0.0), in_space(flat, ASIDE_MM)]
        records = record_scenes(scenes, duration_s, SAMPLE_S, nodes=False)
        for figure in ("lift",) if case == "lift" else ("peak", "stride"):
            found.append(compared(preset, case, figure, *records))
    return found


def in_space(flat: Scene, aside_mm: float) -> Scene:
    """A planar scene in space, its drive beside the line by so much [mm]."""
    motion: dict[str, Any] = dict(values_of(flat)["drive"]["motion"])
    waypoints = motion["kind"] == "waypoints"
    motion["z_m"] = [aside_mm / MM] * len(motion["time_s"]) if waypoints else aside_mm / MM
    return flat.with_values({"dimensions": 3, "drive.motion": motion})


def compared(
    preset: str, case: str, figure: str, plane: Recording, space: Recording, aside: Recording
) -> Comparison:
    """One figure of the same case in the plane, in space, and in space with the drive aside."""
    plane_mm, space_mm, aside_mm = (figure_mm(figure, record) for record in (plane, space, aside))
    rolls = [float(np.abs(rolls_deg(record.magnet_poses[..., 3:])).max()) for record in (space, aside)]
    away = space.magnet_poses[..., :3] - np.pad(plane.magnet_poses[..., :2], ((0, 0), (0, 0), (0, 1)))
    apart_mm = MM * float(np.linalg.norm(away, axis=-1).max())
    return Comparison(preset, case, figure, plane_mm, space_mm, apart_mm, rolls[0], aside_mm, rolls[1])


def figure_mm(figure: str, record: Recording) -> float:
    """Lift at the end or its peak, of the magnet that rises furthest, or the robot's stride [mm]."""
    if figure == "stride":
        return MM * float(record.progress_m[-1])
    lift = MM * (record.magnet_poses[..., 1] - record.magnet_poses[:1, :, 1])
    return float(lift.max() if figure == "peak" else lift[-1].max())
