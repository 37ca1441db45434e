"""Whether a policy fits an environment: the same numbers in the same units, and the same scene."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from magworm_gym.policy.mistake import PolicyError
from magworm_gym.spaces import AnyPart, Part

if TYPE_CHECKING:
    from magworm_gym.policy.policy import Policy

Limits = Mapping[str, float]


def check_fit(policy: Policy, environment: Any, *, other_scene: bool) -> None:
    """See :meth:`Policy.check_fit`."""
    simulated = _simulated(environment)
    _compare("observation", policy.observation, simulated.observation_specification)
    _compare("action", policy.action, getattr(simulated, "batch", simulated).action_specification)
    for scene in simulated.scenes:
        _compare_limits(policy.stage_limits, scene.stage_limits or {})
        if scene not in policy.scenes and not other_scene:
            raise PolicyError(
                f"the policy was trained in scene {policy.scene.name!r}, and {scene.name!r} differs from it; "
                "allowed: the same scene, or other_scene=True"
            )


def parts_of(specification: Iterable[AnyPart]) -> tuple[Part, ...]:
    """A specification as plain values."""
    return tuple(
        Part(part.name, part.unit, part.size, part.low, part.high, part.description) for part in specification
    )


def _simulated(environment: Any) -> Any:
    """What declares observations and actions: the environment below wrappers, or a batch as it is."""
    inner = getattr(environment, "unwrapped", environment)
    spaces = (getattr(env, "observation_space", None) for env in (environment, inner))
    if next(spaces) != next(spaces) or getattr(environment, "norm_obs", False):
        raise PolicyError(
            "a wrapper changes the observations that the policy is to see; allowed: the environment's own"
        )
    for name in ("worms", "_worms"):
        inner = getattr(inner, name, inner)
    return inner


def _compare(kind: str, known: Sequence[Part], shown: Iterable[AnyPart]) -> None:
    """Names, units with their scales, sizes and bounds of an observation's or an action's parts."""
    for own, other in zip(known, parts := parts_of(shown), strict=False):
        for name in ("name", "unit", "size", "low", "high"):
            mine, its = getattr(own, name), getattr(other, name)
            if mine != its:
                raise PolicyError(
                    f"{name} of the environment's {kind} {other.name!r} is {its!r}; allowed for this policy: "
                    f"{mine!r}"
                )
    if len(known) != len(parts):
        raise PolicyError(
            f"the environment's {kind} has the parts {_names(parts)}; allowed for this policy: "
            f"{_names(known)}"
        )


def _compare_limits(known: Limits, shown: Limits) -> None:
    """What an action of 1 is in metres and degrees. Acceleration scales no action."""
    for name in known.keys() | shown.keys():
        if "acceleration" not in name and known.get(name) != shown.get(name):
            raise PolicyError(
                f"{name} of the environment's stage, which scales actions, is {shown.get(name)}; allowed for "
                f"this policy: {known.get(name)}"
            )


def _names(parts: Iterable[Part]) -> str:
    return ", ".join(part.name for part in parts)
