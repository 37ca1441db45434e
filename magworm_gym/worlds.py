"""N worlds side by side: a simulation, what is asked of its worms, and their episodes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from magworm_gym._magworm import Batch, Scene
from magworm_gym.arguments import Lanes
from magworm_gym.bookkeeping import Bookkeeping, put_back
from magworm_gym.draws import TASK, next_episodes, uniform
from magworm_gym.episodes import Episodes
from magworm_gym.infos import Flags, Infos, add, rows
from magworm_gym.outcome import outcome_of, step_infos
from magworm_gym.reset_options import Allowed, ResetOptions
from magworm_gym.robots import Robots
from magworm_gym.tasks import Task

Observations = NDArray[np.float32]
Floats = NDArray[np.float64]
Stepped = tuple[Observations, Floats, Flags, Flags, Infos]


def controlled_batch(scenes: list[Scene], num_envs: int, lanes: Lanes, threads: int | None) -> Batch:
    """A batch whose drives follow actions.

    Raises:
        ValueError: One of the scenes has a drive that does not.
    """
    for scene in scenes:
        if not scene.controlled:
            raise ValueError(
                f"scene {scene.name!r} has no drive that follows actions (drive.motion 'controlled')"
            )
    return Batch(scenes, num_envs, lanes=lanes, threads=threads)


@dataclass
class Worlds:
    """N environments without their face to Gymnasium.

    Attributes:
        batch: The simulation.
        task: What is asked of the worms.
        robots: Which robot each of them is.
        autoreset: When an episode that ended is followed by the next.
        max_episode_steps: Control steps until an episode is truncated.
        allowed: What options of a reset may say.
        episodes: Seeds, counts and what options ask for.
    """

    batch: Batch
    task: Task
    robots: Robots
    autoreset: AutoresetMode
    max_episode_steps: int
    allowed: Allowed = field(init=False)
    episodes: Episodes = field(init=False)

    def __post_init__(self) -> None:
        self.allowed = Allowed.of(self.batch, self.task)
        self.episodes = Episodes.before_the_first(self.batch.num_envs, self.allowed.sizes)

    def __setstate__(self, state: dict[str, object]) -> None:
        """A pickle may make arrays read-only, which a task need not expect of its own."""
        self.__dict__.update(state)
        self.task.state = {name: values.copy() for name, values in self.task.state.items()}

    def reset(
        self,
        request: ResetOptions,
        seeds: Sequence[int | None],
        random: np.random.Generator,
        books: Bookkeeping,
    ) -> Infos:
        """Starts the episodes that a request asks for. Where it fails nothing is changed, but for `random`.

        Raises:
            ValueError: A robot or a start that cannot be simulated.
        """
        mask, of = request.mask, self.episodes
        with put_back(self, ("episodes",)), self.robots.put_back():
            of.take(mask, starts=request.start, goals=request.goal)
            self.robots.ask(request, of)
            of.seeds, numbers = next_episodes(of.seeds, of.numbers, seeds, mask, random)
            self._start(mask, numbers, books)
        infos: Infos = {}
        self._add_reset_infos(infos, mask)
        return infos

    def step(self, actions: Floats, books: Bookkeeping) -> Stepped:
        """One control step of every environment, or the reset that is due in its place.

        Raises:
            ValueError: A value that is not finite; nothing is changed then.
            ResetNeeded: See :meth:`Episodes.due_to_reset`.
        """
        resetting = self.episodes.due_to_reset(self.autoreset)
        if resetting.all():
            nothing = np.zeros(self.batch.num_envs)
            simulated = self.batch.observe(), nothing, self.batch.status()
        else:
            # The simulator advances all: what it makes of the others is dropped by their reset.
            simulated = self.batch.step(
                np.where(resetting[:, None], 0.0, actions) if resetting.any() else actions
            )
        books.begin()
        return self._account(resetting, *simulated)

    def observe(self, simulated: Observations | None = None) -> Observations:
        """What the simulator observes, or has, with what the task appends to it."""
        simulated = self.batch.observe() if simulated is None else simulated
        if not self.task.parts:
            return simulated
        return np.concatenate([simulated, self.task.observe(self.batch).astype(np.float32)], axis=1)

    def _start(self, mask: Flags, numbers: NDArray[np.int64], books: Bookkeeping | None = None) -> None:
        """Starts episodes of these numbers (N,) in the environments of mask."""
        of = self.episodes
        drawn = np.maximum(np.where(mask, numbers, of.numbers), 0)
        self.robots.draw(mask, of.seeds, drawn, of)
        self.batch.reset(mask, of.seeds, drawn, start=of.starts)
        if books is not None:
            books.begin()
        of.begin(mask, numbers)
        self.task.begin(self.batch, mask, of.goals, uniform(of.seeds, drawn, self.task.draws, TASK))

    def _account(
        self, resetting: Flags, simulated: Observations, progress_m: Floats, status: NDArray[np.uint8]
    ) -> Stepped:
        """What a step of the simulator, whose arrays are given, is to the task and the episodes."""
        stepping = ~resetting
        of = self.episodes
        of.elapsed_steps = of.elapsed_steps + stepping
        result = self.task.evaluate(self.batch, progress_m, stepping)
        observations = self.observe(simulated)
        outcome = outcome_of(result, status, stepping, of.elapsed_steps >= self.max_episode_steps)
        ended, seen = outcome.ended, {"progress_m": progress_m, "time_s": self.batch.time_s()}
        same_step = self.autoreset is AutoresetMode.SAME_STEP
        starting = ended if same_step else resetting
        infos = step_infos(outcome, seen, stepping & ~starting)
        if starting.any():
            if same_step:
                add(infos, "final_obs", rows(observations), starting)
                infos |= {"final_info": step_infos(outcome, seen, starting), "_final_info": starting.copy()}
            self._start(starting, of.numbers + 1)
            observations = self.observe()
            self._add_reset_infos(infos, starting)
        of.ended = np.zeros_like(ended) if same_step else ended
        return observations, outcome.rewards, outcome.terminated, outcome.truncated, infos

    def _add_reset_infos(self, infos: Infos, mask: Flags) -> None:
        add(infos, "time_s", self.batch.time_s(), mask)
        add(infos, "seed", self.episodes.seeds, mask)
        add(infos, "episode_number", self.episodes.numbers, mask)
        for key, told in self.task.reset_infos().items():
            add(infos, key, told, mask)
