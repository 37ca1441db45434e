"""What single precision does far from the origin, where places are rounded more."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from studies.error.cases import CRAWL, passes_below
from studies.error.errors import Error, errors
from studies.error.settings import Settings

STEPS_MS = (5.0, 2.0, 0.5)
PLACES_M = (0.0, 0.3, 1.0, 3.0, 10.0)


@dataclass(frozen=True)
class Distance:
    """Error of single precision where the robot starts at a place [m].

    It is against double precision at the origin with the same step.
    """

    step_ms: float
    place_m: float
    error: Error


def distances() -> Iterator[Distance]:
    """All steps and places."""
    for step_ms in STEPS_MS:
        true = CRAWL.run(Settings(step_ms))
        for place_m in PLACES_M:
            there = replace(CRAWL, scenes=passes_below(place_m))
            found = there.run(Settings(step_ms, precision="single"))
            if found.tracks is not None:
                found.tracks[..., 0] -= place_m
            yield from (Distance(step_ms, place_m, error) for error in errors(found, true, {}))
