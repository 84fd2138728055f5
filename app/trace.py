"""When things happened, for those who measure: with INKFALL_TRACE set, lines on standard error."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path


def trace(what: str) -> None:
    """Tells the milliseconds since the process began, and whether numba is loaded."""
    if not os.environ.get("INKFALL_TRACE"):
        return
    print(f"{what}: {since_exec() * 1000:.0f} ms, numba {'numba' in sys.modules}", file=sys.stderr, flush=True)


def since_exec() -> float:
    """Seconds since the process was started, to 10 ms; from the interpreter's own start where /proc is missing."""
    try:
        started = int(Path("/proc/self/stat").read_text().rpartition(")")[2].split()[19])
        return time.clock_gettime(time.CLOCK_BOOTTIME) - started / os.sysconf("SC_CLK_TCK")
    except (OSError, AttributeError):
        return time.process_time()
