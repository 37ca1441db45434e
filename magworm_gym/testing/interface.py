"""Checks of what can be seen call by call: attributes, spaces, shapes, infos, frames."""

from __future__ import annotations

import inspect
from copy import deepcopy
from itertools import islice
from typing import Any

import numpy as np
from gymnasium.spaces import Space
from gymnasium.spaces.utils import is_space_dtype_shape_equiv
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from magworm_gym.testing.bench import (
    FEW_STEPS,
    RETURNED,
    AnyVectorEnv,
    Bench,
    declared_mode,
    equal,
    finding,
    rows,
    share_memory,
)
from magworm_gym.testing.report import Noted, Skipped


@finding("attributes")
def attributes(bench: Bench, env: AnyVectorEnv) -> None:
    """The attributes that wrappers and algorithms read."""
    assert isinstance(env, VectorEnv), f"the factory made a {type(env).__name__}, which is no VectorEnv"
    num_envs = getattr(env, "num_envs", None)
    assert isinstance(num_envs, int) and num_envs > 0, f"num_envs is {num_envs!r}; it must be a positive int"
    for name in ("observation_space", "action_space", "single_observation_space", "single_action_space"):
        assert isinstance(getattr(env, name, None), Space), f"{name} is missing or no Space"
    declared_mode(env)
    modes = env.metadata.get("render_modes", [])
    assert env.render_mode is None or env.render_mode in modes, (
        f'render_mode is {env.render_mode!r}, which metadata["render_modes"] = {modes!r} lacks'
    )
    assert not env.closed, "a new environment says that it is closed"


@finding("spaces are batches of the single spaces")
def spaces(bench: Bench, env: AnyVectorEnv) -> None:
    """Shapes and dtypes of the batched spaces, and samples of them."""
    for kind in ("observation", "action"):
        space, single = getattr(env, f"{kind}_space"), getattr(env, f"single_{kind}_space")
        expected = batch_space(single, env.num_envs)
        assert is_space_dtype_shape_equiv(space, expected), (
            f"{kind}_space is {space}; expected {env.num_envs} times single_{kind}_space: {expected}"
        )
        samples = rows(space, space.sample())
        assert len(samples) == env.num_envs, (
            f"a sample of {kind}_space has {len(samples)} rows for {env.num_envs} environments"
        )


@finding("reset takes seed and options by keyword")
def signature(bench: Bench, env: AnyVectorEnv) -> None:
    """Names and defaults of the arguments of `reset`."""
    parameters = inspect.signature(env.reset).parameters
    if any(parameter.kind is parameter.VAR_KEYWORD for parameter in parameters.values()):
        return
    for name in ("seed", "options"):
        assert name in parameters, f"reset has no argument {name!r}"
        default = parameters[name].default
        assert default is None, f"the default of reset({name}=…) is {default!r}; it must be None"


@finding("reset returns observations and infos")
def reset(bench: Bench, env: AnyVectorEnv) -> None:
    """Type and space of what `reset` returns."""
    result = bench.reset(env, bench.seed)
    assert isinstance(result, tuple) and len(result) == 2, (
        f"reset returned {type(result).__name__}; it must be a tuple (observations, infos)"
    )
    _assert_observations(env, result[0], "reset")
    assert isinstance(result[1], dict), f"the infos of reset are a {type(result[1]).__name__}, not a dict"


@finding("step returns batches of the right shape and dtype")
def step(bench: Bench, env: AnyVectorEnv) -> None:
    """Types, shapes and dtypes of what `step` returns."""
    for transition in islice(bench.play(env), FEW_STEPS):
        _assert_observations(env, transition.observations, "step")
        _assert_array("rewards", transition.rewards, env.num_envs, np.floating)
        assert np.isfinite(transition.rewards).all(), f"rewards are not finite: {transition.rewards}"
        _assert_array("terminated", transition.terminated, env.num_envs, np.bool_)
        _assert_array("truncated", transition.truncated, env.num_envs, np.bool_)
        infos = transition.infos
        assert isinstance(infos, dict), f"the infos of step are a {type(infos).__name__}, not a dict"


@finding("returned data is not reused by later calls")
def freshness(bench: Bench, env: AnyVectorEnv) -> None:
    """Users keep what they get: no call may write into what an earlier one returned, or share it."""
    kept: list[tuple[Any, Any]] = []
    for transition in islice(bench.play(env), FEW_STEPS):
        returned = {name: getattr(transition, name) for name in (*RETURNED, "infos")}
        for earlier, _ in kept[-2:]:
            for name, data in returned.items():
                assert not share_memory(earlier[name], data), (
                    f"two calls of step returned {name} that share memory"
                )
        kept.append((returned, deepcopy(returned)))
    for returned, copied in kept:
        for name in returned:
            assert equal(returned[name], copied[name]), f"a later call changed {name} that step had returned"


@finding("returned data can be written into")
def ownership(bench: Bench, env: AnyVectorEnv) -> None:
    """Algorithms write into what they get (a bootstrap value onto rewards): the environment must not mind."""
    expected = bench.record(env)
    for transition, untouched in zip(bench.play(env), expected, strict=False):
        for name in RETURNED:
            data = getattr(transition, name)
            assert equal(data, getattr(untouched, name)), (
                f"{name} depend on what a user wrote into the arrays returned before"
            )
        for name in RETURNED:
            _overwrite(name, getattr(transition, name))


@finding("infos are arrays beside masks")
def infos(bench: Bench, env: AnyVectorEnv) -> None:
    """The form of infos, also where episodes end."""
    _, reset_infos = bench.reset(env, bench.seed)
    _assert_infos(reset_infos, env.num_envs, "reset")
    keys: set[str] = set()
    for count, transition in enumerate(islice(bench.play(env), bench.max_steps)):
        _assert_infos(transition.infos, env.num_envs, "step")
        keys |= transition.infos.keys()
        if count >= FEW_STEPS and transition.done.any():
            break
    if "episode" in keys and env is env.unwrapped:
        raise Noted("infos have the key 'episode', which RecordEpisodeStatistics owns: wrapping it fails")


@finding("options are left unchanged")
def options(bench: Bench, env: AnyVectorEnv) -> None:
    """The dictionary of options belongs to the caller."""
    bench.reset(env, bench.seed)
    given = bench.options() or {}
    if declared_mode(env) is AutoresetMode.DISABLED:
        given["reset_mask"] = np.ones(env.num_envs, np.bool_)
    untouched = deepcopy(given)
    env.reset(seed=bench.seed, options=given)
    if "reset_mask" not in given and equal(given, {k: v for k, v in untouched.items() if k != "reset_mask"}):
        if "reset_mask" in untouched:
            raise Noted(
                "reset takes 'reset_mask' out of the caller's options, as SyncVectorEnv does: "
                "RecordEpisodeStatistics then drops the statistics of all environments"
            )
    assert equal(given, untouched), f"reset changed its options from {untouched!r} to {given!r}"


@finding("render returns one frame per environment")
def frames(bench: Bench, env: AnyVectorEnv) -> None:
    """Number, shape and dtype of frames."""
    if env.render_mode != "rgb_array":
        raise Skipped(f"render_mode is {env.render_mode!r}, not 'rgb_array'")
    bench.reset(env, bench.seed)
    drawn: Any = env.render()
    assert isinstance(drawn, (tuple, list)) and len(drawn) == env.num_envs, (
        f"render returned {type(drawn).__name__}; it must be a tuple of {env.num_envs} frames"
    )
    shapes = set()
    for frame in drawn:
        fits = isinstance(frame, np.ndarray) and frame.dtype == np.uint8 and frame.ndim == 3
        assert fits and frame.shape[2] == 3, "a frame is no uint8 array of shape (height, width, 3)"
        shapes.add(frame.shape)
    assert len(shapes) == 1, f"frames have different shapes: {sorted(shapes)}"


@finding("closing twice")
def closing(bench: Bench, env: AnyVectorEnv) -> None:
    """A second `close` does nothing."""
    if not bench.is_factory:
        raise Skipped("an environment given itself is left open")
    bench.reset(env, bench.seed)
    env.close()
    assert env.closed, "close() was called, but closed is False"
    env.close()


CHECKS = (attributes, spaces, signature, reset, step, freshness, ownership, infos, options, frames)


def _assert_observations(env: AnyVectorEnv, observations: Any, source: str) -> None:
    space = env.observation_space
    if isinstance(observations, np.ndarray):
        for name in ("shape", "dtype"):
            found, expected = getattr(observations, name), getattr(space, name)
            assert found == expected, (
                f"observations of {source} have {name} {found}; observation_space has {expected}"
            )
    assert observations in space, f"observations of {source} lie outside observation_space"


def _assert_array(name: str, array: Any, num_envs: int, kind: type[np.generic]) -> None:
    assert isinstance(array, np.ndarray), f"{name} are a {type(array).__name__}, not an array"
    assert array.shape == (num_envs,), f"{name} have shape {array.shape}; expected ({num_envs},)"
    assert np.issubdtype(array.dtype, kind), f"{name} have dtype {array.dtype}; expected {kind.__name__}"


def _assert_infos(infos: dict[str, Any], num_envs: int, path: str) -> None:
    for key, value in infos.items():
        where = f"{path}[{key!r}]"
        if key.startswith("_"):
            assert key[1:] in infos, f"{where} is a mask without values {key[1:]!r}"
            _assert_array(where, value, num_envs, np.bool_)
            continue
        assert f"_{key}" in infos, f"{where} has no mask '_{key}'"
        if isinstance(value, dict):
            nested = {k: v for k, v in value.items() if k.startswith("_") or f"_{k}" in value}
            _assert_infos(nested, num_envs, where)
        else:
            assert isinstance(value, np.ndarray), f"{where} is a {type(value).__name__}, not an array"
            assert value.shape[:1] == (num_envs,), (
                f"{where} has shape {value.shape}; expected ({num_envs}, …)"
            )


def _overwrite(name: str, data: Any) -> None:
    if not isinstance(data, np.ndarray):
        return
    assert data.flags.writeable, f"{name} are read-only"
    data[...] = ~data if data.dtype == np.bool_ else 77
