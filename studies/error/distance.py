"""What single precision does far from the origin, where places are rounded more."""

from dataclasses import dataclass

from magworm_gym import Scene, record_scenes
from studies.error.cases import HEIGHTS_MM, MM, PASS_S, SPEED_M_S, read_crawl
from studies.error.errors import Errors, errors
from studies.paper.scenes import AHEAD_M

STEPS_MS = (5.0, 2.0, 0.5)
PLACES_M = (0.0, 0.3, 1.0, 3.0, 10.0)


@dataclass(frozen=True)
class Distance:
    """Passes of the drive at some place.

    Attributes:
        step_ms: Step [ms].
        place_m: Where the robot starts [m].
        errors: Of single precision, against double precision with the same step at the origin.
    """

    step_ms: float
    place_m: float
    errors: Errors


def passes(step_ms: float, place_m: float, precision: str) -> list[Scene]:
    """The passes of the case `crawl`, all of them moved along x."""
    scenes = []
    for height_mm in HEIGHTS_MM:
        drive = {"x_m": place_m - AHEAD_M, "y_m": float(height_mm) / MM, "speed_m_s": SPEED_M_S}
        values = {
            "start.x_m": place_m,
            "solver.step_s": step_ms / MM,
            "solver.precision": precision,
            "drive.motion": {"kind": "constant", **drive},
        }
        scenes.append(Scene.preset("paper-3").with_values(values))
    return scenes


def distances() -> list[Distance]:
    """All steps and places."""
    found = []
    for step_ms in STEPS_MS:
        true = read_crawl(record_scenes(passes(step_ms, 0.0, "double"), PASS_S, 0.02))
        for place_m in PLACES_M:
            records = record_scenes(passes(step_ms, place_m, "single"), PASS_S, 0.02)
            seen = read_crawl(records)
            if seen.tracks is not None:
                seen.tracks[..., 0] -= place_m
            off = errors(seen, true, {})
            if off is None or any(record.broken is not None for record in records):
                raise RuntimeError(f"a pass at {place_m} m broke down")
            found.append(Distance(step_ms, place_m, off))
    return found
