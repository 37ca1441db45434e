"""One experiment of the paper: what is kept of it, and what the page says and shows of that."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from studies.kit.data import DIGITS, read_json, write_json

DATA = Path(__file__).parent / "data"
Kept = TypeVar("Kept", bound="Experiment")
Numbers = Mapping[str, float | tuple[float, float]]
"""What the model gives, by key of ``quantities.toml``; where it has a spread, with that."""


class Experiment(ABC):
    """The dataclass of an experiment; all that is rendered follows from its fields.

    Attributes:
        name: Of its file in ``data/`` and of its section in ``sections/``.
        digits: Significant digits of the numbers in that file.
    """

    name: ClassVar[str]
    digits: ClassVar[int] = DIGITS

    @classmethod
    @abstractmethod
    def measured(cls: type[Kept]) -> Kept:
        """Runs the simulator."""

    @abstractmethod
    def numbers(self) -> Numbers:
        """What is compared with the paper, in the order of the page."""

    def figures(self) -> dict[str, Any]:
        """Its figures, by name."""
        return {}

    def keep(self) -> None:
        """Writes its data."""
        write_json(DATA / f"{self.name}.json", self, self.digits)

    @classmethod
    def kept(cls: type[Kept]) -> Kept:
        """What was written last."""
        return read_json(DATA / f"{cls.name}.json", cls)
