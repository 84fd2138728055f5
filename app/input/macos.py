"""Pens on macOS: a local monitor of NSEvents through pyobjc, where that is installed.

Untested: written from Apple's documentation of NSEvent, never run.  A mouse keeps coming through GLFW.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any

import glfw

from app.input.events import LEFT, PenEvent

_DOWN, _UP, _MOVED, _DRAGGED = 1, 2, 5, 6
_KIND = {_DOWN: "down", _UP: "up", _MOVED: "move", _DRAGGED: "move"}
_TABLET_SUBTYPE = 1
_MASK = sum(1 << kind for kind in _KIND)


class MacPointer:
    """Takes tablet events from the application's queue; all others pass on to GLFW."""

    name = "pen (macOS)"

    def __init__(self, window: Any, wake: Callable[[], None]) -> None:
        import AppKit  # type: ignore[import-not-found]  # ImportError: no pens, the mouse stays

        self._kit, self._window, self._wake = AppKit, window, wake
        self._queue: deque[PenEvent] = deque()
        self._heard = False
        self._monitor = AppKit.NSEvent.addLocalMonitorForEventsMatchingMask_handler_(_MASK, self._take)

    def _take(self, event: Any) -> Any:
        kind = _KIND.get(event.type())
        if kind is None or event.subtype() != _TABLET_SUBTYPE:
            return event
        at, tilt = event.locationInWindow(), event.tilt()
        width, height = glfw.get_window_size(self._window)
        scale = glfw.get_framebuffer_size(self._window)[0] / max(1, width)
        found = PenEvent(
            kind,
            at.x * scale,
            (height - at.y) * scale,
            pressure=float(event.pressure()),
            tilt_x=float(tilt.x) * 90,
            tilt_y=float(tilt.y) * -90,
            rotation=float(event.rotation()),
            time=float(event.timestamp()),
            button=0 if kind == "move" else LEFT,
            pen=True,
        )
        self._queue.append(found)
        self._heard = True
        self._wake()
        return None

    def events(self) -> list[PenEvent]:
        """Gives what came since the last call, in order."""
        out = list(self._queue)
        self._queue.clear()
        return out

    def tablets(self) -> list[str]:
        """Returns the name of what pens were heard by, once one was: pens are known by their events."""
        return [self.name] if self._heard else []

    def close(self) -> None:
        """Stops listening."""
        self._kit.NSEvent.removeMonitor_(self._monitor)
