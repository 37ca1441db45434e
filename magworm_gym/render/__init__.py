"""Drawing of the worm from the side: frames, a window, animations.

Needs the extra ``magworm-gym[render]`` (Pillow; pygame for a window; imageio-ffmpeg for mp4).
"""

from magworm_gym.render.side_view import SideView

__all__ = ["SideView"]
