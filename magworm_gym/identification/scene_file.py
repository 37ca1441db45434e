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
    entries: dict[str, int] = {}
    for line in scene.to_toml().splitlines():
        if line.startswith("["):
            table = _table(line, entries) + "."
        if " = " not in line or line.startswith("["):
            lines.append(line)
            continue
        path = table + line.split(" = ", 1)[0]
        lines.append(f"{line}  # {_origin(path, origins) or otherwise}")
    return "\n".join(lines).rstrip() + "\n"


def _table(header: str, entries: dict[str, int]) -> str:
    """Dotted path of the table that a header begins; ``entries`` counts those of lists, from 0."""
    name = header.strip("[] ")
    if header.startswith("[["):
        entries[name] = entries.get(name, -1) + 1
        return f"{name}[{entries[name]}]"
    for of, entry in entries.items():
        if name.startswith(f"{of}."):
            return f"{of}[{entry}]{name.removeprefix(of)}"
    return name


def _origin(path: str, origins: Mapping[str, str]) -> str | None:
    """Comment on a field: its own, or that of the closest table around it."""
    while path:
        if path in origins:
            return origins[path]
        path = path.rpartition("[" if path.endswith("]") else ".")[0]
    return None
