"""Policies as folders: what they give, what they refuse, and that nothing of a folder is ever run."""

import json
import os
import pickle
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from drawn_policies import drawn

import magworm_gym
from magworm_gym import Batch, MagWormVectorEnv, Policy, PolicyError, Scene, load_policy, save_policy


@pytest.fixture(scope="module")
def crawler() -> Policy:
    return drawn(MagWormVectorEnv(1))


@pytest.fixture
def folder(crawler: Policy, tmp_path: Path) -> Path:
    save_policy(tmp_path / "policy", crawler)
    return tmp_path / "policy"


def observations(policy: Policy, count: int = 50) -> np.ndarray:
    return np.random.default_rng(1).normal(0.0, 2.0, (count, policy.network.inputs)).astype(np.float32)


@pytest.mark.parametrize("network", [{}, {"activation": "relu", "squashed": True, "limit": 2.0}])
def test_a_policy_that_was_saved_acts_as_before(network: dict[str, Any], tmp_path: Path) -> None:
    policy = drawn(MagWormVectorEnv(1), **network)
    save_policy(tmp_path / "policy", policy)
    loaded = load_policy(tmp_path / "policy")
    seen = observations(policy)
    assert np.array_equal(loaded(seen), policy(seen))
    assert loaded.scenes == [policy.scene]
    for name in (
        "observation",
        "action",
        "stage_limits",
        "environment_id",
        "arguments",
        "provenance",
    ):
        assert getattr(loaded, name) == getattr(policy, name)
    assert sorted(path.name for path in (tmp_path / "policy").iterdir()) == [
        "policy.json",
        "scene.toml",
        "weights.safetensors",
    ]


def test_actions_are_what_the_layers_say(crawler: Policy) -> None:
    seen = observations(crawler)
    rows = np.clip(
        (seen - crawler.normaliser.mean) / np.sqrt(crawler.normaliser.variance + 1e-8), -10.0, 10.0
    )
    for layer in crawler.network.layers[:-1]:
        rows = np.tanh(rows @ layer.weight.T.astype(np.float64) + layer.bias)
    last = crawler.network.layers[-1]
    wanted = np.clip(rows @ last.weight.T.astype(np.float64) + last.bias, -1.0, 1.0)
    given = crawler(seen)
    assert given.dtype == np.float32 and np.abs(given - wanted).max() < 1e-5
    assert (np.abs(wanted) == 1.0).any() and (np.abs(wanted) < 1.0).any()


def test_an_action_is_the_same_alone_and_among_others(crawler: Policy) -> None:
    seen = observations(crawler, 33)
    together = crawler(seen)
    assert np.array_equal(together, [crawler(row) for row in seen])
    assert np.array_equal(together[:5], crawler(seen[:5].astype(np.float64)))
    assert crawler(seen[0]).shape == together.shape[1:] and crawler(seen[:0]).shape == (0, together.shape[1])


@pytest.mark.parametrize("wrong", [np.zeros((2, 3)), np.zeros((2, 2, 25)), np.full(25, np.nan), "ahead", 1.0])
def test_observations_that_are_none_are_refused(crawler: Policy, wrong: Any) -> None:
    with pytest.raises(ValueError, match=r"observation.* allowed"):
        crawler(wrong)


def test_a_policy_makes_the_environments_that_it_was_trained_for(crawler: Policy) -> None:
    worms = crawler.make_vec(num_envs=3)
    assert worms.num_envs == 3 and worms.max_episode_steps == 7 and worms.scene == crawler.scene
    seen, _ = worms.reset(seed=0)
    assert worms.action_space.contains(crawler(seen))
    assert crawler.make_vec(max_episode_steps=9).max_episode_steps == 9


def test_a_policy_of_several_scenes_makes_environments_of_all(tmp_path: Path) -> None:
    scenes = [Scene.preset("paper-3").with_values({"ground.static_friction": value}) for value in (0.9, 1.1)]
    save_policy(tmp_path / "policy", drawn(MagWormVectorEnv(2, scenes)))
    policy = load_policy(tmp_path / "policy")
    assert policy.make_vec(num_envs=4).scenes == tuple(policy.scenes) == tuple(scenes)
    policy.check_fit(MagWormVectorEnv(1, scenes[1]))
    with pytest.raises(PolicyError, match="other_scene=True"):
        policy.check_fit(MagWormVectorEnv(1, "paper-3"))


def test_another_scene_of_equal_specification_has_to_be_asked_for(crawler: Policy) -> None:
    slippery = crawler.scene.with_values({"ground.static_friction": 0.9})
    with pytest.raises(PolicyError, match="other_scene=True"):
        crawler.make_vec(scene=slippery)
    assert crawler.make_vec(scene=slippery, other_scene=True).scene == slippery


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"body.magnets": 4}, "size of the environment's observation 'magnet_x' is 4"),
        ({"drive.motion.speed_m_s": 0.3}, "unit of the environment's observation 'magnet_vx' is '0.3 m/s'"),
        ({"body.pitch_m": 0.021}, "unit .* is '0.021 m'"),
        ({"drive.motion.reach_m": 0.05}, "reach_m of the environment's stage, .* is 0.05"),
    ],
)
def test_other_units_scales_and_sizes_are_refused_in_any_scene(
    crawler: Policy, values: dict[str, Any], told: str
) -> None:
    with pytest.raises(PolicyError, match=told):
        crawler.make_vec(scene=crawler.scene.with_values(values), other_scene=True)


def test_every_kind_of_environment_is_checked(crawler: Policy) -> None:
    preset = {"scene": "paper-3"}
    for fitting in (
        gymnasium.make("MagWorm/Crawl-v0", **preset),
        gymnasium.make_vec("MagWorm/Crawl-v0", num_envs=2, **preset),
        MagWormVectorEnv(2, **preset),
        Batch(Scene.preset("paper-3"), 2),
    ):
        crawler.check_fit(fitting)
    renamed = replace(
        crawler, observation=[replace(crawler.observation[0], name="x"), *crawler.observation[1:]]
    )
    with pytest.raises(PolicyError, match="name of the environment's observation 'magnet_x' is"):
        renamed.check_fit(MagWormVectorEnv(1))
    with pytest.raises(PolicyError, match="has the parts"):
        drawn(MagWormVectorEnv(1, "turn-3", task="turn")).check_fit(Batch(Scene.preset("turn-3"), 1))
    wrapped = gymnasium.wrappers.NormalizeObservation(gymnasium.make("MagWorm/Crawl-v0"))
    with pytest.raises(PolicyError, match="a wrapper"):
        crawler.check_fit(wrapped)


def edited(change: Callable[[dict[str, Any]], object]) -> Callable[[Path], None]:
    """A change of ``policy.json``."""

    def edit(folder: Path) -> None:
        document = json.loads((folder / "policy.json").read_text())
        change(document)
        (folder / "policy.json").write_text(json.dumps(document))

    return edit


def written(name: str, content: bytes) -> Callable[[Path], object]:
    """A file that is replaced."""
    return lambda folder: (folder / name).write_bytes(content)


def at(name: str, value: Any, *path: str) -> Callable[[Path], None]:
    """An entry of ``policy.json`` that is replaced."""

    def change(document: dict[str, Any]) -> None:
        for step in path:
            document = document[step]
        document[name] = value

    return edited(change)


DAMAGE: dict[str, Callable[[Path], object]] = {
    "no normaliser": edited(lambda document: document.pop("normaliser")),
    "normaliser is null": at("normaliser", None),
    "no statistics": edited(lambda document: document["normaliser"].pop("mean")),
    "statistics of another size": edited(lambda document: document["normaliser"]["mean"].pop()),
    "statistics for fewer": edited(lambda d: [d["normaliser"][name].pop() for name in ("mean", "variance")]),
    "negative variance": edited(lambda document: document["normaliser"]["variance"].__setitem__(3, -1.0)),
    "mean as text": edited(lambda document: document["normaliser"]["mean"].__setitem__(3, "0")),
    "clip of 0": at("clip", 0.0, "normaliser"),
    "epsilon beyond floats": at("epsilon", 10**400, "normaliser"),
    "no scene": lambda folder: (folder / "scene.toml").unlink(),
    "a scene that is none": written("scene.toml", b"name = 3"),
    "a scene in another encoding": written("scene.toml", b"\xff\xfe"),
    "no document": lambda folder: (folder / "policy.json").unlink(),
    "a list as document": written("policy.json", b"[]"),
    "half a document": written("policy.json", b'{"format": "magworm'),
    "a document of deep lists": written("policy.json", b"[" * 100_000),
    "numbers that are none": written("policy.json", b'{"format": NaN}'),
    "another format": at("format", "magworm-policy-2"),
    "an activation that is none": at("activation", "__import__('os')", "network"),
    "squashed as text": at("squashed", "yes", "network"),
    "limit below 0": at("limit", -1.0, "network"),
    "a part of size 0": edited(lambda document: document["observation"][0].update(size=0)),
    "a part of size true": edited(lambda document: document["observation"][0].update(size=True)),
    "parts that are none": at("observation", ["magnet_x"]),
    "an action without bounds": edited(lambda document: document["action"][0].update(high=None)),
    "bounds beyond float32": edited(lambda document: document["action"][0].update(high=1e308)),
    "bounds the wrong way round": edited(lambda document: document["action"][0].update(low=2.0)),
    "arguments that are none": at("arguments", [], "environment"),
    "more scenes than there are": at("scenes", 2),
    "no sentence": edited(lambda document: document.pop("sentence")),
    "stage limits as text": at("stage_limits", {"reach_m": "0.06"}),
    "no weights": lambda folder: (folder / "weights.safetensors").unlink(),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_a_damaged_folder_is_refused_in_one_sentence(name: str, folder: Path) -> None:
    DAMAGE[name](folder)
    with pytest.raises(PolicyError) as told:
        load_policy(folder)
    assert "\n" not in str(told.value) and len(str(told.value)) < 500


class Trap:
    """Leaves a file behind where it is unpickled."""

    def __init__(self, mark: Path) -> None:
        self._mark = mark

    def __reduce__(self) -> tuple[Any, ...]:
        return os.mkdir, (str(self._mark),)


def test_nothing_of_a_folder_is_run(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mark, trap = tmp_path / "mark", tmp_path / "trap.py"
    poison = pickle.dumps(Trap(mark))
    pickle.loads(poison)
    assert mark.is_dir(), "the trap works"
    mark.rmdir()
    trap.write_text(f"import os\nos.mkdir({str(mark)!r})\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    for name in ("weights.safetensors", "policy.json", "scene.toml", "model.zip", "vecnormalize.pkl"):
        crafted = tmp_path / "crafted"
        shutil.copytree(folder, crafted, dirs_exist_ok=True)
        (crafted / name).write_bytes(poison)
        if name in ("model.zip", "vecnormalize.pkl"):  # no file of a policy: never looked at
            load_policy(crafted)
        else:
            with pytest.raises(PolicyError):
                load_policy(crafted)
        shutil.rmtree(crafted)
    for name, value in (
        ("num_envs", 3),
        ("scene", "paper-4"),
        ("task", "trap:Trap"),
        ("task_class", "trap:Trap"),
    ):
        at("arguments", {name: value}, "environment")(folder)
        with pytest.raises(ValueError, match=name):
            load_policy(folder).make_vec()
    for identifier in ("trap:MagWorm/Crawl-v0", "trap", "CartPole-v1"):
        at("id", identifier, "environment")(folder)
        with pytest.raises(PolicyError, match="no registered environment of worms"):
            load_policy(folder).make_vec()
    assert not mark.exists()


def test_a_policy_that_is_not_there_is_told_from_those_that_are(tmp_path: Path) -> None:
    for missing in ("crawl-99", tmp_path / "none", "x" * 5000, "\0"):
        with pytest.raises(PolicyError, match="allowed"):
            load_policy(missing)
    with pytest.raises(ValueError, match="a path"):
        load_policy(3)  # type: ignore[arg-type]


def test_a_folder_that_holds_something_else_is_left_alone(crawler: Policy, tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("all of it")
    with pytest.raises(PolicyError, match="holds no policy"):
        save_policy(tmp_path, crawler)
    assert (tmp_path / "thesis.tex").read_text() == "all of it"
    save_policy(tmp_path / "policy", crawler)
    save_policy(tmp_path / "policy", replace(crawler, sentence="Again."))
    assert load_policy(tmp_path / "policy").sentence == "Again."
    with pytest.raises(PolicyError, match="JSON"):
        save_policy(tmp_path / "policy", replace(crawler, provenance={"at": tmp_path}))
    assert load_policy(tmp_path / "policy").sentence == "Again."


def test_shipped_policies_act_in_the_environments_that_they_make() -> None:
    for name, sentence in magworm_gym.policies().items():
        policy = load_policy(name)
        assert policy.sentence == sentence and policy.provenance
        worms = policy.make_vec(num_envs=2)
        seen, _ = worms.reset(seed=0)
        worms.step(policy(seen))
