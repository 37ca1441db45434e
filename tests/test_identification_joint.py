"""Fitting many robots that share parameters to claims about their curves."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent.parent))

from magworm_gym import Recording, Scene, record_scenes
from magworm_gym.identification import ProblemError, identify, make_problem, read_problem, write_results
from magworm_gym.identification.alternatives import alternatives
from magworm_gym.identification.claims import KINDS, Claim, Curve, curve_of
from magworm_gym.identification.ensemble import alike, coverage, farthest_first
from magworm_gym.identification.evaluation import BROKEN, Evaluator
from magworm_gym.identification.problem import scene_numbers
from magworm_gym.identification.profiles import profiles
from magworm_gym.identification.quantities import Quantity
from magworm_gym.identification.search import search
from magworm_gym.identification.settings import SearchSettings
from magworm_gym.identification.sweep import LANES, Passes, Sweep
from studies.paper.passes import FRICTIONS, Walk, measured_strides

REPOSITORY = Path(__file__).parent.parent
JOINT = REPOSITORY / "studies/identification/paper-joint.toml"
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
    return curve_of(sweep, STRIDE)


# Sweeps


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


def test_conditions_are_factors_of_the_scene_and_more_lanes_than_a_block_has():
    conditions = ({"static_friction": 1.0}, {"static_friction": 1.1}, {"static_friction": 1.0})
    sweep = Sweep("three", moving(0.2), (0.2, 0.3, 0.4), conditions)
    assert len(sweep.lanes) * len(conditions) > LANES
    strides = curve_of(sweep, STRIDE).values(sweep.record({}, 0.01))
    assert strides.shape == (3, 3)
    assert np.array_equal(strides[:, 0], strides[:, 2])
    assert (strides[:, 0] != strides[:, 1]).all()


def test_a_symmetric_robot_makes_the_same_stride_backward():
    strides = [
        curve_of(sweep, STRIDE).values(sweep.record({}, 0.01))
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
        curve_of(sweep, STRIDE).values(sweep.record({}, 0.01))[0, 0]
        for sweep in (
            Sweep("one", belt, (0.2,), belt=Passes(0.3, 0, 1)),
            Sweep("two", belt, (0.2,), belt=Passes(0.3, 1, 2)),
        )
    )
    assert one > 1e-3
    assert two == pytest.approx(one, rel=0.1)


def test_strides_of_a_sweep_are_those_that_the_page_of_the_paper_measures():
    conditions = tuple({"static_friction": factor} for factor in FRICTIONS)
    curve_m = curve_of(sweep := Sweep("three", moving(0.2), (0.2,), conditions), STRIDE)
    stride_m = curve_m.values(sweep.record({}, 0.01)).mean()
    (measured,) = measured_strides([Walk(moving(0.2), 0.2)])
    assert stride_m == pytest.approx(measured.mean_m, abs=1e-4)


# Claims


def claim(kind, *curves, other=None, amount=0.0, within=0.0, low=0.2, high=0.4):
    rows = tuple((each,) for each in curves)
    return Claim("it", kind, rows, (other,) if other else (), low, high, amount, within, scale=1e-4)


@pytest.mark.parametrize(
    ("kind", "amount", "strides", "other", "model", "lacking"),
    [
        ("value", 4e-3, [4e-3, 4e-3, 4.2e-3], None, 4.0667e-3, 2.0 / 3.0**0.5),
        ("longest", 4e-3, [1e-3, 4.3e-3, 2e-3], None, 4.3e-3, 3.0),
        ("at_least", 1e-3, [1e-3, 2e-3, 3e-3], None, 1e-3, 0.0),
        ("at_least", 1e-3, [0.7e-3, 2e-3, 3e-3], None, 0.7e-3, 3.0 / 3.0**0.5),
        ("at_most", 3e-3, [1e-3, 2e-3, 3.3e-3], None, 3.3e-3, 3.0 / 3.0**0.5),
        ("some_at_least", 3e-3, [1e-3, 2e-3, 2.9e-3], None, 2.9e-3, 1.0),
        ("rises", 1e-3, [1e-3, 0.0, 2e-3], None, 1e-3, 0.0),
        ("rises", 1e-3, [1e-3, 5e-3, 1.8e-3], None, 0.8e-3, 2.0),
        ("falls", 1e-3, [2e-3, 5e-3, 1.2e-3], None, -0.8e-3, 2.0),
        ("greater", 1e-4, [2e-3, 2e-3, 2e-3], [1e-3, 1e-3, 2.1e-3], -1e-4, 2.0 / 3.0**0.5),
        ("differs", 1e-3, [2e-3, 2e-3, 2e-3], [3e-3, 1e-3, 2e-3], 2e-3 / 3.0, 10.0 / 3.0),
    ],
)
def test_a_claim_costs_what_it_lacks_in_units_of_its_scale(kind, amount, strides, other, model, lacking):
    recordings = {**of(paths(*strides), "a"), **of(paths(*(other or strides)), "b")}
    made = claim(kind, curve("a"), other=curve("b") if other else None, amount=amount)
    outcome = made.outcome(recordings)
    assert outcome.model == pytest.approx(model, rel=1e-3)
    assert np.linalg.norm(made.residuals(recordings)) == pytest.approx(lacking, rel=0.02, abs=1e-9)
    assert outcome.met is (lacking == 0.0)


def test_a_value_is_met_within_its_band_and_still_pulls():
    made = claim("value", curve("a", speeds=(0.2,)), amount=4e-3, within=3e-4)
    outcome = made.outcome(of(paths(4.2e-3), "a"))
    assert outcome.met and outcome.loss == pytest.approx(4.0, rel=0.01)
    assert not made.outcome(of(paths(4.4e-3), "a")).met


def test_nearly_equal_curves_differ_by_a_part_of_the_shortest():
    made = claim("nearly_equal", curve("a"), curve("b"), amount=0.25)
    recordings = {**of(paths(4e-3, 4e-3, 4e-3), "a"), **of(paths(5e-3, 4e-3, 4.4e-3), "b")}
    assert made.outcome(recordings).model == pytest.approx(0.25)
    assert made.outcome(recordings).met
    recordings.update(of(paths(5.2e-3, 4e-3, 4.4e-3), "b"))
    assert np.linalg.norm(made.residuals(recordings)) == pytest.approx(2.0 / 3.0**0.5, rel=0.01)


def test_a_curve_peaks_within_a_range_and_keeps_steady():
    peaks = claim("peaks", curve("a"), low=0.25, high=0.35)
    assert peaks.outcome(of(paths(1e-3, 2e-3, 1e-3), "a")).met
    outcome = peaks.outcome(of(paths(1e-3, 2e-3, 2.3e-3), "a"))
    assert outcome.model == 0.4 and outcome.error_tolerances == pytest.approx(-3.0)
    steady = claim("steady", curve("a", conditions=2), amount=1e-4)
    outcome = steady.outcome(of(paths([1e-3, 1.1e-3], [2e-3, 2e-3], [3e-3, 3.6e-3]), "a"))
    assert outcome.model == pytest.approx(3e-4) and outcome.error_tolerances == pytest.approx(-2.0)


def test_the_mean_of_two_curves_is_over_conditions_too():
    both = Claim("it", "at_least", ((curve("a", 2), curve("b", 2)),), (), 0.2, 0.4, 0.0, 0.0, 1e-4)
    recordings = {**of(paths([1.0, 3.0], [0.0, 0.0], [1.0, 1.0]), "a"), **of(paths(*[[4.0, 4.0]] * 3), "b")}
    assert both.means(recordings) == pytest.approx(np.array([[3.0, 2.0, 2.5]]))


def test_every_kind_of_claim_is_documented():
    documented = (REPOSITORY / "docs/identify.md").read_text(encoding="utf-8")
    assert all(f"| `{kind}` |" in documented for kind in KINDS)


# Search


def test_parameters_that_robots_share_are_recovered_from_their_curves():
    truth = {"material.youngs_modulus_pa": 65e3, "ground.static_friction": 0.9}
    blank = problem([FAST])
    claims = []
    for sweep in blank.sweeps:
        seen = sweep.record(truth, blank.sample_s)
        for name in ("stride_m", "peak_m.1"):
            kind, *magnet = name.split(".")
            measured = curve_of(sweep, Quantity(kind, int(magnet[0]) if magnet else None)).values(seen)
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
    exact = evaluator.losses(units, np.full(6, np.inf))
    assert exact.max() < BROKEN
    bound = float(np.median(exact))
    raced = evaluator.losses(units, np.full(6, bound))
    assert np.array_equal(raced[exact <= bound], exact[exact <= bound])
    assert (raced[exact > bound] > bound).all() and (raced <= exact).all()
    assert (raced < exact).any(), "somebody was stopped before the second robot"


def test_what_is_held_out_is_reported_and_changes_nothing():
    with_it, without = problem([FAST, HELD]), problem([FAST])
    units = np.random.default_rng(1).random((3, 2))
    bounds = np.full(3, np.inf)
    assert np.array_equal(Evaluator(with_it).losses(units, bounds), Evaluator(without).losses(units, bounds))
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


def test_the_best_candidate_that_meets_a_target_is_found():
    units = np.random.default_rng(3).random((24, 2))
    blank = problem([FAST, value("four.stride_m", 0.4, 0.0)])
    reached = Evaluator(blank).outcomes(units[7])[1].model
    made = problem([FAST, value("four.stride_m", 0.4, reached)])
    evaluator = Evaluator(made)
    losses, shares = evaluator.judged(units, np.full(24, np.inf))
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


# Files


def test_the_joint_problem_fits_the_filmed_pass_and_curves_of_three_and_five_only():
    made = read_problem(JOINT)
    fitted = [aim for aim in made.aims if aim.fitted]
    assert {source for aim in fitted for source in aim.sources} == {"film", "three", "five"}
    assert made.simulated_s < sum(run.simulated_s for run in made.runs)
    fast = read_problem(JOINT, without=["three-fast"])
    assert fast.measurements == made.measurements - 1
    assert fast.fingerprint != made.fingerprint
    assert all(
        ((unit := made.space.unit_of(start)) >= 0.0).all() and (unit < 1.0).all() for start in made.starts
    )


def test_a_problem_adds_to_the_one_that_it_is_like(tmp_path):
    (tmp_path / "first.toml").write_text(
        f"""
        scene = "paper-3"
        [parameters]
        "material.youngs_modulus_pa" = {{ low = 4e4, high = 9e4 }}
        [search]
        seed = 3
        restarts = 2
        [[sweep]]
        name = "three"
        speeds_m_s = {list(SPEEDS)}
        [[claim]]
        name = "some"
        kind = "at_least"
        curve = "three.stride_m"
        over_m_s = [0.2, 0.4]
        value = 1e-3
        scale = 1e-4
        """
    )
    second = tmp_path / "second.toml"
    second.write_text(
        'like = "first.toml"\n[parameters]\n"material.damping_time_s" = { low = 0, high = 0.01 }\n'
        "[search]\nrestarts = 4\n"
    )
    made = read_problem(second, {"population": 8})
    assert [p.path for p in made.space.parameters] == [
        "material.youngs_modulus_pa",
        "material.damping_time_s",
    ]
    assert (made.settings.seed, made.settings.restarts, made.settings.population) == (3, 4, 8)
    second.write_text('like = "second.toml"\n')
    with pytest.raises(ProblemError, match=r"like is 'second.toml'; allowed: another problem file"):
        read_problem(second)


def test_values_and_settings_that_are_given_replace_those_of_the_file():
    finer = {"solver.step_s": 0.0005, "body.elements_per_bridge": 8}
    made = read_problem(JOINT, {"restarts": 3}, values=finer)
    assert made.settings.restarts == 3 and made.settings.population == read_problem(JOINT).settings.population
    for run in made.runs:
        assert scene_numbers(run.scene)["solver.step_s"] == 0.0005
        assert scene_numbers(run.scene)["body.elements_per_bridge"] == 8


SWEEP = {"name": "three", "speeds_m_s": list(SPEEDS)}


@pytest.mark.parametrize(
    ("sweep", "message"),
    [
        (
            {"speeds_m_s": [0.3, 0.2]},
            r"speeds_m_s is \[0.3, 0.2\]; allowed: a list of speeds from 0.001 to 10",
        ),
        ({"speeds_m_s": []}, r"speeds_m_s is \[\]; allowed: a list of speeds"),
        ({"name": "a.b"}, "name is 'a.b'; allowed: a name without a dot, slash or asterisk"),
        ({"factors": {"colour": 1.1}}, "factors is 'colour'; allowed: factors of stiffness"),
        ({"factors": {"mass": [1.0, 1.1], "damping": [1, 1, 2]}}, "mass has 2 factors; allowed: 1, or 3"),
        ({"factors": {"mass": "heavy"}}, r"factors.mass is \['heavy'\]; allowed: a factor or a list"),
        ({"factors": {"mass": -1.0}}, "factor of mass in environment 0 is -1"),
        ({"direction": "up"}, "direction is 'up'; allowed: forward, backward"),
        ({"robots": []}, r"robots is \[\]; allowed: a list of tables of values"),
        ({"robots": [{"body.magnets": 400}]}, r"sweep\[0\].values: body.magnets"),
        ({"belt": {"pitch_m": 0.1, "passes": 0}}, "belt.passes is 0; allowed: a whole number from 1"),
        ({"pitch": 1}, r"sweep\[0\].pitch is not a setting"),
    ],
)
def test_mistakes_in_a_sweep_are_said_in_a_sentence(sweep, message):
    with pytest.raises(ProblemError, match=message) as raised:
        problem([FAST], sweep=[{**SWEEP, **sweep}])
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"kind": "grows"}, "kind is 'grows'; allowed: value, longest, at_least"),
        ({"curve": "six.stride_m"}, "curve is 'six.stride_m'; allowed: sweep.quantity"),
        ({"curve": "three.stride_m.3"}, "curve is 'three.stride_m.3'; allowed: sweep.quantity"),
        ({"curve": 3}, "curve is 3; allowed: sweep.quantity, sweep.quantity.magnet, or a list"),
        ({"at_m_s": 0.25}, "three.stride_m has no speed in the range"),
        ({"kind": "greater", "than": "other.stride_m"}, "other.stride_m have other speeds in the range"),
        ({"scale": 0.0}, "scale is 0.0; allowed: a number from 1e-12"),
        ({"within": None}, "within is missing|within is None"),
        ({"fit": "no"}, "fit is 'no'; allowed: true or false"),
        ({"fit": False}, "nothing is fitted; allowed: at least one target"),
        ({"colour": 1}, r"claim\[0\].colour is not a setting"),
    ],
)
def test_mistakes_in_a_claim_are_said_in_a_sentence(change, message):
    other = {"name": "other", "speeds_m_s": [0.21, 0.39]}
    made = {**FAST, **change}
    if made["kind"] == "greater":
        made = {
            **{key: made[key] for key in ("name", "kind", "curve", "than", "scale")},
            "over_m_s": [0.2, 0.4],
        }
    with pytest.raises(ProblemError, match=message) as raised:
        problem([made], sweep=[SWEEP, other])
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"without": ["five"]}, r"without is \['five'\]; allowed: a list of groups of claims, of four"),
        ({"start": [{"values": {"material.youngs_modulus_pa": "soft"}}]}, "is 'soft'; allowed: a number"),
        ({"sweep": [SWEEP, SWEEP]}, "name is 'three'; allowed: a name that no other run has"),
        ({"search": {"halve_after": [5, 3]}}, r"halve_after is \[5, 3\]; allowed: a list of whole numbers"),
        ({"search": {"fits_within": 0.5}}, "fits_within is 0.5; allowed: a number from 1"),
        (
            {
                "claim": [
                    {
                        "name": "p",
                        "kind": "peaks",
                        "curve": "three.stride_m",
                        "over_m_s": [0, 1],
                        "scale": 1e-4,
                    }
                ]
            },
            "holds all or none of the speeds of three.stride_m",
        ),
    ],
)
def test_mistakes_in_a_joint_problem_are_said_in_a_sentence(more, message):
    with pytest.raises(ProblemError, match=message) as raised:
        make_problem({**entries([FAST, {**HELD, "fit": True}]), **more}, Path())
    assert "\n" not in str(raised.value)


def test_curves_are_cut_to_a_range_with_both_ends():
    cut = curve("a").within(0.3, 0.4)
    assert isinstance(cut, Curve)
    assert cut.speeds_m_s == (0.3, 0.4) and cut.lanes == (("a/1/0",), ("a/2/0",))
