"""Flags that several commands share."""

import argparse
from collections.abc import Sequence
from typing import Any

from magworm_gym.documents import parse_toml

DRIVE_HEIGHT_M = -0.022


def add_set(parser: Any) -> None:
    """Adds ``--set``."""
    parser.add_argument(
        "--set",
        nargs=2,
        action="append",
        default=[],
        metavar=("PATH", "VALUE"),
        help="a value of the scene, as in TOML: --set body.width_m 0.02; may be repeated",
    )


def add_constant_drive(parser: Any, x_m: float | None, speed_m_s: float | None) -> None:
    """Adds the flags of a drive that moves at constant speed, with defaults."""
    parser.add_argument("--drive-x", type=float, default=x_m, metavar="M", help="where the drive starts [m]")
    parser.add_argument(
        "--drive-y",
        type=float,
        default=DRIVE_HEIGHT_M,
        metavar="M",
        help="height of the drive, negative beneath the ground [m] (default %(default)s)",
    )
    parser.add_argument(
        "--drive-speed", type=float, default=speed_m_s, metavar="M/S", help="its speed along x [m/s]"
    )


def constant_drive(parsed: argparse.Namespace) -> dict[str, Any]:
    """The motion that the flags of ``add_constant_drive`` describe."""
    return {
        "kind": "constant",
        "x_m": parsed.drive_x,
        "y_m": parsed.drive_y,
        "speed_m_s": parsed.drive_speed,
    }


def set_values(pairs: Sequence[Sequence[str]]) -> dict[str, Any]:
    """Values of a scene from the pairs of ``--set``; a value that is no TOML is a text."""
    values = {}
    for path, text in pairs:
        try:
            values[path] = parse_toml(f"value = {text}", f"--set {path}")["value"]
        except ValueError:
            values[path] = text
    return values
