"""The profile of the screen as the system's colour manager leaves it with the X server: the property `_ICC_PROFILE` of
the root window ("ICC Profiles in X", version 0.4, freedesktop.org)."""

from __future__ import annotations

import ctypes as ct
import os
import sys

_MOST = 1 << 24  # bytes
_ANY = 0  # type of property


def x_profile(display: str | None = None) -> bytes:
    """Returns the profile of the first screen; nothing where there is none, or no X server.  On a connection of its
    own, which may take its time: not for the window's thread."""
    if not sys.platform.startswith("linux") or not (display or os.environ.get("DISPLAY")):
        return b""
    try:
        x = ct.CDLL("libX11.so.6")
    except OSError:
        return b""
    p, u, length = ct.c_void_p, ct.c_ulong, ct.c_long
    x.XOpenDisplay.restype, x.XOpenDisplay.argtypes = p, (ct.c_char_p,)
    x.XInternAtom.restype, x.XInternAtom.argtypes = u, (p, ct.c_char_p, ct.c_int)
    x.XDefaultRootWindow.restype, x.XDefaultRootWindow.argtypes = u, (p,)
    x.XFree.argtypes = x.XCloseDisplay.argtypes = (p,)
    answers = ct.POINTER(u), ct.POINTER(ct.c_int), ct.POINTER(u), ct.POINTER(u), ct.POINTER(p)
    x.XGetWindowProperty.argtypes = (p, u, u, length, length, ct.c_int, u, *answers)
    connection = x.XOpenDisplay(display.encode() if display else None)
    if not connection:
        return b""
    try:
        atom = x.XInternAtom(connection, b"_ICC_PROFILE", 1)
        return _property(x, connection, atom) if atom else b""
    finally:
        x.XCloseDisplay(connection)


def _property(x: ct.CDLL, connection: int, atom: int) -> bytes:
    """Returns a property of bytes of the root window."""
    kind, form, count, left, data = ct.c_ulong(), ct.c_int(), ct.c_ulong(), ct.c_ulong(), ct.c_void_p()
    root, answers = x.XDefaultRootWindow(connection), (kind, form, count, left, data)
    x.XGetWindowProperty(connection, root, atom, 0, _MOST // 4, 0, _ANY, *map(ct.byref, answers))
    if not data.value:
        return b""
    try:
        return ct.string_at(data.value, count.value) if form.value == 8 and not left.value else b""
    finally:
        x.XFree(data)
