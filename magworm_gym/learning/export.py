"""A policy in the formats of others: ONNX, and the files of Stable-Baselines3."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

from magworm_gym.arguments import path_of
from magworm_gym.atomic_files import new_folder, replace_file
from magworm_gym.policy import Policy, PolicyError
from magworm_gym.spaces import box

OPSET = 17
OBSERVATIONS, ACTIONS = "observations", "actions"
MODEL, NORMALISER = "model.zip", "vecnormalize.pkl"


def export_onnx(policy: Policy, path: str | Path) -> None:
    """Writes a policy, its normaliser included, as an ONNX model.

    Its input ``observations`` (N, O) and its output ``actions`` (N, A) are float32, as those of the policy.

    Args:
        policy: What to write.
        path: File, replaced if it is there.

    Raises:
        ImportError: The extra ``magworm-gym[export]`` is missing.
    """
    try:
        import onnx
    except ImportError:
        raise ImportError('ONNX needs: pip install "magworm-gym[export]"') from None
    graph = _Graph(onnx)
    network, normaliser, single = policy.network, policy.normaliser, onnx.TensorProto.FLOAT
    rows = graph.add("Cast", OBSERVATIONS, to=onnx.TensorProto.DOUBLE)
    rows = graph.add("Sub", rows, graph.constant(normaliser.mean))
    rows = graph.add("Div", rows, graph.constant(normaliser.deviation))
    rows = graph.cut(rows, np.array(-normaliser.clip), np.array(normaliser.clip))
    rows = graph.add("Cast", rows, to=single)
    for number, layer in enumerate(network.layers):
        if number:
            rows = graph.add({"tanh": "Tanh", "relu": "Relu"}[network.activation], rows)
        rows = graph.add("Gemm", rows, graph.constant(layer.weight), graph.constant(layer.bias), transB=1)
    low, high = policy.low, policy.high
    if network.squashed:
        limit = np.array(network.limit, np.float32)
        rows = graph.add("Tanh", graph.cut(rows, -limit, limit))
        rows = graph.add("Mul", rows, graph.constant(0.5 * (high - low)))
        rows = graph.add("Add", rows, graph.constant(0.5 * (high + low)))
    graph.cut(rows, low, high, name=ACTIONS)
    helper = onnx.helper
    shapes = {OBSERVATIONS: network.inputs, ACTIONS: network.outputs}
    seen, acted = (helper.make_tensor_value_info(name, single, ["N", size]) for name, size in shapes.items())
    model = helper.make_model(
        helper.make_graph(graph.nodes, "policy", [seen], [acted], graph.constants),
        opset_imports=[helper.make_opsetid("", OPSET)],
        ir_version=8,
        doc_string=policy.sentence,
    )
    onnx.checker.check_model(model, full_check=True)
    with replace_file(path_of("path", path)) as part:
        part.write_bytes(model.SerializeToString())


class _Graph:
    """Nodes of an ONNX graph in the order of their computation."""

    def __init__(self, onnx: Any) -> None:
        self._onnx = onnx
        self.nodes: list[Any] = []
        self.constants: list[Any] = []

    def add(self, operation: str, *inputs: str, name: str | None = None, **options: Any) -> str:
        """Adds a node. Returns the name of its output."""
        output = name or f"{operation.lower()}_{len(self.nodes)}"
        self.nodes.append(self._onnx.helper.make_node(operation, list(inputs), [output], **options))
        return output

    def constant(self, values: Any) -> str:
        """Adds numbers. Returns their name."""
        name = f"constant_{len(self.constants)}"
        self.constants.append(self._onnx.numpy_helper.from_array(np.asarray(values), name))
        return name

    def cut(self, rows: str, low: Any, high: Any, name: str | None = None) -> str:
        """Cuts at bounds, which may be one for each column. Returns the name of what is left."""
        return self.add("Min", self.add("Max", rows, self.constant(low)), self.constant(high), name=name)


def export_sb3(policy: Policy, folder: str | Path) -> None:
    """Writes ``model.zip`` and ``vecnormalize.pkl`` of Stable-Baselines3.

    The model is PPO, or SAC where actions are squashed, and acts as the policy does. Critic and optimiser are
    new: before it learns on, it has to learn what its actions are worth. ``PPO.load`` and
    ``VecNormalize.load`` read the files; these hold pickles, so take none from others.

    Args:
        policy: What to write.
        folder: The folder of both files; replaced if it is there.

    Raises:
        PolicyError: The folder holds something else.
        ImportError: The extra ``magworm-gym[train]`` is missing.
    """
    try:
        import torch
        from stable_baselines3 import PPO, SAC
        from stable_baselines3.common.vec_env import DummyVecEnv, VecNormalize

        from magworm_gym.learning.actor import actor_modules
    except ImportError:
        raise ImportError('Stable-Baselines3 needs: pip install "magworm-gym[train]"') from None
    path = path_of("folder", folder)
    if path.exists() and {entry.name for entry in path.iterdir()} - {MODEL, NORMALISER}:
        raise PolicyError(f"folder is {str(path)!r}, which holds other files; allowed: a new or empty folder")
    network, normaliser = policy.network, policy.normaliser
    kind: type[PPO] | type[SAC] = SAC if network.squashed else PPO
    options: dict[str, Any] = {
        "net_arch": [len(layer.bias) for layer in network.layers[:-1]],
        "activation_fn": {"tanh": torch.nn.Tanh, "relu": torch.nn.ReLU}[network.activation],
    }
    limited = network.squashed and bool(np.isfinite(network.limit))
    if limited:
        options["clip_mean"] = network.limit
    spaces = DummyVecEnv([lambda: _Spaces(policy)])
    model = kind("MlpPolicy", spaces, policy_kwargs=options, use_sde=limited, device="cpu")
    linear = [module for module in actor_modules(model) if isinstance(module, torch.nn.Linear)]
    with torch.no_grad():
        for module, layer in zip(linear, network.layers, strict=True):
            module.weight.copy_(torch.tensor(layer.weight))
            module.bias.copy_(torch.tensor(layer.bias))
    statistics: Any = VecNormalize(spaces, epsilon=normaliser.epsilon, clip_obs=normaliser.clip)
    statistics.obs_rms.mean, statistics.obs_rms.var = normaliser.mean, normaliser.variance
    statistics.training = False
    with new_folder(path) as part:
        model.save(part / MODEL)
        statistics.save(str(part / NORMALISER))


class _Spaces(gymnasium.Env[Any, Any]):
    """The spaces of a policy, which is all that a model without an environment needs."""

    def __init__(self, policy: Policy) -> None:
        self.observation_space = box(policy.observation)
        self.action_space = box(policy.action)
