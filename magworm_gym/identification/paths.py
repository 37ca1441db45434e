"""Dotted paths of a scene, also where TOML made tables of keys that were written without quotes."""

from collections.abc import Callable, Mapping
from typing import Any

from magworm_gym._magworm import Scene
from magworm_gym.documents import parse_toml


def dotted(
    values: Mapping[str, Any], opens: Callable[[str, Mapping[str, Any]], bool], place: str = ""
) -> dict[str, Any]:
    """Dotted path → value, the same for ``"body.width_m" = 0.02`` and ``body.width_m = 0.02``.

    Args:
        values: What a table of a file holds.
        opens: Whether a table at a path stands for its entries; else it is a value itself.
        place: Path of the table.
    """
    flat: dict[str, Any] = {}
    for key, value in values.items():
        path = f"{place}.{key}" if place else key
        if isinstance(value, Mapping) and opens(path, value):
            flat.update(dotted(value, opens, path))
        else:
            flat[path] = value
    return flat


def scene_paths(values: Mapping[str, Any], scene: Scene) -> dict[str, Any]:
    """Dotted path → value of a scene; a table with a kind, or that the scene does not have, is a value."""
    fields = parse_toml(scene.to_toml(), "scene")

    def opens(path: str, value: Mapping[str, Any]) -> bool:
        found: Any = fields
        for name in path.split("."):
            found = found.get(name) if isinstance(found, dict) else None
        return isinstance(found, dict) and "kind" not in value

    return dotted(values, opens)


def scene_numbers(scene: Scene) -> dict[str, float]:
    """All numbers of a scene: dotted path → value in the field's unit."""
    return {path: float(value) for path, value in _numbers(scene).items()}


def whole_numbers(scene: Scene) -> frozenset[str]:
    """Dotted paths of the fields of a scene that take whole numbers only."""
    return frozenset(path for path, value in _numbers(scene).items() if isinstance(value, int))


def _numbers(scene: Scene) -> dict[str, int | float]:
    numbers: dict[str, int | float] = {}
    waiting: list[tuple[str, Any]] = [("", parse_toml(scene.to_toml(), "scene"))]
    while waiting:
        place, value = waiting.pop()
        if isinstance(value, dict):
            waiting += [(f"{place}.{key}" if place else key, each) for key, each in value.items()]
        elif isinstance(value, list):
            waiting += [(f"{place}[{index}]", each) for index, each in enumerate(value)]
        elif isinstance(value, int | float) and not isinstance(value, bool):
            numbers[place] = value
    return numbers
