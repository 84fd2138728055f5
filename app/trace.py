"""When things happened and where controls lie, for those who measure and for tests: with INKFALL_TRACE set, lines on
standard error; with "frames" in it, one for each frame."""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path

Box = tuple[int, int, int, int]  # left, top, right, bottom, pixels of the window
TRACED = bool(os.environ.get("INKFALL_TRACE"))

_placed: dict[tuple[str, str], Box] = {}  # in the frame that is drawn now
_told: dict[tuple[str, str], Box] = {}  # at the end of the frame before
moved = False  # whether those of the last frame lay elsewhere than those of the frame before
_rest = ""  # what was told of it last
_typing = ""  # likewise


def trace(what: str) -> None:
    """Tells the milliseconds since the process began, and whether numba is loaded."""
    if not TRACED:
        return
    sys.stderr.write(f"{what}: {since_exec() * 1000:.0f} ms, numba {'numba' in sys.modules}\n")
    sys.stderr.flush()


def note_place(window: str, name: str, box: Box) -> None:
    """Notes where a control of a window lies in this frame; a second one of a name gets a number."""
    if not TRACED:
        return
    key, count = (window, name), 1
    while key in _placed:
        count += 1
        key = window, f"{name} {count}"
    _placed[key] = box


def tell_places() -> None:
    """Ends a frame: tells each box that came or moved since the frame before, and each that went."""
    global _placed, _told, moved
    if not TRACED:
        return
    moved = _placed != _told
    for key, box in _placed.items():
        if _told.get(key) != box:
            sys.stderr.write(f"box {json.dumps([*key, *box])}\n")
    for key in _told.keys() - _placed.keys():
        sys.stderr.write(f"gone {json.dumps(key)}\n")
    sys.stderr.flush()
    _told, _placed = _placed, {}


def trace_frame(began: float, ended: float) -> None:
    """Tells when a frame began, how long it took, and how long the thread has had the processor in all, milliseconds.
    `began`, `ended`: by the monotonic clock, seconds."""
    if "frames" in os.environ.get("INKFALL_TRACE", ""):
        told = (began, ended - began, time.thread_time())
        print("frame:", *(f"{seconds * 1000:.1f}" for seconds in told), file=sys.stderr, flush=True)


def trace_points(count: int, began: float) -> None:
    """Tells that so many points of a stroke were posted, from when to when, by the monotonic clock."""
    if TRACED:
        print("points", count, began, time.monotonic(), file=sys.stderr, flush=True)


def trace_rest(rests: bool, kept: bool, at: tuple[float, float], taken: tuple[int, int]) -> None:
    """Tells whether all that was asked for is done and on the screen, and whether it is `kept` on disk, too, where the
    pointer was then, pixels of the window, and how many keys and how many presses were `taken` until then; when that is
    another than before."""
    global _rest
    how = f"{'rest' if rests else 'work'} {'kept' if kept else 'held'}"
    told = f"at {how} {at[0]:g},{at[1]:g} {taken[0]} {taken[1]}"
    if TRACED and told != _rest:
        _rest = told
        sys.stderr.write(f"{told}\n")
        sys.stderr.flush()


def trace_typing(on: bool, text: str | None) -> None:
    """Tells whether a field takes what is typed, and what stands in it, None where that is not known, when that is
    another than before."""
    global _typing
    told = f"typing on {json.dumps(text)}" if on else "typing off"
    if TRACED and told != _typing:
        _typing = told
        sys.stderr.write(f"{told}\n")
        sys.stderr.flush()


def since_exec() -> float:
    """Seconds since the process was started, to 10 ms; from the interpreter's own start where /proc is missing."""
    try:
        started = int(Path("/proc/self/stat").read_text().rpartition(")")[2].split()[19])
        return time.clock_gettime(time.CLOCK_BOOTTIME) - started / os.sysconf("SC_CLK_TCK")
    except (OSError, AttributeError):
        return time.process_time()
