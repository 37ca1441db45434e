"""The study of error against run time: its arithmetic, its data and its page."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from studies.error.case import Axis, Outcome
from studies.error.cases import CASES, crawl, incline
from studies.error.errors import errors, figure_error, pose_error_mm
from studies.error.front import pareto, size
from studies.error.held import age_ms, held
from studies.error.magnets import magnets
from studies.error.measured import Row, measure, read, write
from studies.error.page import page, percent
from studies.error.settings import Settings
from studies.error.work import Work


def row(error: float, wall_s: float, uncertainty: float = 0.0) -> Row:
    return Row(
        "crawl", "front", Settings(2.0), "stride", error, uncertainty, abs(error), Work(wall_s, 500, 1, 1, 1)
    )


def test_figures_are_compared_run_by_run() -> None:
    found = figure_error(np.array([1.1, 2.0, 3.0]), np.array([1.0, 2.0, 3.0]))
    assert found.mean == pytest.approx(0.1 / 3 / 2)
    assert found.uncertainty == pytest.approx(0.05 / 3)
    assert found.median == 0.0


def test_poses_are_compared_point_by_point() -> None:
    tracks = np.zeros((2, 3, 1, 2))
    moved = tracks + np.array([0.003, 0.004])
    assert pose_error_mm(moved, tracks) == pytest.approx(5.0)
    assert pose_error_mm(None, tracks) is None


def test_exact_figures_stand_in_for_those_of_the_reference() -> None:
    outcome = Outcome({"way": np.array([2.0])}, None)
    found = errors(outcome, outcome, {"way": 4.0})
    assert found is not None
    assert found.figures["way"].mean == -0.5


def test_what_broke_has_no_error() -> None:
    assert errors(Outcome({}, None, "broke"), Outcome({}, None), {}) is None


def test_the_front_has_no_row_that_another_beats() -> None:
    cheap, good, bad = row(0.1, 1.0), row(0.01, 2.0), row(0.05, 3.0)
    assert pareto([bad, good, cheap]) == [cheap, good]


def test_an_error_is_no_smaller_than_what_scatter_leaves_open() -> None:
    assert size(row(1e-6, 1.0, uncertainty=1e-3)) == 1e-3


def test_percentages_show_what_they_leave_open() -> None:
    assert percent(0.0123, 0.001) == "+1.23 ± 0.10 %"
    assert percent(-0.0123, 0.0) == "-1.23 %"


def test_rows_survive_a_file(tmp_path: Path) -> None:
    rows = [row(0.125, 0.5), replace(row(-0.25, 1.0), part="check", work=None)]
    write(rows, tmp_path / "errors.csv")
    assert read(tmp_path / "errors.csv") == rows


def test_longer_steps_slide_too_far_by_half_a_step() -> None:
    """v grows by a Δt a step, so the way is ½ a t² + ½ a t Δt."""
    case = replace(incline(), front=[], axes=[])
    outcome = case.run(Settings(10.0, 8))
    found = errors(outcome, outcome, case.exact)
    assert found is not None
    assert found.figures["way"].mean == pytest.approx(0.010, rel=0.05)


def test_a_case_becomes_a_page() -> None:
    case = replace(incline(), front=[Settings(10.0, 8), Settings(5.0, 8)], axes=incline().axes[:1])
    text = page([case], measure(case, 1), {}, [], [])
    assert case.title in text
    assert "On the front, by the error of the way" in text
    assert "Newmark, 5 ms, 8 elements" in text


def test_a_rod_with_magnets_is_run_with_the_wrench_of_its_settings() -> None:
    case = magnets()
    cuboids, dipoles = (case.run(Settings(4.0, 18, order)) for order in (2, 0))
    found = errors(dipoles, cuboids, {})
    assert found is not None
    assert abs(found.figures["height"].mean) > 0.05


def test_every_case_has_settings_that_differ() -> None:
    for case in CASES.values():
        assert len(case.all_settings()) > 5
        assert case.reference != case.check


def test_settings_say_how_long_a_wrench_acts() -> None:
    settings = Settings(2.0, interval=5)
    assert settings.changes("worm")["solver.wrench_interval"] == 5
    assert settings.text() == "Newmark, 2 ms, 4 elements, order 2, a wrench for 5 steps"
    assert "wrench for" not in Settings(2.0).text()


def test_held_wrenches_are_older_and_fewer() -> None:
    axis = Axis("interval", [Settings(2.0, interval=steps) for steps in (1, 5)], Settings(2.0), costs=True)
    step = Axis("step", [Settings(2.0)], Settings(1.0))
    one = replace(crawl(), scenes=crawl().scenes[16:18], axes=[step, axis], front=[Settings(5.0)])
    rows = measure(replace(one, reference=Settings(2.0), check=Settings(5.0)), 1)
    along = [row for row in rows if (row.part, row.figure) == ("axis interval", "pose")]
    steps, of_drive, of_body = 500, 3, 4  # one pair lies evenly about the middle and counts twice
    expected = [steps * (of_drive / interval + of_body) for interval in (1, 5)]
    assert [row.work.wrenches for row in along if row.work] == expected
    assert along[0].error == 0.0 < along[1].error
    assert age_ms(along[1].settings) == 4.0
    said = held([one], rows)
    assert f"moves the pose by {along[1].error / 4.0:.3f} to" in said
    assert "by the stride 0 of 1 settings" in said
    assert "Newmark, 2 ms, 4 elements, order 2, a wrench for 5 steps" in page([one], rows, {}, [], [])
