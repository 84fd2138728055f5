"""The mouse through GLFW: works everywhere, knows no pressure."""

from __future__ import annotations

import time
from typing import Any

import glfw

from app.input.events import BACK, FORWARD, LEFT, MIDDLE, RIGHT, PenEvent

_BUTTONS = {
    glfw.MOUSE_BUTTON_LEFT: LEFT,
    glfw.MOUSE_BUTTON_MIDDLE: MIDDLE,
    glfw.MOUSE_BUTTON_RIGHT: RIGHT,
    glfw.MOUSE_BUTTON_4: BACK,
    glfw.MOUSE_BUTTON_5: FORWARD,
    **{glfw.MOUSE_BUTTON_6 + i: FORWARD + 1 + i for i in range(3)},
}


class GlfwPointer:
    """Collects GLFW's pointer callbacks of one window."""

    name = "mouse"

    def __init__(self, window: Any) -> None:
        self._window = window
        self._queue: list[PenEvent] = []
        self._scale = 1.0
        self._at: tuple[float, float] | None = None
        glfw.set_cursor_pos_callback(window, self._moved)
        glfw.set_mouse_button_callback(window, self._pressed)
        glfw.set_scroll_callback(window, self._scrolled)
        self._measure()

    def _measure(self) -> None:
        """Framebuffer pixels per window unit; 1 on X11, 2 on a Retina screen."""
        wide, _ = glfw.get_window_size(self._window)
        self._scale = glfw.get_framebuffer_size(self._window)[0] / wide if wide else 1.0

    def _add(self, kind: str, x: float, y: float, **fields: Any) -> None:
        s = self._scale
        self._queue.append(PenEvent(kind, x * s, y * s, time=time.monotonic(), **fields))

    def _moved(self, _window: Any, x: float, y: float) -> None:
        self._measure()
        self._at = x, y
        self._add("move", x, y)

    def _where(self) -> tuple[float, float]:
        """Returns the last place reported: at a press, GLFW itself would tell where the pointer is by now."""
        x, y = self._at or glfw.get_cursor_pos(self._window)
        return x, y

    def _pressed(self, _window: Any, button: int, action: int, _mods: int) -> None:
        if button in _BUTTONS:
            kind = "down" if action == glfw.PRESS else "up"
            self._add(kind, *self._where(), button=_BUTTONS[button])

    def _scrolled(self, _window: Any, dx: float, dy: float) -> None:
        self._add("wheel", *self._where(), dx=dx, dy=dy)

    def events(self) -> list[PenEvent]:
        """Gives what came since the last call, in order."""
        queue, self._queue = self._queue, []
        return queue

    def close(self) -> None:
        """Nothing to give back: the callbacks end with the window."""
