"""Pens on macOS: a local monitor of NSEvents through pyobjc, where that is installed.

Untested: written from Apple's documentation of NSEvent, never run.  A mouse keeps coming through GLFW.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import glfw

from app.input.events import LEFT, MIDDLE, RIGHT, PenEvent
from app.input.pen_queue import PenQueue

_KIND = {1: "down", 2: "up", 3: "down", 4: "up", 5: "move", 6: "move", 7: "move", 25: "down", 26: "up", 27: "move"}
_BUTTON = {1: LEFT, 2: LEFT, 3: RIGHT, 4: RIGHT, 25: MIDDLE, 26: MIDDLE}  # by NSEventType
_POINT, _PROXIMITY = 23, 24  # NSEventTypeTabletPoint, NSEventTypeTabletProximity
_TABLET_SUBTYPE, _PROXIMITY_SUBTYPE = 1, 2
_ERASER = 3  # NSPointingDeviceTypeEraser
_MASK = sum(1 << kind for kind in (*_KIND, _POINT, _PROXIMITY))


class MacPointer(PenQueue):
    """Takes tablet events from the application's queue; all others pass on to GLFW."""

    name = "pen (macOS)"

    def __init__(self, window: Any, wake: Callable[[], None]) -> None:
        import AppKit  # type: ignore[import-not-found]  # ImportError: no pens, the mouse stays

        super().__init__(wake)
        self._kit, self._window, self._eraser = AppKit, window, False
        self._monitor = AppKit.NSEvent.addLocalMonitorForEventsMatchingMask_handler_(_MASK, self._take)

    def _take(self, event: Any) -> Any:
        told = event.type()
        if told == _PROXIMITY or (told in _KIND and event.subtype() == _PROXIMITY_SUBTYPE):
            self._eraser = bool(event.isEnteringProximity()) and event.pointingDeviceType() == _ERASER
            return event
        kind = "move" if told == _POINT else _KIND.get(told)
        if kind is None or (told != _POINT and event.subtype() != _TABLET_SUBTYPE):
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
            button=0 if kind == "move" else _BUTTON[told],
            eraser=self._eraser,
            pen=True,
        )
        self.hear(found)
        return None

    def close(self) -> None:
        """Stops listening."""
        self._kit.NSEvent.removeMonitor_(self._monitor)
