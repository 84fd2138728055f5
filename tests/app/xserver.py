"""X servers for tests, on displays that they choose themselves."""

import ctypes
import os
import shutil
import subprocess
from typing import NoReturn

import pytest


def lacking(what: str) -> NoReturn:
    """This machine has not what a test needs: it is skipped, but not where every test must run."""
    if os.environ.get("CI"):
        pytest.fail(f"needs {what}")
    pytest.skip(f"needs {what}")


def need(*programs: str) -> None:
    for program in programs:
        if shutil.which(program) is None:
            lacking(program)


def started_server(command: list[str]) -> tuple[subprocess.Popen, str]:
    """An X server on a free display that it chooses itself, and the display's name."""
    read, write = os.pipe()
    process = subprocess.Popen(
        [*command, "-displayfd", str(write)], pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    os.close(write)
    with os.fdopen(read) as answer:
        number = answer.readline().strip()
    assert number, f"{command[0]} did not start"
    return process, f":{number}"


def started_screen(size: str = "1280x800") -> tuple[subprocess.Popen, str]:
    """As `started_server`, with a screen that nobody sees.  No key repeats: on a loaded machine each is held long."""
    return started_server(["Xvfb", "-screen", "0", f"{size}x24", "-noreset", "-nolisten", "tcp", "-r"])


def let_keys_repeat(display: str, repeat: bool) -> None:
    """Whether a key that is held repeats on a display."""
    x = ctypes.CDLL("libX11.so.6")
    x.XOpenDisplay.restype, x.XOpenDisplay.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    for name in ("XAutoRepeatOn", "XAutoRepeatOff", "XCloseDisplay"):
        getattr(x, name).argtypes = [ctypes.c_void_p]
    connection = x.XOpenDisplay(display.encode())
    assert connection
    (x.XAutoRepeatOn if repeat else x.XAutoRepeatOff)(connection)
    x.XCloseDisplay(connection)
