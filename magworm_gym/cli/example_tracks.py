"""``magworm example-tracks``: a film that was never made, to try ``magworm identify`` on."""

import argparse
import shlex
from pathlib import Path
from typing import Any

from magworm_gym.cli.flags import add_constant_drive, add_set, constant_drive, set_values
from magworm_gym.identification.camera import Camera
from magworm_gym.identification.example_tracks import Blur, write_example_tracks
from magworm_gym.identification.experiment import edited_scene
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.paths import scene_numbers
from magworm_gym.scene import load_scene

STIFFNESS, STATIC, DYNAMIC = "material.youngs_modulus_pa", "ground.static_friction", "ground.dynamic_friction"

TRUTH = {STIFFNESS: 0.9, STATIC: 1.13}
"""Path → what the example's value is of the scene's [1]."""

LOW, HIGH = 0.6, 1.6
"""Bounds in the command that finds the values again, in parts of the scene's [1]."""

DESCRIPTION = """\
Simulates a robot that a drive magnet passes once, adds the noise, lost points and outliers of a tracked
film, and writes them as DeepLabCut would. Stiffness and static friction differ from the scene's, unless
--set says otherwise; magworm identify should find them again.
"""


def add_to(commands: Any) -> None:
    """Adds the command to the parsers of ``magworm``."""
    parser = commands.add_parser(
        "example-tracks", help="write tracks of a simulated robot, to try identify", description=DESCRIPTION
    )
    parser.set_defaults(run=run, mistake=ProblemError)
    parser.add_argument("file", type=Path, help="CSV file to write")
    parser.add_argument("--scene", default="paper-3", help="preset or TOML file (default %(default)s)")
    add_set(parser)
    add_constant_drive(parser, -0.05, 0.1)
    parser.add_argument("--duration-s", type=float, default=1.5, metavar="S", help="(default %(default)s)")
    parser.add_argument("--metres-per-pixel", type=float, default=1.5e-4, metavar="M", help="(%(default)s)")
    parser.add_argument("--frames-per-second", type=float, default=60.0, metavar="N", help="(%(default)s)")
    parser.add_argument("--noise-px", type=float, default=1.0, metavar="PX", help="(%(default)s)")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="seed of the noise (%(default)s)")


def run(parsed: argparse.Namespace) -> None:
    """Runs the command.

    Raises:
        ProblemError: A mistake in flags, or the file exists.
    """
    if parsed.file.exists():
        raise ProblemError(f"file is {str(parsed.file)!r}, which exists; allowed: a new one")
    base = load_scene(parsed.scene)
    numbers = scene_numbers(base)
    if STATIC not in numbers:
        raise ProblemError(f"scene is {parsed.scene!r}, which has no ground; allowed: one with a ground")
    truth = {path: float(f"{factor * numbers[path]:.3g}") for path, factor in TRUTH.items()}
    values = {**truth, **set_values(parsed.set), "drive.motion": constant_drive(parsed)}
    scene = edited_scene(base, values, "--set")
    camera = Camera(parsed.metres_per_pixel, parsed.frames_per_second)
    middle = ["middle"] if scene.magnets == 3 else [f"middle{at}" for at in range(1, scene.magnets - 1)]
    parts = ["head", *middle, "tail"][: scene.magnets]
    try:
        write_example_tracks(
            parsed.file, scene, parsed.duration_s, camera, parts, blur=Blur(parsed.noise_px), seed=parsed.seed
        )
    except (ValueError, OSError) as error:
        raise ProblemError(str(error)) from error
    print(f"{parsed.file}: {', '.join(f'{path} = {values[path]:g}' for path in TRUTH)}; to find them again:")
    print(_command(parsed, parts, numbers))


def _command(parsed: argparse.Namespace, parts: list[str], numbers: dict[str, float]) -> str:
    """The command that finds the values again."""
    words = ["magworm", "identify", "--scene", parsed.scene, "--tracks", str(parsed.file)]
    words += ["--metres-per-pixel", f"{parsed.metres_per_pixel:.12g}"]
    words += ["--frames-per-second", f"{parsed.frames_per_second:.12g}", "--magnets", *parts]
    for path in TRUTH:
        low = max(LOW * numbers[path], numbers[DYNAMIC] if path == STATIC else 0.0)
        words += ["--fit", path, f"{low:.3g}", f"{HIGH * numbers[path]:.3g}"]
    for path, text in parsed.set:
        if path not in TRUTH:
            words += ["--set", path, text]
    words += ["--drive-x", f"{parsed.drive_x:.12g}", "--drive-y", f"{parsed.drive_y:.12g}"]
    words += ["--drive-speed", f"{parsed.drive_speed:.12g}", "--out", "runs/fit"]
    return shlex.join(words)
