"""A display of its own for benchmarks that open the window: an X server without a screen."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
NEEDED = "Xvfb, imgui_bundle, glfw and moderngl"


def available() -> bool:
    """Whether a window can be opened where nobody sees it."""
    from importlib.util import find_spec

    return shutil.which("Xvfb") is not None and all(find_spec(n) for n in ("imgui_bundle", "glfw", "moderngl"))


def children() -> dict[str, str]:
    """The environment of programs that import this checkout's code and benchmarks."""
    paths = [str(ROOT), str(ROOT / "tests"), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in paths if path)}


@contextmanager
def display() -> Iterator[dict[str, str]]:
    """An environment for programs that shall open their windows there."""
    read, write = os.pipe()
    command = ["Xvfb", "-screen", "0", "1280x800x24", "-noreset", "-nolisten", "tcp", "-r", "-displayfd", str(write)]
    server = subprocess.Popen(command, pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    try:
        with os.fdopen(read) as told:
            number = told.readline().strip()
        if not number:
            raise OSError("Xvfb did not start")
        yield {**children(), "DISPLAY": f":{number}"}
    finally:
        server.terminate()
        server.wait(10)


def python(*words: str) -> list[str]:
    """The command of a program that runs in this interpreter."""
    return [sys.executable, *words]
