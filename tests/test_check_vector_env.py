"""The checker of vector environments: sound ones pass, and each defect is caught."""

from functools import partial
from typing import Any

import gymnasium
import pytest
from defective import (
    AnyNumberOfSeeds,
    ClosesOnce,
    Crowd,
    DeclaresAString,
    Defective,
    DoublePrecision,
    FinalIsFirst,
    ForgetsSeeds,
    Gossip,
    KeepsOptions,
    ListedFlags,
    ListedInfos,
    MaskOfAll,
    MaskOfAnyShape,
    MaskOfNothing,
    NextStepInName,
    NoOptions,
    NumberedFlags,
    OneFrame,
    OutOfBounds,
    ReadOnlyRewards,
    RendersWhatItDoesNotDeclare,
    ResetsAll,
    ResetWithoutInfos,
    ReusedInfos,
    ReusedObservations,
    ReusedRewards,
    RewardColumns,
    RewardsTheReset,
    SameSeedForAll,
    SameStepInName,
    SeedByDefault,
    SeedsOnce,
    SharedSeeds,
    ShortInfos,
    SpaceOfOne,
    TrustsItsReturns,
    UnevenFrames,
    Unmasked,
    WholeRewards,
    cart_poles,
)
from gymnasium.vector import AutoresetMode

from magworm_gym import CRAWL_ID, MagWormVectorEnv
from magworm_gym.testing import check_vector_env

MODES = list(AutoresetMode)


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
