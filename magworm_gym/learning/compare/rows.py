"""What a comparison yields: samples of each rival on each robot, and the policies that took part."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from magworm_gym.learning.compare.rivals import Plain, Rival
from magworm_gym.learning.compare.statistics import interval
from magworm_gym.learning.results import Column, Interval
from magworm_gym.learning.settings import TrainingSettings

MM_PER_M = 1000.0


@dataclass(frozen=True)
class Training:
    """Policies and how they were made."""

    folder: Path  # of the training, with a folder for each seed
    settings: TrainingSettings
    summaries: list[Plain]  # of each seed, see magworm_gym.learning.training.train_seed

    @property
    def folders(self) -> dict[int, Path]:
        """Folders of the policies by their seeds."""
        return {one["seed"]: self.folder / f"seed-{one['seed']}" / "policy" for one in self.summaries}

    @property
    def simulated_s(self) -> float:
        """Simulated time [s] that went into one policy."""
        return max(float(summary["simulated_s"]) for summary in self.summaries)


@dataclass(frozen=True)
class Measure:
    """A measured quantity."""

    key: str  # its name among the samples
    words: str  # what it is, in a sentence
    unit: str  # when printed
    form: str = ".1f"  # format of its numbers
    factor: float = 1.0  # from the unit of the samples to that
    less: bool = False  # whether less of it is better

    def column(self, heading: str = "") -> Column:
        """Its column in a table."""
        return Column(self.key, heading or f"{self.words} [{self.unit}]", self.form, self.factor)


@dataclass(frozen=True)
class Row:
    """What a rival did on a robot."""

    robot: str
    rival: Rival
    found: list[Plain]  # for each seed
    samples: dict[str, list[float]]  # of each measure: for each seed, or each start where it was found once
    curves: list[Any]  # of each found, where there are any

    @property
    def title(self) -> str:
        """Name of the rival."""
        return self.rival.title

    @property
    def sampled_over(self) -> str:
        """What the samples are."""
        return "seeds" if self.rival.seeds else "starts"

    def interval(self, measure: Measure) -> Interval:
        """Central mean of a measure with its interval."""
        return interval(self.samples[measure.key])

    def best(self, key: str) -> Plain:
        """What was found with the greatest sample of a measure."""
        samples = self.samples[key] if self.rival.seeds else [0.0]
        return self.found[samples.index(max(samples))]

    @property
    def plain(self) -> Plain:
        """All of it but curves, as plain values."""
        named = {"robot": self.robot, "rival": self.title, "sampled_over": self.sampled_over}
        return {**named, "found": [without_curve(one) for one in self.found], "samples": self.samples}


@dataclass(frozen=True)
class Compared:
    """All that a report and its figures are made of."""

    training: Training
    rows: dict[str, list[Row]]  # what each rival did, by the robot: the whole one first

    @property
    def whole(self) -> list[Row]:
        """Rows of the robot without damage."""
        return next(iter(self.rows.values()))

    def of(self, title: str) -> Row:
        """The row of a rival on the whole robot."""
        return next(row for row in self.whole if row.title == title)


def without_curve(found: Plain) -> Plain:
    """What was found but for the way there, a summary but for its curve."""
    return {name: value for name, value in found.items() if name != "curve"}
