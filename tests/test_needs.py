"""Shares of the phases of a step, and the guard of committed instruction counts."""

import numpy as np
import pytest

from magworm_gym import Scene, magnet
from studies.needs.counts import compare
from studies.needs.effects import EFFECTS, cost
from studies.needs.orders import OrderError, distance_of_order_1_m
from studies.needs.reach import Beyond, Reach, magnets, shares_beyond
from studies.needs.study import left_out


@pytest.mark.parametrize("preset", ["paper-3", "turn-3"])
def test_shares_sum_to_one_and_explain_shows_them(preset):
    scene = Scene.preset(preset)
    shares = scene.shares()
    assert sum(shares.values()) == pytest.approx(1.0)
    assert all(share > 0.0 for share in shares.values())
    assert {"magnets", "mutual magnets", "contact", "springs"} <= shares.keys()
    explained = scene.explain(measure=True)
    assert explained.startswith(scene.explain())
    assert all(f"\n{phase}" in explained for phase in shares)


def test_what_a_scene_lacks_has_no_share():
    lacks = {"drive": None, "ground": None, "gravity_m_s2": 0.0, "magnetic_terms.mutual": False}
    scene = Scene.preset("paper-3").with_values(lacks)
    assert scene.shares().keys() == {"kinematics", "inertia", "springs", "system", "commit"}


def test_counts_beyond_the_tolerance_are_named():
    expected = {"a": 100.0, "b": 100.0, "c": 100.0, "gone": 1.0}
    table, wrong = compare({"a": 104.0, "b": 106.0, "c": 94.0, "new": 1.0}, expected)
    assert wrong == ["b", "c", "new", "gone"]
    assert "+6.00%" in table


def test_the_bound_of_the_force_holds_at_every_pose():
    pair = magnets(Scene.preset("paper-3"))
    draws = np.random.default_rng(3)
    places, turns = draws.uniform(-0.12, 0.12, (2000, 3)), draws.normal(size=(2000, 4))
    nearest = np.linalg.norm(places, axis=-1) - pair.half_diagonals_m
    apart = nearest > 0.0
    force, _ = magnet.wrench(pair.drive_m, pair.body_m, places[apart], turns[apart])
    bounds = np.array([pair.force_bound_n(distance) for distance in nearest[apart]])
    assert (np.linalg.norm(force, axis=-1) < bounds).all()
    # The bound is not idle: far away it is within a factor of ten for some pose.
    assert (np.linalg.norm(force, axis=-1) > 0.1 * bounds).any()


def test_a_block_is_out_of_reach_only_where_all_its_lanes_are():
    distances = np.full((1, 16, 1, 1), 2.0)
    distances[0, 3] = 0.5
    assert shares_beyond(distances, 1.0) == (15 / 16, 1 / 2)


def test_what_an_effect_leaves_behind_is_beside_its_own_phases():
    drive = next(effect for effect in EFFECTS if effect.with_it == "drive")
    phases = {"drive-plane": {"magnets": 30.0, "drive": 8.0, "springs": 60.0}}
    found = cost(drive, "plane", {"bare-plane": 100.0, "drive-plane": 140.0}, phases)
    assert (found.without, found.with_it, found.rest) == (100.0, 140.0, pytest.approx(0.02))
    damping = next(effect for effect in EFFECTS if effect.with_it == "damping")
    assert cost(damping, "plane", {"bare-plane": 100.0, "damping-plane": 100.0}, phases).rest is None


def test_order_1_reaches_the_error_of_order_2_further_away():
    errors = [
        OrderError(2, height, height**-4.0, (2.0 * height) ** -4.0, 0.0, 0.0) for height in (0.022, 0.03)
    ]
    near = OrderError(2, 0.012, 1e9, 1e9, 0.0, 0.0)
    assert distance_of_order_1_m([near, *errors]) == pytest.approx(0.044)


def test_scenes_are_named_where_enough_is_out_of_reach():
    reaches = [Reach("near", 1, 0.0, 1.0, [Beyond(1e-3, 2.0, 0.04, 0.04)], 1.0, 0.0)]
    assert left_out(reaches, 1e-3, 0.0) == ["`near`"]
    assert left_out(reaches, 1e-3, 0.05) == left_out(reaches, 1e-4, 0.0) == []
