"""CartPoles with a defect each, for the checker of vector environments to find."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorWrapper


def cart_poles(
    mode: AutoresetMode = AutoresetMode.NEXT_STEP, num_envs: int = 3, **kwargs: Any
) -> SyncVectorEnv:
    return SyncVectorEnv([lambda: gymnasium.make("CartPole-v1")] * num_envs, autoreset_mode=mode, **kwargs)


class Defective(VectorWrapper):
    """CartPoles with a defect: subclasses bring one each."""

    mode = AutoresetMode.NEXT_STEP

    def __init__(self, num_envs: int = 3) -> None:
        super().__init__(cart_poles(self.mode, num_envs))


class DeclaresAString(Defective):
    @property
    def metadata(self) -> dict[str, Any]:
        return {**self.env.metadata, "autoreset_mode": "NextStep"}


class RendersWhatItDoesNotDeclare(Defective):
    render_mode = "smell"


class SpaceOfOne(Defective):
    def __init__(self, num_envs: int = 3) -> None:
        super().__init__(num_envs)
        self.action_space = self.single_action_space


class NoOptions(Defective):
    def reset(self, seed: Any = None) -> Any:  # type: ignore[override]
        return self.env.reset(seed=seed)


class SeedByDefault(Defective):
    def reset(self, *, seed: Any = 0, options: Any = None) -> Any:
        return self.env.reset(seed=seed, options=options)


class ResetWithoutInfos(Defective):
    def reset(self, **kwargs: Any) -> Any:
        return self.env.reset(**kwargs)[0]


class DoublePrecision(Defective):
    def step(self, actions: Any) -> Any:
        observations, *others = self.env.step(actions)
        return observations.astype(np.float64), *others


class OutOfBounds(Defective):
    def step(self, actions: Any) -> Any:
        observations, *others = self.env.step(actions)
        return observations + np.float32(100.0), *others


class RewardColumns(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        return observations, rewards[:, None], *others


class WholeRewards(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        return observations, rewards.astype(np.int64), *others


class InfiniteRewards(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        return observations, rewards / 0.0 if rewards.all() else rewards + np.inf, *others


class ListedFlags(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, terminated, truncated, infos = self.env.step(actions)
        return observations, rewards, terminated.tolist(), truncated, infos


class NumberedFlags(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, terminated, truncated, infos = self.env.step(actions)
        return observations, rewards, terminated, truncated.astype(np.float32), infos


class ListedInfos(Defective):
    def step(self, actions: Any) -> Any:
        *others, _ = self.env.step(actions)
        return *others, [{}] * self.num_envs


class ReusedObservations(Defective):
    def __init__(self, num_envs: int = 3) -> None:
        VectorWrapper.__init__(self, cart_poles(num_envs=num_envs, copy=False))


class ReusedRewards(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        self._buffer = getattr(self, "_buffer", rewards)
        self._buffer[...] = rewards
        return observations, self._buffer, *others


class ReusedInfos(Defective):
    _infos: dict[str, Any] = {}  # noqa: RUF012

    def step(self, actions: Any) -> Any:
        *others, infos = self.env.step(actions)
        self._infos.update(infos)
        return *others, self._infos


class ReadOnlyRewards(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        rewards.flags.writeable = False
        return observations, rewards, *others


class TrustsItsReturns(Defective):
    """Keeps what it returned, and computes with it: a fresh array each time, but not its own."""

    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        rewards = rewards + 0.5 * getattr(self, "_last", np.zeros(self.num_envs))
        self._last = rewards
        return observations, rewards, *others

    def reset(self, **kwargs: Any) -> Any:
        self._last = np.zeros(self.num_envs)
        return self.env.reset(**kwargs)


class Unmasked(Defective):
    def step(self, actions: Any) -> Any:
        *others, infos = self.env.step(actions)
        return *others, {**infos, "speed": np.zeros(self.num_envs)}


class MaskOfNothing(Defective):
    def reset(self, **kwargs: Any) -> Any:
        observations, infos = self.env.reset(**kwargs)
        return observations, {**infos, "_speed": np.ones(self.num_envs, np.bool_)}


class ShortInfos(Defective):
    def step(self, actions: Any) -> Any:
        *others, infos = self.env.step(actions)
        return *others, {**infos, "speed": np.zeros(1), "_speed": np.ones(self.num_envs, np.bool_)}


class KeepsOptions(Defective):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if options is not None:
            options["seen"] = True
        return self.env.reset(seed=seed, options=None)


class ForgetsSeeds(Defective):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        return self.env.reset(options=options)


class SeedsOnce(Defective):
    """Takes a seed, but draws the next episode from elsewhere."""

    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if seed is None:
            seed = int(np.random.default_rng().integers(2**31))
        return self.env.reset(seed=seed, options=options)


class SameSeedForAll(Defective):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        seed = [seed] * self.num_envs if isinstance(seed, int) else seed
        return self.env.reset(seed=seed, options=options)


class SharedSeeds(Defective):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if isinstance(seed, int):
            seed = [seed + i for i in range(self.num_envs)]
        if seed is not None and len(seed) == self.num_envs:
            seed = [sum(seed) + i for i in range(self.num_envs)]
        return self.env.reset(seed=seed, options=options)


class AnyNumberOfSeeds(Defective):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if isinstance(seed, list):
            seed = (seed * 2)[: self.num_envs]
        return self.env.reset(seed=seed, options=options)


class Gossip(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        return observations, rewards + np.mean(actions), *others


class Crowd(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        return observations, rewards * self.num_envs, *others


class OneFrame(Defective):
    render_mode = "rgb_array"

    def render(self) -> Any:
        return np.zeros((4, 4, 3), np.uint8)


class UnevenFrames(Defective):
    render_mode = "rgb_array"

    def render(self) -> Any:
        return tuple(np.zeros((4, 4 + i, 3), np.uint8) for i in range(self.num_envs))


class ClosesOnce(Defective):
    def close(self, **kwargs: Any) -> None:
        if self.env.closed:
            raise RuntimeError("closed already")
        self.env.close(**kwargs)


class NextStepInName(Defective):
    """Resets within the step, and says otherwise."""

    mode = AutoresetMode.SAME_STEP

    @property
    def metadata(self) -> dict[str, Any]:
        return {**self.env.metadata, "autoreset_mode": AutoresetMode.NEXT_STEP}


class SameStepInName(Defective):
    """Resets with the next step, and says otherwise."""

    @property
    def metadata(self) -> dict[str, Any]:
        return {**self.env.metadata, "autoreset_mode": AutoresetMode.SAME_STEP}


class RewardsTheReset(Defective):
    def step(self, actions: Any) -> Any:
        observations, rewards, *others = self.env.step(actions)
        return observations, rewards + 1.0, *others


class MaskOfAll(Defective):
    mode = AutoresetMode.SAME_STEP

    def step(self, actions: Any) -> Any:
        *others, infos = self.env.step(actions)
        if "final_obs" in infos:
            infos["_final_obs"][:] = True
        return *others, infos


class FinalIsFirst(Defective):
    """Returns the first observation of the next episode as the last one of this."""

    mode = AutoresetMode.SAME_STEP

    def step(self, actions: Any) -> Any:
        observations, *others, infos = self.env.step(actions)
        for i in np.flatnonzero(infos.get("_final_obs", [])):
            infos["final_obs"][i] = observations[i]
        return observations, *others, infos


class ResetsAll(Defective):
    mode = AutoresetMode.DISABLED

    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        return self.env.reset(seed=seed)


class MaskOfAnyShape(Defective):
    mode = AutoresetMode.DISABLED

    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if options is not None and "reset_mask" in options:
            options = {**options, "reset_mask": options["reset_mask"][: self.num_envs]}
        return self.env.reset(seed=seed, options=options)
