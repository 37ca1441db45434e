"""Files and flags of the identification, and what is said of mistakes in them."""

import datetime
import sys
from pathlib import Path

import numpy as np
import pytest

from magworm_gym import Scene, record_scenes
from magworm_gym.cli import main
from magworm_gym.identification import (
    Blur,
    Camera,
    ProblemError,
    make_problem,
    read_deeplabcut,
    read_problem,
    write_example_tracks,
)
from magworm_gym.identification.quantities import MEASURES

REPOSITORY = Path(__file__).parent.parent
PASS = {"drive.motion": {"kind": "constant", "x_m": -0.05, "y_m": -0.022, "speed_m_s": 0.1}}
HEADER = "scorer,s,s,s\nbodyparts,head,head,head\ncoords,x,y,likelihood\n"
TRACKS = {"file": "worm.csv", "metres_per_pixel": 1e-4, "frames_per_second": 50.0, "magnets": ["a", "b", "c"]}


def entries(**experiment):
    experiment = {"values": PASS, "duration_s": 0.1, **experiment}
    return {
        "scene": "paper-3",
        "parameters": {"material.youngs_modulus_pa": {"low": 5e4, "high": 1e5}},
        "experiment": [experiment],
    }


def test_tracks_of_deeplabcut_are_read_with_gaps(tmp_path):
    path = tmp_path / "worm.csv"
    path.write_text(HEADER + "0,1.5,2.5,0.99\n2,,,\n3,4.0,5.0,0.1\n")
    tracks = read_deeplabcut(path)
    assert tracks.frames.tolist() == [0, 2, 3]
    assert tracks.part("head")[0].tolist() == [1.5, 2.5, 0.99]
    assert np.isnan(tracks.part("head")[1]).all()
    with pytest.raises(ProblemError, match="no body part 'tail'; it has: head"):
        tracks.part("tail")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time,x,y\n", "line 1, its beginning is 'time'; allowed: 'scorer'"),
        ("", "line 1, its beginning is ''; allowed: 'scorer'"),
        ("scorer,s\nbodyparts,b\ncoords\n", "has no columns; allowed: x, y, likelihood"),
        (HEADER, "has no frames"),
        (HEADER + "0,1,2\n", "line 4 has 3 columns; allowed: 4"),
        (HEADER + "0,1,two,1\n", "line 4, column 3 is 'two'; allowed: a number or nothing"),
        (
            HEADER + "1,1,2,1\n1,1,2,1\n",
            "line 5, column 1 is '1'; allowed: the frame's number, a whole one, greater than 1",
        ),
        (
            HEADER.replace("likelihood", "z") + "0,1,2,3\n",
            "coordinates 'z' of 'head'; allowed: x",
        ),
        (HEADER.replace("x,", "likelihood_,") + "0,1,2,3\n", "coordinates 'likelihood_' of 'head'"),
        (HEADER.replace("x,y", "y,x_ens_median") + "0,1,2,3\n", "lacks 'x' of body part 'head'"),
    ],
)
def test_another_form_of_tracks_is_refused_with_line_and_column(tmp_path, text, message):
    path = tmp_path / "worm.csv"
    path.write_text(text)
    with pytest.raises(ProblemError, match=message):
        read_deeplabcut(path)


@pytest.mark.parametrize("camera", [
    Camera(1e-4, 50.0),
    Camera(1e-4, 50.0, head="right", y_axis="up", angle_deg=7.0, origin="start"),
    Camera(1e-4, 50.0, head="right", angle_deg=-12.0, origin=(30.0, 40.0)),
])  # fmt: skip
def test_a_camera_in_any_pose_sees_the_same_robot(tmp_path, camera):
    scene = Scene.preset("paper-3").with_values(PASS)
    blur = Blur(noise_px=0.0, lost=0.05, wrong=0.0, origin_px=(30.0, 40.0))
    write_example_tracks(tmp_path / "worm.csv", scene, 0.5, camera, ["a", "b", "c", "drive"], blur=blur)
    origin = camera.origin if isinstance(camera.origin, str) else list(camera.origin)
    pose = {"head": camera.head, "y_axis": camera.y_axis, "angle_deg": camera.angle_deg, "origin": origin}
    values = {"drive.motion": {"kind": "constant", "x_m": 0.0, "y_m": -0.05, "speed_m_s": 0.0}}
    problem = make_problem(
        entries(values=values, duration_s=0.5, tracks={**TRACKS, **pose}, drive={"part": "drive"}), tmp_path
    )
    run = record_scenes([problem.experiments[0].scene], 0.5, problem.sample_s)[0]
    assert run.drive_positions[-1, 0] == pytest.approx([-0.001, -0.022], abs=1.1e-3)
    film = problem.aims[0]
    assert np.abs(film.deviation_m(record_scenes([scene], 0.5, 0.002)[0])).max() < 2e-5


def test_a_measured_drive_becomes_waypoints(tmp_path):
    (tmp_path / "stage.csv").write_text("time_s,x_m,y_m\n1.0,0.0,-0.03\n1.2,0.02,-0.03\n1.4,0.04,-0.02\n")
    targets = [{"quantity": "lift_m", "value": 0.0, "tolerance": 1e-3}]
    problem = make_problem(
        entries(values={}, targets=targets, drive={"file": "stage.csv", "start_s": 1.1}), tmp_path
    )
    run = record_scenes([problem.experiments[0].scene], 0.1, 0.05)[0]
    assert run.drive_positions[:, 0] == pytest.approx(
        np.array([[0.01, -0.03], [0.015, -0.03], [0.02, -0.03]])
    )
    (tmp_path / "stage.csv").write_text("time_s,x_m,y_m\n0,0,-0.03\n0.1,left,-0.03\n")
    with pytest.raises(ProblemError, match=r"line 3, column x_m is 'left'; allowed: a number"):
        make_problem(entries(values={}, targets=targets, drive={"file": "stage.csv"}), tmp_path)


def test_a_parameter_of_a_drive_is_not_fitted_where_a_stage_was_measured(tmp_path):
    (tmp_path / "stage.csv").write_text("time_s,x_m,y_m\n0,0.0,-0.03\n0.2,0.02,-0.03\n")
    measured = {"name": "stage", "duration_s": 0.1, "targets": [TARGET], "drive": {"file": "stage.csv"}}
    made = entries(targets=[TARGET])
    made["experiment"].append(measured)
    made["parameters"] = {"drive.motion.x_m": {"low": -0.06, "high": -0.04}}
    one, other = make_problem(made, tmp_path).experiments
    assert "drive.motion.x_m" not in one.known and "drive.motion.x_m" in other.known
    assert "x_m = -0.045\n" in one.fitted_scene({"drive.motion.x_m": -0.045}).to_toml()
    assert other.fitted_scene({"drive.motion.x_m": -0.045}) == other.scene


TARGET = {"quantity": "stride_m", "value": 1e-3, "tolerance": 1e-5}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"targets": [{**TARGET, "quantity": "jump_m"}]},
            r"experiment\[0\].targets\[0\].quantity is 'jump_m'",
        ),
        ({"targets": [{**TARGET, "magnet": 3}]}, "magnet is 3; allowed: a whole number from 0 to 2"),
        ({"targets": [{**TARGET, "tolerance": 0}]}, "tolerance is 0"),
        ({"targets": [{"quantity": "lift_m", "tolerance": 1.0}]}, "allowed: value, at_least or at_most"),
        (
            {"targets": [{**TARGET, "weight": 2}]},
            r"targets\[0\].weight is not a setting; allowed here: quantity",
        ),
        ({"targets": []}, "nothing is fitted; allowed: at least one target"),
        ({"targets": [TARGET], "values": {}}, "the drive is a controlled one and would stand still"),
        ({"targets": [TARGET], "values": {"ground.statik": 1}}, "ground.statik is not a field of a scene"),
        ({"targets": [TARGET], "duration_s": 0.0011}, "duration_s of experiment 'experiment-1' is 0.0011"),
        ({"tracks": {**TRACKS, "magnets": ["a"]}}, "the body part of each of the 3 magnets from the head"),
        ({"tracks": {**TRACKS, "frames_per_second": "60"}}, "frames_per_second is '60'; allowed: a number"),
    ],
)
def test_mistakes_in_a_problem_are_said_in_a_sentence(tmp_path, change, message):
    path = tmp_path / "worm.csv"
    scene = Scene.preset("paper-3").with_values(PASS)
    write_example_tracks(path, scene, 0.1, Camera(1e-4, 50.0), ["a", "b", "c"])
    with pytest.raises(ProblemError, match=message):
        make_problem(entries(**change), tmp_path)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({}, "parameters is empty"),
        (
            {"material.youngs_modulus_pa": {"low": 5.0}},
            r"youngs_modulus_pa.high is missing; allowed: a number",
        ),
        (
            {"material.youngs_modulus_pa": {"low": 5.0, "high": 4.0}},
            "low is 5.0; allowed: a number less than",
        ),
        ({"material.stiffness": {"low": 5.0, "high": 6.0}}, "no number in the scene of experiment"),
        ({"drive.motion": {"low": 5.0, "high": 6.0}}, "is set by the values of every experiment"),
        (
            {"ground.dynamic_friction": {"low": 0.5, "high": 1.0, "times": "ground.static_friction"}},
            "allowed: another parameter that is no ratio itself",
        ),
    ],
)
def test_mistakes_in_parameters_are_said_in_a_sentence(tmp_path, parameters, message):
    with pytest.raises(ProblemError, match=message):
        make_problem({**entries(targets=[TARGET]), "parameters": parameters}, tmp_path)


def command(capsys, *arguments):
    with pytest.raises(SystemExit) as stopped:
        main([str(argument) for argument in arguments])
    return stopped.value.code, capsys.readouterr()


def test_the_command_fits_example_tracks_and_refuses_the_same_folder(tmp_path, capsys):
    csv, out = tmp_path / "worm.csv", tmp_path / "fit"
    code, said = command(capsys, "example-tracks", csv, "--duration-s", 1.0)
    assert code == 0
    words = said.out.splitlines()[1].split()
    assert words[:2] == ["magworm", "identify"]
    words = [*words[1:-1], str(out)]
    small = ["--restarts", 1, "--population", 6, "--generations", 4, "--scatter", 24, "--rounds", 1]
    code, said = command(capsys, *words, *small)
    assert code == 0, said.err
    assert said.out.startswith("material.youngs_modulus_pa = ")
    assert {path.name for path in out.iterdir()} == {
        "candidates.npz",
        "report.json",
        "report.md",
        "scene.toml",
    }
    code, said = command(capsys, *words, *small)
    assert code == 2
    assert said.err.startswith("magworm identify: out is") and said.err.count("\n") == 1
    code, said = command(capsys, *words, *small, "--resume", "--quiet")
    assert (code, said.out, said.err) == (0, "", "")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["identify", "--out", "x"], "neither a problem file nor --tracks is given"),
        (["identify", "nowhere.toml", "--out", "x"], "problem file nowhere.toml cannot be read"),
        (["identify", "--tracks", "t.csv", "--out", "x"], "--metres-per-pixel is missing"),
        (["identify", "p.toml", "--tracks", "t.csv", "--out", "x"], "allowed: one or the other"),
    ],
)
def test_the_command_says_what_is_wrong_in_a_sentence(capsys, arguments, message):
    code, said = command(capsys, *arguments)
    assert code == 2
    assert message in said.err and said.err.count("\n") == 1


@pytest.mark.parametrize("moment", ["make_problem", "identify", "write_results"])
def test_ctrl_c_says_how_to_go_on_at_any_moment(tmp_path, capsys, monkeypatch, moment):
    csv = tmp_path / "worm.csv"
    words = command(capsys, "example-tracks", csv)[1].out.splitlines()[1].split()[1:-1]
    if moment == "write_results":
        monkeypatch.setattr("magworm_gym.cli.identify.identify", lambda *_, **__: None)
    monkeypatch.setattr(
        f"magworm_gym.cli.identify.{moment}", lambda *_, **__: (_ for _ in ()).throw(KeyboardInterrupt)
    )
    code, said = command(capsys, *words, "fit")
    assert code == 130
    assert "To go on: magworm identify" in said.err and "fit --resume" in said.err
    code, said = command(capsys, *words, "fit", "--resume")
    assert said.err.count("--resume") == 1


def test_a_missing_library_is_named_with_its_extra(tmp_path, capsys, monkeypatch):
    words = command(capsys, "example-tracks", tmp_path / "worm.csv")[1].out.splitlines()[1].split()[1:-1]
    monkeypatch.setitem(sys.modules, "cmaes", None)
    code, said = command(capsys, *words, tmp_path / "fit")
    assert code == 2
    assert "pip install 'magworm-gym[identify]'" in said.err


@pytest.mark.parametrize(
    "problem", sorted((REPOSITORY / "studies/identification").glob("*.toml")), ids=lambda p: p.stem
)
def test_problems_of_the_repository_can_be_read(problem):
    assert read_problem(problem).measurements >= 1


def test_the_problem_of_the_documentation_can_be_read(tmp_path):
    text = (REPOSITORY / "docs/identify.md").read_text(encoding="utf-8")
    (tmp_path / "problem.toml").write_text(text.split("```toml\n")[1].split("```")[0], encoding="utf-8")
    scene = Scene.preset("paper-3").with_values(PASS)
    write_example_tracks(tmp_path / "worm.csv", scene, 1.5, Camera(1.5e-4, 60.0), ["head", "middle", "tail"])
    problem = read_problem(tmp_path / "problem.toml")
    assert len(problem.aims) == 5
    documented = text.split("| quantity | what |")[1].split("\n\n")[0]
    assert all(f"| `{kind}` | {meaning} |" in documented for kind, (_, meaning) in MEASURES.items())


def test_commands_without_their_extra_say_which_and_leave_the_others_alone(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "magworm_gym.cli.identify", None)
    monkeypatch.delattr("magworm_gym.cli.identify")
    code, said = command(capsys, "identify", "--out", "x", "--drive-x", "-5e-2")
    assert code == 2
    assert said.err.startswith("magworm identify: needs the library ")
    assert said.err.endswith("pip install 'magworm-gym[identify]'\n") and said.err.count("\n") == 1
    assert command(capsys, "policies")[0] == 0


def test_values_of_no_type_that_a_scene_has_are_refused():
    for value in (datetime.date(2026, 1, 1), 2**63):
        made = {**entries(targets=[TARGET]), "values": {"material.damping_time_s": value}}
        with pytest.raises(ProblemError, match=r"values: material.damping_time_s is .*; (allowed|leave)"):
            make_problem(made, Path())
