"""Fitting many robots that share parameters to claims about their curves."""

import numpy as np
import pytest
from joint_problems import FAST, HELD, ROBOT, SPEEDS, problem, value

from magworm_gym.identification import identify, write_results
from magworm_gym.identification.claims import Curve
from magworm_gym.identification.evaluation import BROKEN, Evaluator
from magworm_gym.identification.quantities import Quantity


def test_parameters_that_robots_share_are_recovered_from_their_curves():
    truth = {"material.youngs_modulus_pa": 65e3, "ground.static_friction": 0.9}
    blank = problem([FAST])
    claims = []
    for sweep in blank.sweeps:
        seen = sweep.record(truth, blank.sample_s)
        for name in ("stride_m", "peak_m.1"):
            kind, *magnet = name.split(".")
            measured = Curve(sweep, Quantity(kind, int(magnet[0]) if magnet else None)).values(seen)
            pairs = zip(sweep.speeds_m_s, measured[:, 0].tolist(), strict=True)
            claims += [
                value(f"{sweep.name}.{name}", at, number, within=5e-5, scale=2e-5) for at, number in pairs
            ]
    settings = {"restarts": 4, "population": 8, "generations": 20, "halve_after": [4, 8], "scatter": 48}
    found = identify(problem(claims, search={**settings, "rounds": 2}))
    assert found.values == pytest.approx(truth, rel=0.02)
    assert all(outcome.met for outcome in found.outcomes)
    assert [each.ended for each in found.evolutions].count("dropped: others fitted better") == 3


def test_losses_are_exact_up_to_their_bound_and_beyond_it_otherwise():
    made = problem([FAST, value("four.stride_m", 0.4, 3e-3)])
    units = np.random.default_rng(0).random((6, 2))
    evaluator = Evaluator(made)
    exact = evaluator.losses_and_shares(units, np.full(6, np.inf))[0]
    assert exact.max() < BROKEN
    bound = float(np.median(exact))
    raced = evaluator.losses_and_shares(units, np.full(6, bound))[0]
    assert np.array_equal(raced[exact <= bound], exact[exact <= bound])
    assert (raced[exact > bound] > bound).all() and (raced <= exact).all()
    assert (raced < exact).any(), "somebody was stopped before the second robot"


def test_what_is_held_out_is_reported_and_changes_nothing():
    with_it, without = problem([FAST, HELD]), problem([FAST])
    units = np.random.default_rng(1).random((3, 2))
    bounds = np.full(3, np.inf)
    assert np.array_equal(
        Evaluator(with_it).losses_and_shares(units, bounds)[0],
        Evaluator(without).losses_and_shares(units, bounds)[0],
    )
    assert with_it.measurements == without.measurements == 1
    assert with_it.simulated_s == without.simulated_s
    outcomes = Evaluator(with_it).outcomes(units[0])
    assert [outcome.fitted for outcome in outcomes] == [True, False]


def test_a_group_of_claims_is_left_out_and_then_judged(tmp_path):
    fitted = {**HELD, "fit": True}
    left_out = problem([FAST, fitted], without=["four"])
    assert [aim.fitted for aim in left_out.aims] == [True, False]
    found = identify(left_out)
    write_results(found, tmp_path)
    report = (tmp_path / "report.md").read_text()
    assert "of 1 held out" in report
    assert "Never part of the loss." in report and "## Profiles" in report


def test_a_held_out_robot_that_cannot_be_simulated_says_so():
    floor = {"name": "four", "values": {"ground.dynamic_friction": 0.61}, "speeds_m_s": [0.3]}
    made = problem([FAST, HELD], sweep=[{"name": "three", "speeds_m_s": list(SPEEDS)}, floor])
    outcome = Evaluator(made).outcomes(np.array([0.5, 0.0]))[1]
    assert not outcome.met and "dynamic_friction" in outcome.remark


def interrupted_at(stage, done):
    def progress(now, count, most, best):
        if (now, count) == (stage, done):
            raise KeyboardInterrupt

    return progress


def test_a_race_that_was_stopped_goes_on_to_the_identical_result(tmp_path):
    def made():
        return problem([FAST, value("four.stride_m", 0.4, 3e-3)])

    whole, parts = tmp_path / "whole", tmp_path / "parts"
    expected = identify(made(), whole, threads=2)
    for stage, done in (("search", 1), ("search", 4), ("explore", 1)):
        with pytest.raises(KeyboardInterrupt):
            identify(made(), parts, resume=parts.exists(), progress=interrupted_at(stage, done))
    resumed = identify(made(), parts, resume=True, threads=1)
    write_results(expected, whole)
    write_results(resumed, parts)
    for name in ("scene.toml", "report.md", "report.json"):
        assert (whole / name).read_text() == (parts / name).read_text()


def test_a_blind_search_does_not_depend_on_known_robots_nor_on_the_scene():
    start = [{"values": {"material.youngs_modulus_pa": 55e3}}]
    softer = {**ROBOT, "material.youngs_modulus_pa": 41e3}
    blind = {"restarts": 2, "population": 6, "generations": 2, "scatter": 8, "rounds": 1, "blind": True}
    one, other = (
        identify(problem([FAST], search=blind, start=starts, values=values))
        for starts, values in (([], ROBOT), (start, softer))
    )
    assert one.values == other.values and one.candidates == other.candidates
    seeing = identify(problem([FAST], search={**blind, "blind": False}, start=start))
    assert seeing.candidates == one.candidates + 2
