"""What studies share: data that are written and read back, words, fingerprints of figures."""

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import msgspec
import numpy as np
import pytest
from numpy.typing import NDArray

pytest.importorskip("matplotlib")

from jinja2 import UndefinedError

from magworm_gym import Recording
from studies.kit.data import read_json, read_rows, write_json, write_rows
from studies.kit.figures import fingerprint, kept_fingerprint, panels, save
from studies.kit.page import page, table
from studies.kit.passes import unbroken
from studies.kit.timing import timed
from studies.kit.words import exponent, listed, number, ranking, short, signed, trend


@dataclass(frozen=True)
class Setting:
    step_ms: float
    scheme: str


@dataclass(frozen=True)
class Cost:
    wall_s: float


@dataclass(frozen=True)
class Row:
    of: Setting
    error: float
    broken: int
    note: str | None
    cost: Cost | None = None


class Spread(NamedTuple):
    mean: float
    low: float


@dataclass(frozen=True)
class Told:
    place: Literal["plane", "space"]
    spread: Spread
    rolls: tuple[float, ...]


@dataclass(frozen=True)
class Found:
    places: NDArray[np.float64]
    best: float
    names: tuple[str, ...]


def test_rows_come_back_as_they_were_written(tmp_path):
    rows = [
        Row(Setting(0.5, "newmark"), 1.25, 0, None, Cost(2.0)),
        Row(Setting(2.0, "euler"), -1e-9, 3, "why, and when"),
    ]
    write_rows(tmp_path / "rows.csv", Row, rows)
    assert (tmp_path / "rows.csv").read_text().splitlines() == [
        "step_ms,scheme,error,broken,note,wall_s",
        "0.5,newmark,1.25,0,,2",
        '2,euler,-1e-09,3,"why, and when",',
    ]
    assert read_rows(tmp_path / "rows.csv", Row) == rows


def test_what_is_no_number_is_an_empty_cell(tmp_path):
    write_rows(tmp_path / "rows.csv", Cost, [Cost(math.nan), Cost(math.inf)])
    first, second = read_rows(tmp_path / "rows.csv", Cost)
    assert math.isnan(first.wall_s) and second.wall_s == math.inf


def test_a_tuple_is_one_cell_and_so_is_a_word_of_a_closed_set(tmp_path):
    rows = [Told("space", Spread(1.5, -2.0), (3.0,)), Told("plane", Spread(0.5, 0.25), ())]
    write_rows(tmp_path / "rows.csv", Told, rows)
    assert (tmp_path / "rows.csv").read_text().splitlines()[1] == "space,1.5 -2,3"
    assert read_rows(tmp_path / "rows.csv", Told) == rows


def test_a_cell_of_the_wrong_type_is_refused(tmp_path):
    (tmp_path / "rows.csv").write_text("wall_s\nsoon\n")
    with pytest.raises(msgspec.ValidationError, match="wall_s"):
        read_rows(tmp_path / "rows.csv", Cost)


def test_json_keeps_arrays_and_rounds(tmp_path):
    path = tmp_path / "found.json"
    write_json(path, Found(np.array([[1 / 3, 2.0], [math.nan, 4.0]]), math.inf, ("[ a\n", "b")))
    assert "[0.333333, 2.0]" in path.read_text()
    found = read_json(path, Found)
    np.testing.assert_array_equal(found.places, [[0.333333, 2.0], [math.nan, 4.0]])
    assert (found.best, found.names) == (math.inf, ("[ a\n", "b"))


def test_words_follow_from_numbers():
    assert trend([1.0, 2.0, 3.0]) == "rises"
    assert trend([3.0, 2.0, 2.5]) == "falls"
    assert trend([1.0, 1.01, 1.0]) == "stays level"
    assert ranking({"three": 1.0, "five": 2.0, "four": -1.0}) == "five > three > four"
    assert listed(["a"]) == "a" and listed(["a", "b", 3.0]) == "a, b and 3"
    assert number(-0.001, 2) == "0.00" and number(-1.5, 1) == "−1.5" and signed(0.0, 1) == "+0.0"
    assert short(1.23e-7) == "1.2e-7" and short(0.0) == "0" and exponent("-1.0e+00") == "−1.0"


def test_a_template_names_only_what_it_is_given(tmp_path):
    (tmp_path / "page.md").write_text(
        "# {{ title }}\n\n{% if rows %}\n{{ table(['a'], rows) }}\n{% endif %}\n"
    )
    assert page(tmp_path / "page.md", title="T", rows=[[1]]) == "# T\n\n| a |\n| --- |\n| 1 |\n"
    assert table(["a"], [[1]]) == "| a |\n| --- |\n| 1 |"
    with pytest.raises(UndefinedError, match="title"):
        page(tmp_path / "page.md", rows=[])


def test_a_fingerprint_is_that_of_what_is_drawn(tmp_path):
    def figure(height=1.0, label="line"):
        drawn, axes = panels()
        axes.plot([0.0, 1.0], [0.0, height], label=label)
        axes.bar([0.0], [height])
        return drawn

    save(figure(), tmp_path / "figure.png")
    assert kept_fingerprint(tmp_path / "figure.png") == fingerprint(figure()) == fingerprint(figure(1 + 1e-9))
    assert len({fingerprint(figure()), fingerprint(figure(1.001)), fingerprint(figure(label="other"))}) == 3


def test_work_is_timed_until_it_is_enough():
    calls = []
    times = timed(lambda: calls.append("work"), 2, prepare=lambda: calls.append("prepare"))
    assert calls == ["prepare", "work"] * 2 and len(times.wall_s) == len(times.processor_s) == 2
    assert times.best_s <= times.median_s
    assert len(timed(lambda: None, 2, enough_s=60.0, most=5).wall_s) == 5


def test_a_broken_simulation_is_no_result():
    nothing = np.zeros((1, 0, 2))
    record = Recording(np.zeros(1), nothing, np.zeros((1, 1, 3)), np.ones(1, bool), nothing, "no limit")
    with pytest.raises(RuntimeError, match="no limit"):
        unbroken(record)
