"""Tracks, stages and flags as people have them: read, refused in a sentence, or read with a word of doubt."""

import csv
import pickle
import re
import shlex
import sys
from pathlib import Path

import numpy as np
import pytest
from tracks import PARTS, PASS, SMALL, entries, saved

from magworm_gym import Scene
from magworm_gym.cli import main
from magworm_gym.identification import (
    Camera,
    ProblemError,
    identify,
    make_problem,
    read_deeplabcut,
    read_problem,
    write_example_tracks,
)

DATA = Path(__file__).parent / "data"
STILL = {"drive.motion": {**PASS["drive.motion"], "speed_m_s": 0.0}}


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    """Rows of the tracks of a simulated pass: three header rows, then 91 frames."""
    path = tmp_path_factory.mktemp("film") / "worm.csv"
    scene = Scene.preset("paper-3").with_values(PASS)
    write_example_tracks(path, scene, 1.5, Camera(1.5e-4, 60.0), PARTS)
    return list(csv.reader(path.read_text().splitlines()))


def command(capsys, *arguments):
    with pytest.raises(SystemExit) as stopped:
        main([str(argument) for argument in arguments])
    return stopped.value.code, capsys.readouterr()


def columns(rows, kept):
    """Columns of the tracks that are kept, by the row of coordinates."""
    places = [0, *(at for at, name in enumerate(rows[2]) if name in kept)]
    return [[row[at] for at in places] for row in rows]


def with_ensembles(rows):
    more = [["s"] * 2, ["tail"] * 2, ["x_ens_median", "y_posterior_var"], *[["7.0", "0.1"]] * (len(rows) - 3)]
    return [[*row, *extra] for row, extra in zip(rows, more, strict=True)]


def of_two(rows):
    """A second animal, and a mark on the stage that belongs to neither."""
    individuals = ["individuals", *["worm"] * 9, *["other"] * 9, *["single"] * 3]
    parts = [*rows[1], *rows[1][1:], *["stage"] * 3]
    body = [[*row, *["1.0"] * 9, "5.0", "6.0", "0.9"] for row in rows[3:]]
    coordinates = [*rows[2], *rows[2][1:], *rows[2][1:4]]
    return [[rows[0][0], *["s"] * 21], individuals, parts, coordinates, *body]


FORMS = {
    "as it is": (lambda rows: rows, ","),
    "semicolons": (lambda rows: rows, ";"),
    "tabs": (lambda rows: rows, "\t"),
    "decimal commas": (
        lambda rows: rows[:3] + [[cell.replace(".", ",") for cell in row] for row in rows[3:]],
        ";",
    ),
    "sep=": (lambda rows: [["sep=;"], *rows], ";"),
    "empty columns": (lambda rows: [[*row, "", ""] for row in rows], ","),
    "an empty column within": (lambda rows: [[*row[:4], "", *row[4:]] for row in rows], ","),
    "empty rows": (lambda rows: [[""] * 10, *rows[:20], [""] * 10, *rows[20:], *[[""] * 10] * 3], ","),
    "blanks around cells": (lambda rows: [[f" {cell} " for cell in row] for row in rows], ","),
    "merged headers": (
        lambda rows: [
            rows[0],
            [*rows[1][:2], "", "", rows[1][4], "", "", rows[1][7], "", ""],
            *rows[2:],
        ],
        ",",
    ),
    "one individual": (lambda rows: [rows[0], ["individuals", *["worm"] * 9], *rows[1:]], ","),
    "frames as 0.0": (lambda rows: rows[:3] + [[f"{row[0]}.0", *row[1:]] for row in rows[3:]], ","),
    "without likelihood": (lambda rows: columns(rows, {"x", "y"}), ","),
    "an ensemble's columns": (with_ensembles, ","),
}


@pytest.mark.parametrize("form", FORMS)
def test_tracks_are_read_in_every_form_that_tools_and_spreadsheets_save(tmp_path, film, form):
    change, separator = FORMS[form]
    tracks = read_deeplabcut(saved(tmp_path / "worm.csv", change(film), separator))
    expected = read_deeplabcut(saved(tmp_path / "expected.csv", film))
    assert np.array_equal(tracks.frames, expected.frames)
    for part in PARTS:
        kept = tracks.part(part), expected.part(part)
        if form == "without likelihood":
            assert (kept[0][:, 2] == 1.0).all()
            kept = kept[0][:, :2], kept[1][:, :2]
        assert np.array_equal(*kept)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_marks_of_byte_order_are_passed_over(tmp_path, film, encoding):
    text = "\r\n".join(",".join(row) for row in film)
    (tmp_path / "worm.csv").write_bytes(text.encode(encoding))
    assert len(read_deeplabcut(tmp_path / "worm.csv").frames) == 91


def test_one_of_several_individuals_is_chosen_by_name(tmp_path, film):
    path = saved(tmp_path / "worm.csv", of_two(film))
    with pytest.raises(ProblemError, match=r"several animals; allowed: individual .* one of: worm, other"):
        read_deeplabcut(path)
    with pytest.raises(ProblemError, match=r"no individual 'third'; allowed: .* worm, other"):
        read_deeplabcut(path, "third")
    tracks = read_deeplabcut(path, "worm")
    assert np.array_equal(
        tracks.part("head"), read_deeplabcut(saved(tmp_path / "one.csv", film)).part("head")
    )
    assert tracks.part("stage")[0].tolist() == [5.0, 6.0, 0.9]
    assert make_problem(entries("worm.csv", individual="worm"), tmp_path).noticed == ()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda row, at: [f"{at * 1000 / 60:.3f}", *row[1:]], r"column 1 is '16.667'; .* time in s or ms\?"),
        (lambda row, at: [f"{at * 1000 / 60:.0f}", *row[1:]], "rises by 16 or 17 a row"),
        (lambda row, at: [f"{at / 60:.4f}", *row[1:]], "column 1 is '0.0167'"),
        (lambda row, at: ["inf" if at == 50 else row[0], *row[1:]], "line 54, column 1 is 'inf'; allowed"),
        (lambda row, at: ["1e30" if at == 90 else row[0], *row[1:]], "line 94, column 1 is '1e30'; allowed"),
        (lambda row, at: ["" if at == 3 else row[0], *row[1:]], "line 7, column 1 is ''; allowed"),
        (
            lambda row, at: ["img4.png", *row[1:]],
            "line 4, column 1 is 'img4.png'; allowed: the frame's number",
        ),
        (lambda row, at: [*row, "5"], "line 4, column 11 is '5'; allowed: nothing"),
        (lambda row, at: row[: 9 if at == 5 else 10], "line 9 has 9 columns; allowed: 10"),
        (lambda row, at: [row[0], "1,5", *row[2:]], "line 4, column 11 is .*; allowed: nothing"),
    ],
)
def test_rows_that_mean_something_else_are_refused_with_line_and_value(tmp_path, film, change, message):
    rows = film[:3] + [change(row, at) for at, row in enumerate(film[3:])]
    with pytest.raises(ProblemError, match=message):
        read_deeplabcut(saved(tmp_path / "worm.csv", rows))


def test_whole_milliseconds_are_known_by_the_frame_rate(tmp_path, film):
    saved(tmp_path / "worm.csv", film[:3] + [[f"{20 * int(row[0])}", *row[1:]] for row in film[3:]])
    with pytest.raises(ProblemError, match=r"rises by 20 a row, .* is it a time in ms\?"):
        make_problem(entries(frames_per_second=50.0), tmp_path)


def test_a_film_of_years_is_refused(tmp_path, film):
    saved(tmp_path / "worm.csv", [*film, ["90000000", *film[-1][1:]]])
    with pytest.raises(ProblemError, match=r"the tracks end at 1.5e.06 s .* allowed: 0.01 to 3600 s"):
        make_problem(entries(), tmp_path)


@pytest.mark.parametrize("form", ["table", "fixed"])
def test_hdf5_of_pandas_says_what_the_csv_says(film, form):
    pytest.importorskip("h5py")
    tracks = read_deeplabcut(DATA / f"tracks_{form}.h5")
    assert tracks.frames.tolist() == [0, 1, 2, 4]
    assert tracks.part("head").tolist()[0] == [212.5, 388.25, 0.875]
    assert np.isnan(tracks.part("tail")[2]).all()
    assert list(tracks.parts) == ["head", "tail", "stage"]


def test_hdf5_runs_nothing_and_is_refused_where_it_is_damaged(tmp_path):
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "evil.h5"

    class Evil:
        def __reduce__(self):
            return Path.touch, (tmp_path / "ran",)

    path.write_bytes((DATA / "tracks_table.h5").read_bytes())
    with h5py.File(path, "r+") as file:
        file["df_with_missing/table"].attrs["values_block_0_kind"] = np.bytes_(pickle.dumps(Evil(), 0))
    with pytest.raises(ProblemError, match="no table of tracks can be read"):
        read_deeplabcut(path)
    assert not (tmp_path / "ran").exists()
    for cut in (20, 3000):
        path.write_bytes((DATA / "tracks_table.h5").read_bytes()[:cut])
        with pytest.raises(ProblemError, match=r"is HDF5, but no table of tracks .* as CSV"):
            read_deeplabcut(path)


def test_hdf5_without_its_library_says_the_extra(capsys, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "h5py", None)
    words = ["--tracks", DATA / "tracks_table.h5", "--metres-per-pixel", 1.5e-4, "--frames-per-second", 60]
    words += ["--magnets", "head", "", "tail", "--fit", "material.youngs_modulus_pa", 3e4, 7e4]
    code, said = command(capsys, "identify", *words, "--out", tmp_path / "fit")
    assert code == 2
    assert "pip install 'magworm-gym[h5]'" in said.err and "CSV" in said.err


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"metres_per_pixel": 0.15},
            r"the marks at rest reach over 39.9 m .*allowed: a metres_per_pixel",
        ),
        ({"metres_per_pixel": 1.5e-7}, "the marks at rest reach over 3.99e-05 m"),
        ({"magnets": PARTS[::-1]}, "lie from the tail to the head; allowed: magnets"),
        ({"head": "right"}, "lie from the tail to the head; .* now 'right'"),
        ({"magnets": ["head", "tail", "middle"]}, "lie in another order"),
        ({"magnets": ["head", "tail", "head"]}, "each body part once, and 'head' is there twice"),
    ],
)
def test_scale_and_order_that_cannot_be_meant_are_refused(tmp_path, film, change, message):
    saved(tmp_path / "worm.csv", film)
    with pytest.raises(ProblemError, match=message):
        make_problem(entries(**change), tmp_path)


def test_a_part_that_the_header_names_twice_is_refused(tmp_path, film):
    rows = [[*row, *row[1:4]] for row in film]
    with pytest.raises(ProblemError, match="'x' of body part 'head' twice; allowed: once"):
        read_deeplabcut(saved(tmp_path / "worm.csv", rows))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({}, None),
        ({"metres_per_pixel": 2.1e-4}, r"is metres_per_pixel right\?"),
        ({"angle_deg": 15.0}, r"turned by .*15° .* is angle_deg right\?"),
        ({"frames_per_second": 30.0}, r"about 60 frames per second: is frames_per_second = 30 right\?"),
        ({"frames_per_second": 240.0}, r"about 60 frames per second"),
        ({"y_axis": "up"}, 'with y_axis = "down"'),
        ({"start_s": 0.4}, r"0.4 s later: is the time right .* \(start_s\)\?"),
        ({"values": {"drive.motion": {**PASS["drive.motion"], "x_m": -9.0}}}, "the drive comes no nearer"),
        (
            {"values": {"drive.motion": {**PASS["drive.motion"], "x_m": -0.3, "speed_m_s": -0.1}}},
            "the drive comes no nearer to the robot than 0.3",
        ),
        ({"values": STILL}, r"the marks rise by 0.00\d+ m and .* does the drive pass them"),
    ],
)
def test_what_may_be_a_mistake_is_said_before_the_search(tmp_path, film, change, message):
    saved(tmp_path / "worm.csv", film)
    noticed = make_problem(entries(**change), tmp_path).noticed
    if message is None:
        assert noticed == ()
    else:
        assert any(map(re.compile(message).search, noticed)), noticed


def test_targets_in_millimetres_are_said():
    target = {"quantity": "stride_m", "value": 4.1, "tolerance": 0.1}
    problem = make_problem(
        {**entries(), "experiment": [{"values": PASS, "duration_s": 0.1, "targets": [target]}]}, Path()
    )
    assert any("stride_m is asked to be 4.1 m" in each for each in problem.noticed)


@pytest.mark.parametrize("times", [(5.0, 6.0), (-6.0, -5.0)])
def test_a_stage_of_another_time_is_refused(tmp_path, film, times):
    saved(tmp_path / "worm.csv", film)
    saved(tmp_path / "stage.csv", [["time_s", "x_m", "y_m"], *([f"{t}", "0.0", "-0.022"] for t in times)])
    with pytest.raises(ProblemError, match=r"stage.csv: its times .* are -?\d to -?\d s, and the experiment"):
        make_problem(entries(values={}, drive={"file": "stage.csv"}), tmp_path)


def test_a_stage_that_covers_a_part_of_the_film_is_said(tmp_path, film):
    saved(tmp_path / "worm.csv", film)
    rows = [["time_s", "x_m", "y_m"], ["0", "-0.05", "-0.022"], ["0.5", "0.0", "-0.022"]]
    saved(tmp_path / "stage.csv", rows)
    problem = make_problem(entries(values={}, drive={"file": "stage.csv"}), tmp_path)
    assert "of 0 to 1.5 s; in the rest the drive stands still" in problem.remarks[0]


def test_a_whole_number_is_not_fitted(tmp_path, film):
    saved(tmp_path / "worm.csv", film)
    for path in ("body.elements_per_bridge", "solver.quadrature_order", "body.magnets"):
        parameters = {path: {"low": 2, "high": 6}}
        with pytest.raises(ProblemError, match=f"{path} is a whole number and cannot be fitted; allowed"):
            make_problem({**entries(), "parameters": parameters}, tmp_path)


def test_numbers_with_exponents_are_numbers_on_the_command_line(tmp_path, capsys):
    csv_file = tmp_path / "worm.csv"
    code, said = command(capsys, "example-tracks", csv_file, "--drive-x", "-5e-5", "--duration-s", "0.5")
    assert code == 0
    words = shlex.split(said.out.splitlines()[1])[1:-1]
    assert words[words.index("--drive-x") + 1] == "-5e-05"
    words += [tmp_path / "fit", "--start-s", "-1e-9", "--set", "body.first_polarity", "-1"]
    small = [word for name, value in SMALL.items() for word in (f"--{name}", value)]
    code, said = command(capsys, *words, *small)
    assert code == 0, said.err


UNQUOTED = """
scene = "paper-3"
[values]
solver.step_s = 0.002
drive.motion = { kind = "constant", x_m = -0.05, y_m = -0.022, speed_m_s = 0.1 }
[values.material]
damping_time_s = 0.005
[parameters]
material.youngs_modulus_pa = { low = 28600, high = 76300 }
[parameters.ground]
static_friction = { low = 0.7, high = 1.8 }
[[experiment]]
duration_s = 0.2
values.solver.wrench_interval = 1
targets = [{ quantity = "stride_m", value = 0.0, tolerance = 1e-3 }]
[[start]]
values.material.youngs_modulus_pa = 5e4
"""


def test_keys_without_quotes_mean_what_they_say(tmp_path):
    (tmp_path / "bare.toml").write_text(UNQUOTED)
    made = read_problem(tmp_path / "bare.toml")
    assert [p.path for p in made.space.parameters] == ["material.youngs_modulus_pa", "ground.static_friction"]
    text = made.base.to_toml()
    assert "step_s = 0.002\n" in text and "damping_time_s = 0.005\n" in text and "speed_m_s = 0.1\n" in text
    assert made.starts == ({"material.youngs_modulus_pa": 5e4},)
    (tmp_path / "like.toml").write_text('like = "bare.toml"\n[values]\nmaterial.softness = 3\n')
    with pytest.raises(ProblemError, match=r"material.softness is not a field"):
        read_problem(tmp_path / "like.toml")
    (tmp_path / "like.toml").write_text('like = "bare.toml"\n[values]\nmaterial.density_kg_m3 = 1100\n')
    assert "damping_time_s = 0.005\n" in read_problem(tmp_path / "like.toml").base.to_toml()


@pytest.mark.parametrize(
    "words",
    [
        ["--frames-per-second", 0],
        ["--frames-per-second", -60],
        ["--frames-per-second", "nan"],
        ["--metres-per-pixel", 0],
        ["--metres-per-pixel", "inf"],
        ["--noise-px", "nan"],
        ["--noise-px", -1],
        ["--seed", -1],
        ["--duration-s", 0],
        ["--duration-s", "1e9"],
        ["--duration-s", "nan"],
        ["--drive-x", "nan"],
        ["--drive-speed", "inf"],
    ],
)
def test_an_example_of_nonsense_is_refused_in_a_sentence_and_leaves_no_file(tmp_path, capsys, words):
    code, said = command(capsys, "example-tracks", tmp_path / "x.csv", *words)
    assert code == 2
    assert said.err.count("\n") == 1 and "allowed" in said.err
    assert not list(tmp_path.iterdir())


def test_candidates_that_are_damaged_anywhere_are_refused_in_a_sentence(tmp_path):
    target = {"quantity": "stride_m", "value": 0.0, "tolerance": 1e-3}
    problem = make_problem(
        {**entries(), "experiment": [{"values": STILL, "duration_s": 0.02, "targets": [target]}]}, Path()
    )
    identify(problem, tmp_path)
    path = tmp_path / "candidates.npz"
    kept = path.read_bytes()
    central = kept.find(b"PK\x01\x02")
    for content in (b"", kept[:100], kept[:-40]):
        path.write_bytes(content)
        with pytest.raises(ProblemError, match="cannot be read; allowed: the file of a run that was stopped"):
            identify(problem, tmp_path, resume=True)
    for at in (central + 8, central + 10, len(kept) // 3):
        damaged = bytearray(kept)
        damaged[at] ^= 0x63
        path.write_bytes(damaged)
        with pytest.raises(ProblemError, match="cannot be read"):
            identify(problem, tmp_path, resume=True)
