"""Memory that is not there is a MemoryError that tells how much was asked for; the process lives on."""

import subprocess
import sys

import pytest

from magworm_gym import Batch, MagWormVectorEnv, Scene, record_scenes

ROOM = 100_000_000
"""Address space that a limited process has left [bytes]."""

ROOM_OF_PIECES = 1_200_000_000
"""The same for what is made of small pieces: the C library reserves 64 MB at a time for each thread."""

CALLS = {
    "batch": "Batch(paper, n, threads=2)",
    "scalar batch": 'Batch(paper, n, lanes="scalar", threads=1)',
    "environments": "MagWormVectorEnv(n, threads=1)",
    "plan": "batch.rollout(np.zeros((n, 8, 3)), observations=True, magnet_poses=True)",
    "plan of environments": "env.rollout(np.zeros((50, n, 3)), start=0, observations=True)",
    "copies": "batch.copies(np.zeros(n, int))",
    "recording": "record_scenes([belt], n * 0.002, 0.002)",
    "states": "[states.append(Batch(paper, n, threads=2).get_state()) for _ in range(9)]",
    "queries": "[states.append(Batch(paper, n, threads=2).node_positions()) for _ in range(9)]",
    "field": "magnet.field((1, 1, 1), np.ones((n, 3)))",
    "wrench": "magnet.wrench((1, 1, 1), (1, 1, 1), np.full((n, 3), 9.0), (1, 0, 0, 0), order=1)",
}

PROGRAM = """
import resource
import numpy as np
from magworm_gym import Batch, MagWormVectorEnv, Scene, magnet, record_scenes
paper, belt = Scene.preset("paper-3"), Scene.preset("belt-125")
quick = paper.with_values({{"control.step_s": 0.002}})  # much is seen of few solver steps
batch = Batch(quick, 8, threads=2)
env = MagWormVectorEnv(2, scene=quick, threads=1)
env.reset()
states = []
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + {room}, used + {room}))
n = 100
while True:
    try:
        {call}
    except MemoryError as error:
        print(n, "MemoryError", error)
        break
    finally:
        states.clear()
    n = n * 4 // 3
batch.reset(np.ones(8, bool), np.zeros(8, int), np.zeros(8, int))
assert not batch.step(np.zeros((8, 3)))[2].any()
print("goes on")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the address space and limits it")
@pytest.mark.parametrize("call", CALLS)
def test_a_limited_process_lives_on(call: str) -> None:
    """What grows until it does not fit any more meets the limit from near by."""
    room = ROOM if CALLS[call].startswith("magnet.") else ROOM_OF_PIECES
    program = PROGRAM.format(room=room, call=CALLS[call])
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert run.returncode == 0, f"{run.returncode}: {run.stderr[-500:]}"
    first, last = run.stdout.splitlines()
    assert int(first.split()[0]) > 1000 and "MemoryError" in first and last == "goes on"


def test_what_the_machine_has_not_is_refused_beforehand() -> None:
    scene = Scene.preset("paper-3")
    many = scene.with_values({"body.magnets": 32, "body.elements_per_bridge": 25})
    with pytest.raises(MemoryError, match=r"num_envs is 16777216.* GB.* GB"):
        Batch(many, 1 << 24)
    with pytest.raises(MemoryError, match=r"num_envs is 16000000.* GB.* GB"):
        MagWormVectorEnv(16_000_000, scene=many)
    with pytest.raises(MemoryError, match=r"recording.* GB.* GB"):
        record_scenes([scene] * 100, 2_000_000.0, 0.002)
    with pytest.raises(MemoryError, match=r"copies.* GB.* GB"):
        Batch(many, 1).copies([0] * 10_000_000)
