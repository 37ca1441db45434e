"""Arguments of the compiled classes: taken where nothing is lost, else refused by name."""

import pickle
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import magworm_gym
from magworm_gym import Batch, MagWormVectorEnv, Scene, SceneError, load_scene, magnet, record_scenes

SCENE = Scene.preset("paper-3").with_values({"magnetic_terms.mutual": False})
ON, FIRST = np.ones(2, np.bool_), np.zeros(2, np.uint64)


@pytest.fixture
def batch() -> Batch:
    batch = Batch(SCENE, 2, threads=1)
    batch.reset(ON, FIRST, FIRST)
    return batch


ACTIONS = np.array([[0.5, -0.25, 1.0], [-1.0, 0.0, 0.125]])


@pytest.mark.parametrize(
    "actions",
    [
        ACTIONS.astype(np.float32),
        ACTIONS.astype(np.float16),
        ACTIONS.astype(">f8"),
        np.asfortranarray(ACTIONS),
        np.repeat(ACTIONS, 2, axis=1)[:, ::2],
        ACTIONS.tolist(),
        tuple(map(tuple, ACTIONS)),
    ],
    ids=["float32", "float16", "big endian", "Fortran order", "strided", "lists", "tuples"],
)
def test_numbers_that_lose_nothing_are_taken(batch: Batch, actions: Any) -> None:
    other = Batch(SCENE, 2, threads=1)
    other.set_state(batch.get_state())
    assert all(np.array_equal(a, b) for a, b in zip(batch.step(actions), other.step(ACTIONS), strict=True))
    assert batch.get_state() == other.get_state()


def test_whole_numbers_of_any_size_and_flags_of_lists_are_taken(batch: Batch) -> None:
    expected = batch.get_state()
    for mask in (ON, ON.tolist()):
        for numbers in (FIRST.astype(np.int64), FIRST.astype(np.uint8), [0, 0]):
            batch.reset(mask, numbers, numbers)
            assert batch.get_state() == expected
    assert Batch(SCENE, np.int32(2), threads=np.int8(1)).num_envs == 2  # type: ignore[arg-type]
    assert batch.copies(np.array([1, 0])).num_envs == 2  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda b: b.step(ACTIONS.astype(complex)), "actions.*complex128.*numbers"),
        (lambda b: b.step(ACTIONS.astype(np.longdouble)), "actions.*longdouble|actions.*float128"),
        (lambda b: b.step("up"), "actions"),
        (lambda b: b.step([[1.0], [1.0, 2.0]]), "actions"),
        (lambda b: b.step(None), "actions"),
        (lambda b: b.step(np.zeros((2, 4))), r"actions.*\[2, 4\].*\[2, 3\]"),
        (lambda b: b.rollout(np.zeros((2, 3))), "actions.*T"),
        (lambda b: b.rollout(np.zeros((1, 2, 3)), observations="yes"), "observations.*yes.*True"),
        (lambda b: b.reset(ON.astype(int), FIRST, FIRST), "mask.*int64.*True"),
        (lambda b: b.reset(ON, FIRST.astype(float), FIRST), "seeds.*float64.*whole"),
        (lambda b: b.reset(ON, np.array([0, -3]), FIRST), "seeds.*-3.*0 to 2"),
        (lambda b: b.reset(ON, [0, 2**64], FIRST), "seeds.*whole"),
        (lambda b: b.reset(ON, FIRST, [True, False]), "episodes.*bool"),
        (lambda b: b.reset(ON, FIRST, FIRST, [[0.0, 20.0, 0.0]] * 2), "height.*20.*-10 to 10"),
        (lambda b: b.set_parameter("stiffness", [0.9, "x"]), "factors"),
        (lambda b: b.set_parameter("stiffness", [0.9, -1.0]), "stiffness.*1 is -1.*0 to 1e3"),
        (lambda b: b.set_parameter(3, [1.0, 1.0]), "name.*3.*stiffness"),
        (lambda b: b.set_parameter("mutual", [1.0, 0.5]), "mutual in environment 1 is 0.5; allowed: 1, as"),
        (lambda b: b.set_magnets_present(np.ones((2, 3))), "present.*float64"),
        (lambda b: b.copies([0, -1]), "copy 1 is -1.*0 to 1"),
        (lambda b: b.copies([0.5]), "environments.*float64.*whole"),
        (lambda b: b.copies([2**70]), "environments"),
        (lambda b: b.copies(1), "environments"),
        (lambda b: b.advance("long"), "duration_s.*long.*solver steps"),
        (lambda b: b.advance(-1.0), "duration_s.*-1.*solver steps"),
        (lambda b: b.set_state("text"), "state.*text.*bytes"),
        (lambda b: b.status_text(-1), "code.*-1.*0 to 255"),
        (lambda b: b.status_text(10**30), "code.*1000.*0 to 255"),
        (lambda _: Batch("paper-3", 2), "scene.*paper-3.*Scene"),  # type: ignore[arg-type]
        (lambda _: Batch(SCENE, -1), "num_envs.*-1.*1 to"),
        (lambda _: Batch(SCENE, 2.0), "num_envs.*2.0.*whole"),  # type: ignore[arg-type]
        (lambda _: Batch(SCENE, 10**30), "num_envs.*1000.*1 to"),
        (lambda _: Batch(SCENE, 2, threads=-1), "threads.*-1.*1 to 4096"),
        (lambda _: Batch(SCENE, 2, threads="all"), "threads.*all"),  # type: ignore[arg-type]
        (lambda _: Batch(SCENE, 2, lanes="narrow"), "lanes.*narrow.*wide"),
        (lambda _: Batch(SCENE, 2, lanes=8), "lanes.*8.*wide"),  # type: ignore[arg-type]
        (lambda _: SCENE.explain(measure=1), "measure.*1.*True"),  # type: ignore[arg-type]
        (lambda _: Scene.preset(Path("paper-3")), "name.*paper-3.*load_scene"),  # type: ignore[arg-type]
        (lambda _: Scene.from_toml(Path("a.toml")), "text.*a.toml.*load_scene"),  # type: ignore[arg-type]
        (lambda _: Scene.from_toml("\ud800"), "text"),
        (lambda _: record_scenes([SCENE, "belt-125"], 1.0), r"scenes\[1\].*belt-125"),  # type: ignore[list-item]
        (lambda _: record_scenes(SCENE, 1.0), "scenes"),  # type: ignore[arg-type]
        (lambda _: record_scenes([SCENE], [1.0, 2.0]), r"duration_s.*\[2\].*\[1\]"),
        (lambda _: record_scenes([SCENE], 1.0, sample_s="often"), "sample_s.*often"),  # type: ignore[arg-type]
        (lambda _: record_scenes([SCENE], 1.0, threads=0), "threads.*0"),
        (lambda _: MagWormVectorEnv(2, threads=-1), "threads.*-1"),
        (lambda _: MagWormVectorEnv("two"), "num_envs.*two"),  # type: ignore[arg-type]
        (lambda _: MagWormVectorEnv(2, render_envs=3), "render_envs.*3"),  # type: ignore[arg-type]
        (lambda _: MagWormVectorEnv(2, render_envs=["a"]), "render_envs.*a"),  # type: ignore[list-item]
        (lambda _: MagWormVectorEnv(2, task=np.arange(3)), "task.*array"),  # type: ignore[arg-type]
        (lambda _: MagWormVectorEnv(2).reset(seed=3.5), "seed.*3.5"),  # type: ignore[arg-type]
        (lambda _: MagWormVectorEnv(2).reset(seed=10**5000), "seed"),
        (lambda _: magnet.field("large", (0, 0, 1)), "size_m.*large"),  # type: ignore[arg-type]
        (lambda _: magnet.field((1, 1, 1), "here"), "points_m.*here"),
        (lambda _: magnet.wrench((1, 1, 1), (1, 1, 1), (0, 0, 9), (1, 0, 0, 0), order="5"), "order.*5"),  # type: ignore[arg-type]
    ],
)
def test_others_are_refused_by_name(batch: Batch, call: Callable[[Batch], Any], told: str) -> None:
    before = batch.get_state()
    with pytest.raises((TypeError, ValueError), match=f"(?s){told}") as raised:
        call(batch)
    assert len(str(raised.value)) < 1000 and "\n" not in str(raised.value)
    assert batch.get_state() == before


@pytest.mark.parametrize(
    ("path", "value", "same"),
    [
        ("body.magnets", np.int64(4), 4),
        ("body.magnets", np.array(4, np.uint8), 4),
        ("body.removed", np.array([1]), [1]),
        ("body.removed", [np.int64(1)], [1]),
        ("body.removed", (1,), [1]),
        ("magnetic_terms.torque", np.bool_(False), False),
        ("gravity_m_s2", np.float64(9.0), 9.0),
        ("gravity_m_s2", np.float32(9.5), 9.5),
        ("gravity_m_s2", 9, 9.0),
        ("name", np.str_("worm"), "worm"),
    ],
)
def test_values_of_a_scene_may_be_numpys(path: str, value: Any, same: Any) -> None:
    assert SCENE.with_values({path: value}) == SCENE.with_values({path: same})


def deep(levels: int) -> list[Any]:
    outer: list[Any] = []
    for _ in range(levels):
        outer = [outer]
    return outer


def endless() -> dict[str, Any]:
    inner: dict[str, Any] = {}
    inner["again"] = inner
    return inner


def endless_list() -> list[Any]:
    inner: list[Any] = []
    inner.append(inner)
    return inner


@pytest.mark.parametrize("value", [deep(10_000), endless(), endless_list(), {"a": deep(10_000)}])
def test_containers_without_an_end_are_refused_with_their_path(batch: Batch, value: Any) -> None:
    with pytest.raises(ValueError, match=r"^material[.\[].*containers"):
        SCENE.with_values({"material": value})
    for call in (batch.step, batch.copies, lambda v: batch.set_parameter("mass", v)):
        with pytest.raises((TypeError, ValueError), match=r"actions|environments|factors"):
            call(value)
    env = MagWormVectorEnv(2, threads=1)
    for key in ("start", "removed", "parameters", "reset_mask"):
        with pytest.raises(ValueError, match=key):
            env.reset(options={key: value})
    with pytest.raises(ValueError, match="options"):
        env.reset(options=value)
    with pytest.raises(ValueError, match="seed"):
        env.reset(seed=value)
    env.reset(seed=0)
    with pytest.raises(ValueError, match="actions"):
        env.step(value)
    with pytest.raises(ValueError, match="actions"):
        env.rollout(value)
    with pytest.raises(SceneError, match="scene"):
        load_scene(value)


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"body.magnets": 2**70}, "body.magnets is 1180591620717411303424.*64 bits"),
        ({"body.removed": [0, 10**5000]}, r"body.removed\[1\].*64 bits"),
        ({"name": "\udc80"}, "name.*UTF-8"),
        ({"name": b"worm"}, "name is of type bytes"),
        ({"name": {1, 2}}, "name is of type set"),
        ({"material": {3: 1.0}}, "key of material is 3"),
        ({3: 1.0}, "key of values is 3"),
        ({"material": {"density_kg_m3": None}}, "material.density_kg_m3 is None"),
        ({"material": {"density_kg_m3": 1j}}, "material.density_kg_m3 is of type complex"),
        ([("name", "worm")], "values is .*mapping"),
    ],
)
def test_values_that_no_scene_holds_are_refused_with_their_path(values: Any, told: str) -> None:
    with pytest.raises((TypeError, ValueError), match=told):
        SCENE.with_values(values)


def test_scene_errors_carry_field_and_line() -> None:
    text = SCENE.to_toml()
    bad = text.replace("static_friction = ", "static_friction = -")
    line = bad[: bad.index("static_friction")].count("\n") + 1
    with pytest.raises(SceneError, match=r"ground\.static_friction") as raised:
        Scene.from_toml(bad)
    for error in (raised.value, pickle.loads(pickle.dumps(raised.value))):
        assert (error.field, error.line) == ("ground.static_friction", line)
    with pytest.raises(SceneError) as raised:
        SCENE.with_values({"body.magnets": 0})
    assert (raised.value.field, raised.value.line) == ("body.magnets", None)
    with pytest.raises(SceneError) as raised:
        Scene.from_toml("a = [")
    assert (raised.value.field, raised.value.line) == (None, 1)
    with pytest.raises(SceneError) as raised:
        load_scene("paper-33")
    assert (raised.value.field, raised.value.line) == (None, None)


def test_equal_scenes_are_equal_keys() -> None:
    plus, minus = (SCENE.with_values({"start.x_m": zero}) for zero in (0.0, -0.0))
    other = SCENE.with_values({"start.x_m": 1e-300})
    assert plus == minus and hash(plus) == hash(minus) and plus.to_toml() == minus.to_toml()
    assert other != plus
    assert {plus: 1, other: 2}[pickle.loads(pickle.dumps(minus))] == 1
    assert all(hash(load_scene(name)) == hash(Scene.preset(name)) for name in magworm_gym.PRESETS)


def test_states_pass_between_equal_scenes_whatever_the_sign_of_their_zeros() -> None:
    plus, minus = (Batch(SCENE.with_values({"start.x_m": zero}), 2, threads=1) for zero in (0.0, -0.0))
    for batch in (plus, minus):
        batch.reset(ON, FIRST, FIRST)
        batch.step(ACTIONS)
    assert plus.get_state() == minus.get_state()
    plus.set_state(minus.get_state())


def test_scene_files_are_named_where_they_cannot_be_read(tmp_path: Path) -> None:
    text = "# St\u00e4rke\r\n" + SCENE.to_toml()
    path = tmp_path / "wurm.toml"
    path.write_bytes(b"\r\n" + text.encode("latin-1"))
    with pytest.raises(SceneError, match=r"wurm.toml is not UTF-8: byte 0xe4 in line 2"):
        load_scene(path)
    path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert load_scene(path) == SCENE
    for nothing in (tmp_path, "no\0file", "x" * 5000, b"paper-3", 3, None, tmp_path / "none.toml"):
        with pytest.raises(SceneError, match=r"scene is .*allowed"):
            load_scene(nothing)  # type: ignore[arg-type]
    with pytest.raises(SceneError, match="from_toml"):
        load_scene(SCENE.to_toml())


def test_a_batch_in_use_says_so() -> None:
    batch = Batch(Scene.preset("belt-125"), 64, threads=1)
    batch.reset(np.ones(64, np.bool_), np.zeros(64, np.uint64), np.zeros(64, np.uint64))
    long = threading.Thread(target=batch.advance, args=(20.0,))
    long.start()
    told = []
    while long.is_alive() and not told:
        try:
            batch.status()
        except RuntimeError as error:
            told.append(str(error))
    long.join()
    assert told and "this batch is in use" in told[0] and "allowed" in told[0]
    assert batch.num_envs == 64 and not batch.status().any()
