"""A window on the screen."""

from typing import Any

import numpy as np
from numpy.typing import NDArray


class Window:
    """Shows frames with pygame, which is imported on construction only.

    Args:
        width: Width [pixels].
        height: Height [pixels].
        title: Caption of the window.

    Raises:
        ImportError: pygame is missing; the sentence names the extra to install.
    """

    def __init__(self, width: int, height: int, title: str = "MagWorm") -> None:
        try:
            import pygame
        except ImportError as error:
            raise ImportError("A window needs pygame: pip install 'magworm-gym[render]'.") from error
        self._pygame: Any = pygame
        # The display of pygame is one window, which all would share.
        from pygame._sdl2 import video

        pygame.display.init()
        self._video: Any = video
        self._window = video.Window(title, size=(width, height))
        self._renderer = video.Renderer(self._window)

    def show(self, frame: NDArray[np.uint8]) -> None:
        """Shows a frame (H, W, 3) and answers the events of the window system."""
        surface = self._pygame.surfarray.make_surface(frame.swapaxes(0, 1))
        self._video.Texture.from_surface(self._renderer, surface).draw()
        self._pygame.event.pump()
        self._renderer.present()

    def close(self) -> None:
        """Closes the window."""
        del self._renderer  # before the window that it draws on
        self._window.destroy()


class Windowed:
    """A view that can show its frames in a window of their size."""

    width: int
    height: int
    _window: Window | None = None

    def show(self, frame: NDArray[np.uint8]) -> None:
        """Shows a frame (H, W, 3) in a window, opened on the first call.

        Raises:
            ImportError: pygame is missing; the sentence names the extra to install.
        """
        if self._window is None:
            self._window = Window(self.width, self.height)
        self._window.show(frame)

    def close(self) -> None:
        """Closes the window, if one is open. May be called twice."""
        if self._window is not None:
            self._window.close()
            self._window = None
