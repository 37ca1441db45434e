"""Peers on the cantilevers: who is left out and why, steps, errors, tables, the rod with magnets."""

import importlib.metadata

import numpy as np
import pytest

from magworm_gym import Scene
from magworm_gym.magnet import wrench
from studies.error.magnets import PLACES_M, POLARITIES, ROBOT
from studies.error.peers import cantilever
from studies.error.peers.cantilever import tip_only
from studies.error.peers.magnet_rod import AS_IT_IS, HARDLY_SHEARS, MagnetRod, magnet_inertia, magnet_rod
from studies.error.peers.measure import Measured, Series, Track, apart, longest_step_s, measured
from studies.error.peers.runs import ELASTICA, PEERS, peer_run, reference_mm, why_missing
from studies.error.study import run_peers

PEERS_CSV = """\
case,peer,scheme,version,elements,step_s,tip_x_mm,tip_y_mm,error,own_error,wall_s
cantilever,PyElastica,position Verlet,1.2,9,0.001,50,-10,0.06,0.04,0.5
"""
INFINITE = tip_only(float("nan"), float("nan"))


def run_at(tip_mm: Track, finest_mm: Track):
    run = Measured(9, 1e-3, tip_mm, 0.5)
    return peer_run(PEERS[0], "1.2", Series("scheme", [run], finest_mm), run, tip_only(*cantilever.TIP_MM))


def test_peers_that_are_not_installed_are_left_out_with_a_sentence(monkeypatch, tmp_path, capsys) -> None:
    def absent(distribution: str) -> str:
        raise importlib.metadata.PackageNotFoundError(distribution)

    monkeypatch.setattr(importlib.metadata, "version", absent)
    monkeypatch.setattr("studies.error.study.DATA", tmp_path)
    (tmp_path / "peers.csv").write_text(PEERS_CSV)
    run_peers()
    sentences = capsys.readouterr().out.splitlines()
    for peer, sentence in zip(PEERS, sentences, strict=True):
        assert f"{peer.name} is left out: {next(iter(peer.packages))} is not installed" in sentence
    assert (tmp_path / "peers.csv").read_text() == PEERS_CSV, "what was measured elsewhere stays"


def test_the_package_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def elastica_only(distribution: str) -> str:
        if distribution != ELASTICA[0]:
            raise importlib.metadata.PackageNotFoundError(distribution)
        return "1.0.0"

    monkeypatch.setattr(importlib.metadata, "version", elastica_only)
    sentences = {peer.name: why_missing(peer) for peer in PEERS}
    assert sentences["PyElastica"] is None
    assert "magpylib is not installed" in str(sentences["PyElastica with magpylib"])


def test_another_major_version_is_left_out_with_both_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.metadata, "version", lambda _: "4.0.0")
    for peer in PEERS:
        assert f"4.0.0 is installed, not {next(iter(peer.packages.values()))}" in str(why_missing(peer))


def test_a_peer_of_the_right_version_is_not_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    majors = {package: f"{major}.7.1" for peer in PEERS for package, major in peer.packages.items()}
    monkeypatch.setattr(importlib.metadata, "version", majors.__getitem__)
    assert [why_missing(peer) for peer in PEERS] == [None] * len(PEERS)


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
    run = run_at(tip_only(x_mm + 3.0, y_mm - 4.0), tip_only(x_mm, y_mm + 5.4))
    assert run.error == pytest.approx(5.0 / 54.0)
    assert run.own_error == pytest.approx((3.0**2 + 9.4**2) ** 0.5 / 54.0)


def test_distances_are_averaged_over_points_and_instants() -> None:
    still = np.zeros((3, 2, 2))
    moved = still.copy()
    moved[1, 0] = 3.0, 4.0
    assert apart(moved, still) == pytest.approx((25.0 / 6.0) ** 0.5 / 54.0)


def test_the_longest_step_that_neither_breaks_nor_changes_when_halved_is_found() -> None:
    def release(_: int, step_s: float):
        if step_s > 1 / 99.5:
            return lambda: INFINITE
        return lambda: tip_only(50.0, -40.0) if step_s > 1 / 149.5 else tip_only(50.0, -10.0)

    def fewest_steps(**how) -> int:
        return round(1.0 / longest_step_s(release, 9, 0.1, **how))

    assert 150 <= fewest_steps() <= 165
    assert fewest_steps(instants=40) == 160
    assert fewest_steps(same=1.0) <= 110


def test_what_is_never_stable_is_said() -> None:
    with pytest.raises(RuntimeError, match="no step is stable: tried 10 to"):
        longest_step_s(lambda _, __: lambda: INFINITE, 9, 0.1)


def test_each_mesh_is_run_at_its_longest_stable_step_and_at_half_of_it() -> None:
    def release(elements: int, step_s: float):
        stable = step_s * elements <= 0.1
        return lambda: tip_only(float(elements), 0.0) if stable else INFINITE

    runs = measured(release, {10: 0.01, 20: 0.005})
    assert [run.elements for run in runs] == [10, 10, 20, 20]
    for long, short in (runs[:2], runs[2:]):
        assert short.step_s == pytest.approx(0.5 * long.step_s)
        assert 0.1 / 1.2 <= long.step_s * long.elements <= 0.1
        assert long.track_mm.tolist() == [[[float(long.elements), 0.0]]]


def moment_of_inertia(rod: MagnetRod, middle: int) -> float:
    """Of a magnet's elements and nodes about z through its middle [kg·m²]; its ends are half rubber's."""
    ends = [middle - 1, middle + 1]
    rubber_kg = (
        0.5 * cantilever.DENSITY_KG_M3 * cantilever.AREA_M2 * np.diff(rod.nodes_m)[[middle - 2, middle + 1]]
    )
    arms_m = rod.nodes_m[ends] - rod.nodes_m[middle]
    return float(
        (rod.masses_kg[ends] - rubber_kg) @ arms_m**2 + rod.inertias_kg_m2[0, [middle - 1, middle]].sum()
    )


@pytest.mark.parametrize("elements", [18, 27, 54])
def test_the_rod_with_magnets_is_that_of_the_scene(elements: int) -> None:
    rod = magnet_rod(elements, AS_IT_IS)
    assert rod.nodes_m[0] + rod.nodes_m[1] == pytest.approx(0.0, abs=1e-15)
    assert rod.nodes_m[-1] == pytest.approx(cantilever.LENGTH_M)
    np.testing.assert_allclose(rod.nodes_m[rod.middles], PLACES_M)

    magnet = ROBOT["magnet"]
    magnet_m3 = magnet["length_m"] * magnet["width_m"] * magnet["height_m"]
    heavier_kg_m3 = magnet["density_kg_m3"] - cantilever.DENSITY_KG_M3
    rubber_kg = cantilever.DENSITY_KG_M3 * cantilever.AREA_M2 * np.ptp(rod.nodes_m)
    assert rod.masses_kg.sum() == pytest.approx(rubber_kg + len(PLACES_M) * heavier_kg_m3 * magnet_m3)
    for middle in rod.middles:
        assert moment_of_inertia(rod, middle) == pytest.approx(magnet_inertia()[1][0])


def test_rubber_alone_bends_the_rod_with_magnets() -> None:
    """A bend gives (length of both halves)/(stiffness); together they give as the rubber's length does."""
    for stiffening in (AS_IT_IS, HARDLY_SHEARS):
        rod = magnet_rod(27, stiffening)
        lengths_m = np.diff(rod.nodes_m)
        gives = (0.5 * (lengths_m[1:] + lengths_m[:-1]) / rod.bend_n_m2[0]).sum()
        magnet_m = ROBOT["magnet"]["length_m"]
        rigid_m = 2.0 * magnet_m * (1.0 - 0.5 / stiffening.magnet_bending)
        ends_m = 0.5 * (lengths_m[0] + lengths_m[-1])  # the last element's half has no neighbour
        soft_m = np.ptp(rod.nodes_m) - ends_m - rigid_m
        assert gives * cantilever.YOUNGS_MODULUS_PA * cantilever.WEAK_M4 == pytest.approx(soft_m)


def test_validates_the_wrench_that_magpylib_gives_the_rod() -> None:
    """Against MagWorm's cuboids with fine quadrature, a little nearer to the drive than the rod comes."""
    pytest.importorskip("magpylib", minversion="6")
    from studies.error.peers.magpylib_wrench import DriveMagnet

    drive, magnet = ROBOT["drive"], ROBOT["magnet"]
    sizes = [[box[name] for name in ("length_m", "height_m", "width_m")] for box in (drive, magnet)]
    places_m, angles = np.array([[-0.020, 0.028, 0.0], [0.005, 0.030, 0.0]]), np.radians([-10.0, 40.0])
    found = DriveMagnet().wrenches(np.zeros(3), places_m, angles)
    quaternions = np.stack([np.cos(0.5 * angles), 0.0 * angles, 0.0 * angles, np.sin(0.5 * angles)], axis=-1)
    force_n, torque_n_m = wrench(
        *sizes,
        places_m,
        quaternions,
        drive_magnetisation_t=(0.0, drive["remanence_t"], 0.0),
        body_magnetisation_t=np.outer(POLARITIES, (0.0, magnet["remanence_t"], 0.0)),
        order=10,
    )
    np.testing.assert_allclose(found[:, :2], force_n[:, :2], rtol=0.0, atol=1e-3 * np.abs(force_n).max())
    np.testing.assert_allclose(found[:, 2], torque_n_m[:, 2], rtol=0.0, atol=1e-3 * np.abs(torque_n_m).max())


def test_between_computations_values_are_on_the_line_through_the_last_two() -> None:
    pytest.importorskip("magpylib", minversion="6")
    from studies.error.peers.magpylib_wrench import Extrapolated

    asked = []

    def line(call: int) -> np.ndarray:
        asked.append(call)
        return np.array([3.0 + 2.0 * call])

    values = Extrapolated(4, line)
    found = [float(values(call)[0]) for call in range(12)]
    assert asked == [0, 4, 8]
    assert found[:4] == [3.0] * 4, "at first there is no slope"
    assert found[4:] == [3.0 + 2.0 * call for call in range(4, 12)]


def test_validates_the_rod_with_magnets_against_elastica_and_magpylib() -> None:
    """Within 2 % of the motion, 15 mm; PyElastica's rod shears."""
    pytest.importorskip("elastica")
    pytest.importorskip("magpylib", minversion="6")
    from studies.error.peers.elastica_magnets import released

    reference = reference_mm("magnets")
    found_mm = released(HARDLY_SHEARS, 40, 18, 1.0 / 16_000)()
    motion = apart(reference, np.broadcast_to(reference[0], reference.shape))
    assert apart(found_mm, reference) < 0.02 * motion
