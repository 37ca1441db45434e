"""The native vector environment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium import logger
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from magworm_gym._magworm import Batch, Scene
from magworm_gym.arguments import action_rows, choice, indices, positive, seeds_of
from magworm_gym.bookkeeping import Bookkeeping, put_back
from magworm_gym.drawing import Drawing, Frame
from magworm_gym.draws import next_episodes, uniform
from magworm_gym.episodes import Episodes
from magworm_gym.infos import Flags, Infos, add, rows
from magworm_gym.outcome import outcome_of, step_infos
from magworm_gym.reset_options import equipped, read_options, start_limits
from magworm_gym.rollout import Origin, Rollout, roll_out
from magworm_gym.scene import AnyScenes, load_scenes
from magworm_gym.spaces import AnyPart, box, layout
from magworm_gym.state import State
from magworm_gym.tasks import Task, task_named

Observations = NDArray[np.float32]

RENDER_MODES = ("human", "rgb_array")
DRAWN = ("_episodes", "_np_random", "_np_random_seed")
"""Attributes that a reset changes before the simulator is asked."""


class MagWormVectorEnv(VectorEnv[Observations, ArrayLike, NDArray[Any]]):
    """N worms above a driven magnet, advanced together by the compiled simulator.

    Gymnasium makes one with ``gymnasium.make_vec("MagWorm/Crawl-v0", num_envs=N)``, or ``Turn-v0``,
    ``Reach-v0``. What is asked of them is their task: see :class:`~magworm_gym.tasks.Crawl`,
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
    ``episode_number``, and the task's goal. As usual in Gymnasium, each
    is an array of length N beside a mask ``_key``.

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

    Args:
        num_envs: Number of environments N.
        scene: Preset, path of a TOML file, or scene; its drive must follow actions. None takes the
            task's: ``paper-3`` in the plane for "crawl", ``turn-3`` in space for the others. A list of S
            scenes of one shape gives environment i the scene i S // N, see :attr:`scenes`.
        max_episode_steps: Control steps until truncation; None takes the scene's ``episode_s``.
        render_mode: None; "rgb_array": :meth:`render` returns frames; "human": a window follows
            each reset and step.
        autoreset_mode: An ``AutoresetMode`` or its value ("NextStep", "SameStep", "Disabled").
        render_envs: Environments to draw. "human" shows the first of them.
        lanes: "wide" for SIMD, or "scalar"; the results are equal bit for bit.
        threads: Most threads to use; None for all cores.
        task: "crawl", "turn" or "reach".

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
        render_mode: str | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        render_envs: Sequence[int] = (0,),
        lanes: str = "wide",
        threads: int | None = None,
        task: str = "crawl",
    ) -> None:
        kind = task_named(task)
        scenes = load_scenes(kind.default_scene if scene is None else scene)
        for one in scenes:
            if not one.controlled:
                raise ValueError(
                    f"scene {one.name!r} has no drive that follows actions (drive.motion 'controlled')"
                )
        self.num_envs = positive("num_envs", num_envs)
        self.render_mode = choice("render_mode", render_mode, (None, *RENDER_MODES))
        self._autoreset = AutoresetMode(autoreset_mode)
        self._render_envs = indices("render_envs", render_envs, self.num_envs)
        self._batch = Batch(scenes, self.num_envs, lanes=lanes, threads=threads)
        first = self._batch.scene
        self.metadata = {
            "render_modes": list(RENDER_MODES),
            "render_fps": round(1.0 / first.control_step_s),
            "autoreset_mode": self._autoreset,
        }
        of_scene = round(first.episode_s / first.control_step_s)
        limit = of_scene if max_episode_steps is None else max_episode_steps
        self._max_episode_steps = positive("max_episode_steps", limit)

        observed = self._batch.observation_specification
        self._task = kind(first, observed, self.num_envs)
        self.single_observation_space = box(self.observation_specification)
        self.single_action_space = box(self._batch.action_specification)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._action_shape = (self.num_envs, sum(part.size for part in self._batch.action_specification))

        columns, goal = len(start_limits(first.dimensions)), self._task.goal_option
        self._episodes = Episodes.before_the_first(self.num_envs, columns, 0 if goal is None else goal.size)

    @property
    def batch(self) -> Batch:
        """The simulation itself, to read poses and times from. Change it through `reset` and `step` only."""
        return self._batch

    @property
    def scene(self) -> Scene:
        """The scene of every environment; the first of several, whose shape all have."""
        return self._batch.scene

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes; ``batch.scene_indices`` (N,) says which of them each environment has."""
        return self._batch.scenes

    @property
    def max_episode_steps(self) -> int:
        """Control steps until an episode is truncated."""
        return self._max_episode_steps

    @property
    def task(self) -> Task:
        """What is asked of the worms."""
        return self._task

    @property
    def observation_specification(self) -> tuple[AnyPart, ...]:
        """Name, unit, size and bounds of each part of an observation: the simulator's, then the task's."""
        return (*self._batch.observation_specification, *self._task.parts)

    @property
    def observation_layout(self) -> dict[str, slice]:
        """Where each named part stands in an observation."""
        return layout(self.observation_specification)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: Mapping[str, Any] | None = None,
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
        scene = self.scene
        request = read_options(
            options,
            num_envs=self.num_envs,
            magnets=scene.magnets,
            parameter_names=self._batch.parameter_names,
            dimensions=scene.dimensions,
            goal_option=self._task.goal_option,
        )
        with Bookkeeping() as books, put_back(self, DRAWN), equipped(self._batch, request):
            if isinstance(seed, (int, np.integer)):
                super().reset(seed=int(seed))
            mask, of = request.mask, self._episodes
            of.starts[mask] = np.nan if request.start is None else request.start[mask]
            of.goals[mask] = np.nan if request.goal is None else request.goal[mask]
            numbers = next_episodes(of.seeds, of.numbers, seeds, mask, self.np_random)
            self._start_episodes(mask, numbers, books)
            infos: Infos = {}
            self._add_reset_infos(infos, mask)
        self._show()
        return self._observe(), infos

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
        resetting = self._episodes.due_to_reset(self._autoreset)
        with Bookkeeping() as books:
            simulated = self._advance(values, resetting)
            books.begin()
            stepped = self._account(resetting, *simulated)
        self._show()
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
        origin = Origin(self._batch, self._task, self._episodes)
        return roll_out(origin, self._max_episode_steps, actions, start, observations)

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
        return self._state().pack()

    def set_state(self, state: bytes) -> None:
        """Goes on from a state of an environment with the same scene, N and autoreset mode.

        Raises:
            ValueError: The bytes are no such state; nothing is changed then.
        """
        self._state().restore(state)
        if self._drawing is not None:
            self._drawing.forget(np.ones(self.num_envs, np.bool_))

    def close_extras(self, **_: Any) -> None:
        """Closes the window."""
        if self._drawing is not None:
            self._drawing.close()
            self._drawing = None

    def __getstate__(self) -> dict[str, Any]:
        """A copy goes on bit for bit, and opens a window of its own."""
        _ = self.np_random  # made on first use: from now on both have the same
        return {**self.__dict__, "_drawing": None}

    def _state(self) -> State:
        return State(self._batch, self._episodes, self._task, self.np_random, self._autoreset)

    def _start_episodes(
        self, mask: Flags, numbers: NDArray[np.int64], books: Bookkeeping | None = None
    ) -> None:
        """Resets the simulation of the environments of mask, to their episodes (N,)."""
        of = self._episodes
        numbers = np.where(mask, numbers, of.numbers)
        drawn = np.maximum(numbers, 0)
        self._batch.reset(mask, of.seeds, drawn, start=of.starts)
        if books is not None:
            books.begin()
        of.begin(mask, numbers)
        self._task.begin(self._batch, mask, of.goals, uniform(of.seeds, drawn, self._task.draws))
        if self._drawing is not None:
            self._drawing.forget(mask)

    def _advance(
        self, actions: NDArray[np.float64], resetting: Flags
    ) -> tuple[Observations, NDArray[np.float64], NDArray[np.uint8]]:
        if resetting.all():
            return self._batch.observe(), np.zeros(self.num_envs), self._batch.status()
        # The simulator advances all: what it makes of the others is dropped by their reset.
        return self._batch.step(np.where(resetting[:, None], 0.0, actions) if resetting.any() else actions)

    def _account(
        self,
        resetting: Flags,
        simulated: Observations,
        progress_m: NDArray[np.float64],
        status: NDArray[np.uint8],
    ) -> tuple[Observations, NDArray[np.float64], Flags, Flags, Infos]:
        """What a step of the simulator, whose arrays are given, is to the task and the episodes."""
        stepping = ~resetting
        of = self._episodes
        of.elapsed_steps += stepping
        result = self._task.evaluate(self._batch, progress_m, stepping)
        observations = self._observe(simulated)
        outcome = outcome_of(result, status, stepping, of.elapsed_steps >= self._max_episode_steps)
        ended, seen = outcome.ended, {"progress_m": progress_m, "time_s": self._batch.time_s()}
        same_step = self._autoreset is AutoresetMode.SAME_STEP
        starting = ended if same_step else resetting
        infos = step_infos(outcome, seen, stepping & ~starting)
        if starting.any():
            if same_step:
                add(infos, "final_obs", rows(observations), starting)
                infos |= {"final_info": step_infos(outcome, seen, starting), "_final_info": starting.copy()}
            self._start_episodes(starting, of.numbers + 1)
            observations = self._observe()
            self._add_reset_infos(infos, starting)
        of.ended = np.zeros_like(ended) if same_step else ended
        return observations, outcome.rewards, outcome.terminated, outcome.truncated, infos

    def _observe(self, simulated: Observations | None = None) -> Observations:
        """What the simulator observes, or has, with what the task appends to it."""
        simulated = self._batch.observe() if simulated is None else simulated
        if not self._task.parts:
            return simulated
        return np.concatenate([simulated, self._task.observe(self._batch).astype(np.float32)], axis=1)

    def _add_reset_infos(self, infos: Infos, mask: Flags) -> None:
        add(infos, "time_s", self._batch.time_s(), mask)
        add(infos, "seed", self._episodes.seeds, mask)
        add(infos, "episode_number", self._episodes.numbers, mask)
        for key, told in self._task.reset_infos().items():
            add(infos, key, told, mask)

    def _drawn(self) -> Drawing:
        if self._drawing is None:
            self._drawing = Drawing(self._batch, self._render_envs, self._task)
        return self._drawing

    def _show(self) -> None:
        if self.render_mode == "human":
            self._drawn().show()
