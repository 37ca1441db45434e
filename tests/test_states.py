"""States of environments that were damaged: each is refused in one sentence, or runs on finite."""

from hashlib import blake2b
from typing import Any

import numpy as np
import pytest
from gymnasium.error import ResetNeeded

from magworm_gym import MagWormEnv, MagWormVectorEnv, snapshot
from magworm_gym.state import fields as state_fields

pytest.importorskip("stable_baselines3")
from magworm_gym.sb3 import MagWormSB3VecEnv

DAMAGES = 1500
ENVS = 2


def crawl() -> MagWormVectorEnv:
    return MagWormVectorEnv(ENVS, max_episode_steps=50, threads=1)


def reach() -> MagWormVectorEnv:
    return MagWormVectorEnv(ENVS, max_episode_steps=50, threads=1, task="reach")


def single() -> MagWormEnv:
    return MagWormEnv(max_episode_steps=50)


def stable() -> MagWormSB3VecEnv:
    return MagWormSB3VecEnv(ENVS, max_episode_steps=50, threads=1)


def begun(make: Any) -> Any:
    env = make()
    env.reset() if make is stable else env.reset(seed=3)
    act(env)
    return env


def act(env: Any) -> Any:
    """A step of an environment of any kind."""
    many = (ENVS,) if isinstance(env, MagWormSB3VecEnv) else ()
    return env.step(np.full((*many, *env.action_space.shape), 0.5))


def numbers(result: Any) -> np.ndarray[Any, Any]:
    return np.concatenate([np.ravel(np.asarray(part, np.float64)) for part in result[:2]])


def damaged(state: bytes, other: bytes, draw: np.random.Generator) -> bytes:
    """A flip, a cut or a splice."""
    kind = draw.integers(5)
    place, length = int(draw.integers(len(state))), int(draw.integers(1, 40))
    if kind == 0:
        return state[:place]
    if kind == 1:
        return state[:place] + other[place : place + length] + state[place + int(draw.integers(40)) :]
    changed = bytearray(state)
    for bit in draw.integers(8 * len(state), size=draw.integers(1, 4)).tolist():
        changed[bit // 8] ^= 1 << bit % 8
    return bytes(changed)


def renewed(state: bytes) -> bytes:
    """The same with a checksum that fits."""
    body = state[16:]
    return state[:8] + blake2b(body, digest_size=8).digest() + body


@pytest.mark.parametrize("make", [crawl, reach, single, stable])
def test_damaged_states_are_refused_or_run_on_finite(make: Any) -> None:
    env, other = begun(make), begun(make)
    for _ in range(3):
        act(other)
    good, splice, draw = env.get_state(), other.get_state(), np.random.default_rng(15)
    refused = 0
    for number in range(DAMAGES):
        state = damaged(good, splice, draw)
        state = renewed(state) if number % 2 else state
        try:
            env.set_state(state)
        except ValueError as error:
            assert str(error) and "\n" not in str(error)
            assert env.get_state() == good
            refused += 1
            continue
        try:
            result = act(env)
        except ResetNeeded:  # a state of an episode that is over
            env.reset()
            result = act(env)
        assert np.isfinite(numbers(result)).all()
        env.set_state(good)
    assert refused >= DAMAGES // 2


def test_numbers_that_no_environment_has_are_named() -> None:
    env = begun(crawl)
    fields = state_fields(env._worlds, env.np_random)
    for name, value in [("numbers", -2), ("elapsed_steps", -1), ("starts", 1e9), ("seeds", -1)]:
        changed = {**fields, name: np.full_like(fields[name], value)}
        with pytest.raises(ValueError, match=rf"^{name} of environment 0 in the state is .*; allowed: "):
            env.set_state(snapshot.pack(changed))


def test_a_state_of_an_older_layout_is_refused_by_name() -> None:
    for older in (b"PK\x03\x04 and so on", b"MAGWENV2" + bytes(99)):
        with pytest.raises(ValueError, match="layout of an older version"):
            begun(crawl).set_state(older)
