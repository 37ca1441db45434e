"""Trains the policies that come with the package, and writes into each what it reaches.

``python training/ship_policies.py``, or with names of tables of ``configs/shipped.toml``. A run that was
stopped goes on.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from magworm_gym import Policy, __version__, load_policy, save_policy
from magworm_gym.learning.command_line import Parser, UsageError, run
from magworm_gym.learning.settings import read_settings, read_toml
from magworm_gym.learning.train import train
from magworm_gym.policy.folder import SHIPPED

CONFIGS = Path(__file__).parent / "configs"
RUNS = Path("runs/shipped")
EPISODES = 256
FIRST_SEED = 1_000_000_000
"""No training comes here: what is reached is measured in episodes that the policy has not seen."""


def main(arguments: list[str]) -> None:
    """Reads the command line, trains and writes.

    Raises:
        UsageError: A name or a setting is not usable.
    """
    known = tables()
    parser = Parser(prog="ship_policies.py", description="Trains the policies that come with the package.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"some of {', '.join(known)} (default: all)")
    parser.add_argument("--out", type=Path, default=SHIPPED, metavar="FOLDER", help="(default: the package)")
    flags = parser.parse_args(arguments)
    for name in flags.names:
        if name not in known:
            raise UsageError(f"policy is {name!r}; allowed: {', '.join(known)}")
    for name in flags.names or known:
        policy = trained(name, known[name])
        save_policy(flags.out / name, policy)
        print(f"{name}: {policy.sentence}")


def tables() -> dict[str, Any]:
    """What is said of each policy, by its name."""
    return read_toml(CONFIGS / "shipped.toml")


def trained(name: str, table: dict[str, Any]) -> Policy:
    """Trains a policy of a table on one core, and says what the best of its seeds reaches."""
    changes = {"seeds": [0], **table.get("training", {})}
    settings = read_settings(CONFIGS / "ppo.toml", table["environment"], changes)
    train(settings, RUNS / name, workers=1)
    policies = [load_policy(RUNS / name / f"seed-{seed}" / "policy") for seed in settings.seeds]
    reached = [measured(policy) for policy in policies]
    best = int(np.argmax([figures["mean_return"] for figures in reached]))
    provenance = {**policies[best].provenance, "magworm_gym": __version__, "reaches": reached[best]}
    sentence = table["sentence"].format(**reached[best])
    return replace(policies[best], sentence=sentence, provenance=provenance)


def measured(policy: Policy, episodes: int = EPISODES) -> dict[str, float]:
    """What a policy reaches in its environments, in one episode of each.

    Returns:
        ``episodes``, ``seconds`` until the time limit, ``mean_return``, ``return_per_s``, ``success_share``
        (of a task with a goal) and ``terminated_share``.
    """
    worms = policy.make_vec(num_envs=episodes)
    observations, _ = worms.reset(seed=FIRST_SEED)
    returns, ended = np.zeros(episodes), np.zeros(episodes, bool)
    success, lost = np.zeros(episodes, bool), np.zeros(episodes, bool)
    while not ended.all():
        observations, rewards, terminated, truncated, infos = worms.step(policy(observations))
        returns += np.where(ended, 0.0, rewards)
        ending = (terminated | truncated) & ~ended
        success |= ending & infos.get("is_success", ending & False)
        lost |= ending & terminated
        ended |= ending
    seconds = worms.max_episode_steps * worms.scene.control_step_s
    reached = {"episodes": episodes, "seconds": seconds, "mean_return": float(returns.mean())}
    reached["return_per_s"] = reached["mean_return"] / seconds
    if worms.task.goal_option is not None:
        reached["success_share"] = float(success.mean())
    return {**reached, "terminated_share": float(lost.mean())}


if __name__ == "__main__":
    run("ship_policies.py", main)
