"""Trainings that are killed at random moments end as others: ``python tests/killed_trainings.py``.

They have the shipped settings; only their steps are cut, to three checkpoints.
"""

import argparse
import multiprocessing
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from magworm_gym.learning import train
from magworm_gym.learning.checkpoints import checkpoints

CONFIGS = Path(__file__).parent.parent / "training" / "configs"
CASES = {
    "ppo": ("crawl", "--checkpoint-steps", "16384", "--steps", "49152"),
    "sac": ("crawl", "--algorithm", "sac", "--checkpoint-steps", "3200", "--steps", "9600"),
    "turn": ("turn", "--checkpoint-steps", "8192", "--steps", "24576"),
}
SEED = 7


def run_to_the_end(arguments: tuple[str, ...], out: Path, kill_after_s: float | None = None) -> bool:
    """Trains in a process of its own, which is killed after a time; returns whether it was through."""
    resume = ["--resume"] if (out / train.SETTINGS).exists() else []
    flags = [*arguments, "--seeds", str(SEED), "--workers", "1", "--out", str(out), *resume]
    process = multiprocessing.get_context("fork").Process(target=_quietly, args=(flags,))
    process.start()
    process.join(kill_after_s)
    process.kill()
    process.join()
    assert kill_after_s is not None or process.exitcode == 0, f"the training ended with {process.exitcode}"
    return process.exitcode == 0


def remains(out: Path) -> tuple[str, bytes]:
    """What trainings are compared by: the checksum of their whole last state, and the policy's weights."""
    folder = out / f"seed-{SEED}"
    return checkpoints(folder / "checkpoints")[-1].name, (
        folder / "policy" / "weights.safetensors"
    ).read_bytes()


def kill_at_random(case: str, kills: int, folder: Path, seed: int = 0) -> float:
    """Kills a training so often, beginning it anew when it is through, and compares its ends.

    Returns:
        Time of the uninterrupted training [s].

    Raises:
        AssertionError: A training ended otherwise than the uninterrupted one.
    """
    generator = np.random.default_rng(seed)
    began = time.monotonic()
    run_to_the_end(CASES[case], folder / "whole")
    duration_s = time.monotonic() - began
    wanted, number = remains(folder / "whole"), 0
    while kills > 0:
        out = folder / f"killed-{number}"
        while kills > 0 and not run_to_the_end(CASES[case], out, generator.uniform(0.0, duration_s / 2)):
            kills -= 1
        run_to_the_end(CASES[case], out)
        assert remains(out) == wanted, f"{case}: {remains(out)[0]} in place of {wanted[0]}"
        number += 1
    return duration_s


def _quietly(flags: list[str]) -> None:
    with open(os.devnull, "w", encoding="utf-8") as nowhere:
        sys.stdout = sys.stderr = nowhere
        train.main(flags, CONFIGS)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=40, help="of each training (default: %(default)s)")
    parser.add_argument("--cases", nargs="+", default=list(CASES), help="default: all")
    flags = parser.parse_args()
    for case in flags.cases:
        with tempfile.TemporaryDirectory() as folder:
            duration_s = kill_at_random(case, flags.kills, Path(folder))
        print(f"{case}: {flags.kills} kills of trainings of {duration_s:.0f} s, all ends equal", flush=True)


if __name__ == "__main__":
    main()
