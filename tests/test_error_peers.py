"""Peers on the falling cantilever: who is left out and why, steps, errors, the table. No peer is run."""

import csv
import importlib.metadata
import sys
from io import StringIO
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent.parent))

from magworm_gym import Scene
from studies.error.peers import cantilever, cantilever_runs, missing
from studies.error.peers.measure import Measured, fewest_steps, measured
from studies.error.peers.runs import PEERS, peer_run
from studies.error.peers.table import COLUMNS, peers_csv, peers_text

INFINITE = (float("nan"), float("nan"))


def test_peers_that_are_not_installed_are_left_out_with_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(distribution: str) -> str:
        raise importlib.metadata.PackageNotFoundError(distribution)

    monkeypatch.setattr(importlib.metadata, "version", absent)
    assert cantilever_runs() == []
    assert [found.name for found in missing()] == [peer.name for peer in PEERS]
    for peer, found in zip(PEERS, missing(), strict=True):
        assert f"{peer.distribution} is not installed" in found.sentence


def test_another_major_version_is_left_out_with_both_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.metadata, "version", lambda _: "4.0.0")
    assert cantilever_runs() == []
    assert all(
        f"4.0.0 is installed, not {peer.major}" in found.sentence
        for peer, found in zip(PEERS, missing(), strict=True)
    )


def test_a_peer_of_the_right_version_is_not_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    majors = {peer.distribution: f"{peer.major}.7.1" for peer in PEERS}
    monkeypatch.setattr(importlib.metadata, "version", majors.__getitem__)
    assert missing() == []


def test_the_case_is_that_of_the_preset() -> None:
    preset = Scene.preset("cantilever")
    values = {
        "gravity_m_s2": cantilever.GRAVITY_M_S2,
        "body.length_m": cantilever.LENGTH_M,
        "body.width_m": cantilever.WIDTH_M,
        "body.thickness_m": cantilever.THICKNESS_M,
        "material.youngs_modulus_pa": cantilever.YOUNGS_MODULUS_PA,
        "material.density_kg_m3": cantilever.DENSITY_KG_M3,
    }
    assert preset.with_values(values) == preset
    assert preset.with_values(values | {"body.length_m": 0.055}) != preset


def test_the_first_element_is_centred_on_the_clamp() -> None:
    for elements in (2, 9, 54):
        length_m = cantilever.half_cell_length_m(elements)
        assert -0.5 * length_m + elements * length_m == pytest.approx(cantilever.LENGTH_M)


def test_errors_are_distances_over_the_length() -> None:
    x_mm, y_mm = cantilever.TIP_MM
    off, fine = (x_mm + 3.0, y_mm - 4.0), (x_mm, y_mm + 5.4)
    run = peer_run("peer", "1.2", Measured(9, 1e-3, off, 0.5), fine)
    assert run.error == pytest.approx(5.0 / 54.0)
    assert run.own_error == pytest.approx((3.0**2 + 9.4**2) ** 0.5 / 54.0)


def test_the_fewest_steps_that_neither_break_nor_change_when_halved_are_found() -> None:
    def tip_mm(steps: int) -> tuple[float, float]:
        if steps < 100:
            return INFINITE
        return (50.0, -40.0) if steps < 150 else (50.0, -10.0)

    assert 150 <= fewest_steps(tip_mm, 10) <= 165


def test_what_is_never_stable_is_said() -> None:
    with pytest.raises(RuntimeError, match="no step is stable: tried 10 to"):
        fewest_steps(lambda _: INFINITE, 10)


def test_each_mesh_is_run_at_its_longest_stable_step_and_at_half_of_it() -> None:
    def release(elements: int, step_s: float):
        stable = step_s * elements <= 0.1
        return lambda: (float(elements), 0.0) if stable else INFINITE

    runs = measured(release, {10: 0.01, 20: 0.005})
    assert [run.elements for run in runs] == [10, 10, 20, 20]
    for long, short in (runs[:2], runs[2:]):
        assert short.step_s == pytest.approx(0.5 * long.step_s)
        assert 0.1 / 1.2 <= long.step_s * long.elements <= 0.1
        assert long.tip_mm == (float(long.elements), 0.0)


def test_the_table_has_a_row_for_each_run() -> None:
    runs = [peer_run("peer, scheme", "1.2", Measured(9, 1e-3, (50.0, -10.0), 0.5), (51.0, -10.0))]
    read = list(csv.DictReader(StringIO(peers_csv(runs))))
    assert tuple(read[0]) == COLUMNS
    assert [row["name"] for row in read] == ["peer, scheme"]
    assert float(read[0]["tip_y_mm"]) == -10.0
    assert float(read[0]["error"]) == pytest.approx(runs[0].error, abs=1e-5)
    assert len(peers_text(runs).splitlines()) == 2
