"""Finding a scene."""

from os import PathLike, fspath
from pathlib import Path

from magworm_gym._magworm import PRESETS, Scene, SceneError


def load_scene(scene: str | PathLike[str] | Scene) -> Scene:
    """Returns a validated scene.

    Args:
        scene: Name of a preset (one of :data:`magworm_gym.PRESETS`), path of a TOML file, or a
            scene, which is returned as it is.

    Raises:
        SceneError: No such preset or file, or a scene that cannot be simulated.
    """
    if isinstance(scene, Scene):
        return scene
    name = fspath(scene)
    if name in PRESETS:
        return Scene.preset(name)
    if Path(name).is_file():
        return Scene.from_toml(Path(name).read_text(encoding="utf-8"))
    raise SceneError(
        f"scene is {name!r}; allowed: a preset ({', '.join(PRESETS)}) or the path of a TOML file"
    )
