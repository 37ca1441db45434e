"""One run of the robot that was measured."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from magworm_gym._magworm import Scene
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.recording import Recording, record_scenes


@dataclass(frozen=True)
class Run(ABC):
    """Something that a candidate does and that is looked at: an experiment or a sweep.

    Attributes:
        name: Its name.
        scene: The scene, before parameters are set.
        known: Paths that it sets itself; a parameter of the same path is not fitted here.
    """

    name: str
    scene: Scene
    known: frozenset[str] = field(default_factory=frozenset, kw_only=True)

    @property
    @abstractmethod
    def simulated_s(self) -> float:
        """Simulated time of a candidate, all its robots together [s]."""

    @abstractmethod
    def record(self, values: Mapping[str, float], sample_s: float) -> dict[str, Recording]:
        """What a candidate does, on one thread: name → recording.

        Args:
            values: Path of a field → its value.
            sample_s: Time between two instants [s].

        Raises:
            SceneError: The scene cannot be simulated.
        """

    def fitted_scene(self, values: Mapping[str, float]) -> Scene:
        """The scene of a candidate: its values where the run does not set them itself.

        Raises:
            SceneError: The scene cannot be simulated.
        """
        return self.scene.with_values(
            {path: value for path, value in values.items() if path not in self.known}
        )


@dataclass(frozen=True)
class Experiment(Run):
    """A scene that runs once from its start pose; its recording has its name.

    Attributes:
        duration_s: For how long [s].
    """

    duration_s: float

    @property
    def simulated_s(self) -> float:
        """The duration [s]."""
        return self.duration_s

    def record(self, values: Mapping[str, float], sample_s: float) -> dict[str, Recording]:
        """See :meth:`Run.record`."""
        scene = self.fitted_scene(values)
        (recording,) = record_scenes([scene], self.duration_s, sample_s, nodes=False, threads=1)
        return {self.name: recording}


def edited_scene(scene: Scene, values: Mapping[str, Any], where: str) -> Scene:
    """A scene with fields replaced.

    Raises:
        ProblemError: It cannot be simulated; says where the values stand.
    """
    try:
        return scene.with_values(dict(values))
    except (ValueError, TypeError) as error:  # a SceneError, or a value of no type that a scene has
        raise ProblemError(f"{where}: {error}") from error
