"""The study of validation: what is said of cases that are missing or fail. Nothing is simulated."""

import pytest

pytest.importorskip("matplotlib")

from msgspec.structs import replace

from studies.validation.cases import Row, read_cases, read_sections
from studies.validation.page import validation_page
from studies.validation.study import complaints_of

SECTIONS = read_sections()


def row(**values):
    whole = {
        "quantity": "tip",
        "unit": "m",
        "measured": [1.0],
        "expected": [],
        "quantiles": [],
        "error_unit": "",
    }
    return Row(**{**whole, "low": 0.0, "high": 2.0, "within": True, **values})


def test_a_missing_case_is_on_the_page_and_a_complaint():
    cases = read_cases()
    del cases["pass"]
    assert "| pass | the paper's figures, fitted | **missing** | | | |" in validation_page(cases, SECTIONS)
    assert complaints_of(cases, SECTIONS) == ["pass is missing, its test did not come to its end"]


def test_a_number_outside_of_its_band_is_named():
    cases = read_cases()
    first, *rest = cases["free_fall"].rows
    cases["free_fall"] = replace(cases["free_fall"], rows=[replace(first, within=False), *rest])
    text = validation_page(cases, SECTIONS)
    assert text.count("**outside of") == 1 and text.count(") **outside** |") == 1
    assert complaints_of(cases, SECTIONS) == [f"free_fall: {first.quantity} is outside of its band"]


def test_a_case_that_the_page_leaves_out_is_a_complaint():
    cases = read_cases()
    cases["new"] = replace(cases["pass"], name="new")
    assert complaints_of(cases, SECTIONS) == ["new is not in studies/validation/contents.toml"]


@pytest.mark.parametrize(
    ("of", "share"),
    [
        (row(), 0.0),
        (row(measured=[1.5]), 0.5),
        (row(error=-0.5, high=2.0), 0.25),
        (row(low=-float("inf"), measured=[0.5]), 0.25),
        (row(low=1.0, high=1.0), 0.0),
        (row(low=1.0, high=1.0, measured=[2.0]), float("inf")),
    ],
)
def test_the_share_of_a_band_that_is_used_up(of, share):
    assert of.share == share
