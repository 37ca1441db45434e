"""Checks the wheel where nothing else is installed: what it needs, and that both environments run."""

from importlib.metadata import distribution, distributions
from pathlib import Path

import gymnasium
import numpy as np

import magworm_gym
import magworm_gym.cli

ALLOWED = {
    "cloudpickle", "farama-notifications", "gymnasium", "magworm-gym", "numpy", "pip", "setuptools",
    "typing-extensions",
}  # fmt: skip

installed = {found.metadata["Name"].lower().replace("_", "-") for found in distributions()}
assert installed <= ALLOWED, f"the wheel pulls in {sorted(installed - ALLOWED)}"

package = Path(magworm_gym.__file__).parent
repository = Path(__file__).resolve().parent.parent
assert package.parent != repository, f"{package} is not the installed wheel"
assert (package / "py.typed").exists() and (package / "_magworm.pyi").exists(), "the wheel is not typed"
assert (package / "identification/report.md.j2").exists(), "the wheel lacks the template of reports"

for identifier in (magworm_gym.CRAWL_ID, magworm_gym.TURN_ID, magworm_gym.REACH_ID):
    worm = gymnasium.make(identifier)
    worm.reset(seed=0)
    observation, _, _, _, _ = worm.step(worm.action_space.sample())
    assert worm.observation_space.contains(observation)

worms = gymnasium.make_vec(magworm_gym.CRAWL_ID, num_envs=16)
worms.reset(seed=0)
observations, rewards, _, _, _ = worms.step(np.zeros((16, 3)))
assert observations.shape == worms.observation_space.shape and np.isfinite(rewards).all()

assert magworm_gym.policies(), "the wheel brings no policies"
for name in magworm_gym.policies():
    policy = magworm_gym.load_policy(name)
    driven = policy.make_vec(num_envs=2)
    seen, _ = driven.reset(seed=0)
    driven.step(policy(seen))

version = distribution("magworm-gym").version
print(f"wheel of magworm-gym {version}: runs beside {', '.join(sorted(installed - {'magworm-gym', 'pip'}))}")
