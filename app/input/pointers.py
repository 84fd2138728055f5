"""All pointers of a window: the mouse, and pens where the system tells of them."""

from __future__ import annotations

from typing import Any

import glfw

from app.input.choose import pen_source
from app.input.events import PenEvent, PointerSource
from app.input.glfw_events import GlfwPointer


class Pointers:
    """All calls from the window's thread."""

    def __init__(self, window: Any) -> None:
        self._window = window
        self.mouse: PointerSource = GlfwPointer(window)
        self._pen: PointerSource | None = None

    def hear_pens(self) -> None:
        """From now on pens are heard."""
        self._pen = pen_source(self._window)

    def events(self) -> list[PenEvent]:
        """Returns what came since the last call.

        What GLFW tells comes first: where pens are heard, X tells it nothing any more but what happened before.
        """
        found = self._pen.events() if self._pen is not None else []
        return [*self.mouse.events(), *found]

    def at(self) -> tuple[float, float]:
        """Tells where the mouse is, framebuffer pixels: while something is dragged, no events tell."""
        x, y = glfw.get_cursor_pos(self._window)
        width, height = glfw.get_window_size(self._window)
        wide, tall = glfw.get_framebuffer_size(self._window)
        return x * wide / max(width, 1), y * tall / max(height, 1)

    def close(self) -> None:
        """Gives back what pens hold."""
        if self._pen is not None:
            self._pen.close()
