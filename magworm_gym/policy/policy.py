"""A trained policy with all that acting needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import ArrayLike, NDArray

from magworm_gym._magworm import Scene
from magworm_gym.arguments import numbers, shown
from magworm_gym.policy.fit import compare_limits, compare_parts, declarer, parts_of
from magworm_gym.policy.mistake import PolicyError
from magworm_gym.policy.network import Network, Normaliser
from magworm_gym.scene import AnyScenes, load_scenes
from magworm_gym.spaces import Part
from magworm_gym.vector_env import MagWormVectorEnv

Singles = NDArray[np.float32]

LARGEST = float(np.finfo(np.float32).max)


@dataclass(frozen=True, eq=False)
class Policy:
    """Actions for observations, and what is known of where they come from.

    >>> policy = magworm_gym.load_policy("crawl-3")
    >>> worms = policy.make_vec(num_envs=64)
    >>> observations, _ = worms.reset(seed=0)
    >>> observations, *_ = worms.step(policy(observations))

    Attributes:
        network: Layers.
        normaliser: What observations go through first.
        observation: Name, unit with its scale, size and bounds of each part of an observation.
        action: The same of an action.
        stage_limits: What an action of −1 or 1 is, see :attr:`Scene.stage_limits`.
        environment_id: Gymnasium's identifier of the environment that it was trained for.
        arguments: That environment's arguments beside scene and number; plain values.
        scenes: The scene that it was trained in, or several of one shape.
        sentence: What it does, in one sentence.
        provenance: How it was trained and what it reaches; plain values.

    Raises:
        PolicyError: Sizes of network, statistics and specification do not go together.
    """

    network: Network
    normaliser: Normaliser
    observation: Sequence[Part]
    action: Sequence[Part]
    stage_limits: Mapping[str, float]
    environment_id: str
    arguments: Mapping[str, Any]
    scenes: Sequence[Scene]
    sentence: str
    provenance: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Checks sizes."""
        observed, acted = (sum(part.size for part in parts) for parts in (self.observation, self.action))
        for what, size, allowed in (
            ("the network takes", self.network.inputs, observed),
            ("the normaliser takes", len(self.normaliser.mean), observed),
            ("the network gives", self.network.outputs, acted),
        ):
            if size != allowed:
                raise PolicyError(f"{what} {size} numbers; allowed by the specification: {allowed}")
        for part in self.action:
            if not -LARGEST <= part.low < part.high <= LARGEST:
                raise PolicyError(
                    f"action {part.name!r} has the bounds {part.low} and {part.high}; allowed: finite "
                    "ones, the lower first"
                )

    @classmethod
    def trained_in(
        cls,
        worms: MagWormVectorEnv,
        network: Network,
        normaliser: Normaliser,
        *,
        environment_id: str,
        arguments: Mapping[str, Any],
        sentence: str,
        provenance: Mapping[str, Any],
    ) -> Policy:
        """A policy that was trained in environments, whose specification and scene it takes.

        Raises:
            PolicyError: The network or the normaliser does not fit them.
        """
        return cls(
            network=network,
            normaliser=normaliser,
            observation=parts_of(worms.observation_specification),
            action=parts_of(worms.batch.action_specification),
            stage_limits=worms.scene.stage_limits or {},
            environment_id=environment_id,
            arguments=arguments,
            scenes=worms.scenes,
            sentence=sentence,
            provenance=provenance,
        )

    def __call__(self, observations: ArrayLike) -> Singles:
        """Actions for observations, without exploring: the same for the same.

        Args:
            observations: (O,) or (N, O), finite, as the environment gives them.

        Returns:
            (A,) or (N, A), float32, within the bounds of an action. A row is the same, to the bit, alone and
            among others.

        Raises:
            ValueError: Observations of a wrong shape, or one that is not finite.
        """
        size, rows = self.network.inputs, numbers(observations)
        if rows is None:
            raise ValueError(f"observations are {shown(observations)}; allowed: numbers of shape (N, {size})")
        if rows.ndim not in (1, 2) or rows.shape[-1] != size:
            raise ValueError(f"observations have shape {rows.shape}; allowed: ({size},) or (N, {size})")
        if not np.isfinite(rows).all():
            raise ValueError("an observation is not finite; allowed: finite numbers")
        actions = self.network(self.normaliser(np.atleast_2d(rows)), self.low, self.high)
        return actions if rows.ndim == 2 else actions[0]

    def make_vec(
        self,
        num_envs: int = 1,
        *,
        scene: AnyScenes | None = None,
        other_scene: bool = False,
        **arguments: Any,
    ) -> MagWormVectorEnv:
        """Makes the environments that the policy was trained for.

        Args:
            num_envs: Number of environments N.
            scene: Preset, path of a TOML file, or scene, or a list of several; None for the policy's own.
            other_scene: Whether the scene may differ from the policy's own.
            **arguments: Arguments of the environment that replace those of the training.

        Raises:
            PolicyError: The environment is not registered, or the policy does not fit it.
            SceneError: The scene cannot be simulated.
            ValueError: Another argument is out of range.
        """
        # Looked up, not handed on: Gymnasium imports what stands before a colon in an identifier.
        known = gymnasium.registry.get(self.environment_id)
        if known is None or not str(known.vector_entry_point).startswith("magworm_gym."):
            raise PolicyError(
                f"environment {shown(self.environment_id)} is no registered environment of worms; allowed: "
                "one that is, so import first what registers it"
            )
        scenes = self.scenes if scene is None else load_scenes(scene)
        try:
            made = gymnasium.make_vec(
                self.environment_id, num_envs=num_envs, scene=scenes, **{**self.arguments, **arguments}
            )
        except TypeError as error:
            raise PolicyError(f"{self.environment_id} does not take the arguments: {error}") from None
        assert isinstance(made, MagWormVectorEnv), "the entry point that was registered"
        self.check_fit(made, other_scene=other_scene)
        return made

    def check_fit(self, environment: Any, *, other_scene: bool = False) -> None:
        """Refuses an environment whose observations or actions the policy would take for something else.

        Args:
            environment: An environment of this package, single or vectorised, for Gymnasium or for
                Stable-Baselines3, or a :class:`~magworm_gym.Batch`.
            other_scene: Whether its scene may differ from the policy's own.

        Raises:
            PolicyError: Names, units, scales, sizes or bounds differ, a wrapper changes observations, or the
                scene is another.
        """
        known = declarer(environment)
        compare_parts("observation", self.observation, known.observation_specification)
        compare_parts("action", self.action, getattr(known, "batch", known).action_specification)
        for scene in known.scenes:
            compare_limits(self.stage_limits, scene.stage_limits or {})
            if scene not in self.scenes and not other_scene:
                raise PolicyError(
                    f"scene {scene.name!r} differs from {self.scene.name!r}, the scene of the training; "
                    "allowed: the same scene, or other_scene=True"
                )

    @property
    def scene(self) -> Scene:
        """The scene that it was trained in; the first of several."""
        return self.scenes[0]

    @property
    def low(self) -> Singles:
        """Least action (A,)."""
        return np.concatenate([np.full(part.size, part.low, np.float32) for part in self.action])

    @property
    def high(self) -> Singles:
        """Greatest action (A,)."""
        return np.concatenate([np.full(part.size, part.high, np.float32) for part in self.action])
