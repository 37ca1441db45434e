"""The study of speed: what is measured, and the table of it."""

import pytest

pytest.importorskip("jinja2")

from magworm_gym import Scene
from studies.speed.rates import TASKS, WAYS, Rate, Way, measured
from studies.speed.study import rates_table


def test_ways_are_told_apart_in_words() -> None:
    assert Way("scalar", 1, 0.5).text() == "one lane, one core, 0.5 ms"
    assert Way("wide", None, 2.0, "single").text() == "sixteen lanes, single precision, all cores, 2 ms"
    assert len({way.text() for way in WAYS}) == len(WAYS)


@pytest.mark.parametrize("dimensions", TASKS)
def test_runs_are_timed_and_their_work_is_counted_by_the_step(dimensions: int) -> None:
    task, preset = TASKS[dimensions]
    found, work = measured(task, Scene.preset(preset), 2, control_steps=1)
    assert len(found) == 2 and min(found) > 0.0
    assert 1.0 <= work["factorisations"] <= work["trials"] + 1.0


def test_the_table_has_a_line_for_each_way() -> None:
    rates = [Rate(of, way, 2000.0, 1000.0, 30000.0, 1.25, 1.5) for way in WAYS for of in TASKS]
    lines = rates_table(rates).splitlines()[2:]
    cells = "2,000 (1,000 to 30,000) | 1.25, 1.50"
    assert lines == [f"| {way.text()} | {cells} | {cells} |" for way in WAYS]
