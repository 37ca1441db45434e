"""Shares of the phases of a step, and the guard of committed instruction counts."""

import numpy as np
import pytest

from magworm_gym import Scene, magnet
from studies.needs.counts import compare
from studies.needs.reach import shares_beyond
from studies.needs.wrenches import pair_of


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
    pair = pair_of(Scene.preset("paper-3"))
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
