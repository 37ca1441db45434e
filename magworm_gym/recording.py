"""Robots over time, for pictures, phase portraits, fits and studies."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch, Scene
from magworm_gym._magworm import record_scenes as simulated

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Moment:
    """One robot at one time, as views draw it. Rows of a scene in space are longer, as those of a batch are.

    Attributes:
        nodes: Centre line (K, 2), in space (K, 3) [m], head first.
        magnet_poses: Body magnets (M, 3): x [m], y [m], angle [rad]; in space (M, 7): x, y, z [m] and
            quaternion w, x, y, z.
        present: Which body magnets are in place (M,).
        drive_positions: Centres of the drive magnets (D, 2) [m]; in space (D, 4): x, y, z [m] and yaw [rad].
        trail: Past places of the body's centre (T, 2), in space (T, 3) [m], oldest first; may be empty.
    """

    nodes: Floats
    magnet_poses: Floats
    present: NDArray[np.bool_]
    drive_positions: Floats
    trail: Floats


@dataclass(frozen=True)
class Recording:
    """One robot over time. Rows of a scene in space are longer, as those of a batch are.

    Attributes:
        time_s: Instants (T,) [s], evenly spaced.
        nodes: Centre line (T, K, 2), in space (T, K, 3) [m]; K is 0 where it was not kept.
        magnet_poses: Body magnets (T, M, 3): [m], [m], [rad]; in space (T, M, 7).
        present: Which body magnets are in place (M,).
        drive_positions: Drive magnets (T, D, 2) [m]; in space (T, D, 4).
        broken: Why the simulation broke down, in words; from then on the robot stands still. None
            where it did not.
    """

    time_s: Floats
    nodes: Floats
    magnet_poses: Floats
    present: NDArray[np.bool_]
    drive_positions: Floats
    broken: str | None = None

    @property
    def centre(self) -> Floats:
        """Places of the centre (T, 2), in space (T, 3) [m]: the mean of its magnets, else of its nodes."""
        axes = 2 if self.magnet_poses.shape[-1] == 3 else 3
        places = self.magnet_poses if self.magnet_poses.shape[1] else self.nodes
        return np.asarray(places[..., :axes].mean(axis=1))

    @property
    def progress_m(self) -> Floats:
        """Way along -x, towards the head of a robot that does not turn, since the first instant (T,) [m]."""
        centre_x = self.centre[:, 0]
        return np.asarray(centre_x[0] - centre_x)

    def at(self, instant: int) -> Moment:
        """The robot at an instant, with the places of its centre up to then as its trail."""
        return Moment(
            self.nodes[instant],
            self.magnet_poses[instant],
            self.present,
            self.drive_positions[instant],
            self.centre[: instant + 1],
        )


def record_scenes(
    scenes: Sequence[Scene],
    duration_s: float | Sequence[float],
    sample_s: float = 0.01,
    *,
    nodes: bool = True,
    threads: int | None = None,
) -> list[Recording]:
    """Runs each scene once from its start pose, all of them side by side.

    The scenes may differ in everything. A drive that follows actions stands still.

    Args:
        scenes: What to run.
        duration_s: For how long [s]: for all, or for each its own.
        sample_s: Time between two instants that are kept [s]; a whole number of solver steps.
        nodes: Whether the centre line is kept.
        threads: None for all cores.

    Raises:
        ValueError: A time that is no whole number of steps.
    """
    runs = simulated(scenes, duration_s, sample_s, nodes=nodes, threads=threads)
    return [_recording(scene, sample_s, *run) for scene, run in zip(scenes, runs, strict=True)]


def _recording(
    scene: Scene, sample_s: float, poses: Floats, drive: Floats, nodes: Floats, status: int
) -> Recording:
    present = np.ones(scene.magnets, np.bool_)
    present[list(scene.removed)] = False
    return Recording(
        time_s=sample_s * np.arange(len(poses), dtype=np.float64),
        nodes=nodes,
        magnet_poses=poses,
        present=present,
        drive_positions=drive,
        broken=Batch.status_text(status) if status else None,
    )
