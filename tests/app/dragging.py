"""Files dragged onto a window of an X server: the source's side of the protocol XDND, version 5, through Xlib."""

import ctypes
import os
import subprocess
import time
from ctypes import POINTER, Structure, c_char_p, c_int, c_long, c_ulong, c_void_p
from pathlib import Path

CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31
PATIENCE = 90.0  # seconds
_HEAD = [("type", c_int), ("serial", c_ulong), ("sent", c_int), ("display", c_void_p)]


class Message(Structure):
    _fields_ = (*_HEAD, ("window", c_ulong), ("kind", c_ulong), ("format", c_int), ("data", c_long * 5))


class Request(Structure):
    _fields_ = (
        *_HEAD,
        *((name, c_ulong) for name in ("owner", "requestor", "selection", "target", "property", "time")),
    )


class Notice(Structure):
    _fields_ = (*_HEAD, *((name, c_ulong) for name in ("requestor", "selection", "target", "property", "time")))


class Event(ctypes.Union):
    _fields_ = (("type", c_int), ("message", Message), ("request", Request), ("notice", Notice), ("room", c_long * 24))


def _library() -> ctypes.CDLL:
    x = ctypes.CDLL("libX11.so.6")
    x.XOpenDisplay.restype, x.XOpenDisplay.argtypes = c_void_p, [c_char_p]
    x.XDefaultRootWindow.restype, x.XDefaultRootWindow.argtypes = c_ulong, [c_void_p]
    x.XInternAtom.restype, x.XInternAtom.argtypes = c_ulong, [c_void_p, c_char_p, c_int]
    x.XCreateSimpleWindow.restype = c_ulong
    x.XCreateSimpleWindow.argtypes = [c_void_p, c_ulong, *[c_int] * 5, c_ulong, c_ulong]
    x.XSetSelectionOwner.argtypes = [c_void_p, c_ulong, c_ulong, c_ulong]
    x.XSendEvent.argtypes = [c_void_p, c_ulong, c_int, c_long, POINTER(Event)]
    x.XNextEvent.argtypes = [c_void_p, POINTER(Event)]
    x.XChangeProperty.argtypes = [c_void_p, *[c_ulong] * 3, c_int, c_int, c_char_p, c_int]
    for name in ("XPending", "XFlush", "XCloseDisplay"):
        getattr(x, name).argtypes = [c_void_p]
    return x


class Drag:
    """A file on its way to the window `target`."""

    def __init__(self, display: str, target: int, path: Path) -> None:
        self._x, self._target, self._path = _library(), target, path
        self._display = self._x.XOpenDisplay(display.encode())
        assert self._display
        root = self._x.XDefaultRootWindow(self._display)
        self._own = self._x.XCreateSimpleWindow(self._display, root, 0, 0, 1, 1, 0, 0, 0)
        self._x.XSetSelectionOwner(self._display, self._atom("XdndSelection"), self._own, 0)

    def drop(self, x: int, y: int) -> None:
        """Lets it go at a point of the screen, and waits until the window has taken it."""
        uris, copy = self._atom("text/uri-list"), self._atom("XdndActionCopy")
        self._say("XdndEnter", 5 << 24, uris)
        self._say("XdndPosition", 0, x << 16 | y, 0, copy)
        assert self._heard("XdndStatus")[1] & 1, "the window does not take it"
        self._say("XdndDrop", 0, 0)
        assert self._heard("XdndFinished")[1] & 1, "the window did not take it"
        self._x.XCloseDisplay(self._display)

    def _atom(self, name: str) -> int:
        return self._x.XInternAtom(self._display, name.encode(), 0)

    def _say(self, kind: str, *words: int) -> None:
        event = Event()
        data = (c_long * 5)(self._own, *words)
        event.message = Message(
            type=CLIENT_MESSAGE, window=self._target, kind=self._atom(kind), format=32, data=data, display=self._display
        )
        self._send(self._target, event)

    def _send(self, to: int, event: Event) -> None:
        self._x.XSendEvent(self._display, to, 0, 0, ctypes.byref(event))
        self._x.XFlush(self._display)

    def _heard(self, kind: str) -> list[int]:
        """The words of the window's next message of a kind; what it asks for meanwhile it gets."""
        end, event = time.monotonic() + PATIENCE, Event()
        while True:
            while not self._x.XPending(self._display):
                assert time.monotonic() < end, f"no {kind}"
                time.sleep(0.01)
            self._x.XNextEvent(self._display, ctypes.byref(event))
            if event.type == SELECTION_REQUEST:
                self._give(event.request)
            elif event.type == CLIENT_MESSAGE and event.message.kind == self._atom(kind):
                return list(event.message.data)

    def _give(self, asked: Request) -> None:
        """The file's address, as a list of addresses.  GLFW answers a drop with the length of the list, of which 0 in
        the lowest bit means that it was refused: a line of comment makes it even."""
        text = f"{self._path.as_uri()}\r\n".encode()
        text += b"#\r\n" if len(text) % 2 else b""
        self._x.XChangeProperty(self._display, asked.requestor, asked.property, asked.target, 8, 0, text, len(text))
        event = Event()
        event.notice = Notice(
            type=SELECTION_NOTIFY, display=self._display, requestor=asked.requestor, selection=asked.selection,
            target=asked.target, property=asked.property, time=asked.time,
        )  # fmt: skip
        self._send(asked.requestor, event)


def window_of(app):
    """The number of a program's window."""
    words = ["xdotool", "search", "--onlyvisible", "--pid", str(app.process.pid)]
    environment = {**os.environ, "DISPLAY": app.display}
    found = subprocess.run(words, capture_output=True, text=True, check=True, env=environment, timeout=PATIENCE)
    return int(found.stdout.split()[-1])
