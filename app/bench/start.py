"""From the command to the first frame of the window, on a warm machine, the engine not loaded yet."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Iterator

from app.bench import Figure, Skipped
from app.bench.clock import best, slowness
from app.bench.display import NEEDED, available, display, python

REPEATS = 7
MYPAINT = 0.42  # seconds to its first frame, second start (of another run)
LIBRARIES = "from imgui_bundle import imgui; import glfw, moderngl, numpy"
PATIENCE = 60.0  # seconds


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    if not available():
        yield Skipped("first frame", f"needs {NEEDED}")
        return
    with display() as environment:
        starts = [first_frame(environment) for _ in range(2 if small else REPEATS)]
    (loading,) = best(1 if small else 5, lambda: subprocess.run(python("-c", LIBRARIES), check=True))
    slow = slowness()
    taken = min(starts[1:])
    bound = f"MyPaint's {MYPAINT} s"
    note = f"its figure of another run, unscaled; copying takes {slow:.2f} x as long here; libraries {loading:.2f} s"
    yield Figure("first frame", taken, "s", bound, taken / MYPAINT, 0.4 / MYPAINT, note=note)
    note = "an interpreter that only imports the libraries of the window, measured in the same run"
    yield Figure("first frame, over imports", taken, "s", f"{loading:.2f} s", taken / loading, 1.5, note=note)


def first_frame(environment: dict[str, str]) -> float:
    """Seconds from starting the program to the word that its first frame is on the screen."""
    start = time.perf_counter()
    program = subprocess.Popen(
        python("-m", "app"),
        env={**environment, "INKFALL_TRACE": "1"},
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
    )
    try:
        assert program.stderr is not None
        for line in program.stderr:
            if line.startswith("first frame"):
                return time.perf_counter() - start
        raise OSError("the window did not open")
    finally:
        program.kill()
        program.wait(PATIENCE)
        program.stderr.close() if program.stderr else None
