"""The memory that a painting may take: one budget for the process, and how it is shared out.

What can be made again - evaluated tiles, old steps, kept states - is let go before the painting's own records are in
want of room.  The budget is read once, when it is first asked for: `INKFALL_MEMORY`, else the preferences, else a
quarter of the machine's memory and at most 4 GB.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

from engine.files.fault import shown
from engine.keeping.preferences import MEGABYTES, preferences_file, read_preferences

VARIABLE = "INKFALL_MEMORY"  # MB
MEGABYTE = 1 << 20
PROGRAM = 250 * MEGABYTE  # that the program itself takes, beside the budget
_MOST = 4096 * MEGABYTE  # unless somebody says otherwise
_LEAST = 64 * MEGABYTE  # with less, hardly anything that was worked out once is kept
_UNKNOWN = 16384 * MEGABYTE  # of a machine that does not tell how much it has


@cache
def budget() -> int:
    """Returns the bytes that all paintings of this process, and what is known of them, may take."""
    return told_budget(os.environ.get(VARIABLE))[0]


def fault() -> str:
    """Tells in a line what is wrong with the variable; "" where nothing is."""
    return told_budget(os.environ.get(VARIABLE))[1]


def told_budget(word: str | None) -> tuple[int, str]:
    """Returns the budget in bytes, and what is wrong with `word`, the variable's value (None: it is not set): "" where
    nothing is."""
    fault, asked = "", read_preferences(preferences_file())[0].megabytes
    if word is not None:
        if word.isdecimal() and len(word) < 12 and int(word) <= MEGABYTES.high:
            asked = int(word)
        else:
            fault = f"{VARIABLE}: found {shown(word)}, expected a whole number of MB from 0 to {MEGABYTES.high:g}"
    fitting = min(_installed() // 4, _MOST)
    return max(asked * MEGABYTE or fitting, _LEAST), fault


def cache_share() -> int:
    """Returns the bytes that evaluated tiles may take."""
    return budget() // 4


def history_share() -> int:
    """Returns the bytes that the steps which can be taken back may hold beside the painting."""
    return budget() // 4


def states_share() -> int:
    """Returns the bytes that kept states, from which older steps are played anew, may hold."""
    return budget() // 8


def shares() -> dict[str, int]:
    """Returns the bytes that each may take, by what for; the painting itself has what is left, and then the disk."""
    return {"screen": cache_share(), "undo": history_share(), "older steps": states_share()}


def resident() -> int:
    """Returns the bytes of memory that the process has; where the system does not tell, the most it ever had."""
    try:
        return int(os.pread(_statm(os.getpid()), 100, 0).split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, AttributeError):
        return _most_resident()


@cache
def _statm(process: int) -> int:
    """Returns the open file in which the system tells of a process: it is asked for after every piece of work."""
    return os.open(f"/proc/{process}/statm", os.O_RDONLY | os.O_CLOEXEC)


def peak() -> int:
    """Returns the most bytes of memory that the process had since this was asked for last; what it has where the system
    does not tell."""
    try:
        told = Path("/proc/self/status").read_text()
        Path("/proc/self/clear_refs").write_text("5")  # the most is what it has, from now on
        return int(told.partition("VmHWM:")[2].split(maxsplit=1)[0]) << 10
    except (OSError, ValueError, IndexError):
        return resident()


def _most_resident() -> int:
    try:
        import resource
    except ImportError:  # Windows
        return 0
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else most * 1024


def crowded() -> bool:
    """Tells whether the process takes more than it may, the program and what comes and goes with it."""
    return resident() > budget() + PROGRAM


def settle() -> None:
    """Gives free pages back where the process takes more than the budget: what took many has ended."""
    if resident() > budget():
        give_back()


def give_back() -> None:
    """Returns free pages to the system: glibc keeps those between blocks that are in use."""
    trim = _trim()
    if trim is not None:
        trim(0)


@cache
def _trim() -> Callable[[int], object] | None:
    """Returns glibc's `malloc_trim`; None where there is none."""
    if not sys.platform.startswith("linux"):
        return None
    return getattr(ctypes.CDLL(None), "malloc_trim", None)


def _installed() -> int:
    """Returns the bytes of memory of the machine."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (ValueError, OSError, AttributeError):
        return _UNKNOWN
