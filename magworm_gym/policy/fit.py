"""Whether an environment shows and takes the same numbers, in the same units, as another one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from magworm_gym.arguments import shown
from magworm_gym.policy.mistake import PolicyError
from magworm_gym.spaces import AnyPart, Part


def parts_of(specification: Iterable[AnyPart]) -> tuple[Part, ...]:
    """A specification as plain values."""
    return tuple(
        Part(part.name, part.unit, part.size, part.low, part.high, part.description) for part in specification
    )


def declarer(environment: Any) -> Any:
    """What declares observations, actions and scenes: the environment below wrappers, or a batch as it is.

    Raises:
        PolicyError: A wrapper changes observations.
    """
    inner = getattr(environment, "unwrapped", environment)
    spaces = [getattr(env, "observation_space", None) for env in (environment, inner)]
    if spaces[0] != spaces[1] or getattr(environment, "norm_obs", False):
        raise PolicyError(
            "a wrapper changes the observations that the policy is to see; allowed: the environment's own"
        )
    for name in ("worms", "_worms"):
        inner = getattr(inner, name, inner)
    return inner


def compare_parts(kind: str, known: Iterable[Part], given: Iterable[AnyPart]) -> None:
    """Compares names, units with their scales, sizes and bounds. Raises PolicyError where one differs."""
    known, given = tuple(known), parts_of(given)
    for own, other in zip(known, given, strict=False):
        for name in ("name", "unit", "size", "low", "high"):
            mine, its = getattr(own, name), getattr(other, name)
            if mine != its:
                raise PolicyError(
                    f"{name} of the environment's {kind} {other.name!r} is {its!r}; allowed for this policy: "
                    f"{shown(mine)}"
                )
    if len(known) != len(given):
        names, allowed = (", ".join(part.name for part in parts) for parts in (given, known))
        raise PolicyError(
            f"the environment's {kind} has the parts {names}; allowed for this policy: {allowed}"
        )


def compare_limits(known: Mapping[str, float], given: Mapping[str, float]) -> None:
    """Compares what an action of 1 is in metres and degrees. Raises PolicyError where one differs."""
    for name in sorted(known.keys() | given.keys()):
        if "acceleration" not in name and known.get(name) != given.get(name):  # which scales no action
            raise PolicyError(
                f"{name} of the environment's stage, which scales actions, is {given.get(name)}; allowed for "
                f"this policy: {known.get(name)}"
            )
