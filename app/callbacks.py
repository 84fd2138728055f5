"""What GLFW calls the window for, besides pointers: keys, text, focus, drops, and that it has to be drawn anew."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

from imgui_bundle import imgui  # before glfw, so that both use one libglfw

import glfw  # isort: skip
from imgui_bundle.imgui import backends

from app.input.drops import say_taken
from app.router import Router

Drop = Callable[[Path], bool]
Before = Callable[[int | None], None]


class Callbacks:
    """Keys and text go to imgui at once, and to the router when the frame asks for them.

    `event` is called whenever anything happens; `before` with the code of a key, or None as the focus is lost, ahead of
    that: it sees to what the pointer did before; `drop` with a file that was dropped on the window, which tells
    whether that is taken.
    """

    def __init__(self, window: Any, router: Router, event: Callable[[], None], before: Before, drop: Drop) -> None:
        self._address = ctypes.cast(window, ctypes.c_void_p).value or 0
        self._router, self._layout = router, router.layout
        self._event, self._before, self._drop = event, before, drop
        self.exposed = True  # the window system has lost what the window showed, or never had it
        self.taken = 0  # keys that were pressed or let go and given to the router
        self._keys: list[tuple[int, int, int, int] | None] = []  # None: the focus was lost
        glfw.set_key_callback(window, self._key)
        glfw.set_char_callback(window, self._typed)
        glfw.set_window_focus_callback(window, self._focus)
        glfw.set_cursor_enter_callback(window, self._entered)
        glfw.set_window_refresh_callback(window, self._refresh)
        glfw.set_framebuffer_size_callback(window, lambda *_: event())
        dropped: Any = self._dropped  # gets a list of names
        glfw.set_drop_callback(window, dropped)

    def deliver(self) -> None:
        """Gives the router what was pressed and typed since the last call, and that the focus was lost; what follows a
        key that fails comes with the next one."""
        while self._keys:
            key = self._keys.pop(0)
            if key is None:
                self._router.lost_focus()
            else:
                self.taken += key[2] != glfw.REPEAT
                self._router.key(*key)

    def _key(self, _w: Any, key: int, scancode: int, action: int, mods: int) -> None:
        self._event()
        self._before(scancode)
        if self._router.desk.keys.listening and action != glfw.RELEASE:
            self._keys.append((key, scancode, action, mods))
            return
        typing = imgui.get_io().want_text_input or self._layout.dialogs.open or self._router.desk.keys.panel is not None
        if key != glfw.KEY_TAB or typing:  # Tab would put the focus into a field, which then took all keys
            backends.glfw_key_callback(self._address, key, scancode, action, mods)
        self._keys.append((key, scancode, action, mods))

    def _typed(self, _w: Any, character: int) -> None:
        """What is a key of the canvas must not go to a field that opens later; a press before it may have given the
        focus to one."""
        if self._router.typing:
            backends.glfw_char_callback(self._address, character)

    def _focus(self, _w: Any, focused: int) -> None:
        self._event()
        backends.glfw_window_focus_callback(self._address, focused)
        if not focused:
            self._before(None)
            self._keys.append(None)

    def _refresh(self, _w: Any) -> None:
        self._event()
        self.exposed = True

    def _entered(self, _w: Any, entered: int) -> None:
        self._event()
        if not entered:
            self._router.left()

    def _dropped(self, window: Any, paths: Any) -> None:
        self._event()
        if paths and self._drop(Path(paths[0])):
            say_taken(window)
