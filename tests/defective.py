"""CartPoles with a defect each, for the checker of vector environments to find."""

from types import SimpleNamespace
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorWrapper

ATTRIBUTES = "attributes"
SPACES = "spaces are batches of the single spaces"
SIGNATURE = "reset takes seed and options by keyword"
RESET = "reset returns observations and infos"
STEP = "step returns batches of the right shape and dtype"
REUSE = "returned data is not reused by later calls"
OWNERSHIP = "returned data can be written into"
INFOS = "infos are arrays beside masks"
OPTIONS = "options are left unchanged"
TRAJECTORY = "same seed, same trajectory"
CONTINUATION = "a reset without seed goes on from the seed before"
SEEDS = "a seed of its own for each environment"
NEIGHBOURS = "environments do not depend on their neighbours"
NUMBER = "environments do not depend on their number"
FRAMES = "render returns one frame per environment"
CLOSING = "closing twice"
AUTORESET = "episodes end and start as the autoreset mode says"


def cart_poles(
    mode: AutoresetMode = AutoresetMode.NEXT_STEP, num_envs: int = 3, **kwargs: Any
) -> SyncVectorEnv:
    return SyncVectorEnv([lambda: gymnasium.make("CartPole-v1")] * num_envs, autoreset_mode=mode, **kwargs)


class Defective(VectorWrapper):
    """CartPoles with a defect: subclasses bring one each, and name the check and what it has to say."""

    mode = AutoresetMode.NEXT_STEP
    check: str
    sentence: str

    def __init_subclass__(cls, check: str, sentence: str) -> None:
        cls.check, cls.sentence = check, sentence

    def __init__(self, num_envs: int = 3) -> None:
        super().__init__(cart_poles(self.mode, num_envs))

    def step(self, actions: Any) -> Any:
        names = ("observations", "rewards", "terminated", "truncated", "infos")
        returned = SimpleNamespace(**dict(zip(names, self.env.step(actions), strict=True)))
        self.spoil(returned, actions)
        return tuple(getattr(returned, name) for name in names)

    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        """Changes what a step returned."""


class DeclaresAString(Defective, check=ATTRIBUTES, sentence="enum AutoresetMode"):
    @property
    def metadata(self) -> dict[str, Any]:
        return {**self.env.metadata, "autoreset_mode": "NextStep"}


class RendersWhatItDoesNotDeclare(Defective, check=ATTRIBUTES, sentence="render_mode is 'smell'"):
    render_mode = "smell"


class SpaceOfOne(Defective, check=SPACES, sentence="action_space is"):
    def __init__(self, num_envs: int = 3) -> None:
        super().__init__(num_envs)
        self.action_space = self.single_action_space


class NoOptions(Defective, check=SIGNATURE, sentence="no argument 'options'"):
    def reset(self, seed: Any = None) -> Any:  # type: ignore[override]
        return self.env.reset(seed=seed)


class SeedByDefault(Defective, check=SIGNATURE, sentence="must be None"):
    def reset(self, *, seed: Any = 0, options: Any = None) -> Any:
        return self.env.reset(seed=seed, options=options)


class ResetWithoutInfos(Defective, check=RESET, sentence="tuple"):
    def reset(self, **kwargs: Any) -> Any:
        return self.env.reset(**kwargs)[0]


class DoublePrecision(Defective, check=STEP, sentence="float64"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.observations = step.observations.astype(np.float64)


class OutOfBounds(Defective, check=STEP, sentence="outside observation_space"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.observations += np.float32(100.0)


class RewardColumns(Defective, check=STEP, sentence=r"\(3, 1\)"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.rewards = step.rewards[:, None]


class WholeRewards(Defective, check=STEP, sentence="int64"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.rewards = step.rewards.astype(np.int64)


class InfiniteRewards(Defective, check=STEP, sentence="rewards are not finite"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.rewards += np.inf


class ListedFlags(Defective, check=STEP, sentence="terminated are a list"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.terminated = step.terminated.tolist()


class NumberedFlags(Defective, check=STEP, sentence="float32"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.truncated = step.truncated.astype(np.float32)


class ListedInfos(Defective, check=STEP, sentence="not a dict"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.infos = [{}] * self.num_envs


class ReusedObservations(Defective, check=REUSE, sentence="observations that share memory"):
    def __init__(self, num_envs: int = 3) -> None:
        VectorWrapper.__init__(self, cart_poles(num_envs=num_envs, copy=False))


class ReusedRewards(Defective, check=REUSE, sentence="rewards that share memory"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        self._buffer = getattr(self, "_buffer", step.rewards)
        self._buffer[...] = step.rewards
        step.rewards = self._buffer


class ReusedInfos(Defective, check=REUSE, sentence="infos that share memory"):
    _infos: dict[str, Any] = {}  # noqa: RUF012

    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        self._infos.update(step.infos)
        step.infos = self._infos


class ReadOnlyRewards(Defective, check=OWNERSHIP, sentence="read-only"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.rewards.flags.writeable = False


class TrustsItsReturns(Defective, check=OWNERSHIP, sentence="rewards depend on"):
    """Keeps what it returned, and computes with it: a fresh array each time, but not its own."""

    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        self._last = step.rewards = step.rewards + 0.5 * getattr(self, "_last", np.zeros(self.num_envs))

    def reset(self, **kwargs: Any) -> Any:
        self._last = np.zeros(self.num_envs)
        return self.env.reset(**kwargs)


class Unmasked(Defective, check=INFOS, sentence="no mask '_speed'"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.infos["speed"] = np.zeros(self.num_envs)


class MaskOfNothing(Defective, check=INFOS, sentence="mask without values"):
    def reset(self, **kwargs: Any) -> Any:
        observations, infos = self.env.reset(**kwargs)
        return observations, {**infos, "_speed": np.ones(self.num_envs, np.bool_)}


class ShortInfos(Defective, check=INFOS, sentence=r"shape \(1,\)"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.infos.update(speed=np.zeros(1), _speed=np.ones(self.num_envs, np.bool_))


class KeepsOptions(Defective, check=OPTIONS, sentence="seen"):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if options is not None:
            options["seen"] = True
        return self.env.reset(seed=seed, options=None)


class ForgetsSeeds(Defective, check=TRAJECTORY, sentence="differ in the same environment"):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        return self.env.reset(options=options)


class SeedsOnce(Defective, check=CONTINUATION, sentence="when done again"):
    """Takes a seed, but draws the next episode from elsewhere."""

    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if seed is None:
            seed = int(np.random.default_rng().integers(2**31))
        return self.env.reset(seed=seed, options=options)


class SameSeedForAll(Defective, check=SEEDS, sentence="gave different observations"):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        seed = [seed] * self.num_envs if isinstance(seed, int) else seed
        return self.env.reset(seed=seed, options=options)


class SharedSeeds(Defective, check=SEEDS, sentence="seeds of the others"):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if isinstance(seed, int):
            seed = [seed + i for i in range(self.num_envs)]
        if seed is not None and len(seed) == self.num_envs:
            seed = [sum(seed) + i for i in range(self.num_envs)]
        return self.env.reset(seed=seed, options=options)


class AnyNumberOfSeeds(Defective, check=SEEDS, sentence="2 seeds were accepted for 3"):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if isinstance(seed, list):
            seed = (seed * 2)[: self.num_envs]
        return self.env.reset(seed=seed, options=options)


class Gossip(Defective, check=NEIGHBOURS, sentence="the others' actions"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.rewards += np.mean(actions)


class Crowd(Defective, check=NUMBER, sentence="number of environments"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.rewards *= self.num_envs


class OneFrame(Defective, check=FRAMES, sentence="ndarray"):
    render_mode = "rgb_array"

    def render(self) -> Any:
        return np.zeros((4, 4, 3), np.uint8)


class UnevenFrames(Defective, check=FRAMES, sentence="different shapes"):
    render_mode = "rgb_array"

    def render(self) -> Any:
        return tuple(np.zeros((4, 4 + i, 3), np.uint8) for i in range(self.num_envs))


class ClosesOnce(Defective, check=CLOSING, sentence="closed already"):
    def close(self, **kwargs: Any) -> None:
        if self.env.closed:
            raise RuntimeError("closed already")
        self.env.close(**kwargs)


class NextStepInName(Defective, check=AUTORESET, sentence="NEXT_STEP promises"):
    """Resets within the step, and says otherwise."""

    mode = AutoresetMode.SAME_STEP

    @property
    def metadata(self) -> dict[str, Any]:
        return {**self.env.metadata, "autoreset_mode": AutoresetMode.NEXT_STEP}


class SameStepInName(Defective, check=AUTORESET, sentence="lack 'final_obs'"):
    """Resets with the next step, and says otherwise."""

    @property
    def metadata(self) -> dict[str, Any]:
        return {**self.env.metadata, "autoreset_mode": AutoresetMode.SAME_STEP}


class RewardsTheReset(Defective, check=AUTORESET, sentence="NEXT_STEP promises 0"):
    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        step.rewards += 1.0


class MaskOfAll(Defective, check=AUTORESET, sentence="_final_obs"):
    mode = AutoresetMode.SAME_STEP

    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        if "final_obs" in step.infos:
            step.infos["_final_obs"][:] = True


class FinalIsFirst(Defective, check=AUTORESET, sentence="shares memory"):
    """Returns the first observation of the next episode as the last one of this."""

    mode = AutoresetMode.SAME_STEP

    def spoil(self, step: SimpleNamespace, actions: Any) -> None:
        for i in np.flatnonzero(step.infos.get("_final_obs", [])):
            step.infos["final_obs"][i] = step.observations[i]


class ResetsAll(Defective, check=AUTORESET, sentence="changed the observation"):
    mode = AutoresetMode.DISABLED

    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        return self.env.reset(seed=seed)


class MaskOfAnyShape(Defective, check=AUTORESET, sentence="reset_mask of shape"):
    mode = AutoresetMode.DISABLED

    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        if options is not None and "reset_mask" in options:
            options = {**options, "reset_mask": options["reset_mask"][: self.num_envs]}
        return self.env.reset(seed=seed, options=options)
