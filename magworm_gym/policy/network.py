"""From observations to actions: statistics, layers, bounds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import shown
from magworm_gym.policy.mistake import PolicyError

Singles = NDArray[np.float32]
Floats = NDArray[np.float64]

ACTIVATIONS = ("tanh", "relu")


@dataclass(frozen=True, eq=False)
class Normaliser:
    """Brings observations to mean 0 and variance 1: clip((o − mean) / √(variance + epsilon)).

    Attributes:
        mean: (O,).
        variance: (O,).
        epsilon: Keeps a component that never changed from being divided by 0.
        clip: Largest magnitude of what comes out; inf for none.
    """

    mean: Floats
    variance: Floats
    epsilon: float = 0.0
    clip: float = np.inf

    def __post_init__(self) -> None:
        """Checks the numbers. Raises PolicyError."""
        if self.mean.ndim != 1 or self.mean.shape != self.variance.shape:
            raise PolicyError(
                f"mean and variance have {self.mean.shape} and {self.variance.shape} numbers; allowed: one "
                "for each component of an observation"
            )
        if not (np.isfinite(self.mean).all() and np.isfinite(self.deviation).all() and self.deviation.all()):
            raise PolicyError(
                "mean, variance or epsilon is out of range; allowed: numbers, with variance + epsilon above 0"
            )
        if not self.clip > 0.0:
            raise PolicyError(f"clip is {self.clip}; allowed: more than 0")

    @classmethod
    def none(cls, size: int) -> Normaliser:
        """The normaliser of a policy that takes observations (O,) as they are."""
        return cls(np.zeros(size), np.ones(size))

    @property
    def deviation(self) -> Floats:
        """What is divided by (O,)."""
        with np.errstate(invalid="ignore"):
            return np.sqrt(self.variance + self.epsilon)

    def __call__(self, observations: NDArray[Any]) -> Singles:
        """Normalised observations (N, O)."""
        scaled = (observations - self.mean) / self.deviation
        return np.clip(scaled, -self.clip, self.clip).astype(np.float32)


@dataclass(frozen=True, eq=False)
class Layer:
    """A linear layer.

    Attributes:
        weight: (outputs, inputs).
        bias: (outputs,).
    """

    weight: Singles
    bias: Singles

    def __call__(self, rows: Singles) -> Singles:
        """The layer's outputs (N, outputs) for rows (N, inputs).

        Each row is a product of its own, so that its result is the same, to the bit, alone and among others.
        """
        return np.asarray((rows[:, None, :] @ self.weight.T)[:, 0] + self.bias)


@dataclass(frozen=True, eq=False)
class Network:
    """A multilayer perceptron whose outputs are actions.

    Attributes:
        layers: The hidden layers, then the one that gives the action.
        activation: "tanh" or "relu", after each hidden layer.
        squashed: Whether the action is the tanh of the last layer, stretched to the bounds, as SAC's is; else
            it is the last layer cut at the bounds, as PPO's is.
        limit: Largest magnitude of the last layer before it is squashed; inf for none.
    """

    layers: Sequence[Layer]
    activation: str = "tanh"
    squashed: bool = False
    limit: float = np.inf

    def __post_init__(self) -> None:
        """Checks that the layers are numbers and follow each other. Raises PolicyError."""
        if self.activation not in ACTIVATIONS:
            raise PolicyError(f"activation is {shown(self.activation)}; allowed: {', '.join(ACTIVATIONS)}")
        if not self.layers:
            raise PolicyError("there are no layers; allowed: one at least")
        for number, layer in enumerate(self.layers):
            shape, of_bias = layer.weight.shape, layer.bias.shape
            if len(shape) != 2 or of_bias != shape[:1]:
                raise PolicyError(
                    f"layer {number} has weights of shape {shape} and biases of shape {of_bias}; allowed: "
                    "(outputs, inputs) and (outputs,)"
                )
            if not (np.isfinite(layer.weight).all() and np.isfinite(layer.bias).all()):
                raise PolicyError(f"layer {number} has a number that is not finite; allowed: finite ones")
            before = self.layers[number - 1].weight.shape[0] if number else shape[1]
            if shape[1] != before:
                raise PolicyError(
                    f"layer {number} takes {shape[1]} numbers; allowed: {before}, as the one before gives"
                )
        if not self.limit > 0.0:
            raise PolicyError(f"limit is {self.limit}; allowed: more than 0")

    @property
    def inputs(self) -> int:
        """Numbers of an observation O."""
        return int(self.layers[0].weight.shape[1])

    @property
    def outputs(self) -> int:
        """Numbers of an action A."""
        return int(self.layers[-1].weight.shape[0])

    def __call__(self, rows: Singles, low: Singles, high: Singles) -> Singles:
        """Actions (N, A) within the bounds (A,) for normalised observations (N, O)."""
        for layer in self.layers[:-1]:
            rows = layer(rows)
            rows = np.tanh(rows) if self.activation == "tanh" else np.maximum(rows, np.float32(0.0))
        actions = self.layers[-1](rows)
        if self.squashed:
            actions = np.tanh(np.clip(actions, -self.limit, self.limit))
            actions = low + np.float32(0.5) * (actions + np.float32(1.0)) * (high - low)
        return np.clip(actions, low, high)
