"""How long a window takes to answer: `_NET_WM_PING`, by which window managers find those that hang (EWMH 1.5).

GLFW answers when the program next takes its events.  X11 alone.
"""

from __future__ import annotations

import ctypes as ct
import select
import time

from app.input.drops import CLIENT_MESSAGE, Event

_Handler = ct.CFUNCTYPE(ct.c_int, ct.c_void_p, ct.c_void_p)
SUBSTRUCTURE_NOTIFY, LATEST = 1 << 19, 10.0  # seconds after which a window is taken to hang


class Pinger:
    """Pings one window of a display."""

    def __init__(self, display: str, window: int) -> None:
        self._x = _library()
        self._display = self._x.XOpenDisplay(display.encode())
        if not self._display:
            raise OSError(f"display {display}: cannot be opened")
        self._window = window
        self._root = self._x.XDefaultRootWindow(self._display)
        self._protocols, self._ping = (
            self._x.XInternAtom(self._display, name, 0) for name in (b"WM_PROTOCOLS", b"_NET_WM_PING")
        )
        self._x.XSelectInput(self._display, self._root, SUBSTRUCTURE_NOTIFY)
        self._serial = 0

    def ping(self) -> float:
        """Seconds until the window has answered; LATEST if it has not by then."""
        self._serial += 1
        event = Event()
        told = event.message
        told.type, told.window, told.message_type, told.format = CLIENT_MESSAGE, self._window, self._protocols, 32
        told.data[:3] = self._ping, self._serial, self._window
        began = time.perf_counter()
        self._x.XSendEvent(self._display, self._window, 0, 0, ct.byref(event))
        self._x.XFlush(self._display)
        while (taken := time.perf_counter() - began) < LATEST:
            if not self._x.XPending(self._display):
                select.select([self._x.XConnectionNumber(self._display)], [], [], LATEST - taken)
            while self._x.XPending(self._display):
                self._x.XNextEvent(self._display, ct.byref(event))
                if event.message.type == CLIENT_MESSAGE and event.message.data[:2] == [self._ping, self._serial]:
                    return time.perf_counter() - began
        return LATEST

    def close(self) -> None:
        """Gives the connection back."""
        self._x.XCloseDisplay(self._display)


def _library() -> ct.CDLL:
    """Returns libX11 with the types of what is called; OSError without it."""
    x, pointer, ulong = ct.CDLL("libX11.so.6"), ct.c_void_p, ct.c_ulong
    x.XSetErrorHandler.argtypes = [_Handler]
    x.XOpenDisplay.restype, x.XOpenDisplay.argtypes = pointer, [ct.c_char_p]
    x.XDefaultRootWindow.restype, x.XDefaultRootWindow.argtypes = ulong, [pointer]
    x.XInternAtom.restype, x.XInternAtom.argtypes = ulong, [pointer, ct.c_char_p, ct.c_int]
    x.XSelectInput.argtypes = [pointer, ulong, ct.c_long]
    x.XSendEvent.argtypes = [pointer, ulong, ct.c_int, ct.c_long, pointer]
    for name in ("XFlush", "XPending", "XConnectionNumber", "XCloseDisplay"):
        getattr(x, name).argtypes = [pointer]
    x.XNextEvent.argtypes = [pointer, pointer]
    x.XSetErrorHandler(_UNHEARD)  # a window that has just gone gives no answer; Xlib would end the process
    return x


_UNHEARD = _Handler(lambda display, event: 0)
