"""Sizes of a comparison: read from TOML, a table for each environment, named by its identifier."""

from pathlib import Path
from typing import Annotated, Any, TypeVar

from msgspec import Meta, Struct

from magworm_gym.baselines import CycleSearch, StrokeSearch, Trial
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.settings import checked, read_toml

Count = Annotated[int, Meta(ge=1, le=10**6, description="a whole number from 1 to 10^6")]
Several = Annotated[int, Meta(ge=2, le=10**6, description="a whole number from 2 to 10^6")]
Seconds = Annotated[float, Meta(ge=0.0, le=1e4, description="a number from 0 to 10^4")]
Duration = Annotated[float, Meta(gt=0.0, le=1e4, description="a number above 0, up to 10^4")]

AnyBudget = TypeVar("AnyBudget", bound="Budget")


class Size(Struct, frozen=True, forbid_unknown_fields=True):
    """A table of sizes, which refuses names that it does not know."""


class TrialSize(Size, frozen=True):
    """How a speed is measured."""

    settle_s: Seconds = 1.0  # before it
    measure_s: Duration = 8.0

    @property
    def trial(self) -> Trial:
        """The measurement."""
        return Trial(self.settle_s, self.measure_s)


class SweepSize(TrialSize, frozen=True):
    """Sweeps of belts, shuttles and tows."""

    speeds: Count = 21  # of the drive, up to the stage's limit
    starts: Count = 8  # of a belt at each speed
    shuttle_starts: Count = 2  # of a shuttle or a tow at each setting


class StrokeSearchSize(TrialSize, frozen=True):
    """Search of open-loop strokes; its simulated time is that of the training."""

    settle_s: Seconds = 0.5
    measure_s: Duration = 3.0
    seeds: Count = 3  # of independent searches
    control_points: Count = 6
    scouts: Count = 512  # random strokes, tried before
    population: Several = 16  # strokes of a generation
    starts: Count = 2  # of each stroke
    each_robot: bool = False  # whether damaged robots get searches of their own

    @property
    def search(self) -> StrokeSearch:
        """The search."""
        return StrokeSearch(self.control_points, self.scouts, self.starts, self.trial, self.population)


class CycleSearchSize(Size, frozen=True):
    """Search of cycles towards a goal."""

    seeds: Count = 5  # of independent searches of each family
    scouts: Count = 128  # random cycles, tried before
    population: Several = 24  # cycles of a generation
    generations: Count = 10
    starts: Count = 2  # of each cycle
    duration_s: Duration = 6.0  # of a trial

    @property
    def search(self) -> CycleSearch:
        """The search."""
        return CycleSearch(self.scouts, self.population, self.generations, self.starts, self.duration_s)


class SpeedSize(TrialSize, frozen=True):
    """Final measurement of speeds, from the same starts for all."""

    starts: Count = 32
    animation_s: Duration = 8.0


class FlightSize(Size, frozen=True):
    """Final measurement with goals, the same goals and starts for all."""

    starts: Count = 4  # of each goal
    duration_s: Duration = 20.0  # of the longest episode
    animation_s: Duration = 10.0


class Budget(Size, frozen=True):
    """What every comparison has: changes of the settings of the training."""

    training: Annotated[dict[str, Any], Meta(description="a table")] = {}


class CrawlBudget(Budget, frozen=True):
    """Sizes of a comparison of crawling."""

    sweep: SweepSize = SweepSize()
    search: StrokeSearchSize = StrokeSearchSize()
    final: SpeedSize = SpeedSize()


class GoalBudget(Budget, frozen=True):
    """Sizes of a comparison of a task with goals."""

    search: CycleSearchSize = CycleSearchSize()
    final: FlightSize = FlightSize()


def read_budget(path: Path, environment_id: str, kind: type[AnyBudget]) -> AnyBudget:
    """Reads the sizes for an environment.

    Raises:
        UsageError: The file cannot be read, has no such table, or a size is unknown or out of range.
    """
    tables = read_toml(path)
    if environment_id not in tables:
        raise UsageError(f"{path} has no table [{environment_id!r}]; it has: {', '.join(tables)}")
    return checked(tables[environment_id], kind)
