"""The study of stability: verdicts, energies, the explicit scheme's limit, the page. No full run."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.colors import to_rgb

from magworm_gym import Scene, SceneError, record_scenes
from studies.kit.data import read_json, read_rows, write_rows
from studies.kit.passes import values_of
from studies.kit.study import main
from studies.stability import study
from studies.stability.axes import (
    ALONE,
    AXES,
    DRIVE_HALF_HEIGHT_M,
    INSIDE,
    ROBOT,
    STEP,
    STIFFNESS,
    base_scene,
)
from studies.stability.cases import EXPLICIT_S, Case, Outcome, alone, bent, crossed, every_pair, judge
from studies.stability.energy import CLAMPED, Swing, energies_j, measured
from studies.stability.figures import COLOURS
from studies.stability.findings import sentences, tabled
from studies.stability.knots import closed, determinant
from studies.stability.limits import limits, refusal, rod, stays
from studies.stability.postures import filled, untyings
from studies.stability.starts import ROD, STARTS, places
from studies.stability.study import ROWS, Explicit, text

FEET, RATIO, GAP = (
    AXES[title] for title in ("thickness of the feet [mm]", "mass of magnets over rubber", "gap [mm]")
)


def test_every_axis_makes_scenes_or_says_why_not() -> None:
    for body, axes in ALONE.items():
        for axis in axes:
            for value in axis.values:
                changes = axis.changes(value)
                try:
                    base_scene(body, 2).with_values(changes)
                except SceneError:
                    assert axis is INSIDE
                    assert value > 0.0


def test_the_robot_keeps_its_mass_whatever_the_ratio() -> None:
    values = values_of(ROBOT)
    assert values["material"]["density_kg_m3"] == 1070.0
    assert values["drive"]["height_m"] == pytest.approx(2.0 * DRIVE_HALF_HEIGHT_M)
    near = RATIO.changes(7500.0 / 1070.0 * 0.0629)
    assert near["material.density_kg_m3"] == pytest.approx(1070.0, rel=0.01)
    assert near["magnet.density_kg_m3"] == pytest.approx(7500.0, rel=0.01)
    assert GAP.changes(0.0)["drive.motion.y_m"] == pytest.approx(-0.5 * values["drive"]["height_m"])
    assert FEET.changes(7.0)["body.bridge_thickness_m"] == pytest.approx(0.004)


def test_verdicts_of_a_rod() -> None:
    cases = [
        Case("rod", 2, "newmark", STIFFNESS.title, 1e7),
        Case("rod", 2, "newmark", STEP.title, 25),
        Case("rod", 2, "explicit", STEP.title, 2),
        Case("robot", 2, "newmark", FEET.title, 0.1),
    ]
    found = judge(cases)
    assert [outcome.verdict for outcome in found] == ["accurate", "stable", "refused", "broken"]
    assert found[0].error < 0.02 < found[1].error
    assert "axial wave in element 9" in found[2].sentence
    assert "sank into the ground" in found[3].sentence
    assert math.isnan(judge(cases[:1], accuracy=False)[0].error)


def test_energy_is_kept_by_the_explicit_scheme_and_lost_by_backward_euler() -> None:
    swing = Swing(CLAMPED, "explicit", 1e5, 0.05)
    record = record_scenes([swing.scene()], 0.05, swing.step_ms / 1e3)[0]
    visible_j, elastic_j, unit_j = energies_j(record, swing)
    total_j = visible_j + elastic_j
    assert np.ptp(total_j) < 1e-3 * elastic_j.max()
    assert elastic_j.max() > 0.01 * unit_j
    assert measured(Swing(CLAMPED, "explicit", 1e5, 2.0)).broken is None
    assert math.isnan(measured(Swing(CLAMPED, "explicit", 1e5, 2.0)).gain)
    assert measured(Swing(CLAMPED, "euler", 1e5, 2.0)).lost > 0.05


def test_the_limit_is_found_where_it_is_predicted() -> None:
    for one in limits(["rod", "τ = 0.3 ms"]):
        assert one.found_s == pytest.approx(one.predicted_s, rel=0.01)
    scene = rod("heavy magnets", 3)
    predicted_s, _ = scene.explicit_limit()
    assert stays(scene, 0.99 * predicted_s)
    assert not stays(scene, 1.01 * predicted_s)


def test_a_page_is_written_from_results_alone(tmp_path) -> None:
    single = judge([*alone("rod", STIFFNESS, 3)[:2], Case("robot", 2, "newmark", INSIDE.title, 1.0)])
    pair = judge(crossed("rod", (STEP, STIFFNESS))[-2:], accuracy=False)
    swings = [measured(Swing(CLAMPED, "newmark", 1e5, 50.0))]
    starts = judge(short_starts())
    tables = dict.fromkeys(ROWS, ()) | {"limits": limits(["rod"]), "swings": swings, "knots": untyings()}
    tables |= {"alone": single, "crossed": pair, "bent": starts}
    page = text(Explicit(5e-8, refusal()), tables)
    assert f"> {refusal()}" in page and "steps of 50 ns" in page
    assert "start.height_m is -0.001 m; allowed" in page
    assert "The long form" not in page
    assert "The long form crosses" in text(Explicit(5e-8, ""), tables | {"pairs": pair})
    assert "| knotted |" in page and "`start.height_m = -0.001`" in page
    write_rows(tmp_path / "starts.csv", Outcome, starts, digits=4)
    kept = read_rows(tmp_path / "starts.csv", Outcome)
    assert [outcome.case for outcome in kept] == [outcome.case for outcome in starts]
    assert list(sentences(kept)) == list(sentences(starts))


def test_a_table_has_a_column_a_scheme_and_place() -> None:
    outcomes = [
        Outcome(Case("rod", 2, "newmark", STEP.title, 2), "accurate", 1.23e-9),
        Outcome(Case("rod", 2, "newmark", STEP.title, 5), "broken", math.nan, "how"),
        Outcome(Case("rod", 2, "explicit", STEP.title, 2), "refused", math.nan, "why"),
        Outcome(Case("rod", 3, "newmark", STEP.title, 2), "stable", 0.123),
    ]
    assert tabled(STEP.title, "setting", "integrator", outcomes).splitlines() == [
        "| step [ms] | newmark, plane | explicit, plane | newmark, space |",
        "| --- | --- | --- | --- |",
        "| 2 | accurate 1.2e-7 % | refused | stable 12 % |",
        "| 5 | broken |  |  |",
    ]


def test_energies_are_the_worst_of_all_stiffnesses() -> None:
    swings = [
        Swing(CLAMPED, "euler", 1e3, 5.0, gain=0.2, visible=-0.1, lost=0.3),
        Swing(CLAMPED, "euler", 1e7, 5.0, gain=0.1, visible=-0.2, lost=-0.4),
        Swing(CLAMPED, "euler", 1e7, 1.0, gain=0.0, visible=0.0, lost=0.0),
        Swing(CLAMPED, "explicit", 1e7, 5.0),
    ]
    page = text(Explicit(5e-8, ""), dict.fromkeys(ROWS, ()) | {"swings": swings})
    rows = [line for line in page.splitlines() if line.startswith(f"| {CLAMPED} |")]
    assert rows == [
        f"| {CLAMPED} | `euler` | 5 | 0 | 0.2 | −0.4 to 0.3 |",
        f"| {CLAMPED} | `euler` | 1 | 0 | 0 | 0 to 0 |",
    ]


COLOUR_VISION = {
    "normal": "1 0 0, 0 1 0, 0 0 1",
    "no red": "0.152286 1.052583 -0.204868, 0.114503 0.786281 0.099216, -0.003882 -0.048116 1.051998",
    "no green": "0.367322 0.860646 -0.227968, 0.280085 0.672501 0.047413, -0.011820 0.042940 0.968881",
    "no blue": "1.255528 -0.076749 -0.178779, -0.078411 0.930809 0.147602, 0.004733 0.691367 0.303900",
}
"""Machado, Oliveira and Fernandes 2009, severity 1: of linear RGB."""


def lightness_and_hue(linear: np.ndarray) -> np.ndarray:
    """CIELAB of linear sRGB, white of D65."""
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    x, y, z = np.cbrt(to_xyz @ np.clip(linear, 0.0, 1.0) / (0.9505, 1.0, 1.089))
    return np.array([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])


@pytest.mark.parametrize("vision", COLOUR_VISION)
def test_verdicts_are_told_apart_by_all_kinds_of_colour_vision(vision: str) -> None:
    matrix = np.fromstring(COLOUR_VISION[vision].replace(",", " "), sep=" ").reshape(3, 3)
    seen = [lightness_and_hue(matrix @ np.array(to_rgb(colour)) ** 2.2) for colour in COLOURS.values()]
    # Ours: a distance of 30; neighbouring fields are told apart from about 5.
    assert all(np.linalg.norm(a - b) > 30.0 for a, b in itertools.combinations(seen, 2))


def test_every_pair_has_both_ends() -> None:
    settings = {(case.axis, case.value, case.second_axis, case.second_value) for case in every_pair()}
    assert ("Young's modulus [Pa]", 1e3, "retardation time [s]", 1.0) in settings
    assert ("friction", 10.0, "incline [°]", 90.0) in settings


def short_starts() -> list[Case]:
    """Some that are quickly run."""
    return [
        Case("rod", dimensions, "newmark", STEP.title, 2.0, start=start)
        for start, dimensions in (
            ("inside the ground", 2),
            ("rolled up in five turns, dropped", 2),
            ("knotted", 3),
        )
    ]


def test_bent_starts_make_scenes_or_say_why_not() -> None:
    for case in bent():
        try:
            scene = case.scene()
        except SceneError as error:
            assert case.start == "inside the ground"
            assert "start.height_m is -0.001 m" in str(error)
        else:
            assert scene.dimensions == case.dimensions
            if case.integrator == "explicit":
                assert scene.explicit_limit()[0] >= EXPLICIT_S[case.body, case.dimensions]
    for body, named in STARTS.items():
        assert {places(body, name) for name in named} == {(2, 3), (3,)}


def test_a_finer_step_is_no_shorter_than_a_scheme_allows() -> None:
    for integrator, value_ms, finer_s in (
        ("newmark", 0.01, 1e-5),
        ("newmark", 2, 2.5e-4),
        ("explicit", 5e-4, 2.5e-7),
    ):
        case = Case("robot", 2, integrator, STEP.title, value_ms)
        assert values_of(case.scene(8))["solver"]["step_s"] == pytest.approx(finer_s)
        assert case.shortest == (value_ms == 0.01)


def test_verdicts_of_bent_starts() -> None:
    found = judge(short_starts())
    assert [outcome.verdict for outcome in found] == ["refused", "broken", "stable"]


def test_elements_that_magnets_fill_are_counted() -> None:
    line_mm = np.cumsum([[0.0, 0.0], [5.0, 0.0], [0.0, 6.303], [5.0, 0.0]], axis=0)
    assert filled(line_mm, 1) == (1,)
    with pytest.raises(RuntimeError, match="1 elements are as long as a magnet; the body has 2"):
        filled(line_mm, 2)


def test_determinants_of_known_knots() -> None:
    t = np.linspace(0.0, 2.0 * np.pi, 121)[:-1]
    trefoil = np.c_[np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)]
    around = 2.0 + np.cos(2 * t)
    figure_of_eight = np.c_[around * np.cos(3 * t), around * np.sin(3 * t), np.sin(4 * t)]
    around = 2.0 + np.cos(5 * t)
    star = np.c_[around * np.cos(2 * t), around * np.sin(2 * t), np.sin(5 * t)]
    crumpled = np.c_[np.cos(t), np.sin(t) * np.cos(2 * t), 0.3 * np.sin(5 * t)]
    assert [determinant(line) for line in (trefoil, figure_of_eight, star, crumpled)] == [3, 5, 5, 1]
    mirrored = trefoil * (1.0, 1.0, -1.0)
    assert determinant(mirrored) == 3


def test_the_knotted_start_is_a_trefoil_however_it_is_closed() -> None:
    for elements in (27, 60, 120):
        changes = {**ROD, **STARTS["rod"]["knotted"], "dimensions": 3, "body.elements": elements}
        scene = Scene.preset("cantilever").with_values(changes)
        line = record_scenes([scene], 0.002, 0.002)[0].nodes[0]
        ahead, behind = line[0] - line[1], line[-1] - line[-2]
        longer = np.vstack([line[0] + 10 * ahead, line, line[-1] + 10 * behind])
        assert [determinant(line), determinant(closed(line)), determinant(closed(longer))] == [3, 3, 3]
    loose = {**changes, "start.bends_deg": [30.0]}
    line = record_scenes([Scene.preset("cantilever").with_values(loose)], 0.002, 0.002)[0].nodes[0]
    assert determinant(closed(line)) == 1


def test_the_knot_comes_undone() -> None:
    for one in untyings():
        assert 0.0 < one.until_s < 0.02
        assert one.at_end == 1


def test_measuring_leaves_a_table_of_each_name(tmp_path, monkeypatch) -> None:
    swept = {"rod": (replace(STEP, values=(2.0, 5.0, 10.0)),)}
    monkeypatch.setattr(study, "DATA", tmp_path)
    monkeypatch.setattr(study, "ALONE", swept)
    monkeypatch.setattr(study, "CROSSED", {"rod": ((swept["rod"][0], replace(STIFFNESS, values=(1e3,))),)})
    monkeypatch.setattr(study, "every_pair", lambda: crossed("rod", (STEP, STIFFNESS))[-3:])
    monkeypatch.setattr(study, "bent", short_starts)
    for name in ("limits", "swings", "postures", "untyings"):
        monkeypatch.setattr(study, name, list)
    assert main({"stability": "studies.stability.study"}, ["measure", "stability", "--long"]) == 0
    counts = {name: len(study.rows(name)) for name in ROWS}
    assert counts == {
        **dict.fromkeys(("limits", "swings", "knots", "postures"), 0),
        "alone": 3 * 3 * 2, "crossed": 3 * 3, "bent": 3, "pairs": 3,
    }  # fmt: skip
    assert read_json(tmp_path / "explicit.json", Explicit).refusal == refusal()
