"""What ends the program from outside: a signal, and the death of the display.

Xlib ends the process by itself, with a call of `exit` from whichever thread notices first that the X server is gone,
while other threads still draw: that ends in a segmentation fault, and what was painted last is lost.
"""

from __future__ import annotations

import contextlib
import ctypes as ct
import signal
import socket
import threading
from collections.abc import Callable
from types import FrameType
from typing import NoReturn

SIGNALS = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP", "SIGINT", "SIGBREAK") if hasattr(signal, name))
_HANDLER = ct.CFUNCTYPE(ct.c_int, ct.c_void_p)
_lasting: list[object] = []  # what C calls for as long as the process lives


class Signals:
    """Notes the first signal that asks the program to end; the next one ends it at once, as if none were heard.

    `wake` is called from a thread of its own: the window's may sleep in C, where no handler of Python's runs.  A
    signal that is ignored, as under nohup, stays so.  It is made on the main thread.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self.asked = False
        self._wake = wake
        self._heard = [number for number in SIGNALS if signal.getsignal(number) is not signal.SIG_IGN]
        self._read, self._write = socket.socketpair()
        self._write.setblocking(False)
        for number in self._heard:
            signal.signal(number, self._note)
        signal.set_wakeup_fd(self._write.fileno(), warn_on_full_buffer=False)
        threading.Thread(target=self._listen, name="inkfall signals", daemon=True).start()

    def _note(self, _number: int, _frame: FrameType | None) -> None:
        self.asked = True
        for number in self._heard:
            signal.signal(number, signal.SIG_DFL)

    def _listen(self) -> None:
        while self._read.recv(1):
            self._wake()


def hear_display_loss(end: Callable[[], NoReturn]) -> None:
    """Has `end` called on this thread when the X server is gone; nothing where there is no Xlib."""
    with contextlib.suppress(OSError):
        own, xlib = threading.get_ident(), ct.CDLL("libX11.so.6")

        def gone(_display: int | None) -> int:
            if threading.get_ident() == own:
                end()
            threading.Event().wait()  # this thread's own connection: the window's will notice, too
            return 0

        _lasting.append(_HANDLER(gone))
        xlib.XSetIOErrorHandler(_lasting[-1])
