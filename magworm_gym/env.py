"""The single environment: a batch of one."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import ArrayLike, NDArray

from magworm_gym.arguments import RENDER_MODES, Lanes, RenderMode, action_rows
from magworm_gym.bookkeeping import Bookkeeping
from magworm_gym.drawing import Frame
from magworm_gym.infos import Infos, info_of
from magworm_gym.randomise import AnyRandomise
from magworm_gym.rollout import Rollout
from magworm_gym.scene import AnyScene
from magworm_gym.specified import Specified
from magworm_gym.tasks import Task, TaskName
from magworm_gym.vector_env import MagWormVectorEnv
from magworm_gym.worlds import Observations


class MagWormEnv(Specified, gymnasium.Env[Observations, NDArray[Any]]):
    """One worm above a driven magnet.

    Gymnasium makes one with ``gymnasium.make("MagWorm/Crawl-v0")``, or ``Turn-v1``, ``Reach-v1``. Actions,
    observations, rewards, starts, seeds and options are those of
    :class:`~magworm_gym.vector_env.MagWormVectorEnv`, without the leading axis;
    infos hold plain numbers and strings, without masks.

    The time limit of the class is the scene's. That of an ID counts in ``gymnasium.make``, which takes
    another as ``max_episode_steps`` and says once where the scene's differs.

    Args:
        scene: Preset, path of a TOML file, or scene; its drive must follow actions. None takes the task's.
        max_episode_steps: Control steps until truncation; None takes the scene's ``episode_s``.
        render_mode: None; "rgb_array": :meth:`render` returns a frame; "human": a window follows
            each reset and step.
        lanes: "scalar", or "wide" for SIMD, which cannot help one environment; equal bit for bit.
        threads: Most threads to use: one environment needs no more than 1.
        task: What is asked of the worm: "crawl", "turn", "reach", or a task such as ``Turn()``.
        randomise: :class:`~magworm_gym.Randomise`, or a mapping: how each episode draws its robot.

    Raises:
        SceneError: The scene cannot be simulated.
        ValueError: Another argument is out of range.
    """

    metadata: dict[str, Any] = {"render_modes": list(RENDER_MODES), "render_fps": 50}  # noqa: RUF012

    def __init__(
        self,
        scene: AnyScene | None = None,
        max_episode_steps: int | None = None,
        render_mode: RenderMode | None = None,
        lanes: Lanes = "scalar",
        threads: int | None = 1,
        task: Task | TaskName = "crawl",
        randomise: AnyRandomise | None = None,
    ) -> None:
        self._worms = MagWormVectorEnv(
            num_envs=1,
            scene=scene,
            max_episode_steps=max_episode_steps,
            render_mode=render_mode,
            autoreset_mode=AutoresetMode.DISABLED,
            lanes=lanes,
            threads=threads,
            task=task,
            randomise=randomise,
        )
        self._worlds = self._worms._worlds
        self.render_mode = render_mode
        self.metadata = {key: self._worms.metadata[key] for key in ("render_modes", "render_fps")}
        self.observation_space = self._worms.single_observation_space
        self.action_space = self._worms.single_action_space
        self._components = sum(part.size for part in self.batch.action_specification)

    @property
    def _np_random(self) -> np.random.Generator | None:
        """The batch keeps the generator behind `np_random`, so that states and copies hold it once."""
        return self._worms._np_random

    @_np_random.setter
    def _np_random(self, value: np.random.Generator | None) -> None:
        self._worms._np_random = value

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Observations, Infos]:
        """Starts an episode.

        Args:
            seed: From 0 to 2^63 - 1; None goes on to the next episode of the seed.
            options: See :class:`~magworm_gym.vector_env.MagWormVectorEnv`. Never changed.

        Returns:
            The observation (O,), float32, and the info.

        Raises:
            ValueError: The seed or an option is not allowed; nothing is changed then.
        """
        with Bookkeeping():
            observations, infos = self._worms.reset(seed=seed, options=options)
            super().reset(seed=None if seed is None else int(seed))
        return observations[0], info_of(infos, 0)

    def step(self, action: ArrayLike) -> tuple[Observations, float, bool, bool, Infos]:
        """Advances by one control step.

        Args:
            action: (A,), finite; values outside [-1, 1] are clipped.

        Returns:
            The observation (O,) float32, the reward, terminated, truncated, the info.

        Raises:
            ValueError: A wrong shape or a value that is not finite; the state is untouched then.
            ResetNeeded: The episode has ended, or none was started.
        """
        row = action_rows(action, (self._components,))
        observations, rewards, terminated, truncated, infos = self._worms.step(row[np.newaxis])
        return observations[0], float(rewards[0]), bool(terminated[0]), bool(truncated[0]), info_of(infos, 0)

    def rollout(self, actions: ArrayLike, *, observations: bool = False) -> Rollout:
        """Plays K plans (T, K, A) of T control steps from the present state, in one call and on copies.

        See :meth:`magworm_gym.MagWormVectorEnv.rollout`. This environment stays as it is.
        """
        return self._worms.rollout(actions, start=0, observations=observations)

    def render(self) -> Frame | None:
        """Returns a frame (H, W, 3), uint8, with render mode "rgb_array", else None."""
        frames = self._worms.render()
        return None if frames is None else frames[0]

    def get_state(self) -> bytes:
        """Everything that changes in time, for :meth:`set_state`: the continuation is equal bit for bit."""
        return self._worms.get_state()

    def set_state(self, state: bytes) -> None:
        """Goes on from a state of an environment with the same scene. Raises ValueError, changing nothing."""
        self._worms.set_state(state)

    def __copy__(self) -> MagWormEnv:
        """A copy of its own in every respect: two could not share one simulation."""
        return deepcopy(self)

    def close(self) -> None:
        """Closes the window. May be called twice."""
        self._worms.close()
