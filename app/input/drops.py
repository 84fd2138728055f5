"""Answers to those who drop files on the window.

On X11 GLFW tells the source of a drop whether it was taken, in the lowest bit of what is the length of the list of
files: every other drop is refused.  An answer that comes before GLFW's own is the one that counts.
Protocol: "Drag-and-Drop Protocol for the X Window System" (XDND), version 5, XdndFinished.
"""

from __future__ import annotations

import ctypes as ct
import sys
from collections.abc import Callable
from typing import Any

import glfw

CLIENT_MESSAGE = 33
TAKEN = 1  # bit 0 of the second word


class Message(ct.Structure):
    """XClientMessageEvent."""

    _fields_ = (
        ("type", ct.c_int),
        ("serial", ct.c_ulong),
        ("send_event", ct.c_int),
        ("display", ct.c_void_p),
        ("window", ct.c_ulong),
        ("message_type", ct.c_ulong),
        ("format", ct.c_int),
        ("data", ct.c_long * 5),
    )


class Event(ct.Union):
    """XEvent: 24 longs."""

    _fields_ = (("message", Message), ("pad", ct.c_long * 24))


def say_taken(window: Any) -> None:
    """Tells the source of a drop that its files were taken; called while GLFW reports the drop on its window.  Does
    nothing where the window system is not X11: there GLFW's own answer is right."""
    if not sys.platform.startswith("linux") or glfw.get_platform() != glfw.PLATFORM_X11:
        return
    display_of: Callable[[], ct.c_void_p] = glfw.get_x11_display
    x, display = _library(), ct.cast(display_of(), ct.c_void_p)
    atoms = {name: x.XInternAtom(display, name.encode(), 0) for name in ("XdndSelection", "XdndFinished")}
    source = x.XGetSelectionOwner(display, atoms["XdndSelection"])
    if not source:
        return
    words = (glfw.get_x11_window(window), TAKEN, x.XInternAtom(display, b"XdndActionCopy", 0), 0, 0)
    event = Event()
    event.message = Message(
        type=CLIENT_MESSAGE, display=display, window=source, message_type=atoms["XdndFinished"], format=32,
        data=(ct.c_long * 5)(*words),
    )  # fmt: skip
    x.XSendEvent(display, source, 0, 0, ct.byref(event))


def _library() -> ct.CDLL:
    """Opens libX11, which GLFW has loaded, with the signatures used here."""
    x = ct.CDLL("libX11.so.6")
    p, i, u = ct.c_void_p, ct.c_int, ct.c_ulong
    for function, result, arguments in (
        (x.XInternAtom, u, (p, ct.c_char_p, i)),
        (x.XGetSelectionOwner, u, (p, u)),
        (x.XSendEvent, i, (p, u, i, ct.c_long, ct.POINTER(Event))),
    ):
        function.restype, function.argtypes = result, arguments
    return x
