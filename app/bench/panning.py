"""The real window panning by itself, alone and while an example grows: `python -m app.bench.panning BLOCKS`.

Prints one JSON object.  The view follows the pointer in a circle, as if the middle button were held; it moves 60 times
a second, and a frame's time is from when it moved until that is on the screen.
"""

from __future__ import annotations

import json
import math
import os
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from app.loop import SWITCH, opened  # first: it imports imgui before glfw
from app.window import Window

import glfw  # isort: skip

from app import sowing
from app.bench.zooming import processor_times, until
from app.input.events import LEFT, MIDDLE, PenEvent
from engine.painting.commands import Undo
from engine.painting.requests import Do
from engine.painting.worker import Worker

FRAME = 1 / 60  # seconds
SECONDS = 2.5  # of one pan at most
CALM = 1.5  # seconds without a new picture: the presets' are painted
RADIUS = 60.0  # of the stroke that grows, pixels
DEPTHS = range(4)  # of the strokes, which grow one after another
TURN = 3.0  # radians a second

Frames = list[float]


def main(blocks: int) -> dict[str, Any]:
    """By what goes on: the seconds of each frame, and the processor time of one, by thread."""
    window = opened()
    window.frame()
    sys.setswitchinterval(SWITCH)
    worker = Worker(window.told)
    window.connect(worker)
    found: dict[str, list[tuple[Frames, dict[str, float]]]] = {"alone": [], "growing": []}
    try:
        _prepare(window)
        for _ in range(blocks):
            found["alone"].append(_panned(window, lambda: True))
            for depth in DEPTHS:
                _stroke(window, RADIUS, depth)
            until(window, lambda: window.desk.growing is not None)
            found["growing"].append(_panned(window, lambda: window.desk.growing is not None))
            _undo(window)
        renderer = window.ctx.info["GL_RENDERER"].partition(" (")[0]
    finally:
        worker.close()
        window.close()
    return {"renderer": renderer, **{name: _told(parts) for name, parts in found.items()}}


def _told(parts: list[tuple[Frames, dict[str, float]]]) -> dict[str, Any]:
    times = sorted(t for frames, _ in parts for t in frames)
    spent = {name: sum(by.get(name, 0.0) for _, by in parts) for name in ("window", "renderer")}
    return {"times": times, "spent": {name: taken / max(1, len(times)) for name, taken in spent.items()}}


def _prepare(window: Window) -> None:
    """An example is chosen, analysed and has grown once; nothing else is left to do."""
    desk = window.desk
    until(window, lambda: desk.ready and desk.scene is not None)
    until(window, _calm(window))
    desk.view = replace(desk.view, level=0, fraction=0.0)
    desk.stabiliser = 0.0
    sowing.choose(desk, next(entry for entry in desk.examples.entries if not entry.own))
    _stroke(window, 12.0, 0)
    until(window, lambda: desk.growing is not None)
    _undo(window)
    until(window, _calm(window))


def _calm(window: Window) -> Callable[[], bool]:
    """Whether nothing has been pending and no picture has come for a while."""
    seen, since = -1, 0.0

    def calm() -> bool:
        nonlocal seen, since
        now = time.perf_counter()
        if len(window.desk.pictures) != seen or window.desk.pending or window.desk.growing is not None:
            seen, since = len(window.desk.pictures), now
        return now - since > CALM

    return calm


def _undo(window: Window) -> None:
    until(window, lambda: window.desk.growing is None)
    for _ in DEPTHS:
        window.desk.post(Do(Undo()))
    until(window, lambda: window.desk.scene is not None and not window.desk.scene.can_undo)


def _event(window: Window, kind: str, at: tuple[float, float], button: int = 0) -> None:
    window.router.pointer(PenEvent(kind, *at, time=time.monotonic(), button=button))


def _stroke(window: Window, radius: float, depth: int) -> None:
    """Up and down across the canvas, faster than any hand: all of it grows from then on."""
    window.desk.examples.depth = depth
    window.desk.brush = replace(window.desk.brush, radius=radius, depth=float(depth))
    points = [(400.0 + 20 * n, 250.0 + 250 * (n % 4 < 2)) for n in range(20)]
    _event(window, "down", points[0], LEFT)
    for at in points:
        _event(window, "move", at)
    _event(window, "up", points[-1], LEFT)


def _panned(window: Window, goes_on: Callable[[], bool]) -> tuple[Frames, dict[str, float]]:
    """How long after each move of the pointer it was seen; processor time of the window and a software renderer."""
    before, frames, path = processor_times(), [], _circle()
    _event(window, "down", next(path), MIDDLE)
    start = due = time.perf_counter()
    while due - start < SECONDS and goes_on():
        rest = due - time.perf_counter()
        glfw.wait_events_timeout(rest) if rest > 0 else glfw.poll_events()
        moved = time.perf_counter() >= due  # otherwise something of the painting has come
        if moved:
            _event(window, "move", next(path))
        window.frame()
        if moved:
            frames.append(time.perf_counter() - due)
            due += FRAME * (1 + int(frames[-1] / FRAME))  # what was missed is not made up for
    _event(window, "up", next(path), MIDDLE)
    spent = {"window": 0.0, "renderer": 0.0}
    for thread, after in processor_times().items():
        spent["window" if thread == str(os.getpid()) else "renderer"] += after - before.get(thread, 0.0)
    return frames, spent


def _circle() -> Iterator[tuple[float, float]]:
    start = time.perf_counter()
    while True:
        angle = TURN * (time.perf_counter() - start)
        yield 600 + 120 * math.sin(angle), 400 + 100 * (1 - math.cos(angle))


if __name__ == "__main__":
    print(json.dumps(main(int(sys.argv[1]))))
