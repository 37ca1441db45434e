"""Frames of chosen environments of a batch."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch
from magworm_gym.recording import Moment

if TYPE_CHECKING:
    from magworm_gym.render import SideView, SpaceView
    from magworm_gym.tasks import Task

Frame = NDArray[np.uint8]

WIDTH_PX = 640
HEIGHT_PX = 360


class Drawing:
    """Views of chosen environments, each with the trail of its episode and its goal.

    A trail holds the places of the body's centre at the times that were drawn.

    Args:
        batch: The environments.
        chosen: Indices of those to draw.
        task: Has their goals.

    Raises:
        ImportError: What drawing needs is not installed; the sentence names the extra.
    """

    def __init__(self, batch: Batch, chosen: tuple[int, ...], task: Task) -> None:
        # Drawing is an extra: only an environment that draws needs it.
        from magworm_gym.render import view_of

        self._batch = batch
        self._task = task
        scenes, indices = batch.scenes, batch.scene_indices
        self._views: dict[int, SideView | SpaceView] = {
            i: view_of(scenes[indices[i]], WIDTH_PX, HEIGHT_PX) for i in chosen
        }
        self._trails: dict[int, list[NDArray[np.float64]]] = {i: [] for i in chosen}
        self._shown_s = 0.0

    def frames(self) -> tuple[Frame, ...]:
        """N frames (H, W, 3): a black one, read-only and shared, where an environment is not chosen."""
        blank = np.zeros((HEIGHT_PX, WIDTH_PX, 3), np.uint8)
        blank.flags.writeable = False
        drawn = {i: self._draw(i) for i in self._views}
        return tuple(drawn.get(i, blank) for i in range(self._batch.num_envs))

    def show(self) -> None:
        """Shows the first chosen environment in a window, no faster than real time."""
        first = next(iter(self._views))
        frame = self._draw(first)
        due_s = self._shown_s + self._batch.scene.control_step_s
        time.sleep(max(0.0, due_s - time.monotonic()))
        self._views[first].show(frame)
        self._shown_s = time.monotonic()

    def forget(self, mask: NDArray[np.bool_]) -> None:
        """Drops the trails of the environments in mask (N,): they start anew elsewhere."""
        for i, trail in self._trails.items():
            if mask[i]:
                trail.clear()

    def close(self) -> None:
        """Closes the window. May be called twice."""
        for view in self._views.values():
            view.close()

    def _draw(self, i: int) -> Frame:
        nodes_m = self._batch.node_positions()[i]
        self._trails[i].append(nodes_m.mean(axis=0))
        robot = Moment(
            nodes_m,
            self._batch.magnet_poses()[i],
            self._batch.magnets_present()[i],
            self._batch.drive_positions()[i],
            np.array(self._trails[i]),
        )
        return self._views[i].draw(robot, f"{self._batch.time_s()[i]:.2f} s", self._task.goal(i))
