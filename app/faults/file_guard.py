"""Tells on standard error which files the window's thread opens: every one costs frames, on a slow disk many.

With INKFALL_TRACE set, as the tests of the window have it; what Python itself reads to import a module does not count.
"""

from __future__ import annotations

import os
import sys
import threading
import traceback
from types import FrameType
from typing import Any

TOLD = "file on the window's thread:"
_EVENTS = ("open", "os.remove", "os.rename", "os.mkdir", "os.truncate")
_NO_FILES = ("/proc/", "/dev/", "/sys/")


def guard_files() -> None:
    """From now on the thread that calls this is to open, replace and remove no files."""
    if os.environ.get("INKFALL_TRACE"):
        guarded = threading.get_ident()
        sys.addaudithook(lambda event, about: _heard(guarded, event, about))


def _heard(guarded: int, event: str, about: tuple[Any, ...]) -> None:
    if event not in _EVENTS or threading.get_ident() != guarded or not isinstance(about[0], str | bytes):
        return
    path, frame = os.fsdecode(about[0]), sys._getframe(1)
    if not path.startswith(_NO_FILES) and not _imports(frame):
        where = " < ".join(f"{row.name} ({os.path.basename(row.filename)})" for row in _stack(frame))
        print(f"{TOLD} {event} {path}, {where}", file=sys.stderr, flush=True)


def _imports(frame: FrameType | None) -> bool:
    while frame is not None:
        if frame.f_code.co_filename.startswith("<frozen importlib"):
            return True
        frame = frame.f_back
    return False


def _stack(frame: FrameType) -> list[traceback.FrameSummary]:
    """Returns the nearest calls, the innermost first; source lines are not looked up, which would open files."""
    found = traceback.StackSummary.extract(traceback.walk_stack(frame), limit=6, lookup_lines=False)
    return list(found)
