"""How a speed is measured: the same for every controller and every belt."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch
from magworm_gym.baselines.controller import Controller, OpenLoop
from magworm_gym.recording import Recording

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Trial:
    """Measures speed over a window after the robot has settled into its gait.

    Attributes:
        settle_s: Time before the window [s].
        measure_s: Length of the window [s].
    """

    settle_s: float = 1.0
    measure_s: float = 8.0

    @property
    def duration_s(self) -> float:
        """Simulated time of one trial [s]."""
        return self.settle_s + self.measure_s


def centre_x_m(batch: Batch) -> Floats:
    """Mean x of the centre line of each robot (N,) [m]."""
    return np.asarray(batch.node_positions()[:, :, 0].mean(axis=1))


def crawl_speed_m_s(
    batch: Batch,
    trial: Trial,
    seeds: NDArray[np.uint64],
    controller: Controller | None = None,
    start: Floats | None = None,
) -> Floats:
    """Resets every environment and measures how fast it crawls.

    Args:
        batch: Robots (N); magnets present and parameters as set before.
        trial: Times of settling and measuring, rounded to whole control steps.
        seeds: Seeds of the environments (N,), episode 0.
        controller: Drives the stage; None for a scene whose drive is not controlled.
        start: Start poses (N, 3): x [m], height [m], angle [rad]; None for the scene's.

    Returns:
        Speed towards the head (N,) [m/s]. A robot that broke numerically counts as 0.

    Raises:
        ValueError: The scene needs a controller, or takes none.
    """
    _start(batch, seeds, controller, start)
    _run(batch, controller, trial.settle_s)
    before = centre_x_m(batch)
    _run(batch, controller, trial.measure_s)
    speed = (before - centre_x_m(batch)) / trial.measure_s
    return np.where((batch.status() == 0) & np.isfinite(speed), speed, 0.0)


def record(
    batch: Batch,
    duration_s: float,
    seeds: NDArray[np.uint64],
    controller: Controller | None = None,
    start: Floats | None = None,
    environment: int = 0,
) -> Recording:
    """Runs a batch from a reset and keeps one environment, a control step apart.

    Args:
        batch: Robots (N).
        duration_s: Time to record [s].
        seeds: As for ``crawl_speed_m_s``.
        controller: As for ``crawl_speed_m_s``.
        start: As for ``crawl_speed_m_s``.
        environment: Which environment to keep.

    Returns:
        The recording, with an instant at the start and one after every control step.
    """
    _start(batch, seeds, controller, start)
    steps = round(duration_s / batch.scene.control_step_s)
    nodes, poses, drives = [], [], []
    for step in range(steps + 1):
        if step:
            _step(batch, controller)
        nodes.append(batch.node_positions()[environment])
        poses.append(batch.magnet_poses()[environment])
        drives.append(batch.drive_positions()[environment])
    return Recording(
        time_s=np.arange(steps + 1, dtype=np.float64) * batch.scene.control_step_s,
        nodes=np.array(nodes),
        magnet_poses=np.array(poses),
        present=batch.magnets_present()[environment],
        drive_positions=np.array(drives),
    )


def _start(
    batch: Batch, seeds: NDArray[np.uint64], controller: Controller | None, start: Floats | None
) -> None:
    if batch.scene.controlled != (controller is not None):
        raise ValueError("a scene with a controlled drive needs a controller, any other takes none")
    everyone = np.ones(batch.num_envs, dtype=bool)
    episodes = np.zeros(batch.num_envs, dtype=np.uint64)
    batch.reset(everyone, seeds, episodes, start)
    if controller is not None:
        controller.start(batch)


def _step(batch: Batch, controller: Controller | None) -> None:
    if controller is None:
        batch.advance(batch.scene.control_step_s)
    else:
        batch.step(controller.act(batch))


def _run(batch: Batch, controller: Controller | None, duration_s: float) -> None:
    """Runs for the whole number of control steps next to a duration [s]."""
    steps = round(duration_s / batch.scene.control_step_s)
    if not steps:
        return
    if controller is None:
        batch.advance(steps * batch.scene.control_step_s)
    elif isinstance(controller, OpenLoop):
        batch.rollout(controller.plan(batch, steps))
    else:
        for _ in range(steps):
            _step(batch, controller)
