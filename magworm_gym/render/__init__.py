"""Drawing of the worm, from the side and in space also from above: frames, a window, animations.

Needs the extra ``magworm-gym[render]`` (Pillow; pygame for a window; imageio-ffmpeg for mp4).
"""

try:
    import PIL  # noqa: F401 - asked for here, so that its absence is told in one sentence
except ImportError as error:
    raise ImportError("Drawing needs Pillow: pip install 'magworm-gym[render]'.") from error

from magworm_gym._magworm import Scene
from magworm_gym.render.side_view import SideView
from magworm_gym.render.space_view import SpaceView

__all__ = ["SideView", "SpaceView", "view_of"]


def view_of(scene: Scene, width: int = 640, height: int = 360) -> SideView | SpaceView:
    """Draws a scene in frames of that size [pixels]: from the side, in space also from above."""
    return (SideView if scene.dimensions == 2 else SpaceView)(scene.geometry, width, height)
