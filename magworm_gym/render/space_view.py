"""A robot in space: from above and from its side, in one frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.recording import Floats, Moment
from magworm_gym.render.animation import SEPARATOR_PX, joined
from magworm_gym.render.outline import rotations
from magworm_gym.render.robot import body_length
from magworm_gym.render.side_view import SideView
from magworm_gym.render.top_view import TopView
from magworm_gym.render.window import Windowed

if TYPE_CHECKING:
    from magworm_gym.tasks import Goal

SIDE_SPAN_BODY_LENGTHS = 2.6


class SpaceView(Windowed):
    """Draws frames of one environment in space; two panels, of one robot at one time.

    Left the robot from above, as :class:`~magworm_gym.render.top_view.TopView` draws it; right the same from
    its side, as :class:`~magworm_gym.render.SideView` does: the plane through its heading, head to the left,
    its centre at 0.

    Args:
        geometry: ``Scene.geometry`` of a scene in space.
        width: Width of a frame [pixels].
        height: Height of a frame [pixels].

    Raises:
        ImportError: Pillow is missing; the sentence names the extra to install.
    """

    def __init__(self, geometry: dict[str, Any], width: int = 640, height: int = 360) -> None:
        self.width, self.height = width, height
        self._geometry = geometry
        top_width = min(height, width // 2)
        self._top = TopView(geometry, top_width, height)
        self._side_width = width - top_width - SEPARATOR_PX
        self._side: SideView | None = None

    def draw(self, robot: Moment, text: str | None = None, goal: Goal | None = None) -> NDArray[np.uint8]:
        """Draws one frame.

        Args:
            robot: In space.
            text: Written in the upper left corner, lines separated by newlines.
            goal: Where the robot is to go or to look.

        Returns:
            A fresh frame (H, W, 3), uint8, red-green-blue.
        """
        return joined([self._top.draw(robot, text, goal), self._draw_side(robot)], 1)

    def _draw_side(self, robot: Moment) -> NDArray[np.uint8]:
        nodes, drives = robot.nodes, robot.drive_positions
        if self._side is None:
            span_m = SIDE_SPAN_BODY_LENGTHS * body_length(nodes)
            self._side = SideView(
                self._geometry, self._side_width, self.height, span_m=span_m, centre_m=0.0, horizon=0.4
            )
        along = nodes[-1, [0, 2]] - nodes[0, [0, 2]]
        along = along / max(float(np.linalg.norm(along)), 1e-9)
        origin = nodes[:, [0, 2]].mean(axis=0)

        def flat(places: Floats) -> Floats:
            return np.stack([(places[:, [0, 2]] - origin) @ along, places[:, 1]], axis=1)

        # The drive as seen from the side: its length and width as its yaw from the robot turns them.
        turned = drives[:, 3] - np.arctan2(-along[1], along[0])
        size = np.array([self._geometry["drive_size_m"][0], self._geometry["drive_width_m"]])
        seen = np.abs(np.stack([np.cos(turned), np.sin(turned)], axis=1)) @ size
        poses = np.column_stack([flat(robot.magnet_poses), _angles(robot.magnet_poses, along)])
        shadow = Moment(flat(nodes), poses, robot.present, flat(drives), np.zeros((0, 2)))
        return self._side.draw(shadow, "side", drive_lengths=seen)


def _angles(poses: Floats, along: Floats) -> Floats:
    """Angle of each magnet in the plane of a side view (M,) [rad], turned over where its up points down."""
    axes = rotations(poses[:, 3:])
    pitch = np.arctan2(axes[:, 1, 0], axes[:, [0, 2], 0] @ along)
    up = np.cos(pitch) * axes[:, 1, 1]
    return np.asarray(np.where(up < 0.0, pitch + np.pi, pitch))
