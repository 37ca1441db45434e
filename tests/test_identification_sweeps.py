"""Robots that are fitted together: a sweep over speeds and conditions, each in a lane of a block."""

import sys
from pathlib import Path

import numpy as np
import pytest
from joint_problems import STRIDE, moving

sys.path.insert(0, str(Path(__file__).parent.parent))

from magworm_gym import record_scenes
from magworm_gym.identification.claims import Curve
from magworm_gym.identification.sweep import LANES, Passes, Sweep
from studies.paper.passes import FRICTIONS, Walk, measured_strides


def test_a_robot_of_a_sweep_does_what_a_scene_of_its_own_does_bit_for_bit():
    sweep = Sweep("three", moving(0.2), (0.2, 0.4))
    seen = sweep.record({"material.youngs_modulus_pa": 50e3}, 0.01)
    for lanes, speed_m_s in zip(sweep.lanes, sweep.speeds_m_s, strict=True):
        scene = moving(speed_m_s, **{"material.youngs_modulus_pa": 50e3})
        recording = seen[lanes[0].name]
        alone = record_scenes([scene], recording.time_s[-1], 0.01, nodes=False)[0]
        assert np.array_equal(recording.magnet_poses, alone.magnet_poses)
        way_m = 0.1 + scene.body_length_m
        assert recording.time_s[-1] == pytest.approx(way_m / speed_m_s + sweep.settle_s, abs=0.01)


@pytest.mark.parametrize(("precision", "speeds"), [("double", 3), ("single", 6)])
def test_conditions_are_factors_of_the_scene_and_more_lanes_than_a_block_has(precision, speeds):
    conditions = ({"static_friction": 1.0}, {"static_friction": 1.1}, {"static_friction": 1.0})
    scene = moving(0.2).with_values({"solver.precision": precision})
    sweep = Sweep("three", scene, tuple(0.2 + 0.05 * np.arange(speeds)), conditions)
    assert len(sweep.lanes) * len(conditions) > LANES[precision]
    strides = Curve(sweep, STRIDE).values(sweep.record({}, 0.01))
    assert strides.shape == (speeds, 3)
    assert np.array_equal(strides[:, 0], strides[:, 2])
    assert (strides[:, 0] != strides[:, 1]).all()


def test_a_symmetric_robot_makes_the_same_stride_backward():
    strides = [
        Curve(sweep, STRIDE).values(sweep.record({}, 0.01))
        for sweep in (
            Sweep("three", moving(0.2), (0.2, 0.3)),
            Sweep("back", moving(0.2), (0.2, 0.3), backward=True),
        )
    ]
    assert strides[0] == pytest.approx(strides[1], abs=2e-5)
    assert (strides[0] > 1e-3).all()


def test_strides_on_a_belt_are_those_of_a_pass():
    arrangement = {"kind": "belt", "pitch_m": 0.3, "count": 3}
    belt = moving(0.2).with_values({"drive.arrangement": arrangement})
    one, two = (
        Curve(sweep, STRIDE).values(sweep.record({}, 0.01))[0, 0]
        for sweep in (
            Sweep("one", belt, (0.2,), belt=Passes(0.3, 0, 1)),
            Sweep("two", belt, (0.2,), belt=Passes(0.3, 1, 2)),
        )
    )
    assert one > 1e-3
    assert two == pytest.approx(one, rel=0.1)


def test_strides_of_a_sweep_are_those_that_the_page_of_the_paper_measures():
    conditions = tuple({"static_friction": factor} for factor in FRICTIONS)
    curve_m = Curve(sweep := Sweep("three", moving(0.2), (0.2,), conditions), STRIDE)
    stride_m = curve_m.values(sweep.record({}, 0.01)).mean()
    measured = measured_strides([Walk(moving(0.2), 200.0)])
    assert stride_m == pytest.approx(1e-3 * measured.mean_mm.item(), abs=1e-4)
