"""``magworm identify``: fit a scene to measured numbers and tracks."""

import argparse
import shlex
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from magworm_gym.cli.flags import add_constant_drive, add_set, constant_drive, set_values
from magworm_gym.cli.progress_bar import ProgressBar
from magworm_gym.identification.identify import Identification, identify
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.problem import Problem, make_problem
from magworm_gym.identification.problem_file import read_problem
from magworm_gym.identification.report import write_results
from magworm_gym.identification.settings import SearchSettings

DESCRIPTION = """\
Fits parameters of a scene to measured numbers (lift, stride, ...) and to tracks of a film (DeepLabCut)
with CMA-ES, and says which parameters the data pin down.

Either a problem file says everything:
  magworm identify problem.toml --out runs/fit
or flags describe one film of one run:
  magworm identify --tracks worm.csv --metres-per-pixel 1.5e-4 --frames-per-second 60 \\
      --magnets head middle tail --fit material.youngs_modulus_pa 45e3 120e3 \\
      --fit ground.static_friction 0.64 1.2 --drive-x -0.05 --drive-speed 0.1 --out runs/fit
"""

EPILOG = """\
The folder gets scene.toml (the fitted scene), report.md, report.json and candidates.npz. Ctrl-C stops;
the same command with --resume goes on and ends with the same result. See docs/identify.md.
"""

SEARCH_FLAGS = {
    "restarts": "evolutions",
    "population": "candidates of each in a generation",
    "generations": "most generations",
    "scatter": "candidates spread over the bounds first",
    "rounds": "rounds that explore what fits as well",
    "seed": "seed of everything random",
}
FILM_FLAGS: dict[str, dict[str, Any]] = {
    "metres_per_pixel": {"type": float, "metavar": "M", "help": "scale of the film [m/px]"},
    "frames_per_second": {"type": float, "metavar": "N", "help": "frame rate [1/s]"},
    "magnets": {"nargs": "+", "metavar": "PART", "help": "part of each magnet from the head; '' for none"},
    "individual": {"metavar": "NAME", "help": "which animal, where the tracks are of several"},
    "start_s": {"type": float, "metavar": "S", "help": "time in the film when the run begins (0)"},
    "head": {"choices": ("left", "right"), "help": "side the head points to (left)"},
    "y_axis": {"choices": ("down", "up"), "help": "direction of growing y of pixels (down)"},
    "angle_deg": {"type": float, "metavar": "DEG", "help": "how much the ground rises rightwards (0)"},
    "least_likelihood": {"type": float, "metavar": "P", "help": "points below are left out (0.6)"},
    "tolerance_m": {"type": float, "metavar": "M", "help": "tracking and model may be off (1.5 px)"},
}
"""Entries of the table ``tracks`` → their flags."""

NEEDED_FLAGS = ("scene", "metres_per_pixel", "frames_per_second", "magnets", "fit")


def add_to(commands: Any) -> None:
    """Adds the command to the parsers of ``magworm``."""
    parser = commands.add_parser(
        "identify",
        help="fit a scene to measured numbers and tracks of a film",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.set_defaults(run=run, mistake=ProblemError)
    add = parser.add_argument
    add("problem", nargs="?", type=Path, help="problem file (TOML)")
    add("--out", type=Path, required=True, help="folder for the results; new or empty")
    add("--resume", action="store_true", help="go on with what is in the folder")
    add("--threads", type=_positive, help="threads (default: all cores); no effect on results")
    add("--without", nargs="+", default=[], metavar="GROUP", help="groups of claims that are only reported")
    add("--blind", action="store_true", help="try neither the scene nor the problem file's starts first")
    add("--quiet", action="store_true", help="no progress bar and no summary")
    add_set(parser)
    search = parser.add_argument_group("search (replaces what the problem file says)").add_argument
    for name, text in SEARCH_FLAGS.items():
        search(f"--{name}", type=int, metavar="N", help=f"{text} ({getattr(SearchSettings(), name)})")
    film = parser.add_argument_group("one film in place of a problem file").add_argument
    film("--scene", default="paper-3", help="preset or TOML file (default %(default)s)")
    film("--tracks", metavar="FILE", help="tracks of DeepLabCut, CSV or HDF5")
    for name, options in FILM_FLAGS.items():
        film(f"--{name.replace('_', '-')}", **options)
    film("--origin", nargs="+", metavar="PX", help="whole (default), start, or the scene's origin, X Y")
    film("--duration-s", type=float, metavar="S", help="how long it is compared (to its end)")
    fit = "a number of the scene to fit, and its bounds; may be repeated"
    film("--fit", nargs=3, action="append", metavar=("PATH", "LOW", "HIGH"), help=fit)
    drive = parser.add_argument_group("motion of the drive during the film")
    add_constant_drive(drive, None, None)
    drive.add_argument("--drive-file", metavar="CSV", help="its motion: columns time_s,x_m,y_m")
    drive.add_argument("--drive-part", metavar="PART", help="body part of the tracks that is the drive")


def _positive(text: str) -> int:
    number = int(text) if text.isdecimal() else 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of at least 1")
    return number


def run(parsed: argparse.Namespace) -> None:
    """Runs the command.

    Raises:
        ProblemError: A mistake in flags or files.
        KeyboardInterrupt: Stopped; how to go on has been printed.
    """
    try:
        _identify(parsed)
    except KeyboardInterrupt:
        words = parsed.words + ([] if parsed.resume else ["--resume"])
        print(f"\nWhat was complete is kept. To go on: magworm {shlex.join(words)}", file=sys.stderr)
        raise


def _identify(parsed: argparse.Namespace) -> None:
    search = _given(parsed, SEARCH_FLAGS)
    if parsed.blind:
        search["blind"] = True
    problem = _problem(parsed, search)
    for remark in problem.noticed:
        print(f"magworm identify: please check: {remark}", file=sys.stderr)
    with ProgressBar(quiet=parsed.quiet) as progress:
        found = identify(problem, parsed.out, resume=parsed.resume, threads=parsed.threads, progress=progress)
    write_results(found, parsed.out)
    if not parsed.quiet:
        print(_summary(found, parsed.out))


def _problem(parsed: argparse.Namespace, search: dict[str, Any]) -> Problem:
    if parsed.problem is not None:
        if parsed.tracks is not None or parsed.fit is not None:
            raise ProblemError("a problem file and --tracks or --fit are given; allowed: one or the other")
        return read_problem(parsed.problem, search, parsed.without, set_values(parsed.set))
    if parsed.tracks is None:
        raise ProblemError("neither a problem file nor --tracks is given; allowed: one of them")
    for name in NEEDED_FLAGS:
        if getattr(parsed, name) is None:
            raise ProblemError(f"--{name.replace('_', '-')} is missing; --tracks needs it")
    return make_problem(_entries(parsed, search), Path())


def _entries(parsed: argparse.Namespace, search: dict[str, Any]) -> dict[str, Any]:
    """What a problem file would hold."""
    tracks = {"file": parsed.tracks, **_given(parsed, FILM_FLAGS), **_origin(parsed)}
    experiment = {"name": "film", "tracks": tracks, **_given(parsed, ["duration_s"]), **_drive(parsed)}
    return {
        "scene": parsed.scene,
        "values": set_values(parsed.set),
        "parameters": {path: {"low": _number(low), "high": _number(high)} for path, low, high in parsed.fit},
        "experiment": [experiment],
        "search": search,
    }


def _given(parsed: argparse.Namespace, names: Iterable[str]) -> dict[str, Any]:
    """Flags that were given."""
    return {name: value for name in names if (value := getattr(parsed, name)) is not None}


def _origin(parsed: argparse.Namespace) -> dict[str, Any]:
    if parsed.origin is None:
        return {}
    if len(parsed.origin) == 2:
        return {"origin": [_number(text) for text in parsed.origin]}
    return {"origin": " ".join(parsed.origin)}


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        raise ProblemError(f"--fit or --origin has {text!r}; allowed: a number") from error


def _drive(parsed: argparse.Namespace) -> dict[str, Any]:
    """The drive of the experiment: its table ``drive``, or values."""
    constant = parsed.drive_x is not None or parsed.drive_speed is not None
    if constant + (parsed.drive_file is not None) + (parsed.drive_part is not None) > 1:
        raise ProblemError(
            "the drive's motion is given twice; allowed: one of --drive-x with --drive-speed, --drive-file "
            "and --drive-part"
        )
    if parsed.drive_file is not None:
        return {"drive": {"file": parsed.drive_file, "start_s": parsed.start_s or 0.0}}
    if parsed.drive_part is not None:
        return {"drive": {"part": parsed.drive_part, "height_m": parsed.drive_y}}
    if not constant:
        return {}
    if parsed.drive_x is None or parsed.drive_speed is None:
        raise ProblemError("only one of --drive-x and --drive-speed is given; allowed: both")
    return {"values": {"drive.motion": constant_drive(parsed)}}


def _summary(found: Identification, out: Path) -> str:
    lines = [
        f"{finding.parameter.label} = {finding.best:.5g}: {'; '.join(finding.sentences())}"
        for finding in found.findings
    ]
    held = [outcome.met for outcome in found.outcomes if not outcome.fitted]
    if held:
        lines.append(f"of {len(held)} targets that were held out {sum(held)} are met")
    lines.append(f"loss {found.loss:.4g} of {found.problem.measurements:.0f} measurements")
    lines.append(f"{out / 'scene.toml'}, {out / 'report.md'}, {out / 'report.json'}")
    return "\n".join(lines)
