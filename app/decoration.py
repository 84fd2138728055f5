"""What a window shows outside its picture: the pointer's shape, and the title."""

from __future__ import annotations

from typing import Any

import glfw

from app import cursor
from app.desk.desk import Desk


class Decoration:
    """Tells GLFW only what has changed."""

    def __init__(self, window: Any) -> None:
        self._window = window
        self._cursors: dict[int, Any] = {}
        self._cursor = 0
        self._title = ""

    def show(self, desk: Desk, panning: bool) -> None:
        """Brings both up to date."""
        self._point(cursor.shape(desk, panning))
        known = desk.known
        self._name(f"{'*' if known.modified else ''}{known.title} - Inkfall")

    def _point(self, shape: int) -> None:
        if shape != self._cursor:
            self._cursor = shape
            if shape not in self._cursors:
                self._cursors[shape] = glfw.create_standard_cursor(shape)
            glfw.set_cursor(self._window, self._cursors[shape])

    def _name(self, title: str) -> None:
        if title != self._title:
            self._title = title
            glfw.set_window_title(self._window, title)
