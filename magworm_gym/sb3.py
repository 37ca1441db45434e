"""Stable-Baselines3: the native vector environment as a ``VecEnv``.

Needs the extra ``magworm-gym[train]``; ``import magworm_gym`` does not import this module.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray
from stable_baselines3.common.monitor import Monitor
from stable_baselines3.common.vec_env.base_vec_env import VecEnv, VecEnvIndices

from magworm_gym import snapshot
from magworm_gym.arguments import Lanes, RenderMode
from magworm_gym.bookkeeping import Bookkeeping
from magworm_gym.infos import Infos, info_of
from magworm_gym.randomise import AnyRandomise
from magworm_gym.reset_options import MASK, AnyOptions
from magworm_gym.scene import AnyScenes
from magworm_gym.tasks import Task, TaskName
from magworm_gym.vector_env import MagWormVectorEnv
from magworm_gym.worlds import Observations

OF_ALL = ("close", "set_state", "step")
"""Methods of the batch that change all environments."""


class MagWormSB3VecEnv(VecEnv):
    """N worms for the algorithms of Stable-Baselines3.

    >>> from stable_baselines3 import PPO
    >>> model = PPO("MlpPolicy", MagWormSB3VecEnv(256), n_steps=32, batch_size=2048)

    It behaves as ``DummyVecEnv`` of monitored single environments does, with one difference that
    makes it quick: the info of an environment whose episode goes on is an empty dictionary. Where
    an episode ends, the info holds ``terminal_observation``, ``TimeLimit.truncated``, ``episode``
    (``r`` return, ``l`` length in control steps, ``t`` seconds since construction) and what
    :class:`~magworm_gym.vector_env.MagWormVectorEnv` says about its last step (``broken``, …).

    The environments live in one batch: attributes and methods are those of the whole batch (:attr:`worms`),
    whatever the index. ``env_method("reset", indices=…)`` alone is of the environments that it names.

    Args:
        num_envs: Number of environments N.
        scene: Preset, path of a TOML file, or scene; None takes the task's. Or a list of scenes of one
            shape: environment i of N has scene i S // N of S.
        max_episode_steps: Control steps until truncation; None takes the scene's ``episode_s``.
        render_mode: None, "rgb_array" or "human".
        render_envs: Environments to draw.
        lanes: "wide" or "scalar"; equal bit for bit.
        threads: Most threads to use; None for all cores.
        task: What is asked of the worms: "crawl", "turn", "reach", or a task such as ``Turn()``.
        randomise: :class:`~magworm_gym.Randomise`, or a mapping: how each episode draws its robot.

    Raises:
        SceneError: The scene cannot be simulated.
        ValueError: Another argument is out of range.
    """

    def __init__(
        self,
        num_envs: int = 1,
        scene: AnyScenes | None = None,
        max_episode_steps: int | None = None,
        render_mode: RenderMode | None = None,
        render_envs: Sequence[int] = (0,),
        lanes: Lanes = "wide",
        threads: int | None = None,
        task: Task | TaskName = "crawl",
        randomise: AnyRandomise | None = None,
    ) -> None:
        self.worms = MagWormVectorEnv(
            num_envs=num_envs,
            scene=scene,
            max_episode_steps=max_episode_steps,
            render_mode=render_mode,
            autoreset_mode=AutoresetMode.SAME_STEP,
            render_envs=render_envs,
            lanes=lanes,
            threads=threads,
            task=task,
            randomise=randomise,
        )
        super().__init__(num_envs, self.worms.single_observation_space, self.worms.single_action_space)
        self.metadata = self.worms.metadata
        self._actions: NDArray[Any] = np.zeros((num_envs, *self.action_space.shape))  # type: ignore[misc]
        self._returns = np.zeros(num_envs)
        self._lengths = np.zeros(num_envs, np.int64)
        self._built_s = time.monotonic()

    def reset(self) -> Observations:
        """Starts new episodes with the seeds and options given before. Returns observations (N, O).

        Raises:
            ValueError: A seed or an option is not allowed; nothing is changed then.
        """
        shared = self._options[0]
        same = all(options is shared or not (options or shared) for options in self._options)
        with Bookkeeping():
            observations = self._reset(self._seeds, shared if same else self._options)
            self._reset_seeds()
            self._reset_options()
        return observations

    def step_async(self, actions: NDArray[Any]) -> None:
        """Takes the actions (N, A) for the next :meth:`step_wait`."""
        self._actions = actions

    def step_wait(self) -> tuple[Observations, NDArray[np.float32], NDArray[np.bool_], list[Infos]]:
        """Advances by one control step.

        Returns:
            Fresh arrays: observations (N, O) float32, of the new episode where one ended, rewards
            (N,) float32, dones (N,) bool; and N infos.
        """
        with Bookkeeping():
            return self._account(*self.worms.step(self._actions))

    def _account(
        self,
        observations: Observations,
        rewards: NDArray[np.float64],
        terminated: NDArray[np.bool_],
        truncated: NDArray[np.bool_],
        batch_infos: Infos,
    ) -> tuple[Observations, NDArray[np.float32], NDArray[np.bool_], list[Infos]]:
        """What a step of the batch is to the statistics of episodes."""
        dones = terminated | truncated
        self._returns = self._returns + rewards
        self._lengths = self._lengths + 1
        infos: list[Infos] = [{} for _ in range(self.num_envs)]
        for i in np.flatnonzero(dones).tolist():
            infos[i] = self._last_info(batch_infos, i, time_limit=bool(truncated[i] and not terminated[i]))
            first = info_of(batch_infos, i)
            self.reset_infos[i] = {key: first[key] for key in first if not key.startswith("final_")}
        self._forget(dones)
        return observations, rewards.astype(np.float32), dones, infos

    def __copy__(self) -> MagWormSB3VecEnv:
        """A copy of its own in every respect: two could not share one simulation."""
        return deepcopy(self)

    def close(self) -> None:
        """Closes the window. May be called twice."""
        self.worms.close()

    def get_images(self) -> list[NDArray[np.uint8] | None]:
        """N frames (H, W, 3), black where an environment is not drawn; None without "rgb_array"."""
        frames = self.worms.render() if self.render_mode == "rgb_array" else None
        return [None] * self.num_envs if frames is None else list(frames)

    def get_attr(self, attr_name: str, indices: VecEnvIndices = None) -> list[Any]:
        """The attribute of the batch, once per index. Raises AttributeError."""
        value = getattr(self.worms, attr_name)
        return [value for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: VecEnvIndices = None) -> None:
        """Sets an attribute of the batch. Raises ValueError for some of the environments only."""
        self._assert_all(attr_name, indices)
        setattr(self.worms, attr_name, value)

    def env_method(
        self, method_name: str, *method_args: Any, indices: VecEnvIndices = None, **method_kwargs: Any
    ) -> list[Any]:
        """Calls a method of the batch, once, and returns its result once per index.

        "reset" takes ``seed`` and ``options`` of a single environment, resets those of the indices alone, and
        returns an observation (O,) and an info for each.

        Raises:
            ValueError: A method that changes all environments, for some of them only.
        """
        if method_name == "reset":
            return self._reset_some(list(self._get_indices(indices)), *method_args, **method_kwargs)
        if method_name in OF_ALL:
            self._assert_all(method_name, indices)
        result = getattr(self.worms, method_name)(*method_args, **method_kwargs)
        return [result for _ in self._get_indices(indices)]

    def env_is_wrapped(
        self, wrapper_class: type[gymnasium.Wrapper], indices: VecEnvIndices = None
    ) -> list[bool]:
        """True for ``Monitor``, whose statistics of episodes are kept here; nothing else is wrapped."""
        return [issubclass(Monitor, wrapper_class) for _ in self._get_indices(indices)]

    def get_state(self) -> bytes:
        """Everything that changes in time, statistics of running episodes included."""
        return snapshot.pack(self._fields())

    def set_state(self, state: bytes) -> None:
        """Goes on from such a state. Raises ValueError, changing nothing, for one of another scene or N."""
        fields = snapshot.unpack(state, self._fields(), {"lengths": snapshot.COUNT})
        with Bookkeeping():
            self.worms.set_state(fields["worms"].tobytes())
            self._returns, self._lengths = fields["returns"], fields["lengths"]

    def _fields(self) -> dict[str, NDArray[Any]]:
        worms = np.frombuffer(self.worms.get_state(), np.uint8)
        return {"worms": worms, "returns": self._returns, "lengths": self._lengths}

    def _reset(self, seeds: Sequence[int | None], options: AnyOptions) -> Observations:
        """Resets environments, and the statistics of those that the options chose."""
        observations, infos = self.worms.reset(seed=seeds, options=options)
        self._forget(infos["_seed"])
        for i in np.flatnonzero(infos["_seed"]).tolist():
            self.reset_infos[i] = info_of(infos, i)
        return observations

    def _reset_some(
        self, chosen: list[int], *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> list[tuple[Any, Infos]]:
        """As the environments of these indices would reset, each with the same seed and options."""
        mask = np.isin(np.arange(self.num_envs), chosen)
        seeds = [seed if of_mask else None for of_mask in mask]
        with Bookkeeping():
            observations = self._reset(seeds, {**(options or {}), MASK: mask})
        return [(observations[i], self.reset_infos[i]) for i in chosen]

    def _forget(self, mask: NDArray[np.bool_]) -> None:
        """Statistics of the episodes of mask (N,) begin again."""
        self._returns = np.where(mask, 0.0, self._returns)
        self._lengths = np.where(mask, 0, self._lengths)

    def _assert_all(self, name: str, indices: VecEnvIndices) -> None:
        if len(set(self._get_indices(indices))) != self.num_envs:
            raise ValueError(f"{name} belongs to the whole batch; indices must be None or all environments")

    def _last_info(self, batch_infos: Infos, i: int, *, time_limit: bool) -> Infos:
        return {
            **info_of(batch_infos["final_info"], i),
            "terminal_observation": batch_infos["final_obs"][i],
            "TimeLimit.truncated": time_limit,
            "episode": {
                "r": round(float(self._returns[i]), 6),
                "l": int(self._lengths[i]),
                "t": round(time.monotonic() - self._built_s, 6),
            },
        }


def __getattr__(name: str) -> Any:
    """The name that the adapter had before."""
    if name == "MagWormVecEnv":
        warnings.warn("MagWormVecEnv is now called MagWormSB3VecEnv", DeprecationWarning, stacklevel=2)
        return MagWormSB3VecEnv
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
