"""Ctrl-C comes back from every call that can be long, and what the call worked on is as before."""

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import pytest

from magworm_gym import Batch, MagWormEnv, MagWormVectorEnv, Scene, magnet, record_scenes
from magworm_gym.sb3 import MagWormSB3VecEnv

PATIENCE_S = 2.0
"""A call that was stopped has ended by then."""

LONG = {"control.step_s": 10.0, "control.episode_s": 100.0, "solver.step_s": 1e-5}
"""A control step of a million solver steps takes many seconds."""

MANY = 20_000


def interrupted_after_s(call: Callable[[], Any], wait_s: float = 0.2) -> float:
    """How long after Ctrl-C a call ends that would go on for long."""
    sent: list[float] = []

    def press() -> None:
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(wait_s, press)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            call()
    finally:
        timer.cancel()
    return time.monotonic() - sent[0]


def batch_of(scene: Scene, count: int, threads: int | None = None) -> Batch:
    batch = Batch(scene, count, threads=threads)
    batch.reset(np.ones(count, np.bool_), np.arange(count), np.zeros(count, np.int64))
    return batch


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize(
    "call",
    [
        lambda batch: batch.step(np.zeros((batch.num_envs, 3))),
        lambda batch: batch.rollout(np.zeros((100, batch.num_envs, 3))),
        lambda batch: batch.advance(10_000.0),
    ],
    ids=["step", "rollout", "advance"],
)
def test_a_minute_of_a_batch(call: Callable[[Batch], Any], threads: int) -> None:
    batch = batch_of(Scene.preset("paper-3").with_values(LONG), 20, threads)
    before = batch.get_state()
    assert interrupted_after_s(lambda: call(batch)) < PATIENCE_S
    assert batch.get_state() == before


@pytest.mark.parametrize("threads", [1, 2])
def test_a_minute_of_a_recording(threads: int) -> None:
    scenes = [Scene.preset(name) for name in ("belt-125", "paper-3", "belt-125")]
    assert interrupted_after_s(lambda: record_scenes(scenes, 10_000.0, 1.0, threads=threads)) < PATIENCE_S


def test_ten_million_points() -> None:
    size, points = (0.01, 0.01, 0.005), np.random.default_rng(0).uniform(0.02, 0.1, (10_000_000, 3))
    assert interrupted_after_s(lambda: magnet.field(size, points)) < PATIENCE_S
    assert interrupted_after_s(lambda: magnet.wrench(size, size, points, (1, 0, 0, 0), order=10)) < PATIENCE_S


def test_shares_of_a_long_step() -> None:
    scene = Scene.preset("turn-3").with_values({"body.elements_per_bridge": 30, "solver.step_s": 1e-4})

    def explain() -> None:
        while True:  # one alone may be shorter than a second
            scene.explain(measure=True)

    assert interrupted_after_s(explain) < PATIENCE_S


class Alarm(Exception):
    """A signal's handler may raise anything."""


def stopped_half_way(call: Callable[[], Any]) -> bool:
    """Whether a call was stopped that is done twice: once to know how long it takes."""
    began = time.monotonic()
    call()
    half_s = 0.5 * (time.monotonic() - began)

    def ring(*_: Any) -> None:
        raise Alarm

    kept = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, half_s)
    try:
        call()
        time.sleep(1.0)
    except Alarm:
        return True
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, kept)
    return False


def test_calls_that_are_long_for_many_environments() -> None:
    batch = batch_of(Scene.preset("turn-3"), MANY)
    other = batch.copies(np.arange(MANY)[::-1])
    state, elsewhere = batch.get_state(), other.get_state()
    everyone, numbers = np.ones(MANY, np.bool_), np.arange(MANY)
    calls: list[Callable[[], Any]] = [
        lambda: batch.copies(numbers),
        lambda: batch.get_state(),
        lambda: batch.node_positions(),
        lambda: Batch(batch.scene, MANY),
    ]
    for call in calls:
        assert stopped_half_way(call)
        assert batch.get_state() == state
    for change in (lambda: batch.reset(everyone, numbers, numbers), lambda: batch.set_state(elsewhere)):
        change()
        changed = batch.get_state()
        assert stopped_half_way(change)
        assert batch.get_state() == changed


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_a_step_of_environments_is_done_or_not(mode: str) -> None:
    env = MagWormVectorEnv(50, max_episode_steps=3, autoreset_mode=mode, threads=1)
    twin = MagWormVectorEnv(50, max_episode_steps=3, autoreset_mode=mode, threads=1)
    generator = np.random.default_rng(0)
    for each in (env, twin):
        each.reset(seed=0)
    for wait_s in generator.uniform(0.0, 0.02, 60):
        actions = generator.uniform(-1, 1, (50, 3))
        assert_done_or_not(wait_s, env, twin, lambda each, actions=actions: each.step(actions))


def assert_done_or_not(wait_s: float, env: Any, twin: Any, call: Callable[[Any], Any]) -> None:
    """Of a call during which, or soon after which, Ctrl-C is pressed; a twin makes it undisturbed."""
    before = env.get_state()
    call(twin)
    after = twin.get_state()
    timer = threading.Timer(wait_s, os.kill, (os.getpid(), signal.SIGINT))
    with suppress(KeyboardInterrupt):
        timer.start()
        call(env)
        timer.join()
        time.sleep(1.0)
    timer.join()
    assert env.get_state() in (before, after)
    if env.get_state() == before:
        call(env)
    assert env.get_state() == after


def test_a_reset_of_environments_is_done_or_not() -> None:
    env, twin = (MagWormVectorEnv(3000, threads=1) for _ in range(2))
    for each in (env, twin):
        each.reset(seed=0)
    options = {"parameters": {"mass": 1.1}, "removed": [1], "start": {"x_m": 0.1}}
    for seed, wait_s in enumerate(np.random.default_rng(0).uniform(0.0, 0.05, 20)):
        assert_done_or_not(wait_s, env, twin, lambda each, seed=seed: each.reset(seed=seed, options=options))


@pytest.mark.parametrize("make", [MagWormEnv, lambda **kw: MagWormSB3VecEnv(2, **kw)], ids=["one", "sb3"])
def test_a_long_step_of_other_environments(make: Any) -> None:
    env = make(scene=Scene.preset("paper-3").with_values(LONG), threads=1)
    env.reset()
    before = env.get_state()
    shape = (2, 3) if isinstance(env, MagWormSB3VecEnv) else (3,)
    assert interrupted_after_s(lambda: env.step(np.zeros(shape))) < PATIENCE_S
    assert env.get_state() == before


FIRST = """
import os, signal, sys, threading, time
import numpy as np
import magworm_gym, magworm_gym.magnet
signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in what a shell starts in the background
scene = magworm_gym.Scene.preset("belt-125")
points = np.ones((20_000_000, 3))
calls = {
    "record": lambda: magworm_gym.record_scenes([scene], 10_000.0, 1.0, threads=1),
    "advance": lambda: magworm_gym.Batch(scene, 9, threads=1).advance(100_000.0),
    "field": lambda: magworm_gym.magnet.field((1, 1, 1), points),
}
threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
began = time.monotonic()
try:
    calls[sys.argv[1]]()
    print("ended")
except KeyboardInterrupt:
    print("stopped after", time.monotonic() - began)
"""


@pytest.mark.parametrize("call", ["record", "advance", "field"])
def test_the_first_call_of_a_process(call: str) -> None:
    run = subprocess.run([sys.executable, "-c", FIRST, call], capture_output=True, text=True, timeout=120)
    assert run.returncode == 0 and "panic" not in run.stderr, run.stderr
    assert run.stdout.startswith("stopped"), run.stdout
    assert float(run.stdout.split()[-1]) < 0.2 + PATIENCE_S


def test_calls_of_other_threads_go_on() -> None:
    batch, done = batch_of(Scene.preset("belt-125"), 8, threads=1), threading.Event()

    def work() -> None:
        batch.advance(100.0)
        done.set()

    threading.Thread(target=work).start()
    interrupted_after_s(lambda: done.wait(60.0), wait_s=0.05)
    assert done.wait(60.0) and np.allclose(batch.time_s(), 100.0)
