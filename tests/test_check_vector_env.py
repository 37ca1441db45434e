"""The checker of vector environments: sound ones pass, and each defect is caught."""

from functools import partial
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorWrapper

from magworm_gym import CRAWL_ID, MagWormVectorEnv
from magworm_gym.testing import check_vector_env

MODES = list(AutoresetMode)


def cart_poles(
    mode: AutoresetMode = AutoresetMode.NEXT_STEP, num_envs: int = 3, **kwargs: Any
) -> SyncVectorEnv:
    return SyncVectorEnv([lambda: gymnasium.make("CartPole-v1")] * num_envs, autoreset_mode=mode, **kwargs)


@pytest.mark.parametrize("mode", MODES)
def test_sound_environments_pass(mode: AutoresetMode) -> None:
    report = check_vector_env(partial(cart_poles, mode))
    assert report.passed
    skipped = {finding.check for finding in report.with_outcome("skipped")}
    assert skipped == {"render returns one frame per environment"}
    noted = [finding.sentence for finding in report.with_outcome("noted")]
    # SyncVectorEnv takes the mask out of the caller's options.
    assert len(noted) == (mode is AutoresetMode.DISABLED)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("scene", ["paper-3", "paper-5"])
def test_the_native_environment_passes_strictly(scene: str, mode: AutoresetMode) -> None:
    make = partial(
        gymnasium.make_vec, CRAWL_ID, scene=scene, autoreset_mode=mode, max_episode_steps=6, threads=1
    )
    report = check_vector_env(make, strict=True)
    assert {f.check for f in report.with_outcome("skipped")} == {"render returns one frame per environment"}


def test_the_native_environment_passes_with_frames_and_options() -> None:
    pytest.importorskip("PIL")
    options = {"removed": [1], "start": {"x_m": 0.01}, "parameters": {"mass": 1.1}}
    make = partial(
        MagWormVectorEnv, max_episode_steps=6, threads=1, render_mode="rgb_array", render_envs=(0,)
    )
    report = check_vector_env(make, strict=True, options=options)
    assert not report.with_outcome("skipped")


def test_wrapped_environments_pass() -> None:
    def make() -> Any:
        worms = MagWormVectorEnv(3, max_episode_steps=6, threads=1)
        return gymnasium.wrappers.vector.RecordEpisodeStatistics(worms)

    assert check_vector_env(make).passed


def test_an_environment_itself_is_checked_and_left_open() -> None:
    env = MagWormVectorEnv(2, max_episode_steps=6, threads=1)
    report = check_vector_env(env)
    assert report.passed and not env.closed
    assert {"closing twice", "environments do not depend on their number"} <= {
        finding.check for finding in report.with_outcome("skipped")
    }
    assert "passed   attributes" in str(report)


def test_what_is_no_environment_is_refused() -> None:
    with pytest.raises(TypeError, match="VectorEnv"):
        check_vector_env(3)  # type: ignore[arg-type]


def test_episodes_that_do_not_end_are_noted() -> None:
    endless = partial(MagWormVectorEnv, threads=1)
    with pytest.raises(AssertionError, match="no episode ended within 30 steps"):
        check_vector_env(endless, max_steps=30, strict=True)
    assert check_vector_env(endless, max_steps=30).passed


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


DEFECTS: dict[type[Defective], tuple[str, str]] = {
    DeclaresAString: ("attributes", "enum AutoresetMode"),
    RendersWhatItDoesNotDeclare: ("attributes", "render_mode is 'smell'"),
    SpaceOfOne: ("spaces are batches of the single spaces", "action_space is"),
    NoOptions: ("reset takes seed and options by keyword", "no argument 'options'"),
    SeedByDefault: ("reset takes seed and options by keyword", "must be None"),
    ResetWithoutInfos: ("reset returns observations and infos", "tuple"),
    DoublePrecision: ("step returns batches of the right shape and dtype", "float64"),
    OutOfBounds: ("step returns batches of the right shape and dtype", "outside observation_space"),
    RewardColumns: ("step returns batches of the right shape and dtype", r"\(3, 1\)"),
    WholeRewards: ("step returns batches of the right shape and dtype", "int64"),
    ListedFlags: ("step returns batches of the right shape and dtype", "terminated are a list"),
    NumberedFlags: ("step returns batches of the right shape and dtype", "float32"),
    ListedInfos: ("step returns batches of the right shape and dtype", "not a dict"),
    ReusedObservations: ("returned data is not reused by later calls", "observations that share memory"),
    ReusedRewards: ("returned data is not reused by later calls", "rewards that share memory"),
    ReusedInfos: ("returned data is not reused by later calls", "infos that share memory"),
    ReadOnlyRewards: ("returned data can be written into", "read-only"),
    TrustsItsReturns: ("returned data can be written into", "rewards depend on"),
    Unmasked: ("infos are arrays beside masks", "no mask '_speed'"),
    MaskOfNothing: ("infos are arrays beside masks", "mask without values"),
    ShortInfos: ("infos are arrays beside masks", r"shape \(1,\)"),
    KeepsOptions: ("options are left unchanged", "seen"),
    ForgetsSeeds: ("same seed, same trajectory", "differ in the same environment"),
    SeedsOnce: ("a reset without seed goes on from the seed before", "when done again"),
    SameSeedForAll: ("a seed of its own for each environment", "gave different observations"),
    SharedSeeds: ("a seed of its own for each environment", "seeds of the others"),
    AnyNumberOfSeeds: ("a seed of its own for each environment", "2 seeds were accepted for 3"),
    Gossip: ("environments do not depend on their neighbours", "the others' actions"),
    Crowd: ("environments do not depend on their number", "number of environments"),
    OneFrame: ("render returns one frame per environment", "ndarray"),
    UnevenFrames: ("render returns one frame per environment", "different shapes"),
    ClosesOnce: ("closing twice", "closed already"),
    NextStepInName: ("episodes end and start as the autoreset mode says", "NEXT_STEP promises"),
    SameStepInName: ("episodes end and start as the autoreset mode says", "lack 'final_obs'"),
    RewardsTheReset: ("episodes end and start as the autoreset mode says", "NEXT_STEP promises 0"),
    MaskOfAll: ("episodes end and start as the autoreset mode says", "_final_obs"),
    FinalIsFirst: ("episodes end and start as the autoreset mode says", "shares memory"),
    ResetsAll: ("episodes end and start as the autoreset mode says", "changed the observation"),
    MaskOfAnyShape: ("episodes end and start as the autoreset mode says", "reset_mask of shape"),
}


@pytest.mark.parametrize("defect", DEFECTS, ids=lambda defect: defect.__name__)
def test_a_defect_is_caught(defect: type[Defective]) -> None:
    check, sentence = DEFECTS[defect]
    report = check_vector_env(defect, raise_on_failure=False)
    found = {finding.check: finding.sentence for finding in report.with_outcome("failed")}
    assert check in found, str(report)
    with pytest.raises(AssertionError, match=sentence):
        raise AssertionError(found[check])
    with pytest.raises(AssertionError, match=sentence):
        check_vector_env(defect)
