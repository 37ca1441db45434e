"""Files of joint problems, and what is said of mistakes in them."""

from pathlib import Path

import pytest
from joint_problems import FAST, HELD, REPOSITORY, SPEEDS, entries, problem

from magworm_gym.identification import ProblemError, make_problem, read_problem
from magworm_gym.identification.paths import scene_numbers

JOINT = REPOSITORY / "studies/identification/paper-joint.toml"


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
