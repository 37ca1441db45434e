"""Policies of Stable-Baselines3 and in the formats of others: equal to what their own programs compute."""

import copy
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

torch = pytest.importorskip("torch")
pytest.importorskip("stable_baselines3")

from stable_baselines3 import PPO, SAC  # noqa: E402
from stable_baselines3.common.vec_env import DummyVecEnv, VecNormalize  # noqa: E402

from magworm_gym import Policy, PolicyError, load_policy, save_policy  # noqa: E402
from magworm_gym.cli import main  # noqa: E402
from magworm_gym.learning.actor import network_of, normaliser_of  # noqa: E402
from magworm_gym.learning.export import _Spaces, export_onnx, export_sb3  # noqa: E402
from magworm_gym.sb3 import MagWormSB3VecEnv  # noqa: E402

TOLERANCE = 1e-5
TANH = {"net_arch": [32, 32], "activation_fn": torch.nn.Tanh}
RELU = {"net_arch": {"pi": [24], "vf": [8], "qf": [8]}, "activation_fn": torch.nn.ReLU}
KINDS: dict[str, tuple[Any, dict[str, Any]]] = {
    "PPO": (PPO, {"policy_kwargs": TANH}),
    "PPO, relu": (PPO, {"policy_kwargs": RELU}),
    "PPO, gSDE": (PPO, {"policy_kwargs": TANH, "use_sde": True}),
    "PPO, gSDE, squashed": (PPO, {"policy_kwargs": {**TANH, "squash_output": True}, "use_sde": True}),
    "SAC": (SAC, {"policy_kwargs": RELU}),
    "SAC, tanh, gSDE": (SAC, {"policy_kwargs": TANH, "use_sde": True}),
    "a single layer": (PPO, {"policy_kwargs": {"net_arch": []}}),
}


def trained(name: str, normalise: bool) -> tuple[Any, VecNormalize | None, Policy]:
    """A model with random weights, its statistics and the policy made of both."""
    kind, options = KINDS[name]
    robots = MagWormSB3VecEnv(4)
    normalisation = VecNormalize(robots) if normalise else None
    if normalisation is not None:
        normalisation.reset()
        for _ in range(30):
            normalisation.step(np.random.default_rng(0).uniform(-1.0, 1.0, (4, 3)))
    model = kind("MlpPolicy", normalisation or robots, device="cpu", seed=0, **copy.deepcopy(options))
    generator = torch.Generator().manual_seed(0)
    with torch.no_grad():
        for values in model.policy.parameters():
            values.copy_(torch.randn(values.shape, generator=generator) * 1.5 / values.shape[-1] ** 0.5)
    policy = Policy.trained_in(
        robots.worms,
        network_of(model),
        normaliser_of(normalisation, 25),
        environment_id="MagWorm/Crawl-v0",
        arguments={},
        sentence="Is random.",
        provenance={},
    )
    return model, normalisation, policy


def observations(policy: Policy) -> np.ndarray:
    """Random ones about the mean, small and so large that the normaliser cuts them."""
    generator = np.random.default_rng(2)
    scales = 10.0 ** generator.uniform(-2.0, 1.0, (500, 1)) * policy.normaliser.deviation
    return (policy.normaliser.mean + generator.normal(size=(500, 25)) * scales).astype(np.float32)


def predicted(model: Any, normalisation: VecNormalize | None, seen: np.ndarray) -> np.ndarray:
    normalised = seen if normalisation is None else normalisation.normalize_obs(seen)
    return np.asarray(model.predict(normalised, deterministic=True)[0])


@pytest.mark.parametrize("normalise", [True, False])
@pytest.mark.parametrize("name", KINDS)
def test_a_policy_gives_what_its_model_predicts(name: str, normalise: bool, tmp_path: Path) -> None:
    model, normalisation, policy = trained(name, normalise)
    save_policy(tmp_path / "policy", policy)
    seen = observations(policy)
    wanted = predicted(model, normalisation, seen)
    assert wanted.std() > 0.1
    assert np.abs(load_policy(tmp_path / "policy")(seen) - wanted).max() < TOLERANCE


@pytest.mark.parametrize("normalise", [True, False])
@pytest.mark.parametrize("name", KINDS)
def test_onnx_gives_what_the_policy_gives(name: str, normalise: bool, tmp_path: Path) -> None:
    runtime = pytest.importorskip("onnxruntime")
    pytest.importorskip("onnx")
    _, _, policy = trained(name, normalise)
    export_onnx(policy, tmp_path / "policy.onnx")
    session = runtime.InferenceSession(tmp_path / "policy.onnx", providers=["CPUExecutionProvider"])
    for seen in (observations(policy), observations(policy)[:1]):
        (given,) = session.run(["actions"], {"observations": seen})
        assert given.dtype == np.float32 and np.abs(given - policy(seen)).max() < TOLERANCE


@pytest.mark.parametrize("name", KINDS)
def test_stable_baselines3_loads_a_policy_that_acts_the_same(name: str, tmp_path: Path) -> None:
    _, _, policy = trained(name, True)
    for _ in range(2):  # files of an earlier export are replaced
        export_sb3(policy, tmp_path / "sb3")
    kind = SAC if policy.network.squashed else PPO
    robots = DummyVecEnv([lambda: _Spaces(policy)])
    model = kind.load(tmp_path / "sb3" / "model.zip", device="cpu")
    normalisation = VecNormalize.load(str(tmp_path / "sb3" / "vecnormalize.pkl"), robots)
    seen = observations(policy)
    assert not normalisation.training
    assert np.abs(predicted(model, normalisation, seen) - policy(seen)).max() < TOLERANCE
    (tmp_path / "sb3" / "notes.txt").touch()
    with pytest.raises(PolicyError, match="other files"):
        export_sb3(policy, tmp_path / "sb3")


def test_an_actor_that_is_no_perceptron_of_tanh_or_relu_is_refused() -> None:
    for name, activation in (("PPO", torch.nn.ELU), ("SAC", torch.nn.LeakyReLU)):
        kind, _ = KINDS[name]
        model = kind(
            "MlpPolicy", MagWormSB3VecEnv(1), policy_kwargs={"activation_fn": activation}, device="cpu"
        )
        with pytest.raises(PolicyError, match="allowed: linear layers with tanh or relu"):
            network_of(model)


def test_normalised_environments_are_refused() -> None:
    _, normalisation, policy = trained("PPO", True)
    policy.check_fit(MagWormSB3VecEnv(1))
    with pytest.raises(PolicyError, match="a wrapper"):
        policy.check_fit(normalisation)


def test_the_command_writes_both_and_says_what_is_wrong(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("onnx")
    _, _, policy = trained("SAC", True)
    save_policy(tmp_path / "policy", policy)
    for words, code, told in (
        (["policies"], 0, ""),
        (["export-policy", str(tmp_path / "policy"), "--onnx", str(tmp_path / "p.onnx")], 0, "p.onnx"),
        (["export-policy", str(tmp_path / "policy"), "--sb3", str(tmp_path / "sb3")], 0, "sb3"),
        (["export-policy", str(tmp_path / "policy"), "--sb3", str(tmp_path)], 2, "which holds other files"),
        (["export-policy", "crawl-99", "--sb3", str(tmp_path / "sb3")], 2, "policy is 'crawl-99'; allowed: "),
    ):
        with pytest.raises(SystemExit) as ended:
            main(words)
        out = "".join(capsys.readouterr())
        assert ended.value.code == code and told in out and "Traceback" not in out
    assert (tmp_path / "p.onnx").exists() and (tmp_path / "sb3" / "model.zip").exists()
    monkeypatch.setitem(sys.modules, "onnx", None)
    with pytest.raises(SystemExit):
        main(["export-policy", str(tmp_path / "policy"), "--onnx", str(tmp_path / "p.onnx")])
    assert 'pip install "magworm-gym[export]"' in capsys.readouterr().err
