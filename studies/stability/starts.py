"""Starts that are bent: folded, inverted, rolled up, twisted, knotted, and inside the ground.

The *rod* is that of the preset ``cantilever``, 3 mm wide and thick and free, on the ground. The *robot* is
that of the other sweeps.
"""

from pathlib import Path

import msgspec

from studies.stability.axes import Changes

ROD: Changes = {
    "body.clamp": "none",
    "body.width_m": 0.003,
    "body.thickness_m": 0.003,
    "body.elements": 27,
    "ground": {"static_friction": 0.8, "dynamic_friction": 0.6},
}
STARTS = msgspec.toml.decode(
    (Path(__file__).parent / "starts.toml").read_bytes(), type=dict[str, dict[str, Changes]]
)
"""What a scene changes for each start of each body."""


def starting(body: str, start: str) -> Changes:
    """What a scene of a body changes for a start; nothing where it is straight."""
    if not start:
        return {}
    return (ROD if body == "rod" else {}) | STARTS[body][start]


def places(body: str, start: str) -> tuple[int, ...]:
    """Dimensions in which a start is possible: 2 only where it neither bends aside nor twists."""
    return (3,) if {"start.bends_aside_deg", "start.twists_deg"} & set(STARTS[body][start]) else (2, 3)
