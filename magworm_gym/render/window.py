"""A window on the screen."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

TITLE = "MagWorm"


class Windowed:
    """A view that can show its frames in a window of their size, with pygame."""

    width: int
    height: int
    _renderer: Any = None

    def show(self, frame: NDArray[np.uint8]) -> None:
        """Shows a frame (H, W, 3) in a window, opened on the first call, and answers the window system.

        Raises:
            ImportError: pygame is missing; the sentence names the extra to install.
        """
        try:
            import pygame
            from pygame._sdl2 import video
        except ImportError as error:
            raise ImportError("A window needs pygame: pip install 'magworm-gym[render]'.") from error
        if self._renderer is None:
            pygame.display.init()
            # The display of pygame is one window, which all would share.
            self._window = video.Window(TITLE, size=(self.width, self.height))
            self._renderer = video.Renderer(self._window)
        surface = pygame.surfarray.make_surface(frame.swapaxes(0, 1))
        video.Texture.from_surface(self._renderer, surface).draw()
        pygame.event.pump()
        self._renderer.present()

    def close(self) -> None:
        """Closes the window, if one is open. May be called twice."""
        if self._renderer is not None:
            self._renderer = None  # before the window that it draws on
            self._window.destroy()
