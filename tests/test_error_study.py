"""The study of error against run time: its arithmetic, its data and its page."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("jinja2")

from studies.error.case import Axis, Outcome
from studies.error.cases import CASES, CRAWL, INCLINE, MAGNETS
from studies.error.errors import BROKEN, Error, errors, figure_error, pose_error
from studies.error.rows import Row, measure, pareto
from studies.error.settings import Settings
from studies.error.study import DATA, Found, keep, tabled, text
from studies.error.work import Work
from studies.kit.data import read_rows, write_rows


def row(mean: float, wall_s: float, uncertainty: float = 0.0) -> Row:
    error = Error("stride", mean, uncertainty, abs(mean))
    return Row("crawl", "front", Settings(2.0), error, Work(wall_s, 500, 1, 1, 1))


def test_figures_are_compared_run_by_run() -> None:
    found = figure_error("stride", np.array([1.1, 2.0, 3.0]), np.array([1.0, 2.0, 3.0]))
    assert found.mean == pytest.approx(0.1 / 3 / 2)
    assert found.uncertainty == pytest.approx(0.05 / 3)
    assert found.median == 0.0


def test_poses_are_compared_point_by_point() -> None:
    tracks = np.zeros((2, 3, 1, 2))
    moved = tracks + np.array([0.003, 0.004])
    assert pose_error(moved, tracks).mean == pytest.approx(5.0)
    followed, not_followed = Outcome({}, tracks), Outcome({}, None)
    assert errors(not_followed, followed, {}) == []


def test_exact_figures_stand_in_for_those_of_the_reference() -> None:
    outcome = Outcome({"way": np.array([2.0])}, None)
    (found,) = errors(outcome, outcome, {"way": 4.0})
    assert (found.figure, found.mean) == ("way", -0.5)


def test_what_broke_has_no_error() -> None:
    assert errors(Outcome({}, None, "broke"), Outcome({}, None), {}) == [BROKEN]
    broken = replace(row(0.0, 1.0), settings=Settings(5.0), error=BROKEN, work=None)
    assert "| Newmark, 5 ms, 4 elements, order 2 | broke down | – |" in tabled([row(0.1, 1.0), broken])


def test_the_front_has_no_row_that_another_beats() -> None:
    cheap, good, bad = row(0.1, 1.0), row(0.01, 2.0), row(0.05, 3.0)
    assert pareto([bad, good, cheap]) == [cheap, good]


def test_an_error_is_no_smaller_than_what_scatter_leaves_open() -> None:
    assert row(1e-6, 1.0, uncertainty=1e-3).error.size == 1e-3


def test_errors_say_what_they_leave_open() -> None:
    assert Error("stride", 0.0123, 0.001, 0.0).text() == "+1.23 ± 0.10 %"
    assert Error("stride", -0.0123, 0.0, 0.0).text() == "−1.23 %"
    assert Error("pose", 0.0123, 0.0, 0.0).text() == "0.012 mm"


def test_rows_survive_a_file(tmp_path: Path) -> None:
    rows = [row(0.125, 0.5), replace(row(-0.25, 1.0), part="check", work=None)]
    write_rows(tmp_path / "errors.csv", Row, rows)
    assert read_rows(tmp_path / "errors.csv", Row) == rows


def test_cases_that_are_not_run_again_keep_their_rows(tmp_path: Path) -> None:
    path = tmp_path / "errors.csv"
    old, new = row(0.5, 1.0), replace(row(0.25, 1.0), case="turn")
    write_rows(path, Row, [replace(old, case="gone"), old, replace(old, case="turn")])
    keep(path, Row, "case", ["turn", "crawl"], {"turn": [new]})
    assert read_rows(path, Row) == [new, old]


def test_longer_steps_slide_too_far_by_half_a_step() -> None:
    """v grows by a Δt a step, so the way is ½ a t² + ½ a t Δt."""
    case = replace(INCLINE, front=[], axes=[])
    outcome = case.run(Settings(10.0, 8))
    (found,) = errors(outcome, outcome, case.exact)
    assert found.mean == pytest.approx(0.010, rel=0.05)


def test_a_rod_with_magnets_is_run_with_the_wrench_of_its_settings() -> None:
    case = MAGNETS
    cuboids, dipoles = (case.run(Settings(4.0, 18, order)) for order in (2, 0))
    height, _ = errors(dipoles, cuboids, {})
    assert abs(height.mean) > 0.05


def test_every_case_has_settings_that_differ() -> None:
    for case in CASES.values():
        assert len(case.all_settings()) > 5
        assert case.reference != case.check


def test_the_data_hold_what_the_cases_run() -> None:
    rows = read_rows(DATA / "errors.csv", Row)
    for case in CASES.values():
        wanted = [(axis.name, settings) for axis in case.axes for settings in axis.values]
        wanted += [("check", case.check), *(("front", settings) for settings in case.front)]
        assert set(wanted) == {(row.part, row.settings) for row in rows if row.case == case.name}


def test_settings_say_how_long_a_wrench_acts() -> None:
    settings = Settings(2.0, interval=5)
    assert settings.changes("worm")["solver.wrench_interval"] == 5
    assert settings.text() == "Newmark, 2 ms, 4 elements, order 2, a wrench for 5 steps"
    assert "wrench for" not in Settings(2.0).text()
    assert settings.age_ms == 4.0


def test_held_wrenches_are_older_and_fewer() -> None:
    axis = Axis("interval", [Settings(2.0, interval=steps) for steps in (1, 5)], Settings(2.0), costs=True)
    step = Axis("step", [Settings(2.0)], Settings(1.0))
    one = replace(CRAWL, scenes=CRAWL.scenes[16:18], axes=[step, axis], front=[Settings(5.0)])
    rows = list(measure(replace(one, reference=Settings(2.0), check=Settings(5.0)), 1))
    along = [row for row in rows if (row.part, row.error.figure) == ("interval", "pose")]
    steps, of_drive, of_body = 500, 3, 4  # one pair lies evenly about the middle and counts twice
    expected = [steps * (of_drive / interval + of_body) for interval in (1, 5)]
    assert [row.work.wrenches for row in along if row.work] == expected
    assert along[0].error.mean == 0.0 < along[1].error.mean
    found = Found(one, rows)
    assert found.pose_per_ms == [along[1].error.mean / 4.0]
    assert found.held_on_front("stride") == "0 of 1 settings"
    said = text({**{name: Found(case, []) for name, case in CASES.items()}, "crawl": found})
    assert f"moves the pose by {along[1].error.mean / 4.0:.3f} to" in said
    assert "Newmark, 2 ms, 4 elements, order 2, a wrench for 5 steps" in said
    assert "On the front, by the error of the stride" in said
