"""``magworm policies`` and ``magworm export-policy``: which there are, and one for other programs."""

import argparse
from pathlib import Path
from typing import Any

from magworm_gym.learning.export import export_onnx, export_sb3
from magworm_gym.policy import load_policy, policies


def add_to(commands: Any) -> None:
    """Adds the commands to the parsers of ``magworm``."""
    listing = commands.add_parser("policies", help="list the policies that come with the package")
    listing.set_defaults(run=list_policies)
    export = commands.add_parser(
        "export-policy",
        help="write a policy as ONNX, or for Stable-Baselines3",
        description="Writes a policy in the formats of others; see also magworm policies.",
    )
    export.set_defaults(run=export_policy)
    export.add_argument("policy", help="a policy of the package, or a folder")
    formats = export.add_mutually_exclusive_group(required=True)
    formats.add_argument("--onnx", type=Path, metavar="FILE", help="ONNX model with the normaliser inside")
    formats.add_argument("--sb3", type=Path, metavar="FOLDER", help="model.zip and vecnormalize.pkl")


def list_policies(_: argparse.Namespace) -> None:
    """Prints a line for each policy."""
    for name, sentence in policies().items():
        print(f"{name:<10}{sentence}")


def export_policy(parsed: argparse.Namespace) -> None:
    """Writes a policy.

    Raises:
        PolicyError: There is no such policy, or it is damaged, or it cannot be written there.
        ImportError: An extra is missing.
    """
    policy = load_policy(parsed.policy)
    if parsed.onnx:
        export_onnx(policy, parsed.onnx)
    else:
        export_sb3(policy, parsed.sb3)
    print(parsed.onnx or parsed.sb3)
