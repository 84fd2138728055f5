"""From the command to the first frame of the window, on a warm machine, the engine not loaded yet."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Iterator

from bench import Figure, Skipped
from bench.clock import slowness
from bench.display import NEEDED, available, display, python

REPEATS = 7
MYPAINT = 0.42  # seconds to its first frame, second start (of another run)
EMPTY = """
from imgui_bundle import imgui
import glfw, moderngl, numpy
glfw.init()
glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
window = glfw.create_window(1280, 800, "", None, None)
glfw.make_context_current(window)
moderngl.create_context(require=330).clear()
glfw.swap_buffers(window)
print("first frame", flush=True)
"""  # the least that a program with these libraries does
PATIENCE = 60.0  # seconds


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    if not available():
        yield Skipped("first frame", f"needs {NEEDED}")
        return
    with display() as environment:
        words = (("-m", "app"), ("-c", EMPTY))
        starts = [[first_frame(environment, *w) for w in words] for _ in range(2 if small else REPEATS)]
    slow = slowness()
    taken, empty = (min(column) for column in zip(*starts[1:], strict=True))
    bound = f"MyPaint's {MYPAINT} s"
    note = f"its figure of another run, unscaled; copying takes {slow:.2f} x as long here"
    yield Figure("first frame", taken, "s", bound, taken / MYPAINT, 0.4 / MYPAINT, note=note)
    note = "a program that imports the window's libraries and shows an empty window, measured in the same run"
    yield Figure("first frame, over an empty window", taken, "s", f"{empty:.2f} s", taken / empty, 1.5, note=note)


def first_frame(environment: dict[str, str], *words: str) -> float:
    """Seconds from starting the program to the word that its first frame is on the screen."""
    start = time.perf_counter()
    program = subprocess.Popen(
        python(*words),
        env={**environment, "INKFALL_TRACE": "1"},
        stderr=subprocess.STDOUT,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert program.stdout is not None
        for line in program.stdout:
            if line.startswith("first frame"):
                return time.perf_counter() - start
        raise OSError("the window did not open")
    finally:
        program.kill()
        program.wait(PATIENCE)
        if program.stdout is not None:
            program.stdout.close()
