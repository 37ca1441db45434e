"""Tables of observation and action, as simulator and tasks declare them."""

from collections.abc import Iterable

from magworm_gym import CRAWL_ID, REACH_ID, TURN_ID, MagWormVectorEnv, arguments_of
from magworm_gym.spaces import AnyPart


def tables() -> str:
    """All tables as Markdown: the plane, space, and what the tasks in space add."""
    plane, turn, reach = (_environment(name) for name in (CRAWL_ID, TURN_ID, REACH_ID))
    simulated = turn.batch.observation_specification
    return "\n".join(
        [
            f"`{CRAWL_ID}`",
            "",
            *_action(plane),
            "",
            *_observation(plane, plane.observation_specification),
            "",
            f"`{TURN_ID}`, `{REACH_ID}`, and `{CRAWL_ID}` with a scene in space",
            "",
            *_action(turn),
            "",
            *_observation(turn, simulated),
            "",
            *_appended(TURN_ID, turn),
            "",
            *_appended(REACH_ID, reach),
        ]
    )


def _environment(name: str) -> MagWormVectorEnv:
    return MagWormVectorEnv(1, **arguments_of(name, threads=1))


def _action(env: MagWormVectorEnv) -> list[str]:
    parts, limits = env.batch.action_specification, env.scene.stage_limits or {}
    return [
        f"Action, `float32`, shape ({_size(parts)},); values beyond the bounds are clipped:",
        "",
        *_table(parts),
        "",
        f"Limits of the stage in `{env.scene.name}`: "
        + ", ".join(f"`{name}` {value:g}" for name, value in limits.items())
        + f"; a control step lasts {1000.0 * env.scene.control_step_s:g} ms.",
    ]


def _observation(env: MagWormVectorEnv, parts: Iterable[AnyPart]) -> list[str]:
    parts = tuple(parts)
    return [
        f"Observation, `float32`, shape ({_size(parts)},) for `{env.scene.name}` "
        f"(M = {env.scene.magnets} body magnets):",
        "",
        *_table(parts),
    ]


def _appended(name: str, env: MagWormVectorEnv) -> list[str]:
    size = _size(env.observation_specification)
    table = _table(env.task.parts, _size(env.batch.observation_specification))
    return [f"`{name}` appends its goal; shape ({size},):", "", *table]


def _size(parts: Iterable[AnyPart]) -> int:
    return sum(part.size for part in parts)


def _table(parts: Iterable[AnyPart], start: int = 0) -> list[str]:
    rows = ["| at | name | unit | bounds | what |", "|---|---|---|---|---|"]
    for part in parts:
        place = f"{start}" if part.size == 1 else f"{start}–{start + part.size - 1}"
        bounds = f"{part.low:g} to {part.high:g}" if abs(part.high) < float("inf") else "–"
        bounds = f"from {part.low:g}" if abs(part.low) < float("inf") and bounds == "–" else bounds
        rows.append(f"| {place} | `{part.name}` | {part.unit} | {bounds} | {part.description} |")
        start += part.size
    return rows
