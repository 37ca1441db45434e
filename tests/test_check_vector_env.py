"""The checker of vector environments: sound ones pass, and each defect is caught."""

import re
from functools import partial
from typing import Any

import gymnasium
import pytest
from defective import FRAMES, Defective, cart_poles
from gymnasium.vector import AutoresetMode

from magworm_gym import CRAWL_ID, MagWormVectorEnv
from magworm_gym.testing import check_vector_env

MODES = list(AutoresetMode)


@pytest.mark.parametrize("mode", MODES)
def test_sound_environments_pass(mode: AutoresetMode) -> None:
    report = check_vector_env(partial(cart_poles, mode))
    assert report.passed
    skipped = {finding.check for finding in report.with_outcome("skipped")}
    assert skipped == {FRAMES}
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
    assert {f.check for f in report.with_outcome("skipped")} == {FRAMES}


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


@pytest.mark.parametrize("defect", Defective.__subclasses__(), ids=lambda defect: defect.__name__)
def test_a_defect_is_caught(defect: type[Defective]) -> None:
    report = check_vector_env(defect, raise_on_failure=False)
    found = {finding.check: finding.sentence for finding in report.with_outcome("failed")}
    assert re.search(defect.sentence, found.get(defect.check, "")), str(report)
    with pytest.raises(AssertionError, match=defect.sentence):
        check_vector_env(defect)
