"""A policy that begins as a copy of a searched cycle, before it learns by itself."""

from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from magworm_gym.baselines import AIMS, FAMILIES, CycleSearch, Family, Steered
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.sb3 import Sb3Learner, statistics
from magworm_gym.sb3 import MagWormSB3VecEnv

SEARCH = CycleSearch(scouts=128, population=16, generations=10, starts=2, duration_s=5.0)
"""How the teacher is found: the search that the small budget gives a rival."""
STEPS = 200
NOISE = 0.15
NOISY_SHARE = 0.5
"""Share of actions that are disturbed, so that the copy sees how the teacher comes back."""
EPOCHS = 25
BATCH = 1024
RATE = 1e-3
VALUE_WEIGHT = 0.5
LEAST_VARIANCE = 1e-4


def family_of(learner: Sb3Learner) -> Family:
    """The family of cycles in which a learner's teacher is searched.

    Raises:
        UsageError: Its settings do not go with a teacher.
    """
    name, worms = learner.options.teacher, learner.robots.worms
    if name not in FAMILIES:
        raise UsageError(f"teacher is {name!r}; allowed: {', '.join(FAMILIES)}")
    if learner.normalisation is None or type(worms.task) not in AIMS:
        raise UsageError(f"teacher is {name!r}; allowed with normalise = true for turning and reaching")
    if FAMILIES[name].scene(worms.scene) != worms.scene:
        raise UsageError(f"teacher is {name!r}; allowed with its own drive, not that of {worms.scene.name!r}")
    return FAMILIES[name]


def teach(learner: Sb3Learner) -> int:
    """Searches a teacher, lets it act and fits policy, value and normalisation to what was seen.

    Args:
        learner: PPO before its first round.

    Returns:
        Environment steps that this took, search included.
    """
    robots, normalisation, seed = learner.robots, learner.normalisation, learner.place.seed
    assert normalisation is not None, "a learner with a teacher has statistics"
    family, scene = family_of(learner), robots.worms.scene
    found = SEARCH.found(scene, robots.worms.task, family, seed)
    cycle = family.cycle(found.parameters, scene.stage_limits or {})
    seen, actions, returns = _shown(robots, Steered([cycle]), seed, learner.options.gamma)
    of_observations, of_returns = statistics(normalisation)
    of_observations.mean = seen.mean(axis=0, dtype=np.float64)
    of_observations.var = seen.var(axis=0, dtype=np.float64) + LEAST_VARIANCE
    of_returns.mean, of_returns.var = np.array(returns.mean()), np.array(returns.var())
    of_observations.count = of_returns.count = float(len(seen))
    values = returns / np.sqrt(returns.var() + normalisation.epsilon)
    _fit(learner.model, np.asarray(normalisation.normalize_obs(seen)), actions, values)
    return len(seen) + round(SEARCH.simulated_s / scene.control_step_s)


def _shown(
    robots: MagWormSB3VecEnv, teacher: Steered, seed: int, gamma: float
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float64]]:
    """What a teacher saw, wanted to do and got (S, …), some of its actions disturbed."""
    generator = np.random.default_rng(seed)
    observations = robots.reset()
    teacher.start(robots.worms)
    seen, wanted, rewards, dones = [], [], [], []
    for _ in range(STEPS):
        actions = teacher.answer(observations)
        seen.append(observations)
        wanted.append(actions)
        disturbed = generator.random((len(actions), 1)) < NOISY_SHARE
        noise = NOISE * disturbed * generator.standard_normal(actions.shape)
        robots.step_async(np.clip(actions + noise, -1.0, 1.0))
        observations, reward, done, _ = robots.step_wait()
        rewards.append(reward)
        dones.append(done)
    returns = np.zeros((STEPS, robots.num_envs))
    after = np.zeros(robots.num_envs)
    for step in reversed(range(STEPS)):
        after = returns[step] = rewards[step] + gamma * after * ~dones[step]
    return np.concatenate(seen), np.concatenate(wanted).astype(np.float32), returns.ravel()


def _fit(model: Any, seen: NDArray[Any], actions: NDArray[Any], values: NDArray[Any]) -> None:
    """Least squares of the mean action and of the value."""
    policy = model.policy
    inputs, targets = torch.as_tensor(seen, dtype=torch.float32), torch.as_tensor(actions)
    worth = torch.as_tensor(values, dtype=torch.float32)[:, None]
    optimiser = torch.optim.Adam(policy.parameters(), RATE)
    for _ in range(EPOCHS):
        for rows in torch.split(torch.randperm(len(inputs)), BATCH):
            acting, judging = policy.mlp_extractor(inputs[rows])
            wrong = ((policy.action_net(acting) - targets[rows]) ** 2).mean()
            misjudged = ((policy.value_net(judging) - worth[rows]) ** 2).mean()
            optimiser.zero_grad()
            (wrong + VALUE_WEIGHT * misjudged).backward()
            optimiser.step()
