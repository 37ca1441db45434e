"""The search among robots: evolutions, profiles, ensembles, what a missed target would cost."""

from dataclasses import replace

import numpy as np
import pytest
from joint_problems import FAST, problem, value

from magworm_gym.identification import identify, write_results
from magworm_gym.identification.alternatives import alternatives
from magworm_gym.identification.ensemble import alike, coverage, farthest_first
from magworm_gym.identification.evaluation import Evaluator
from magworm_gym.identification.profiles import profiles
from magworm_gym.identification.search import search
from magworm_gym.identification.settings import SearchSettings


def test_evolutions_are_halved_and_begin_at_known_robots():
    def losses(units, bounds):
        return np.square(units - 0.7).sum(axis=1)

    settings = SearchSettings(restarts=4, population=6, generations=30, halve_after=(3, 6), scatter=8)
    start = np.full((1, 3), 0.69)
    told = []
    found = search(losses, lambda loss: 1.3 * loss, start, settings, lambda *stage: told.append(stage[0]))
    assert told[0] == "scatter" and told[1] == "search"
    assert [each.generations for each in found[2:]] == [3, 3]
    assert found[1].generations == 6 and found[0].generations > 6
    assert found[0].loss < 1e-3


def test_the_best_of_an_evolution_is_never_a_loss_that_is_less_than_exact():
    exact = {}

    def losses(units, bounds):
        whole = 10.0 * np.square(units - 0.7).sum(axis=1)
        exact.update(zip(map(tuple, units), whole, strict=True))
        return np.where(whole > bounds, np.minimum(whole, np.nextafter(bounds, np.inf)), whole)

    settings = SearchSettings(restarts=3, population=6, generations=12, scatter=40)
    for each in search(losses, lambda loss: loss, np.empty((0, 4)), settings):
        assert exact[tuple(each.best)] == each.loss <= each.parents


def test_profiles_hold_the_least_loss_of_each_slice():
    units = np.array([[0.05, 0.95], [0.07, 1.0], [0.55, 0.0]])
    least = profiles(units, np.array([3.0, 2.0, 1.0]))
    assert least[0, 0] == 2.0 and least[0, 5] == 1.0 and least[1, 9] == 2.0 and least[1, 0] == 1.0
    assert np.isinf(least[0, 1])


def test_robots_of_an_ensemble_are_as_unlike_as_those_before_allow():
    pools = [np.array([[0.0, 0.0]]), np.array([[0.1, 0.0], [1.0, 0.0], [0.5, 0.0]]), np.array([[0.9, 0.0]])]
    asked = []

    def accept(number, place):
        asked.append((number, place))
        return number < 2 and (number, place) != (1, 1)

    assert farthest_first(pools, np.ones(2), accept, tries=3) == [0, 2, None]
    assert asked == [(0, 0), (1, 1), (1, 2), (2, 0)]
    robots = np.array([[0.0, 0.0], [0.05, 1.0], [1.0, 0.5]])
    assert coverage(robots, np.zeros(2), np.full(2, 2.0)) == pytest.approx([0.5, 0.5])
    assert alike(robots, np.full(2, 0.1), 2) == [(0, 1)]


def test_the_best_candidate_that_meets_a_target_is_found():
    units = np.random.default_rng(3).random((24, 2))
    blank = problem([FAST, value("four.stride_m", 0.4, 0.0)])
    reached = Evaluator(blank).outcomes(units[7])[1].model
    made = problem([FAST, value("four.stride_m", 0.4, reached)])
    evaluator = Evaluator(made)
    losses, shares = evaluator.losses_and_shares(units, np.full(24, np.inf))
    assert shares.sum(axis=1) == pytest.approx(losses)
    worst = int(np.nanargmax(np.where(shares[:, 1] <= made.fitted[1].allowance, losses, np.nan)))
    outcomes = [
        replace(each, met=each.name != made.fitted[1].name) for each in evaluator.outcomes(units[worst])
    ]
    (found,) = alternatives(evaluator, outcomes, units, losses, shares)
    meeting = losses[shares[:, 1] <= made.fitted[1].allowance]
    assert found.target == made.fitted[1].name
    assert found.loss == pytest.approx(meeting.min())
    assert found.target not in found.missed


def test_what_a_target_that_is_not_met_would_cost_is_said(tmp_path):
    far = value("three.stride_m", 0.4, 9e-3)
    least = {"name": "some", "kind": "at_least", "curve": "three.stride_m", "over_m_s": [0.2, 0.4]}
    low, high = {**least, "value": 1e-3, "scale": 1e-4}, {**least, "name": "much", "value": 1.0, "scale": 1.0}
    found = identify(problem([far, low, high]))
    told = {each.target: each for each in found.alternatives}
    assert far["name"] in told and "much" in told
    assert told["much"].values is None
    write_results(found, tmp_path)
    assert "none of " in (tmp_path / "report.md").read_text()
    for alternative in told.values():
        if alternative.values is not None:
            assert alternative.loss >= found.loss
            again = Evaluator(found.problem).outcomes(found.problem.space.unit_of(alternative.values))
            assert [each.name for each in again if not each.met] == list(alternative.missed)
