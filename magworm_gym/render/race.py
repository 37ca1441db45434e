"""Several recorded robots under each other, on one time axis and one ground."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.recording import Recording
from magworm_gym.render.animation import stacked
from magworm_gym.render.side_view import SideView

MARGIN_BODY_LENGTHS = 0.5
MARGIN_M = 0.008


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
    frame = _framing(list(shifted.values()), width / height)
    views = {title: SideView(geometry[title], width, height, **frame) for title in shifted}
    instants = len(next(iter(shifted.values())).time_s)
    for instant in range(0, instants, every):
        yield stacked([_panel(views[title], title, shifted[title], instant) for title in shifted])


def _framing(recordings: list[Recording], aspect: float) -> dict[str, float]:
    """Camera that sees every robot and every height of a drive magnet, all the time."""
    left = min(float(recording.nodes[..., 0].min()) for recording in recordings)
    right = max(float(recording.nodes[..., 0].max()) for recording in recordings)
    top = MARGIN_M + max(float(recording.nodes[..., 1].max()) for recording in recordings)
    depth = MARGIN_M - min(float(recording.drive_positions[..., 1].min()) for recording in recordings)
    margin = MARGIN_BODY_LENGTHS * float(np.ptp(recordings[0].nodes[0, :, 0]))
    return {
        "span_m": max(right - left + 2.0 * margin, (top + depth) * aspect),
        "centre_m": 0.5 * (left + right),
        "horizon": top / (top + depth),
    }


def _from_zero(recording: Recording) -> Recording:
    shift = recording.centre[0, 0]
    return replace(
        recording,
        nodes=recording.nodes - (shift, 0.0),
        magnet_poses=recording.magnet_poses - (shift, 0.0, 0.0),
        drive_positions=recording.drive_positions - (shift, 0.0),
    )


def _panel(view: SideView, title: str, recording: Recording, instant: int) -> NDArray[np.uint8]:
    time = recording.time_s[instant] - recording.time_s[0]
    way_mm = 1000.0 * recording.progress_m[instant]
    return view.draw(recording.at(instant), f"{title}\n{time:5.2f} s   {way_mm:6.1f} mm")
