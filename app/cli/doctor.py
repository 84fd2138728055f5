"""Tell what Inkfall finds on this machine: display, OpenGL, pen tablets, folders."""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import platformdirs

from app.cli.outcome import DONE
from app.faults.log import log_file
from engine.keeping import memory

PACKAGES = ("numpy", "numba", "Pillow", "glfw", "moderngl", "imgui-bundle")
INPUT_DEVICES = Path("/proc/bus/input/devices")
TABLET_WORDS = ("tablet", " pen", "stylus", "wacom", "huion", "xp-pen", "gaomon", "ugee")

# Runs in its own process: a faulty driver may end it, but not the doctor.
PROBE = """
import json, glfw, moderngl
glfw.ERROR_REPORTING = False
def why():
    return (glfw.get_error()[1] or b"no reason given").decode(errors="replace")
if not glfw.init():
    raise SystemExit(f"no display: {why()}")
for hint, value in ((glfw.VISIBLE, 0), (glfw.CONTEXT_VERSION_MAJOR, 3), (glfw.CONTEXT_VERSION_MINOR, 3),
                    (glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE), (glfw.OPENGL_FORWARD_COMPAT, 1)):
    glfw.window_hint(hint, value)
window = glfw.create_window(16, 16, "doctor", None, None)
if not window:
    raise SystemExit(f"no OpenGL 3.3: {why()}")
glfw.make_context_current(window)
found = moderngl.create_context(require=330)
print(json.dumps({"version": found.info["GL_VERSION"], "renderer": found.info["GL_RENDERER"],
                  "vendor": found.info["GL_VENDOR"]}))
glfw.terminate()
"""


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--prepare", action="store_true", help="compile what the brushes need, so that no start waits")


def run(options: argparse.Namespace) -> int:
    """Prints what there is, or makes the brushes ready; returns the exit status."""
    if options.prepare:
        from app.cli.preparation import prepare

        print(prepare())
        return DONE
    found = examination()
    if options.json:
        print(json.dumps(found))
    else:
        for name, value in found.items():
            print(f"{name:<10} {_plain(value)}")
    return DONE


def examination() -> dict[str, Any]:
    """Returns what there is, each by its name; an absent thing is said to be absent."""
    return {
        "inkfall": _version("inkfall"),
        "python": platform.python_version(),
        "system": platform.platform(),
        "processors": os.cpu_count(),
        "memory": memory.fault() or f"{memory.budget() // memory.MEGABYTE} MB for paintings, beside the program's",
        "shares": {name: f"{size // memory.MEGABYTE} MB at most" for name, size in memory.shares().items()},
        "packages": {name: _version(name) for name in PACKAGES},
        "display": display() or "none",
        "opengl": opengl(),
        "tablets": tablets() or "none seen",
        "config": platformdirs.user_config_dir("inkfall"),
        "cache": platformdirs.user_cache_dir("inkfall"),
        "log": str(log_file()),
        "kernels": os.environ.get("NUMBA_CACHE_DIR") or str(Path(platformdirs.user_cache_dir("inkfall")) / "kernels"),
    }


def display() -> str | None:
    """Returns the display a window would open on; None if there is none."""
    if sys.platform in ("win32", "darwin"):
        return "the desktop"
    for name in ("WAYLAND_DISPLAY", "DISPLAY"):
        if os.environ.get(name):
            return f"{name}={os.environ[name]}"
    return None


def opengl(timeout: float = 20.0) -> dict[str, str] | str:
    """Version, renderer and vendor of the OpenGL that the window would use, or why there is none."""
    try:
        done = subprocess.run([sys.executable, "-c", PROBE], capture_output=True, text=True, timeout=timeout)
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"not examined: {error}"
    if done.returncode == 0:
        try:
            told: dict[str, str] = json.loads(done.stdout)
            return told
        except ValueError:
            return f"not understood: {done.stdout[:100]!r}"
    last = done.stderr.strip().splitlines()[-1:] or [f"the probe ended with status {done.returncode}"]
    return last[0]


def tablets() -> list[str]:
    """Returns names of the pen devices that the kernel lists; empty where it has no such list."""
    try:
        text = INPUT_DEVICES.read_text(errors="replace")
    except OSError:
        return []
    names = [line.split('"')[1] for line in text.splitlines() if line.startswith("N: Name=") and line.count('"') >= 2]
    return [name for name in names if any(word in name.lower() for word in TABLET_WORDS)]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


def _plain(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} {text}" for name, text in value.items())
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)
