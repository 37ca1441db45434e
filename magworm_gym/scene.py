"""Finding a scene."""

from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TypeAlias

from magworm_gym._magworm import PRESETS, Scene, SceneError
from magworm_gym.arguments import shown

AnyScene: TypeAlias = str | PathLike[str] | Scene
"""Name of a preset, path of a TOML file, or a scene."""
AnyScenes: TypeAlias = AnyScene | Sequence[AnyScene]
"""One of them, or a list of several of one shape."""


def load_scenes(scenes: AnyScenes) -> list[Scene]:
    """Returns validated scenes, see :func:`load_scene`, from one or a list.

    Raises:
        SceneError: One of them cannot be found or simulated.
    """
    if isinstance(scenes, Sequence) and not isinstance(scenes, str):
        return [load_scene(scene) for scene in scenes]
    return [load_scene(scenes)]


def load_scene(scene: AnyScene) -> Scene:
    """Returns a validated scene.

    Args:
        scene: Name of a preset (one of :data:`magworm_gym.PRESETS`), path of a TOML file, or a
            scene, which is returned as it is.

    Raises:
        SceneError: No such preset or file, or a scene that cannot be simulated.
    """
    if isinstance(scene, Scene):
        return scene
    name = fspath(scene) if isinstance(scene, (str, PathLike)) else None
    if name in PRESETS:
        return Scene.preset(name)
    if isinstance(name, str) and _is_file(name):
        return Scene.from_toml(_read(Path(name)))
    hint = "; a scene as text is read by Scene.from_toml" if name is not None and "\n" in name else ""
    raise SceneError(
        f"scene is {shown(scene)}; allowed: a preset ({', '.join(PRESETS)}), the path of a TOML file, "
        f"or a Scene{hint}"
    )


def episode_steps(scene: Scene) -> int:
    """Control steps of an episode, by the scene."""
    return round(scene.episode_s / scene.control_step_s)


def _is_file(name: str) -> bool:
    """Whether a text is the path of a file; one that can be none, such as a long one, is not."""
    try:
        return Path(name).is_file()
    except (OSError, ValueError):
        return False


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise SceneError(
            f"{path} is not UTF-8: byte 0x{error.object[error.start]:02x} in line {line}; allowed: a file "
            "saved as UTF-8"
        ) from error
    except OSError as error:
        raise SceneError(f"{path} cannot be read: {error.strerror}; allowed: a TOML file") from error
