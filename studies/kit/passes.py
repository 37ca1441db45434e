"""The robots of the presets, and how a drive passes them: once, over and over, or from below.

x runs from head to tail, so the drive moves towards +x and the robot crawls towards −x.
"""

from collections.abc import Sequence
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene

Floats = NDArray[np.float64]

MM = 1e3
ROBOT = "paper-3"
"""Three magnets, identified from the paper's experiment."""
SIMULATION = "paper-3-simulation"
"""Three magnets, identified from the paper's simulation."""

AHEAD_M = 0.050
"""Paper: a pass begins 50 mm ahead of the robot; taken from its head end."""
PLANE_M = -0.022
"""Paper: height of the drive."""
PASS_SPEED_M_S = 0.100
"""Paper: speed of the drive in the pass that it analyses."""
PASS_S = 1.5
"""Paper: duration of that pass."""
SEPARATION_M = 0.300
"""Ours: distance of drive magnets that act one at a time on robots of up to 94 mm."""
LOW_M = -0.052
"""Paper: height from which the drive rises under the middle of the robot, up to its plane."""
RISE_S, HOLD_S = 0.5, 0.3
"""Paper: how long it rises, and then stands."""

CARRIED_M = 0.020
"""Ours: a robot that moves further than one magnet pitch with the drive in a pass was carried along."""


def robot(magnets: int, family: str = ROBOT) -> Scene:
    """A robot with this many magnets and the parameters of a preset with three."""
    if family == ROBOT:
        return Scene.preset(f"paper-{magnets}")
    return Scene.preset(family).with_values({"body.magnets": magnets})


def values_of(scene: Scene) -> dict[str, Any]:
    """Every value of a scene as nested tables."""
    return msgspec.toml.decode(scene.to_toml(), type=dict[str, Any])


def steady(x_m: float, y_m: float, speed_m_s: float, **more: float) -> dict[str, Any]:
    """The motion of a drive that starts at a place and moves along x, as a scene has it."""
    return {"kind": "constant", "x_m": x_m, "y_m": y_m, "speed_m_s": speed_m_s, **more}


def one_pass(scene: Scene, speed_m_s: float = PASS_SPEED_M_S, *, backward: bool = False) -> Scene:
    """A single drive magnet that comes from 50 mm ahead of the head, or backward: of the tail.

    Args:
        scene: The robot.
        speed_m_s: Speed of the drive, positive [m/s].
        backward: Whether it comes from beyond the tail and moves towards the head.
    """
    return scene.with_values({"drive.motion": _motion(scene, speed_m_s, backward, AHEAD_M)})


def on_belt(
    scene: Scene,
    speed_m_s: float,
    pitch_m: float = SEPARATION_M,
    *,
    count: int = 2,
    backward: bool = False,
    ahead_m: float = AHEAD_M,
    friction: float = 1.0,
) -> Scene:
    """Drive magnets that follow each other for ever.

    Args:
        scene: The robot.
        speed_m_s: Speed of the belt, positive [m/s].
        pitch_m: Distance of its magnets [m].
        count: Number of magnets simulated around the robot.
        backward: Whether the belt moves towards the head.
        ahead_m: Where the first magnet starts, ahead of the end that it meets first [m].
        friction: Factor of the static coefficient of friction.
    """
    static = values_of(scene)["ground"]["static_friction"]
    return scene.with_values(
        {
            "drive.motion": _motion(scene, speed_m_s, backward, ahead_m),
            "drive.arrangement": {"kind": "belt", "pitch_m": pitch_m, "count": count},
            "ground.static_friction": friction * static,
        }
    )


def under_middle(scene: Scene, time_s: Sequence[float], height_m: Sequence[float]) -> Scene:
    """A drive magnet under the middle of the robot whose height follows points in time.

    Args:
        scene: The robot.
        time_s: Times, strictly rising from 0 [s].
        height_m: Height of the drive at each time [m].
    """
    middle = [0.5 * scene.body_length_m] * len(time_s)
    points = {"kind": "waypoints", "time_s": list(time_s), "x_m": middle, "y_m": list(height_m)}
    return scene.with_values({"drive.motion": points})


def middle_lift(recording: Recording) -> Floats:
    """Height gained by the middle magnet (T,) [m]."""
    height = recording.magnet_poses[:, recording.magnet_poses.shape[1] // 2, 1]
    return np.asarray(height - height[0])


def unbroken(recording: Recording) -> Recording:
    """The recording itself.

    Raises:
        RuntimeError: The simulation broke down; the sentence says why.
    """
    if recording.broken is not None:
        raise RuntimeError(f"a simulation broke down: {recording.broken}")
    return recording


def _motion(scene: Scene, speed_m_s: float, backward: bool, ahead_m: float) -> dict[str, Any]:
    start, sign = (scene.body_length_m + ahead_m, -1.0) if backward else (-ahead_m, 1.0)
    return steady(start, PLANE_M, sign * speed_m_s)
