"""One run of the robot that was measured."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from magworm_gym._magworm import Scene, SceneError
from magworm_gym.identification.mistake import ProblemError


@dataclass(frozen=True)
class Experiment:
    """A scene that runs once from its start pose.

    Attributes:
        name: Its name.
        duration_s: For how long [s].
        scene: The scene, before parameters are set.
        known: Paths that it sets itself; a parameter of the same path is not fitted here.
    """

    name: str
    duration_s: float
    scene: Scene
    known: frozenset[str] = field(default_factory=frozenset)

    def scene_with(self, values: Mapping[str, float]) -> Scene:
        """The scene of a candidate.

        Args:
            values: Path of a field → its value.

        Raises:
            SceneError: The scene cannot be simulated.
        """
        unknown = {path: value for path, value in values.items() if path not in self.known}
        return self.scene.with_values(unknown)


def edited_scene(scene: Scene, values: Mapping[str, Any], where: str) -> Scene:
    """A scene with fields replaced.

    Raises:
        ProblemError: It cannot be simulated; says where the values stand.
    """
    try:
        return scene.with_values(dict(values))
    except (SceneError, TypeError) as error:
        raise ProblemError(f"{where}: {error}") from error
