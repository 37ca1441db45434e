"""``magworm watch``: a policy at work, in a window or as a film."""

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from magworm_gym.policy import Policy, PolicyError, load_policy
from magworm_gym.render.animation import Frame, write_gif, write_mp4
from magworm_gym.vector_env import MagWormVectorEnv

WRITERS = {".gif": write_gif, ".mp4": write_mp4}


def add_to(commands: Any) -> None:
    """Adds the command to the parsers of ``magworm``."""
    parser = commands.add_parser(
        "watch",
        help="see a policy drive its worm",
        description="Opens a window in which a policy drives its worm, or writes a film of that.",
    )
    parser.set_defaults(run=watch)
    add = parser.add_argument
    add("policy", nargs="?", default="crawl-3", help="a policy of the package, or a folder (crawl-3)")
    add("--seconds", type=float, default=8.0, metavar="S", help="simulated time (%(default)s)")
    add("--seed", type=int, default=0, metavar="N", help="of start and goal (%(default)s)")
    add("--out", type=Path, metavar="FILE", help="a film, .gif or .mp4, in place of a window")


def watch(parsed: argparse.Namespace) -> None:
    """Shows a policy at work.

    Raises:
        PolicyError: There is no such policy, or a flag is out of range.
        ImportError: An extra is missing.
    """
    out: Path | None = parsed.out
    if out is not None and (out.suffix not in WRITERS or not out.parent.is_dir()):
        raise PolicyError(f"--out is {str(out)!r}; allowed: a .gif or .mp4 file in a folder that exists")
    if not 0.0 < parsed.seconds <= 3600.0:
        raise PolicyError(f"--seconds is {parsed.seconds:g}; allowed: more than 0, at most 3600")
    if not 0 <= parsed.seed < 2**63:
        raise PolicyError(f"--seed is {parsed.seed}; allowed: 0 to 2^63 - 1")
    policy = load_policy(parsed.policy)
    worms = policy.make_vec(1, render_mode="rgb_array" if out else "human")
    frames = _frames(policy, worms, parsed.seconds, parsed.seed)
    if out is None:
        for _ in frames:
            pass
    else:
        WRITERS[out.suffix](out, frames, worms.metadata["render_fps"])
        print(out)


def _frames(policy: Policy, worms: MagWormVectorEnv, seconds: float, seed: int) -> Iterator[Frame]:
    """The frames of a policy at work, one for each control step; none where a window shows them."""
    observations, _ = worms.reset(seed=seed)
    for _ in range(max(1, round(seconds / worms.scene.control_step_s))):
        observations, *_ = worms.step(policy(observations))
        if worms.render_mode == "rgb_array":
            yield from worms.render() or ()
    worms.close()
