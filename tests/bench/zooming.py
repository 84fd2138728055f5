"""The real window zooming by itself: `python -m bench.zooming FILE X Y EXPONENT LEVELS SECONDS`.

Prints one JSON object.  A frame's time is from the end of the frame before to its own end, without the rest the
window takes where it is early.
"""

from __future__ import annotations

import json
import os
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from app.canvas.screen import cells
from app.canvas.view import Place
from app.loop import SWITCH, opened_window  # first: it imports imgui before glfw
from app.window import Window
from engine.studio.requests import Open
from engine.studio.worker import Worker

PATIENCE = 120.0
WARM = 0.5  # seconds of zooming before frames are counted: the first tiles' memory on the screen is made
SMOOTH = 0.016


def main(file: str, x: int, y: int, exponent: int, levels: int, duration: float) -> dict[str, Any]:
    window = opened_window()
    window.frame()
    sys.setswitchinterval(SWITCH)
    window.connect(lambda _before: Worker(window.pace.told))
    worker = window.engine.worker
    worker.post(Open(Path(file)))
    place = Place(x, y, exponent)
    try:
        until(window, lambda: window.desk.known.scene is not None and window.desk.known.scene.path is not None)
        window.desk.view = replace(window.desk.view, centre=place, level=0, fraction=0.0)
        until(window, lambda: sharp(window))
        _rest(window, 2.0)  # the presets' pictures are painted
        before = processor_times()
        times, frames = _zoom(window, place, levels, duration)
        spent = {thread: after - before.get(thread, 0.0) for thread, after in processor_times().items()}
        own = spent.pop(str(os.getpid()), 0.0)
        start = time.perf_counter()
        until(window, lambda: sharp(window))
        after = time.perf_counter() - start
        renderer = window.ctx.info["GL_RENDERER"].partition(" (")[0]
    finally:
        worker.close()
        window.close()
    times.sort()
    return {
        "frames": len(times),
        "late": sum(t > SMOOTH for t in times),
        "median": times[len(times) // 2],
        "worst": times[-1],
        "sharp": after,
        "renderer": renderer,
        "spent": (own + max(spent.values(), default=0.0)) / frames,
    }


def processor_times() -> dict[str, float]:
    """Seconds of processor time of this thread, and of each thread of a software renderer; Linux only."""
    times = {}
    for task in Path("/proc/self/task").glob("*/stat"):
        name, _, rest = task.read_text().partition("(")[2].rpartition(")")
        if name.startswith("llvmpipe") or task.parent.name == str(os.getpid()):
            fields = rest.split()
            times[task.parent.name] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return times


def _zoom(window: Window, place: Place, levels: int, duration: float) -> tuple[list[float], int]:
    """Zooms in evenly about the screen's middle; how long each frame took, and how many there were in all."""
    times, frames = [], 0
    x, y = window.desk.view.width / 2, window.desk.view.height / 2
    first = window.desk.view
    start = time.perf_counter()
    while (now := time.perf_counter()) - start < duration:
        window.desk.view = first.zoomed(levels * (now - start) / duration).held(place, x, y)
        window.frame()
        taken = time.perf_counter() - now
        frames += 1
        if now - start > min(WARM, duration / 4):
            times.append(taken)
        window.wait(True)
    window.desk.view = first.zoomed(levels).held(place, x, y)
    return times, frames


def sharp(window: Window) -> bool:
    """Whether every tile on the screen is there."""
    view = window.desk.view
    return all(window.screen.revision(tile) >= 0 for tile in cells(view, view.shown_level))


def _rest(window: Window, seconds: float) -> None:
    end = time.perf_counter() + seconds
    until(window, lambda: time.perf_counter() > end)


def until(window: Window, done) -> None:
    end = time.perf_counter() + PATIENCE
    while True:
        window.frame()
        window.wait(True)
        if done():
            return
        if time.perf_counter() > end:
            raise TimeoutError("the window does not get ready")


if __name__ == "__main__":
    name, *numbers, seconds = sys.argv[1:]
    x, y, exponent, levels = map(int, numbers)
    print(json.dumps(main(name, x, y, exponent, levels, float(seconds))))
