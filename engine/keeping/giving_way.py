"""Threads whose work can wait have less of the processor than those that paint."""

from __future__ import annotations

import os
import threading
from contextlib import suppress

_NICE = 10


def give_way() -> None:
    """Lets threads that paint go before the one that calls, where the system can tell threads apart."""
    with suppress(OSError, AttributeError):
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), _NICE)
