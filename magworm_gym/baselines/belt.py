"""The paper's drive: a belt of magnets that passes under the robot at constant speed.

Source: "MagWorm", Soft Robotics, doi 10.1089/soro.2019.0167: platform with 125 mm pitch, speed test
with 170 mm, belt speed up to 210 mm/s.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene
from magworm_gym.baselines.runner import Runner
from magworm_gym.baselines.sweep import Sweep
from magworm_gym.baselines.trial import Trial

Floats = NDArray[np.float64]

PAPER_PITCHES_M = (0.125, 0.170)
TRAVEL_M = 1.2


def belt_scene(scene: Scene, pitch_m: float, speed_m_s: float | None = None) -> Scene:
    """The same robot over a belt instead of a stage.

    The belt runs at the greatest height of the stage and, unless told, at its greatest speed.

    Args:
        scene: Scene with a controlled drive, whose limits the belt keeps.
        pitch_m: Distance between neighbouring drive magnets [m].
        speed_m_s: Speed of the belt towards the tail [m/s]; None for the stage's limit.

    Returns:
        A scene whose drive is not controlled.

    Raises:
        ValueError: The scene has no controlled drive.
        SceneError: A value that the simulator does not accept.
    """
    limits = scene.stage_limits
    if limits is None:
        raise ValueError(f"scene {scene.name!r} has no controlled drive whose limits a belt could keep")
    count = 2 * math.ceil(0.5 * TRAVEL_M / pitch_m) + 1
    return scene.with_values(
        {
            "drive.motion": {
                "kind": "constant",
                "x_m": 0.0,
                "y_m": limits["highest_m"],
                "speed_m_s": limits["speed_m_s"] if speed_m_s is None else speed_m_s,
            },
            "drive.arrangement": {"kind": "belt", "pitch_m": pitch_m, "count": count},
        }
    )


def belt_starts(pitch_m: float, count: int, seed: int) -> Floats:
    """Start poses (count, 3) that spread the robot over one pitch of the belt.

    Args:
        pitch_m: Pitch of the belt [m].
        count: Number of starts.
        seed: Seed of the draws; one draw in each of ``count`` equal parts of the pitch.

    Returns:
        x [m], height [m] and angle [rad]; height and angle are 0.
    """
    parts = np.arange(count) + np.random.default_rng(seed).uniform(size=count)
    starts = np.zeros((count, 3))
    starts[:, 0] = pitch_m * (parts / count - 0.5)
    return starts


def sweep_belt(
    scene: Scene,
    pitch_m: float,
    drive_speed_m_s: Sequence[float] | Floats,
    trial: Trial,
    *,
    starts: int = 8,
    removed: Sequence[int] | None = None,
    seed: int = 0,
) -> Sweep:
    """Measures crawling speed against belt speed in one batch.

    Args:
        scene: Scene with a controlled drive.
        pitch_m: Pitch of the belt [m].
        drive_speed_m_s: Belt speeds (S,) [m/s], each above 0 and at most the stage's limit.
        trial: How a speed is measured.
        starts: Number of start poses, spread over one pitch.
        removed: Magnets taken out; None for those that the scene lacks.
        seed: Seed of the start poses.

    Returns:
        The sweep, whose axis is ``drive_speed_m_s``.

    Raises:
        ValueError: The scene has no controlled drive, or a belt speed is beyond its limit.
    """
    speeds = np.asarray(drive_speed_m_s, dtype=np.float64)
    limits = scene.stage_limits
    if limits is None or speeds.min() <= 0.0 or speeds.max() > limits["speed_m_s"] * (1.0 + 1e-9):
        raise ValueError("a belt takes speeds above 0 and up to the limit of a controlled stage")
    worms = Runner(belt_scene(scene, pitch_m), len(speeds) * starts, removed)
    worms.batch.set_parameter("drive_speed", np.repeat(speeds / limits["speed_m_s"], starts))
    start = np.tile(belt_starts(pitch_m, starts, seed), (len(speeds), 1))
    seeds = np.tile(np.arange(starts) + seed, len(speeds))
    measured = trial.speed_m_s(worms, seeds, start=start)
    return Sweep({"drive_speed_m_s": speeds}, measured.reshape(len(speeds), starts))
