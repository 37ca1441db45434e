"""Several recorded robots under each other, on one time axis and one ground."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines.recording import Recording
from magworm_gym.render.animation import stacked
from magworm_gym.render.side_view import SideView

MARGIN_BODY_LENGTHS = 0.7


def race_frames(
    recordings: Mapping[str, Recording],
    geometry: Mapping[str, dict[str, Any]],
    width: int = 960,
    height: int = 200,
    every: int = 1,
) -> Iterator[NDArray[np.uint8]]:
    """Draws recordings under each other with one fixed camera.

    Every robot is shifted so that all start at x = 0.

    Args:
        recordings: By title, upper panel first; all with the same instants.
        geometry: ``Scene.geometry`` of each title.
        width: Width of a panel [pixels].
        height: Height of a panel [pixels].
        every: Draws every n-th instant only.

    Yields:
        Frames of all panels, (height of all panels with lines between, width, 3).
    """
    shifted = {title: _from_zero(recording) for title, recording in recordings.items()}
    left = min(recording.nodes[..., 0].min() for recording in shifted.values())
    right = max(recording.nodes[..., 0].max() for recording in shifted.values())
    margin = MARGIN_BODY_LENGTHS * float(np.ptp(next(iter(shifted.values())).nodes[0, :, 0]))
    views = {
        title: SideView(
            geometry[title],
            width,
            height,
            span_m=right - left + 2.0 * margin,
            centre_m=0.5 * (left + right),
        )
        for title in shifted
    }
    instants = len(next(iter(shifted.values())).time_s)
    for instant in range(0, instants, every):
        yield stacked([_panel(views[title], title, shifted[title], instant) for title in shifted])


def _from_zero(recording: Recording) -> Recording:
    shift = recording.centre[0, 0]
    return Recording(
        time_s=recording.time_s,
        nodes=recording.nodes - (shift, 0.0),
        magnet_poses=recording.magnet_poses - (shift, 0.0, 0.0),
        present=recording.present,
        drive_positions=recording.drive_positions - (shift, 0.0),
    )


def _panel(view: SideView, title: str, recording: Recording, instant: int) -> NDArray[np.uint8]:
    time = recording.time_s[instant] - recording.time_s[0]
    way_mm = 1000.0 * recording.progress_m[instant]
    return view.draw(
        recording.nodes[instant],
        recording.magnet_poses[instant],
        recording.present,
        recording.drive_positions[instant],
        recording.centre[: instant + 1],
        f"{title}\n{time:5.2f} s   {way_mm:6.1f} mm",
    )
