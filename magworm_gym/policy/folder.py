"""A policy as a folder, and the folders that come with the package.

``policy.json`` says all that can be said in words and few numbers; ``scene.toml`` is the scene, and where
there are several, the others are ``scene-1.toml`` and so on; ``weights.safetensors`` holds the layers.
Nothing of it is ever run.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import asdict
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from magworm_gym._magworm import Scene, SceneError
from magworm_gym.arguments import path_of, shown
from magworm_gym.atomic_files import new_folder
from magworm_gym.policy.document import Table
from magworm_gym.policy.mistake import PolicyError
from magworm_gym.policy.network import Layer, Network, Normaliser
from magworm_gym.policy.policy import Policy
from magworm_gym.policy.safetensors import Singles, read_tensors, write_tensors
from magworm_gym.spaces import Part

DOCUMENT = "policy.json"
WEIGHTS = "weights.safetensors"
FORMAT = "magworm-policy-1"
SHIPPED = Path(__file__).parent / "shipped"


def policies() -> dict[str, str]:
    """The policies that come with the package: for each name what it does, in one sentence."""
    folders = sorted(path.parent for path in SHIPPED.glob(f"*/{DOCUMENT}"))
    return {folder.name: Table.of_file(folder / DOCUMENT).entry("sentence", str) for folder in folders}


def load_policy(policy: str | PathLike[str]) -> Policy:
    """Reads a policy; numpy is all that it needs, and nothing that stands in a folder is run.

    Args:
        policy: One of :func:`policies`, or a folder that :func:`save_policy` has written.

    Raises:
        PolicyError: There is no such policy, or a file of it is missing or damaged, its normaliser included.
    """
    given = path_of("policy", policy)
    shipped = sorted(path.parent.name for path in SHIPPED.glob(f"*/{DOCUMENT}"))
    folder = SHIPPED / given if policy in shipped else given
    if not os.path.isdir(folder):
        raise PolicyError(f"policy is {shown(str(policy))}; allowed: {', '.join(shipped)}, or a folder")
    document = Table.of_file(folder / DOCUMENT)
    if document.entry("format", str) != FORMAT:
        raise PolicyError(f"{folder} has another format; allowed: {FORMAT!r}")
    environment, network = document.table("environment"), document.table("network")
    return Policy(
        network=Network(
            _layers(folder / WEIGHTS),
            network.entry("activation", str),
            network.entry("squashed", bool),
            network.number("limit", null=np.inf),
        ),
        normaliser=_normaliser(document.table("normaliser")),
        observation=tuple(map(_part, document.tables("observation"))),
        action=tuple(map(_part, document.tables("action"))),
        stage_limits=document.table("stage_limits").each_number(),
        environment_id=environment.entry("id", str),
        arguments=environment.table("arguments").plain(),
        scenes=[_scene(folder / _scene_name(number)) for number in range(document.size("scenes"))],
        sentence=document.entry("sentence", str),
        provenance=document.table("provenance").plain(),
    )


def save_policy(folder: str | PathLike[str], policy: Policy) -> None:
    """Writes a policy as a folder, which appears complete or not at all.

    Args:
        folder: The folder; one that holds a policy is replaced.
        policy: What to write.

    Raises:
        PolicyError: The folder holds something else, or arguments or provenance are no plain values.
    """
    path = path_of("folder", folder)
    if os.path.isdir(path) and any(path.iterdir()) and not (path / DOCUMENT).exists():
        raise PolicyError(
            f"folder is {shown(str(path))}, which holds no policy; allowed: a new or empty folder"
        )
    network, normaliser = policy.network, policy.normaliser
    document = {
        "format": FORMAT,
        "sentence": policy.sentence,
        "environment": {"id": policy.environment_id, "arguments": policy.arguments},
        "scenes": len(policy.scenes),
        "provenance": policy.provenance,
        "network": {
            "activation": network.activation,
            "squashed": network.squashed,
            "limit": _or_null(network.limit),
        },
        "normaliser": {
            "epsilon": normaliser.epsilon,
            "clip": _or_null(normaliser.clip),
            "mean": normaliser.mean.tolist(),
            "variance": normaliser.variance.tolist(),
        },
        "stage_limits": policy.stage_limits,
        "observation": [_row(part) for part in policy.observation],
        "action": [_row(part) for part in policy.action],
    }
    try:
        text = json.dumps(document, indent=1, allow_nan=False, ensure_ascii=False)
    except (TypeError, ValueError) as error:
        raise PolicyError(f"the policy holds what JSON cannot: {error}") from None
    tensors: dict[str, Singles] = {}
    for number, layer in enumerate(network.layers):
        tensors |= {f"{number}.weight": layer.weight, f"{number}.bias": layer.bias}
    with new_folder(path) as part:
        (part / DOCUMENT).write_text(text + "\n", encoding="utf-8")
        for number, scene in enumerate(policy.scenes):
            (part / _scene_name(number)).write_text(scene.to_toml(), encoding="utf-8")
        write_tensors(part / WEIGHTS, tensors)


def _layers(path: Path) -> list[Layer]:
    tensors = read_tensors(path)
    count = len(tensors) // 2
    if tensors.keys() != {f"{number}.{part}" for number in range(count) for part in ("weight", "bias")}:
        raise PolicyError(
            f"{path} has the arrays {shown(sorted(tensors))}; allowed: 0.weight, 0.bias, 1.weight and so on"
        )
    return [Layer(tensors[f"{number}.weight"], tensors[f"{number}.bias"]) for number in range(count)]


def _normaliser(table: Table) -> Normaliser:
    mean, variance = np.array(table.numbers("mean")), np.array(table.numbers("variance"))
    return Normaliser(mean, variance, table.number("epsilon"), table.number("clip", null=np.inf))


def _scene_name(number: int) -> str:
    return f"scene-{number}.toml" if number else "scene.toml"


def _scene(path: Path) -> Scene:
    try:
        return Scene.from_toml(path.read_text("utf-8"))
    except OSError as error:
        raise PolicyError(f"{path} cannot be read: {error.strerror}") from None
    except (SceneError, UnicodeDecodeError) as error:
        raise PolicyError(f"{path} is no scene: {error}") from None


def _part(table: Table) -> Part:
    return Part(
        table.entry("name", str),
        table.entry("unit", str),
        table.size("size"),
        table.number("low", null=-np.inf),
        table.number("high", null=np.inf),
        table.entry("description", str),
    )


def _row(part: Part) -> Mapping[str, Any]:
    return {**asdict(part), "low": _or_null(part.low), "high": _or_null(part.high)}


def _or_null(number: float) -> float | None:
    """JSON has no infinity: null says that there is no bound."""
    return number if np.isfinite(number) else None
