"""Drawing of the worm from the side: frames, a window, animations.

Needs the extra ``magworm-gym[render]`` (Pillow; pygame for a window; imageio-ffmpeg for mp4).
"""

try:
    import PIL  # noqa: F401 - asked for here, so that its absence is told in one sentence
except ImportError as error:
    raise ImportError("Drawing needs Pillow: pip install 'magworm-gym[render]'.") from error

from magworm_gym.render.side_view import SideView

__all__ = ["SideView"]
