"""Claims about curves: what they ask, what they cost, when they are met."""

from dataclasses import replace

import numpy as np
import pytest
from joint_problems import REPOSITORY, curve, of, paths

from magworm_gym.identification.claim_kinds import KINDS
from magworm_gym.identification.claims import ClaimTable, claim


def made_claim(kind, *curves, other=None, amount=0.0, within=1e-12, low=0.2, high=0.4):
    rows = tuple((each,) for each in curves)
    entries = {KINDS[kind].amount: amount, **({"than": "b.stride_m"} if other else {})}
    entries |= {"within": within} if KINDS[kind].exact else {}
    table = ClaimTable("it", kind, 1e-4, curve="a.stride_m", over_m_s=(low, high), **entries)
    return claim(table, rows, (other,) if other else ())


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
    made = made_claim(kind, curve("a"), other=curve("b") if other else None, amount=amount)
    outcome = made.outcome(recordings)
    assert outcome.model == pytest.approx(model, rel=1e-3)
    assert np.linalg.norm(made.residuals(recordings)) == pytest.approx(lacking, rel=0.02, abs=1e-9)
    assert outcome.met is (lacking == 0.0)


def test_a_value_is_met_within_its_band_and_still_pulls():
    made = made_claim("value", curve("a", speeds=(0.2,)), amount=4e-3, within=3e-4)
    outcome = made.outcome(of(paths(4.2e-3), "a"))
    assert outcome.met and outcome.loss == pytest.approx(4.0, rel=0.01)
    assert not made.outcome(of(paths(4.4e-3), "a")).met


def test_nearly_equal_curves_differ_by_a_part_of_the_shortest():
    made = made_claim("nearly_equal", curve("a"), curve("b"), amount=0.25)
    recordings = {**of(paths(4e-3, 4e-3, 4e-3), "a"), **of(paths(5e-3, 4e-3, 4.4e-3), "b")}
    assert made.outcome(recordings).model == pytest.approx(0.25)
    assert made.outcome(recordings).met
    recordings.update(of(paths(5.2e-3, 4e-3, 4.4e-3), "b"))
    assert np.linalg.norm(made.residuals(recordings)) == pytest.approx(2.0 / 3.0**0.5, rel=0.01)


def test_a_curve_peaks_within_a_range_and_keeps_steady():
    peaks = made_claim("peaks", curve("a"), low=0.25, high=0.35)
    assert peaks.outcome(of(paths(1e-3, 2e-3, 1e-3), "a")).met
    outcome = peaks.outcome(of(paths(1e-3, 2e-3, 2.3e-3), "a"))
    assert outcome.model == 0.4 and outcome.error_tolerances == pytest.approx(-3.0)
    steady = made_claim("steady", curve("a", conditions=2), amount=1e-4)
    outcome = steady.outcome(of(paths([1e-3, 1.1e-3], [2e-3, 2e-3], [3e-3, 3.6e-3]), "a"))
    assert outcome.model == pytest.approx(3e-4) and outcome.error_tolerances == pytest.approx(-2.0)


def test_the_mean_of_two_curves_is_over_conditions_too():
    both = replace(made_claim("at_least"), curves=((curve("a", 2), curve("b", 2)),))
    recordings = {**of(paths([1.0, 3.0], [0.0, 0.0], [1.0, 1.0]), "a"), **of(paths(*[[4.0, 4.0]] * 3), "b")}
    assert both.means(recordings) == pytest.approx(np.array([[3.0, 2.0, 2.5]]))


def test_curves_are_cut_to_a_range_with_both_ends():
    cut = replace(curve("a"), low_m_s=0.3, high_m_s=0.4)
    assert cut.speeds_m_s == (0.3, 0.4)
    assert cut.values(of(paths(1e-3, 2e-3, 3e-3), "a")).tolist() == [[2e-3], [3e-3]]


def test_every_kind_of_claim_is_documented():
    documented = (REPOSITORY / "docs/identify.md").read_text(encoding="utf-8")
    assert all(f"| `{kind}` |" in documented for kind in KINDS)
