"""Fitting a scene to numbers and to tracks."""

import json
from pathlib import Path

import numpy as np
import pytest

from magworm_gym import Recording, Scene
from magworm_gym.identification import (
    Camera,
    Identification,
    ProblemError,
    identify,
    make_problem,
    read_problem,
    write_example_tracks,
    write_results,
)
from magworm_gym.identification.evaluation import BROKEN, REFUSED, Evaluator
from magworm_gym.identification.paths import scene_numbers
from magworm_gym.identification.quantities import Quantity
from magworm_gym.identification.targets import target

PASS = {"drive.motion": {"kind": "constant", "x_m": -0.05, "y_m": -0.022, "speed_m_s": 0.1}}
ROBOT = {
    "body.foot_length_m": 0.014,
    "body.width_m": 0.021,
    "material.youngs_modulus_pa": 75e3,
    "material.damping_time_s": 0.0076,
    "magnet.length_m": 0.0083,
    "magnet.width_m": 0.0092,
    "magnet.height_m": 0.0023,
    "drive.length_m": 0.0253,
    "drive.width_m": 0.0427,
    "drive.height_m": 0.0033,
    "ground.static_friction": 0.75,
    "ground.dynamic_friction": 0.63,
    "ground.transition_speed_m_s": 0.008889,
    "ground.adhesion_n": 0.0009,
    "magnetic_terms.mutual": False,
}
"""Values that these tests count on, whatever the preset's are."""
CAMERA = Camera(metres_per_pixel=1.5e-4, frames_per_second=60.0)
PARTS = ["head", "middle", "tail"]
FILM = {"file": "worm.csv", "metres_per_pixel": 1.5e-4, "frames_per_second": 60.0, "magnets": PARTS}
SMALL = {"restarts": 2, "population": 10, "generations": 25, "scatter": 96, "rounds": 4}


def film_problem(folder, truth, parameters, seed=0, search=SMALL, **tracks):
    scene = Scene.preset("paper-3").with_values({**ROBOT, **truth, **PASS})
    write_example_tracks(folder / "worm.csv", scene, 1.5, CAMERA, PARTS, seed=seed)
    experiment = {"name": "pass", "values": PASS, "tracks": {**FILM, **tracks}}
    return make_problem(
        {
            "scene": "paper-3",
            "values": ROBOT,
            "parameters": parameters,
            "experiment": [experiment],
            "search": search,
        },
        folder,
    )


def short_problem(**search):
    """A problem of one number, quick to simulate."""
    experiment = {
        "name": "pass",
        "duration_s": 0.4,
        "values": PASS,
        "targets": [{"quantity": "peak_m", "magnet": 0, "value": 2.8e-3, "tolerance": 2e-5}],
    }
    return make_problem(
        {
            "scene": "paper-3",
            "values": ROBOT,
            "parameters": {
                "material.youngs_modulus_pa": {"low": 45e3, "high": 120e3, "scale": "log"},
                "ground.static_friction": {"low": 0.64, "high": 1.2},
            },
            "experiment": [experiment],
            "search": {
                "restarts": 2,
                "population": 6,
                "generations": 6,
                "scatter": 16,
                "rounds": 2,
                **search,
            },
        },
        Path(),
    )


def test_a_field_of_one_segment_is_fitted(tmp_path):
    (tmp_path / "scene.toml").write_text(Scene.preset("paper-3").in_segments().to_toml())
    path = "body.segment[2].thickness_m"
    aim = {"quantity": "peak_m", "magnet": 1, "value": 8e-3, "tolerance": 1e-4}
    problem = make_problem(
        {
            "scene": "scene.toml",
            "parameters": {path: {"low": 0.005, "high": 0.0069}},
            "experiment": [{"duration_s": 0.2, "values": PASS, "targets": [aim]}],
            "search": {"restarts": 1, "population": 4, "generations": 3, "scatter": 8, "rounds": 1},
        },
        tmp_path,
    )
    assert scene_numbers(problem.base)[path] == 0.007
    found = identify(problem)
    fitted = scene_numbers(found.scene)[path]
    assert 0.005 <= fitted <= 0.0069
    assert found.scene.geometry["element_thickness_m"].count(fitted) == 3


def path_recording(x_m, y_m):
    poses = np.zeros((len(x_m), 2, 3))
    poses[:, 1, 0], poses[:, 1, 1] = x_m, y_m
    time_s = np.arange(len(x_m)) * 0.01
    return Recording(time_s, np.empty((len(x_m), 0, 2)), poses, np.ones(2, bool), np.zeros((len(x_m), 1, 2)))


@pytest.mark.parametrize(("youngs_modulus_pa", "static_friction", "seed"), [(68e3, 0.85, 0), (95e3, 0.7, 1)])
def test_noisy_tracks_of_one_pass_give_stiffness_and_friction_within_5_percent(
    tmp_path, youngs_modulus_pa, static_friction, seed
):
    truth = {"material.youngs_modulus_pa": youngs_modulus_pa, "ground.static_friction": static_friction}
    parameters = {
        "material.youngs_modulus_pa": {"low": 45e3, "high": 120e3},
        "ground.static_friction": {"low": 0.64, "high": 1.2},
    }
    found = identify(film_problem(tmp_path, truth, parameters, seed))
    assert found.values == pytest.approx(truth, rel=0.05)
    for finding in found.findings:
        assert finding.fits_from <= truth[finding.parameter.path] <= finding.fits_to
        assert finding.verdict == "identified"


def test_remanences_that_only_act_as_a_product_are_said_not_to_be_identifiable(tmp_path):
    bounds = {"low": 0.8, "high": 1.6}
    problem = film_problem(
        tmp_path,
        {},
        {"magnet.remanence_t": bounds, "drive.remanence_t": bounds},
        search={**SMALL, "restarts": 3, "rounds": 10},
    )
    found = identify(problem)
    values = found.values
    assert values["magnet.remanence_t"] * values["drive.remanence_t"] == pytest.approx(1.22**2, rel=0.03)
    assert [finding.verdict for finding in found.findings] == ["not identifiable"] * 2
    (free,) = found.free
    assert np.prod(np.sign(free.direction)) == -1 and free.length > 0.5
    write_results(found, tmp_path)
    report = (tmp_path / "report.md").read_text()
    assert "not identifiable from these data: any value from" in report
    assert "fits as well, together with other values of drive.remanence_t" in report
    assert "Free: " in report


def test_friction_is_not_identifiable_where_nothing_slides(tmp_path):
    far = {"drive.motion": {"kind": "constant", "x_m": -0.05, "y_m": -0.06, "speed_m_s": 0.1}}
    experiment = {
        "name": "far",
        "values": far,
        "duration_s": 0.2,
        "targets": [{"quantity": "stride_m", "value": 0.0, "tolerance": 1e-5}],
    }
    problem = make_problem(
        {
            "scene": "paper-3",
            "values": ROBOT,
            "parameters": {"ground.dynamic_friction": {"low": 0.3, "high": 0.75}},
            "experiment": [experiment],
            "search": SMALL,
        },
        tmp_path,
    )
    (finding,) = identify(problem).findings
    assert finding.verdict == "not identifiable"
    assert "any value from 0.3" in finding.sentences()[0]
    assert np.isinf(finding.std_alone)


def interrupted_at(stage, done):
    def progress(now, count, most, best):
        if (now, count) == (stage, done):
            raise KeyboardInterrupt

    return progress


def as_files(found: Identification, folder):
    write_results(found, folder)
    return [(folder / name).read_text() for name in ("scene.toml", "report.md", "report.json")]


def test_a_search_that_was_stopped_twice_goes_on_to_the_identical_result(tmp_path):
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    expected = as_files(identify(short_problem(), whole, threads=1), whole)
    with pytest.raises(KeyboardInterrupt, match=r"kept in .*parts.*resume=True"):
        identify(short_problem(), parts, progress=interrupted_at("search", 3))
    with pytest.raises(KeyboardInterrupt, match=r"kept in .*parts.*resume=True"):
        identify(short_problem(), parts, resume=True, progress=interrupted_at("explore", 1))
    resumed = identify(short_problem(), parts, resume=True, threads=2)
    assert as_files(resumed, parts) == expected
    with np.load(whole / "candidates.npz") as first, np.load(parts / "candidates.npz") as second:
        assert np.array_equal(first["units"], second["units"])
        assert np.array_equal(first["losses"], second["losses"])


def test_a_folder_in_use_and_another_problem_are_refused(tmp_path):
    with pytest.raises(KeyboardInterrupt):
        identify(short_problem(), tmp_path, progress=interrupted_at("search", 1))
    with pytest.raises(ProblemError, match="not empty; allowed: a new folder, or --resume"):
        identify(short_problem(), tmp_path)
    with pytest.raises(ProblemError, match="another problem, other settings"):
        identify(short_problem(seed=1), tmp_path, resume=True)


def test_bounds_that_no_scene_fits_in_are_refused_with_the_reason():
    problem = make_problem(
        {
            "scene": "paper-3",
            "values": ROBOT,
            "parameters": {"ground.static_friction": {"low": 0.1, "high": 0.2}},
            "experiment": [
                {
                    "duration_s": 0.1,
                    "values": PASS,
                    "targets": [{"quantity": "stride_m", "value": 0.0, "tolerance": 1e-3}],
                }
            ],
            "search": SMALL,
        },
        Path(),
    )
    with pytest.raises(
        ProblemError, match=r"no candidate within the bounds can be simulated; .*dynamic_friction"
    ):
        identify(problem)


def test_quantities_are_what_a_ruler_would_measure():
    recording = path_recording([0.02, 0.01, 0.012], [0.003, 0.006, 0.004])
    measured = {
        kind: Quantity(kind, 1).measure(recording)
        for kind in ("lift_m", "peak_m", "stride_m", "displacement_m")
    }
    assert measured == pytest.approx(
        {"lift_m": 1e-3, "peak_m": 3e-3, "stride_m": 8e-3, "displacement_m": np.hypot(8e-3, 1e-3)}
    )
    assert Quantity("stride_m").measure(recording) == pytest.approx(4e-3)


def test_targets_count_in_tolerances_and_bounds_are_hinges():
    runs = {
        "a": path_recording([0.02, 0.01], [0.003, 0.003]),
        "b": path_recording([0.02, 0.019], [0.003, 0.003]),
    }
    stride = Quantity("stride_m", 1)
    assert target(("a", stride), 9e-3, 9e-3, 1e-3).residuals(runs) == pytest.approx([1.0], rel=1e-3)
    assert target(("a", stride), -np.inf, 11e-3, 1e-3).residuals(runs) == [0.0]
    assert target(("a", stride), 11e-3, np.inf, 1e-3).compared(runs)[1] == pytest.approx([-1.0])
    assert target(("a", stride), 8e-3, np.inf, 1e-3, True, ("b", stride)).residuals(runs) == [0.0]
    lead = target(("a", stride), 10e-3, np.inf, 1e-3, True, ("b", stride))
    assert lead.compared(runs)[1] == pytest.approx([-1.0])
    wild = target(("a", stride), 1.0, 1.0, 1e-6).residuals(runs) ** 2
    assert 1e3 < wild[0] < 1e4


def test_refused_scenes_are_worse_than_broken_ones_and_those_than_any_other():
    problem = make_problem(
        {
            "scene": "paper-3",
            "values": ROBOT,
            "parameters": {"ground.static_friction": {"low": 0.1, "high": 1.2}},
            "experiment": [
                {
                    "name": "pass",
                    "duration_s": 0.2,
                    "values": PASS,
                    "targets": [{"quantity": "stride_m", "value": 9.0, "tolerance": 1e-6}],
                }
            ],
        },
        Path(),
    )
    worst, bad, good = Evaluator(problem).losses_and_shares(
        np.array([[0.0], [0.2], [0.9]]), np.full(3, np.inf)
    )[0]
    assert good < BROKEN < REFUSED < bad < worst


def test_the_written_scene_says_where_values_come_from_and_loads_again(tmp_path):
    found = identify(short_problem())
    write_results(found, tmp_path)
    text = (tmp_path / "scene.toml").read_text()
    assert Scene.from_toml(text) == found.scene
    assert found.scene == Scene.preset("paper-3").with_values({**ROBOT, **found.values})
    lines = {line.split(" = ")[0]: line for line in text.splitlines() if " = " in line}
    assert "identif" in lines["youngs_modulus_pa"].split("#")[1]
    assert lines["adhesion_n"].endswith("# set in the problem")
    assert lines["gravity_m_s2"].endswith("# as in paper-3")
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["values"] == found.values
    assert report["targets"][0]["name"] == "pass: peak_m of magnet 0"


def test_ratios_logarithms_and_known_values(tmp_path):
    (tmp_path / "problem.toml").write_text(
        """
        scene = "paper-3"
        [parameters]
        "material.youngs_modulus_pa" = { low = 1e4, high = 1e6, scale = "log" }
        "ground.static_friction" = { low = 0.5, high = 1.5 }
        "ground.dynamic_friction" = { low = 0.5, high = 1.0, times = "ground.static_friction" }
        [[experiment]]
        name = "slow"
        duration_s = 0.1
        [experiment.values]
        "ground.static_friction" = 0.9
        "ground.dynamic_friction" = 0.8
        "drive.motion" = { kind = "constant", x_m = -0.05, y_m = -0.022, speed_m_s = 0.1 }
        [[experiment.targets]]
        quantity = "lift_m"
        magnet = 2
        at_most = 1e-3
        tolerance = 1e-4
        [[experiment]]
        name = "still"
        duration_s = 0.1
        values = { "drive.motion" = { kind = "constant", x_m = -0.05, y_m = -0.022, speed_m_s = 0.0 } }
        [[comparison]]
        greater = "slow.peak_m.0"
        less = "still.peak_m.0"
        tolerance = 1e-4
        """
    )
    problem = read_problem(tmp_path / "problem.toml", {"seed": 7})
    values = problem.space.scene_values(np.array([0.5, 0.5, 0.0]))
    assert values["material.youngs_modulus_pa"] == pytest.approx(1e5)
    assert values["ground.dynamic_friction"] == pytest.approx(0.5)
    assert problem.space.unit_of(values) == pytest.approx([0.5, 0.5, 0.0])
    slow, still = (experiment.fitted_scene(values).to_toml() for experiment in problem.experiments)
    assert "static_friction = 0.9\n" in slow and "dynamic_friction = 0.8\n" in slow
    assert "static_friction = 1.0\n" in still and "dynamic_friction = 0.5\n" in still
    assert problem.settings.seed == 7
