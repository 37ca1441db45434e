"""Cycles that are steered towards goals, and flights of robots that follow them."""

from typing import Any

import numpy as np
import pytest

from magworm_gym import MagWormVectorEnv, Scene
from magworm_gym.baselines import AIMS, FAMILIES, Cycle, Flight, Runner, Steered, fly
from magworm_gym.baselines.cycle import PARK
from magworm_gym.tasks import Reach, Task, Turn

HOLD = Cycle(np.array([0.04, 0.02]), np.array([[0.1, 0.2, 0.3, 0.4, 0.5], [-0.1, -0.2, -0.3, -0.4, -0.5]]))


def acted(task: Task, option: str, goals: Any, steps: int, cycle: Cycle = HOLD) -> np.ndarray:
    """Actions (T, N, 5) of a steered cycle towards goals, the robots held as they begin."""
    worms = MagWormVectorEnv(len(goals), "turn-3", task=task)
    observations, _ = worms.reset(seed=0, options={option: np.array(goals)})
    pilot = Steered([cycle])
    pilot.start(worms)
    return np.array([pilot.answer(observations) for _ in range(steps)])


def test_a_cycle_is_mirrored_to_the_side_of_the_goal_and_parks_at_it() -> None:
    left, right, there = np.moveaxis(acted(Turn(), "goal_deg", [45.0, -45.0, 0.5], 4), 1, 0)
    assert np.array_equal(left, HOLD.points[[0, 0, 1, 0]])
    assert np.array_equal(right, left * [1.0, -1.0, 1.0, 1.0, -1.0])
    assert np.array_equal(there, np.tile(PARK, (4, 1)))


def test_a_smooth_cycle_goes_over_linearly() -> None:
    cycle = Cycle(np.array([0.04, 0.04]), np.array([[0.0] * 5, [1.0] * 5]), smooth=True)
    (actions,) = np.moveaxis(acted(Turn(), "goal_deg", [90.0], 5, cycle), 1, 0)
    assert np.allclose(actions[:, 0], [0.0, 0.5, 1.0, 0.5, 0.0])


def test_a_cycle_towards_a_point_keeps_straight_where_it_is_ahead() -> None:
    goals = [[-0.05, 0.0], [-0.03, 0.03], [-0.03, -0.03]]
    ((ahead, left, right),) = acted(Reach(), "goal_m", goals, 1)
    assert ahead[[1, 4]].tolist() == [0.0, 0.0]
    assert np.array_equal(left, HOLD.points[0]) and np.array_equal(right[[1, 4]], -left[[1, 4]])


@pytest.mark.parametrize("name", list(FAMILIES))
def test_families_make_cycles_that_the_stage_can_follow(name: str) -> None:
    family, scene = FAMILIES[name], Scene.preset("turn-3")
    generator = np.random.default_rng(0)
    assert family.scene(scene).controlled
    for unit in generator.uniform(-1.0, 1.0, (20, family.size)):
        cycle = family.cycle(unit, scene.stage_limits or {})
        assert len(cycle.durations_s) == len(cycle.points) and (cycle.durations_s > 0.0).all()
        assert np.abs(cycle.points).max() <= 1.0


def test_a_flight_holds_what_was_left_and_counts_times_to_the_end() -> None:
    left = np.array([[30.0, -90.0], [10.0, -90.0], [2.0, -60.0], [5.0, -45.0]])
    flight = Flight(left, np.array([False, False]), 0.5, np.zeros(2))
    assert flight.time_until_s(3.0).tolist() == [1.0, 1.5]
    first, second = AIMS[Turn].score(flight)
    assert first == pytest.approx(
        np.mean([0, 20 / 30, 28 / 30, 25 / 30]) / 2 + np.mean([0, 20, 28, 25]) / 180
    )
    assert second == pytest.approx(np.mean([0, 0, 1, 1]) / 2 + np.mean([0, 0, 30, 45]) / 180)


def test_a_still_robot_reaches_nothing_and_is_not_lost() -> None:
    worms, parked = Runner(Scene.preset("turn-3"), 2, task=Turn()), Cycle(np.array([1.0]), PARK[None])
    flight = fly(worms, Steered([parked]), np.array([30.0, -90.0]), [0, 1], 0.3)
    assert flight.left.shape == (16, 2) and not flight.lost.any()
    assert np.allclose(np.abs(flight.left[-1]), [30.0, 90.0], atol=1.0)


def test_where_the_goal_is_at_the_robot_a_flight_ends_and_is_not_lost() -> None:
    worms, parked = Runner(Scene.preset("turn-3"), 2, task=Reach()), Cycle(np.array([1.0]), PARK[None])
    flight = fly(worms, Steered([parked]), np.array([[-0.002, 0.0], [-0.003, 0.001]]), [0, 1], 0.3)
    assert not worms.going.any() and not flight.lost.any()
    assert flight.left.shape == (16, 2) and np.all(flight.left[1:] == flight.left[1])
