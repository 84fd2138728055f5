"""When keys were pressed on X11: GLFW does not tell, and pointers come over another connection.

What the X server sends becomes an event of Xlib through a function that can be set (XESetWireToEvent, in Xlibint.h);
the one set here notes the times of keys, and leaves the rest to the function that was there.
"""

from __future__ import annotations

import ctypes as ct
import struct
from collections import deque

KEY_PRESS, KEY_RELEASE = 2, 3
KEPT = 1024  # keys that GLFW has not told of yet; some it never tells of
_Convert = ct.CFUNCTYPE(ct.c_int, ct.c_void_p, ct.c_void_p, ct.c_void_p)


class KeyTimes:
    """The times of the keys on one connection, of the Xlib display at this address.  OSError without libX11."""

    def __init__(self, display: int) -> None:
        self._display = display
        self._came: deque[tuple[int, int]] = deque(maxlen=KEPT)  # code, milliseconds of the server's clock
        self._set = ct.CDLL("libX11.so.6").XESetWireToEvent
        self._set.restype, self._set.argtypes = ct.c_void_p, (ct.c_void_p, ct.c_int, ct.c_void_p)
        self._noting = _Convert(self._note)  # kept: Xlib calls it
        ours = ct.cast(self._noting, ct.c_void_p)
        self._old = [self._set(display, kind, ours) for kind in (KEY_PRESS, KEY_RELEASE)]
        self._convert = _Convert(self._old[0])  # the same for both: it looks at the kind itself

    def _note(self, display: int, event: int, wire: int) -> int:
        _kind, code, _sequence, time = struct.unpack("=BBHI", ct.string_at(wire, 8))
        self._came.append((code, time))
        return int(self._convert(display, event, wire))

    def of(self, code: int) -> int | None:
        """Returns when the key was pressed or let go that GLFW tells of now; None if that is not known.  Those before
        it will not be told any more."""
        if all(code != came for came, _ in self._came):
            return None
        while True:
            came, time = self._came.popleft()
            if came == code:
                return time

    def close(self) -> None:
        """Sets what was there; before GLFW closes the display."""
        for kind, old in zip((KEY_PRESS, KEY_RELEASE), self._old, strict=True):
            self._set(self._display, kind, old)
