"""A case: scenes that are run, the figures read from them, and the axes along which settings are varied."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from magworm_gym import Recording, Scene, record_scenes
from studies.error.settings import Settings
from studies.kit.passes import Floats

SAMPLE_S = 0.02
"""Between instants of a track [s]."""


@dataclass(frozen=True)
class Outcome:
    """What runs with some settings gave.

    Attributes:
        figures: Each figure, one number per run (R,).
        tracks: Places of what is followed (R, T, P, axes) [m], or none.
        broken: What broke down, in words; None where nothing did.
    """

    figures: Mapping[str, Floats]
    tracks: Floats | None
    broken: str | None = None


@dataclass(frozen=True)
class Axis:
    """Settings of which one value is varied, against a reference that differs in that value alone.

    Attributes:
        name: Of the value.
        values: The settings.
        reference: What their errors are against.
        costs: Whether it is measured what they cost.
    """

    name: str
    values: Sequence[Settings]
    reference: Settings
    costs: bool = False


@dataclass(frozen=True)
class Case:
    """Something simulated.

    Attributes:
        name: Short, for files.
        title: For people.
        body: "worm" or "rod".
        scenes: The runs, as presets with their motions, without numerical choices.
        duration_s: For how long [s].
        read: Figures and track of the recordings.
        axes: One value varied at a time.
        ranked: Figure whose error is set against cost.
        front: Settings for which it is, against the converged reference.
        reference: The converged one, in every value.
        check: Coarser in every value: its difference from the reference bounds the error of that.
        exact: Figures known otherwise, in place of the reference's.
    """

    name: str
    title: str
    body: str
    scenes: Sequence[Scene]
    duration_s: float
    read: Callable[[Sequence[Recording]], Outcome]
    axes: Sequence[Axis]
    ranked: str
    front: Sequence[Settings]
    reference: Settings
    check: Settings
    exact: Mapping[str, float] = field(default_factory=dict)

    def scene(self, index: int, settings: Settings) -> Scene:
        """A run with some settings."""
        return self.scenes[index].with_values(settings.changes(self.body))

    def run(self, settings: Settings) -> Outcome:
        """All runs with some settings."""
        scenes = [self.scene(index, settings) for index in range(len(self.scenes))]
        records = record_scenes(scenes, self.duration_s, SAMPLE_S, nodes=self.body == "rod")
        broken = next((record.broken for record in records if record.broken is not None), None)
        return self.read(records) if broken is None else Outcome({}, None, broken)

    def all_settings(self) -> list[Settings]:
        """Every setting that is run, once."""
        wanted = [self.reference, self.check, *self.front]
        for axis in self.axes:
            wanted += [axis.reference, *axis.values]
        return list(dict.fromkeys(wanted))
