"""Which source of pointer events a system has: the richest that works, the plain mouse otherwise."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import glfw

from app.input.events import PenSource

if TYPE_CHECKING:
    from app.input.key_times import KeyTimes


def pen_source(window: Any, driver: str) -> PenSource | None:
    """Returns a source that knows pens; None where there is none, then GLFW's mouse stays.  `driver`: on Windows "ink"
    or "wintab", in whose place Ink is used where a tablet has no such driver."""
    try:
        if sys.platform == "win32":
            if driver == "wintab":
                with contextlib.suppress(OSError, AttributeError):
                    from app.input.wintab import WintabPointer

                    return WintabPointer(glfw.get_win32_window(window), glfw.post_empty_event)
            from app.input.windows import WindowsPointer

            return WindowsPointer(glfw.get_win32_window(window), glfw.post_empty_event)
        if sys.platform == "darwin":
            from app.input.macos import MacPointer

            return MacPointer(window, glfw.post_empty_event)
        if glfw.get_platform() == glfw.PLATFORM_X11:
            from app.input.xinput2 import XInput2Pointer

            return XInput2Pointer(glfw.get_x11_window(window), glfw.post_empty_event)
    except (RuntimeError, OSError, ImportError, AttributeError):
        return None
    return None


def key_times() -> KeyTimes | None:
    """Returns what knows when keys were pressed where pens are heard over a connection of their own, on X11; None
    elsewhere, as all events of a window come in their order there."""
    try:
        if glfw.get_platform() == glfw.PLATFORM_X11:
            from app.input.key_times import KeyTimes

            display: Callable[[], int] = glfw.get_x11_display
            return KeyTimes(display())
    except (OSError, AttributeError):
        return None
    return None
