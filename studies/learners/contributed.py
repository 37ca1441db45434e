"""TQC and CrossQ of ``sb3-contrib``, which the project does not need otherwise, as learners."""

from typing import Any

import sb3_contrib

from magworm_gym.learning.learner import register_learner
from magworm_gym.learning.sac import SacOptions
from magworm_gym.learning.sb3 import Sb3Learner


class Tqc(Sb3Learner):
    """Truncated quantile critics."""

    Options = SacOptions
    algorithm = sb3_contrib.TQC


class WideCrossQ(sb3_contrib.CrossQ):  # type: ignore[misc,unused-ignore]  # Any where it is missing
    """CrossQ whose critics have layers of twice the actor's size."""

    def __init__(self, *arguments: Any, policy_kwargs: dict[str, Any], **more: Any) -> None:
        actor = policy_kwargs["net_arch"]
        wide = {"pi": actor, "qf": [2 * size for size in actor]}
        super().__init__(*arguments, policy_kwargs={**policy_kwargs, "net_arch": wide}, **more)


class CrossQ(Sb3Learner):
    """CrossQ, which has no target networks."""

    Options = SacOptions
    algorithm = WideCrossQ

    def _arguments(self) -> dict[str, Any]:
        return {name: value for name, value in super()._arguments().items() if name != "tau"}


register_learner("tqc", Tqc)
register_learner("crossq", CrossQ)
