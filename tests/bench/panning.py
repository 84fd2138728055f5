"""The real window panning by itself, while an example grows and over the same painting when it has: `python -m
bench.panning BLOCKS`.

Prints one JSON object.  The view follows the pointer in a circle, as if the middle button were held; it moves 60 times
a second, and a frame's time is from when it moved until that is on the screen.  A thread
beside it wants to wake 60 times a second.
"""

from __future__ import annotations

import json
import math
import os
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from threading import Event, Thread
from typing import Any

from app.desk.examples import example_use
from app.input.events import LEFT, MIDDLE, PenEvent
from app.loop import SWITCH, opened_window
from app.window import Window
from bench.zooming import processor_times, until
from engine.painting.commands import Undo
from engine.studio.requests import Do
from engine.studio.worker import Worker

FRAME = 1 / 60  # seconds
SECONDS = 2.5  # of one pan at most
CALM = 1.5  # seconds without a new picture: the presets' are painted
RADIUS = 80.0  # of the stroke that grows, pixels
TURN = 3.0  # radians a second

Frames = list[float]
Pan = tuple[Frames, Frames, dict[str, float]]  # frames; how late the loop beside them woke; processor time by thread


def main(blocks: int) -> dict[str, Any]:
    """By what goes on: the seconds of each frame, by which a loop beside it wakes late, and the processor time of a
    frame, by thread."""
    window = opened_window()
    window.frame()
    sys.setswitchinterval(SWITCH)
    window.connect(lambda _before: Worker(window.pace.told))
    worker = window.engine.worker
    window.pointers.mouse = hand = Hand()
    found: dict[str, list[Pan]] = {"alone": [], "growing": []}
    try:
        _prepare(window, hand)
        for _ in range(blocks):
            _stroke(window, hand)
            until(window, lambda: window.desk.known.growing is not None)
            found["growing"].append(_panned(window, hand, lambda: window.desk.known.growing is not None))
            until(window, _calm(window))
            found["alone"].append(_panned(window, hand, lambda: True))
            _undo(window)
        renderer = window.ctx.info["GL_RENDERER"].partition(" (")[0]
    finally:
        worker.close()
        window.close()
    return {"renderer": renderer, **{name: _told(parts) for name, parts in found.items()}}


def _told(pans: list[Pan]) -> dict[str, Any]:
    times, late = (sorted(t for pan in pans for t in pan[n]) for n in (0, 1))
    spent = {name: sum(pan[2].get(name, 0.0) for pan in pans) for name in ("window", "renderer")}
    return {"times": times, "late": late, "spent": {name: taken / max(1, len(times)) for name, taken in spent.items()}}


def _prepare(window: Window, hand: Hand) -> None:
    """An example is chosen, analysed and has grown once; nothing else is left to do."""
    desk = window.desk
    until(window, lambda: desk.known.ready and desk.known.scene is not None)
    until(window, _calm(window))
    desk.view = replace(desk.view, level=0, fraction=0.0)
    desk.hand.stabiliser = 0.0
    example_use.choose(desk, next(entry for entry in desk.examples.entries if not entry.own))
    desk.hand.change(radius=RADIUS)
    until(window, _calm(window))
    _stroke(window, hand)
    until(window, lambda: desk.known.growing is not None)
    _undo(window)


def _calm(window: Window) -> Callable[[], bool]:
    """Whether nothing has been pending and no picture has come for a while."""
    seen, since = -1, 0.0

    def calm() -> bool:
        nonlocal seen, since
        now = time.perf_counter()
        if len(window.desk.pictures) != seen or window.desk.known.pending or window.desk.known.growing is not None:
            seen, since = len(window.desk.pictures), now
        return now - since > CALM

    return calm


def _undo(window: Window) -> None:
    until(window, lambda: window.desk.known.growing is None)
    window.desk.post(Do(Undo()))
    until(window, lambda: window.desk.known.scene is not None and not window.desk.known.scene.can_undo)
    until(window, _calm(window))


class Hand:
    """The pointer, instead of a mouse."""

    name = "hand"

    def __init__(self) -> None:
        self._events: list[PenEvent] = []

    def does(self, kind: str, at: tuple[float, float], button: int = 0) -> None:
        self._events.append(PenEvent(kind, *at, time=time.monotonic(), button=button))

    def events(self) -> list[PenEvent]:
        events, self._events = self._events, []
        return events

    def close(self) -> None: ...


def _stroke(window: Window, hand: Hand) -> None:
    """Up and down across the canvas, faster than any hand: all of it grows from then on."""
    points = [(360.0 + 12 * n, 180.0 + 480 * (n % 4 < 2)) for n in range(50)]
    hand.does("down", points[0], LEFT)
    for at in points:
        hand.does("move", at)
    hand.does("up", points[-1], LEFT)
    window.frame()


def _panned(window: Window, hand: Hand, goes_on: Callable[[], bool]) -> Pan:
    """How long after each move of the pointer it was seen; processor time of the window and a software renderer."""
    late: Frames = []
    over = Event()
    beside = Thread(target=_loop, args=(over, late))
    beside.start()
    before, frames, path = processor_times(), [], _circle()
    hand.does("down", next(path), MIDDLE)
    start = due = time.perf_counter()
    while due - start < SECONDS and goes_on():
        rest = due - time.perf_counter()
        window.pace.rest(rest)
        moved = time.perf_counter() >= due  # otherwise something of the painting has come
        if moved:
            hand.does("move", next(path))
        window.frame()
        if moved:
            frames.append(time.perf_counter() - due)
            due += FRAME * (1 + int(frames[-1] / FRAME))  # what was missed is not made up for
    over.set()
    beside.join()
    hand.does("up", next(path), MIDDLE)
    spent = {"window": 0.0, "renderer": 0.0}
    for thread, after in processor_times().items():
        spent["window" if thread == str(os.getpid()) else "renderer"] += after - before.get(thread, 0.0)
    return frames, late, spent


def _loop(over: Event, late: Frames) -> None:
    due = time.perf_counter()
    while not over.is_set():
        due = max(due + FRAME, time.perf_counter())
        time.sleep(max(0.0, due - time.perf_counter()))
        late.append(time.perf_counter() - due)


def _circle() -> Iterator[tuple[float, float]]:
    start = time.perf_counter()
    while True:
        angle = TURN * (time.perf_counter() - start)
        yield 600 + 120 * math.sin(angle), 400 + 100 * (1 - math.cos(angle))


if __name__ == "__main__":
    print(json.dumps(main(int(sys.argv[1]))))
