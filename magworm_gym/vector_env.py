"""The native vector environment."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from typing import Any

import numpy as np
from gymnasium import logger
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from magworm_gym._magworm import Scene
from magworm_gym.arguments import (
    RENDER_MODES,
    AnyAutoreset,
    Lanes,
    RenderMode,
    action_rows,
    autoreset,
    choice,
    indices,
    positive,
    seeds_of,
)
from magworm_gym.bookkeeping import Bookkeeping, put_back
from magworm_gym.drawing import Drawing, Frame
from magworm_gym.infos import Flags, Infos
from magworm_gym.randomise import AnyRandomise, load_randomise
from magworm_gym.reset_options import AnyOptions
from magworm_gym.robots import Robots
from magworm_gym.rollout import Rollout, roll_out
from magworm_gym.scene import AnyScenes, episode_steps, load_scenes
from magworm_gym.spaces import box
from magworm_gym.specified import Specified
from magworm_gym.state import pack, restore
from magworm_gym.tasks import Task, TaskName, task_of
from magworm_gym.worlds import Observations, Worlds, controlled_batch

RANDOM = ("_np_random", "_np_random_seed")
"""Attributes behind ``np_random``, which a reset changes before the simulator is asked."""


class MagWormVectorEnv(Specified, VectorEnv[Observations, ArrayLike, NDArray[Any]]):
    """N worms above a driven magnet, advanced together by the compiled simulator.

    Gymnasium makes one with ``gymnasium.make_vec("MagWorm/Crawl-v0", num_envs=N)``, or ``Turn-v1``,
    ``Reach-v1``. What is asked of them is their task: see :class:`~magworm_gym.tasks.Crawl`,
    :class:`~magworm_gym.tasks.Turn` and :class:`~magworm_gym.tasks.Reach` for rewards, goals, ends and infos.

    **Action** (A,), float32 in [-1, 1], clipped: target position of the stage along the robot, its
    height, its travel speed; in space also its place to the robot's side and, where the stage has it,
    its yaw: see ``batch.action_specification``. **Observation**: see :attr:`observation_layout`; units and
    bounds stand in :attr:`observation_specification`. **Reward** and **terminated**: the task's; 0 and False
    in the step in which a worm breaks. **Truncated**: at the time limit, or where the simulation of a worm
    breaks numerically.

    **Info** of a step: ``progress_m``, ``time_s`` since the start of the episode, what the task adds, and
    where an episode ends ``time_limit`` (bool: it ended by the limit), ``is_success`` (bool: only for tasks
    with a goal) and ``broken`` (the reason, only for broken worms). Of a reset: ``time_s``, ``seed``,
    ``episode_number``, and the task's goal. As usual in Gymnasium, each is an array of length N beside a
    mask ``_key``; every step has the same keys, whose masks are False where there is nothing to say.

    **Seeds**: what a reset draws depends on the seed of the environment and the number of its
    episode alone, not on N, the order of environments or threads. A reset with a seed starts at
    episode 0; one without a seed, and every autoreset, goes on to the next episode of the seed.

    **Options** of a reset hold until the next call of :meth:`reset` for the same environment,
    through autoresets; a scalar is for all environments, an array (N,) one value for each:

    - ``"start"``: ``{"x_m", "height_m", "angle_deg"}``, in space also ``"z_m"`` and ``"yaw_deg"``: pose of
      the body; parts left out are 0. Its shape, straight or bent, is always the scene's.
    - ``"removed"``: magnets taken out, counted from 0 at the head, in place of the scene's own
      ``removed``: one sequence for all, or N sequences.
    - ``"parameters"``: factors of the scene's values by name, see ``batch.parameter_names``.
    - ``"goal_deg"`` or ``"goal_m"``: see the task; where it is left out, each episode draws a goal.
    - ``"reset_mask"``: bool array (N,), the environments to reset.

    In place of one mapping a list of N mappings may be given, one for each environment, without masks.

    Args:
        num_envs: Number of environments N.
        scene: Preset, path of a TOML file, or scene; its drive must follow actions. None takes the
            task's: ``paper-3`` in the plane for "crawl", ``turn-3-pair`` in space for the others. A list of S
            scenes of one shape gives environment i the scene i S // N, see :attr:`scenes`.
        max_episode_steps: Control steps until truncation; None takes the scene's ``episode_s``.
        render_mode: None; "rgb_array": :meth:`render` returns frames; "human": a window follows
            each reset and step.
        autoreset_mode: An ``AutoresetMode`` or its value ("NextStep", "SameStep", "Disabled").
        render_envs: Environments to draw. "human" shows the first of them.
        lanes: "wide" for SIMD, or "scalar"; the results are equal bit for bit.
        threads: Most threads to use; None for all cores.
        task: What is asked of the worms: "crawl", "turn", "reach", or a task such as ``Turn()``.
        randomise: :class:`~magworm_gym.Randomise`, or a mapping: how each episode draws its robot.
            None: all robots are the scene's.

    Raises:
        SceneError: The scene cannot be simulated.
        ValueError: Another argument is out of range.
    """

    metadata: dict[str, Any] = {"render_modes": list(RENDER_MODES), "render_fps": 50}  # noqa: RUF012

    # Here, since Gymnasium may close an environment whose constructor raised.
    _drawing: Drawing | None = None

    def __init__(
        self,
        num_envs: int = 1,
        scene: AnyScenes | None = None,
        max_episode_steps: int | None = None,
        render_mode: RenderMode | None = None,
        autoreset_mode: AnyAutoreset = AutoresetMode.NEXT_STEP,
        render_envs: Sequence[int] = (0,),
        lanes: Lanes = "wide",
        threads: int | None = None,
        task: Task | TaskName = "crawl",
        randomise: AnyRandomise | None = None,
    ) -> None:
        settings = task_of(task)
        scenes = load_scenes(settings.default_scene if scene is None else scene)
        self.num_envs = positive("num_envs", num_envs)
        self.render_mode = choice("render_mode", render_mode, (None, *RENDER_MODES))
        self._render_envs = indices("render_envs", render_envs, self.num_envs)
        mode, drawn = autoreset(autoreset_mode), load_randomise(randomise)
        batch = controlled_batch(scenes, self.num_envs, lanes, threads)
        limit = episode_steps(batch.scene) if max_episode_steps is None else max_episode_steps
        limit = positive("max_episode_steps", limit)
        ready = settings.prepared(batch.scene, batch.observation_specification, self.num_envs)
        self._worlds = Worlds(batch, ready, Robots(batch, drawn), mode, limit)
        self.metadata = {
            "render_modes": list(RENDER_MODES),
            "render_fps": max(1, round(1.0 / self.scene.control_step_s)),
            "autoreset_mode": mode,
        }
        self.single_observation_space = box(self.observation_specification)
        self.single_action_space = box(batch.action_specification)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._action_shape = (self.num_envs, sum(part.size for part in batch.action_specification))

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes; ``batch.scene_indices`` (N,) says which of them each environment has."""
        return self.batch.scenes

    @property
    def autoreset_mode(self) -> AutoresetMode:
        """When an episode that ended is followed by the next."""
        return self._worlds.autoreset

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: AnyOptions = None,
    ) -> tuple[Observations, Infos]:
        """Starts new episodes.

        Args:
            seed: s gives environment i the seed s + i; a sequence gives each its own, with None for
                those that go on to the next episode of their seed. Environments that were never
                seeded draw one from ``np_random``. Seeds are from 0 to 2^63 - 1.
            options: See the class. Never changed.

        Returns:
            Observations (N, O), float32, of all environments, and the infos of those reset.

        Raises:
            ValueError: A seed or an option is not allowed; nothing is changed then.
        """
        seeds = seeds_of(seed, self.num_envs)
        request = self._worlds.allowed.read(options, self.num_envs)
        with Bookkeeping() as books, put_back(self, RANDOM):
            if isinstance(seed, (int, np.integer)):
                super().reset(seed=int(seed))
            infos = self._worlds.reset(request, seeds, self.np_random, books)
        self._show(infos)
        return self._worlds.observe(), infos

    def step(self, actions: ArrayLike) -> tuple[Observations, NDArray[np.float64], Flags, Flags, Infos]:
        """Advances every environment by one control step.

        Args:
            actions: (N, A), finite; values outside [-1, 1] are clipped. With ``NEXT_STEP`` the rows of
                environments that reset in this step are ignored.

        Returns:
            Fresh arrays: observations (N, O) float32, rewards (N,) float64, terminated (N,) and
            truncated (N,) bool, and the infos.

        Raises:
            ValueError: A wrong shape or a value that is not finite; the state is untouched then.
            ResetNeeded: An environment was never reset, or with ``DISABLED`` not since its episode ended.
        """
        values = action_rows(actions, self._action_shape)
        with Bookkeeping() as books:
            stepped = self._worlds.step(values, books)
        self._show(stepped[-1])
        return stepped

    def rollout(
        self,
        actions: ArrayLike,
        *,
        start: int | Sequence[int] | NDArray[Any] | None = None,
        observations: bool = False,
    ) -> Rollout:
        """Plays K plans of T control steps from the present states, in one call and on copies.

        Rewards and ends are bit for bit those of :meth:`step`. These environments stay as they are.

        Args:
            actions: (T, K, A), finite; values outside [-1, 1] are clipped.
            start: The environment whose state a plan starts from: one for all, or one for each plan (K,);
                None: plan k starts from environment k, and K is N.
            observations: Whether observations are kept.

        Raises:
            ValueError: Actions or starts of a wrong shape or value.
            ResetNeeded: An environment to start from was never reset.
        """
        return roll_out(self._worlds, actions, start, observations)

    def render(self) -> tuple[Frame, ...] | None:
        """Draws the environments `render_envs`.

        Returns:
            With "rgb_array" N frames (H, W, 3), uint8, black for environments that are not drawn;
            else None.
        """
        if self.render_mode is None:
            logger.warn(
                "render() draws nothing without a render_mode: make the environment with 'rgb_array'."
            )
        if self.render_mode != "rgb_array":
            return None
        return self._drawn().frames()

    def get_state(self) -> bytes:
        """Everything that changes in time, for :meth:`set_state`: the continuation is equal bit for bit."""
        return pack(self._worlds, self.np_random)

    def set_state(self, state: bytes) -> None:
        """Goes on from a state of an environment with the same scene, N and autoreset mode.

        Raises:
            ValueError: The bytes are no such state; nothing is changed then.
        """
        restore(self._worlds, self.np_random, state)
        if self._drawing is not None:
            self._drawing.forget(np.ones(self.num_envs, np.bool_))

    def close_extras(self, **_: Any) -> None:
        """Closes the window."""
        if self._drawing is not None:
            self._drawing.close()
            self._drawing = None

    def __copy__(self) -> MagWormVectorEnv:
        """A copy of its own in every respect: two could not share one simulation."""
        return deepcopy(self)

    def __getstate__(self) -> dict[str, Any]:
        """A copy goes on bit for bit, and opens a window of its own."""
        _ = self.np_random  # made on first use: from now on both have the same
        return {**self.__dict__, "_drawing": None}

    def _drawn(self) -> Drawing:
        if self._drawing is None:
            self._drawing = Drawing(self.batch, self._render_envs, self.task)
        return self._drawing

    def _show(self, infos: Infos) -> None:
        """Follows a call in the window; episodes that it started have new trails."""
        if self._drawing is not None and "_seed" in infos:
            self._drawing.forget(infos["_seed"])
        if self.render_mode == "human":
            self._drawn().show()
