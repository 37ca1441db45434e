"""Robots, problems, claims and made-up recordings that the tests of joint identification share."""

from pathlib import Path

import numpy as np

from magworm_gym import Recording, Scene
from magworm_gym.identification import make_problem
from magworm_gym.identification.claims import Curve
from magworm_gym.identification.quantities import Quantity
from magworm_gym.identification.sweep import Sweep

REPOSITORY = Path(__file__).parent.parent
ROBOT = {
    "body.width_m": 0.0176,
    "body.foot_length_m": 0.0156,
    "material.youngs_modulus_pa": 61e3,
    "material.damping_time_s": 0.0465,
    "magnet.length_m": 0.0071,
    "magnet.width_m": 0.008,
    "magnet.height_m": 0.0018,
    "drive.length_m": 0.0239,
    "drive.width_m": 0.0184,
    "drive.height_m": 0.0067,
    "ground.static_friction": 0.98,
    "ground.dynamic_friction": 0.54,
    "ground.transition_speed_m_s": 0.0139,
    "ground.adhesion_n": 0.0097,
}
"""Values that these tests count on, whatever the preset's are."""
STRIDE = Quantity("stride_m")
SPEEDS = (0.2, 0.3, 0.4)


def moving(speed_m_s, **values):
    motion = {"kind": "constant", "x_m": -0.05, "y_m": -0.022, "speed_m_s": speed_m_s}
    return Scene.preset("paper-3").with_values({**ROBOT, "drive.motion": motion, **values})


def entries(claims, sweeps=None, **more):
    """A joint problem of robots with three and four magnets, quick to simulate."""
    sweeps = sweeps or [
        {"name": "three", "speeds_m_s": list(SPEEDS)},
        {"name": "four", "values": {"body.magnets": 4}, "speeds_m_s": list(SPEEDS)},
    ]
    return {
        "scene": "paper-3",
        "values": ROBOT,
        "sample_s": 0.01,
        "parameters": {
            "material.youngs_modulus_pa": {"low": 50e3, "high": 90e3, "scale": "log"},
            "ground.static_friction": {"low": 0.6, "high": 1.3},
        },
        "sweep": sweeps,
        "claim": claims,
        "search": {"restarts": 2, "population": 6, "generations": 5, "scatter": 16, "rounds": 1},
        **more,
    }


def problem(claims, **more):
    return make_problem(entries(claims, **more), Path())


def value(curve, at_m_s, value, **more):
    name = f"{curve} at {at_m_s}"
    claim = {"name": name, "kind": "value", "curve": curve, "at_m_s": at_m_s, "value": value}
    return {**claim, "within": 2e-4, "scale": 1e-4, **more}


FAST = value("three.stride_m", 0.4, 3e-3)
HELD = value("four.stride_m", 0.3, 3e-3, fit=False, group="four")


def paths(*strides_m):
    """Recordings named 0/0, 0/1, … of robots that make these strides [m], by speed and condition."""
    named = {}
    for place, row in enumerate(strides_m):
        for at, stride_m in enumerate(np.atleast_1d(row)):
            poses = np.zeros((2, 1, 3))
            poses[1, 0, 0] = -stride_m
            nothing = np.empty((2, 0, 2))
            named[f"{place}/{at}"] = Recording(
                np.array([0.0, 1.0]), nothing, poses, np.ones(1, bool), nothing
            )
    return named


def of(recordings, name):
    return {f"{name}/{key}": recording for key, recording in recordings.items()}


def curve(name, conditions=1, speeds=SPEEDS):
    sweep = Sweep(name, moving(0.2), speeds, ({},) * conditions)
    return Curve(sweep, STRIDE)
