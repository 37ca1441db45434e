"""What a learner is, and the learners by name."""

import importlib
from abc import ABC, abstractmethod
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple

from msgspec import Meta

from magworm_gym.documents import Table
from magworm_gym.learning.checkpoints import Tree
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.place import Place
from magworm_gym.policy import Network, Normaliser

Share = Annotated[float, Meta(ge=0.0, le=1.0)]
"""A setting from 0 to 1."""


class Round(NamedTuple):
    """Environment steps between two moments at which a learner can be kept, and the sum of their rewards."""

    steps: int
    reward: float


class Learner(ABC):
    """An algorithm that improves a policy, round by round. A subclass is all that a new algorithm needs.

    What it draws comes from torch, from NumPy's global generator or from ``random``, whose states are
    kept with it, or from a generator that is part of its :meth:`state`: then a training that was killed
    ends as one that was not.

    Args:
        place: Where it acts; it makes its environments there.
        options: Its settings, an ``Options``.
        steps: Environment steps of the whole training.
        folder: Folder for TensorBoard files.
    """

    Options: ClassVar[type[Table]]
    """Its table [learner] in the settings, frozen."""

    @abstractmethod
    def __init__(self, place: Place, options: Any, steps: int, folder: Path) -> None: ...

    def begin(self) -> int:
        """What comes before the first round of a fresh training. Returns the environment steps it took."""
        return 0

    @abstractmethod
    def advance(self) -> Round:
        """Acts for a while and learns from it."""

    @abstractmethod
    def actor(self) -> tuple[Network, Normaliser]:
        """The policy as it is now, which acts without exploring."""

    @abstractmethod
    def state(self) -> Tree:
        """All that changes with time, environments included, as numbers, text, arrays, lists and dicts."""

    @abstractmethod
    def restore(self, state: Tree) -> None:
        """Goes on from such a state. Raises ValueError for one of other settings."""


_LEARNERS: dict[str, type[Learner] | str] = {
    "ppo": "magworm_gym.learning.ppo:Ppo",
    "sac": "magworm_gym.learning.sac:Sac",
}


def register_learner(name: str, learner: type[Learner]) -> None:
    """Makes a learner known to settings and command lines.

    Seeds that are trained side by side each have a process of their own, which imports the script or the
    module again: call this where an import runs it.
    """
    _LEARNERS[name] = learner


def learner_named(name: str) -> type[Learner]:
    """The learner of a name. Raises UsageError where there is none."""
    found = _LEARNERS.get(name)
    if found is None:
        raise UsageError(f"algorithm is {name!r}; allowed: {', '.join(sorted(_LEARNERS))}")
    if isinstance(found, str):
        module, _, attribute = found.partition(":")
        found = _LEARNERS[name] = getattr(importlib.import_module(module), attribute)
    assert not isinstance(found, str), "resolved above"
    return found
