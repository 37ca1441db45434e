"""`solver.accuracy`: what the words stand for, and that they keep what they promise."""

from itertools import pairwise

import numpy as np
import pytest

from magworm_gym import Scene, SceneError
from studies.error.cases import CRAWL
from studies.error.errors import errors
from studies.error.levels import LEVELS, settings_of
from studies.error.settings import Settings

PROMISED = {"fast": 0.02, "balanced": 0.005}
"""Greatest error of the mean stride of 33 passes in the plane, against a converged reference."""


def with_word(word: object, preset: str = "paper-3") -> Scene:
    return Scene.preset(preset).with_values({"solver.accuracy": word})


def test_words_are_replaced_by_what_they_stand_for() -> None:
    text = with_word("fast").to_toml()
    assert "accuracy" not in text
    fast = settings_of(with_word("fast"))
    assert fast == Settings(5.0, 4, 2, precision="single", foot_end=2)
    assert settings_of(with_word("fast", "turn-3")).step_ms < fast.step_ms


def test_each_word_is_finer_than_the_one_before() -> None:
    found = [settings_of(with_word(word)) for word in LEVELS]
    for coarse, fine in pairwise(found):
        assert fine.step_ms < coarse.step_ms
        assert fine.elements > coarse.elements
        assert fine.order >= coarse.order


@pytest.mark.parametrize("word", ["exact", 3, True])
def test_other_words_are_refused(word: object) -> None:
    with pytest.raises(SceneError, match="allowed: one of fast, balanced, reference"):
        with_word(word)


def test_a_rod_keeps_its_elements() -> None:
    scene = Scene.preset("cantilever").with_values({"solver.accuracy": "fast"})
    assert "elements = 27" in scene.to_toml()


def test_the_words_keep_the_stride() -> None:
    case = CRAWL
    reference = case.run(case.check)
    for word, promised in PROMISED.items():
        stride, *_ = errors(case.run(settings_of(with_word(word))), reference, {})
        assert stride.figure == "stride" and abs(stride.mean) <= promised, (word, stride)
    assert np.mean(reference.figures["stride"]) == pytest.approx(4.11, rel=0.02)
