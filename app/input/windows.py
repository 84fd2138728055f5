"""Pens on Windows: WM_POINTER messages of GLFW's window.

Untested: written from Microsoft's documentation of Pointer Input Messages (winuser.h), never run.  A mouse keeps coming
through GLFW; this adds pens and leaves everything else alone.
"""

from __future__ import annotations

import ctypes as ct
import time
from collections.abc import Callable
from typing import Any

from app.input.events import LEFT, PenEvent
from app.input.pen_queue import PenQueue

_UPDATE, _DOWN, _UP = 0x0245, 0x0246, 0x0247
_KIND = {_UPDATE: "move", _DOWN: "down", _UP: "up"}
_PEN = 3
_ERASER_FLAGS = 0x2 | 0x4  # PEN_FLAG_INVERTED, PEN_FLAG_ERASER
_WINDOW_PROCEDURE = -4
_HISTORY = 256
_TELLS_ROTATION = 0x2  # PEN_MASK_ROTATION


class _Point(ct.Structure):
    _fields_ = (("x", ct.c_long), ("y", ct.c_long))


class _PointerInfo(ct.Structure):
    _fields_ = (
        ("pointerType", ct.c_uint32),
        ("pointerId", ct.c_uint32),
        ("frameId", ct.c_uint32),
        ("pointerFlags", ct.c_uint32),
        ("sourceDevice", ct.c_void_p),
        ("hwndTarget", ct.c_void_p),
        ("ptPixelLocation", _Point),
        ("ptHimetricLocation", _Point),
        ("ptPixelLocationRaw", _Point),
        ("ptHimetricLocationRaw", _Point),
        ("dwTime", ct.c_uint32),
        ("historyCount", ct.c_uint32),
        ("InputData", ct.c_int32),
        ("dwKeyStates", ct.c_uint32),
        ("PerformanceCount", ct.c_uint64),
        ("ButtonChangeType", ct.c_int),
    )


class _PenInfo(ct.Structure):
    _fields_ = (
        ("pointerInfo", _PointerInfo),
        ("penFlags", ct.c_uint32),
        ("penMask", ct.c_uint32),
        ("pressure", ct.c_uint32),
        ("rotation", ct.c_uint32),
        ("tiltX", ct.c_int32),
        ("tiltY", ct.c_int32),
    )


class WindowsPointer(PenQueue):
    """Subclasses the window's procedure; pens become PenEvents, other messages go on to GLFW."""

    name = "pen (Windows Ink)"

    def __init__(self, window: Any, wake: Callable[[], None]) -> None:
        super().__init__(wake)
        self._user: Any = ct.WinDLL("user32")  # type: ignore[attr-defined]
        self._window = window
        signature = ct.WINFUNCTYPE(  # type: ignore[attr-defined]
            ct.c_ssize_t, ct.c_void_p, ct.c_uint, ct.c_size_t, ct.c_ssize_t
        )
        self._procedure = signature(self._message)
        self._user.SetWindowLongPtrW.restype = ct.c_void_p
        self._user.SetWindowLongPtrW.argtypes = (ct.c_void_p, ct.c_int, ct.c_void_p)
        self._user.CallWindowProcW.restype = ct.c_ssize_t
        self._user.CallWindowProcW.argtypes = (ct.c_void_p, ct.c_void_p, ct.c_uint, ct.c_size_t, ct.c_ssize_t)
        address = ct.cast(self._procedure, ct.c_void_p)
        self._old = self._user.SetWindowLongPtrW(window, _WINDOW_PROCEDURE, address)

    def _message(self, window: int, message: int, wparam: int, lparam: int) -> int:
        if message in _KIND and self._is_pen(wparam & 0xFFFF):
            self._take(_KIND[message], wparam & 0xFFFF)
            return 0
        return int(self._user.CallWindowProcW(self._old, window, message, wparam, lparam))

    def _is_pen(self, pointer: int) -> bool:
        kind = ct.c_uint32()
        return bool(self._user.GetPointerType(pointer, ct.byref(kind))) and kind.value == _PEN

    def _take(self, kind: str, pointer: int) -> None:
        """Takes in all reports since the last message, oldest first."""
        count, infos = ct.c_uint32(_HISTORY), (_PenInfo * _HISTORY)()
        if not self._user.GetPointerPenInfoHistory(pointer, ct.byref(count), infos):
            return
        for info in reversed(infos[: count.value]):
            at = info.pointerInfo.ptPixelLocation
            self._user.ScreenToClient(self._window, ct.byref(at))
            event = PenEvent(
                kind,
                float(at.x),
                float(at.y),
                pressure=info.pressure / 1024,
                tilt_x=float(info.tiltX),
                tilt_y=float(info.tiltY),
                rotation=float(info.rotation) if info.penMask & _TELLS_ROTATION else None,
                time=info.pointerInfo.dwTime / 1000 or time.monotonic(),
                button=0 if kind == "move" else LEFT,
                eraser=bool(info.penFlags & _ERASER_FLAGS),
                pen=True,
            )
            self.hear(event)

    def close(self) -> None:
        """Gives the window its own procedure back."""
        self._user.SetWindowLongPtrW(self._window, _WINDOW_PROCEDURE, self._old)
