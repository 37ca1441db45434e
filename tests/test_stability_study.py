"""The study of stability: verdicts, energies, the explicit scheme's limit, the page. No full run."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

sys.path.insert(0, str(Path(__file__).parent.parent))

from magworm_gym import Scene, SceneError, record_scenes
from studies.kit.passes import values_of
from studies.stability.axes import (
    ALONE,
    DRIVE_HALF_HEIGHT_M,
    GAP,
    INSIDE,
    MASS_RATIO,
    ROBOT,
    SECTION,
    STEP,
    STIFFNESS,
    base_scene,
)
from studies.stability.cases import Case, alone, crossed, every_pair, judge
from studies.stability.data import energy_csv, limits_csv, outcomes_csv, starts_csv
from studies.stability.energy import CLAMPED, Swing, energies_j, measured
from studies.stability.knots import closed, determinant
from studies.stability.limits import limits, refusal, rod, stays
from studies.stability.page import page
from studies.stability.starts import (
    EXPLICIT_S,
    KNOT,
    ROD,
    STARTS,
    StartCase,
    lies_in_the_plane,
    start_cases,
    untyings,
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
    near = MASS_RATIO.changes(7500.0 / 1070.0 * 0.0629)
    assert near["material.density_kg_m3"] == pytest.approx(1070.0, rel=0.01)
    assert near["magnet.density_kg_m3"] == pytest.approx(7500.0, rel=0.01)
    assert GAP.changes(0.0)["drive.motion.y_m"] == pytest.approx(-0.5 * values["drive"]["height_m"])
    assert SECTION.changes(7.0)["body.bridge_thickness_m"] == pytest.approx(0.004)


def test_verdicts_of_a_rod() -> None:
    cases = [
        Case("rod", 2, "newmark", ((STIFFNESS, 1e7),)),
        Case("rod", 2, "newmark", ((STEP, 25),)),
        Case("rod", 2, "explicit", ((STEP, 2),)),
        Case("robot", 2, "newmark", ((SECTION, 0.1),)),
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


def test_page_and_tables(tmp_path: Path) -> None:
    single = judge([*alone("rod", STIFFNESS, 3)[:2], Case("robot", 2, "newmark", ((INSIDE, 1.0),))])
    pair = judge(crossed("rod", (STEP, STIFFNESS))[-2:], accuracy=False)
    swings = [measured(Swing(CLAMPED, "newmark", 1e5, 50.0))]
    found = limits(["rod"])
    pairs = tmp_path / "pairs.csv"
    bent = judge(short_starts())
    starts = bent, untyings()
    bare = page(found, swings, single, {"rod": pair, "robot": []}, *starts, pairs)
    assert refusal() in bare
    assert "start.height_m is -0.001 m; allowed" in bare
    assert "The long form" not in bare
    pairs.write_text(outcomes_csv(pair), encoding="utf-8")
    assert "The long form" in page(found, swings, single, {"rod": pair, "robot": []}, *starts, pairs)
    assert "| knotted |" in bare
    assert "start.height_m = -0.001" in bare
    assert len(starts_csv(bent).splitlines()) == 1 + len(bent)
    assert len(outcomes_csv(single).splitlines()) == 1 + len(single)
    assert len(limits_csv(found).splitlines()) == 3
    assert ",50," in energy_csv(swings)


def test_every_pair_has_both_ends() -> None:
    settings = {tuple((axis.name, value) for axis, value in case.settings) for case in every_pair()}
    assert (("Young's modulus", 1e3), ("retardation time", 1.0)) in settings
    assert (("friction", 10), ("incline", 90)) in settings


def short_starts() -> list[StartCase]:
    """Some that are quickly run."""
    return [
        StartCase("rod", 2, "newmark", (), start="inside the ground", step_s=2e-3),
        StartCase("rod", 2, "newmark", (), start="rolled up in five turns, dropped", step_s=2e-3),
        StartCase("rod", 3, "newmark", (), start="knotted", step_s=2e-3),
    ]


def test_bent_starts_make_scenes_or_say_why_not() -> None:
    for case in start_cases():
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
        assert {lies_in_the_plane(body, name) for name in named} == {True, False}


def test_verdicts_of_bent_starts() -> None:
    found = judge(short_starts())
    assert [outcome.verdict for outcome in found] == ["refused", "broken", "stable"]


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
        changes = {**ROD, **KNOT, "dimensions": 3, "body.elements": elements}
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
