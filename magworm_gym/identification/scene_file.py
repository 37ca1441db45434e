"""The fitted scene as a TOML file that says where each value comes from."""

from collections.abc import Mapping, Sequence

from magworm_gym._magworm import Scene


def commented_scene(scene: Scene, origins: Mapping[str, str], otherwise: str, head: Sequence[str]) -> str:
    """A scene in full with a comment on every value.

    Args:
        scene: The scene.
        origins: Dotted path of a field, or of a table → comment on its values.
        otherwise: Comment on all others.
        head: Lines of comment at the beginning.

    Returns:
        TOML; without its comments it is ``scene.to_toml()``.
    """
    lines, table = [f"# {line}" for line in head] + [""], ""
    for line in scene.to_toml().splitlines():
        if line.startswith("["):
            table = line.strip("[] ") + "."
        if " = " not in line or line.startswith("["):
            lines.append(line)
            continue
        path = table + line.split(" = ", 1)[0]
        lines.append(f"{line}  # {_origin(path, origins) or otherwise}")
    return "\n".join(lines).rstrip() + "\n"


def _origin(path: str, origins: Mapping[str, str]) -> str | None:
    """Comment on a field: its own, or that of the closest table around it."""
    while path:
        if path in origins:
            return origins[path]
        path = path.rpartition(".")[0]
    return None
