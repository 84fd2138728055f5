"""The real window, painted in at random: `python -m bench.random_window SECONDS SEED FOLDER`.

Prints JSON lines: what the window is, what it holds after every `TELL` seconds, and the faults that it tells.  With
`INKFALL_HOLDERS`, a folder, who holds arrays is written there every so often (`bench.holders`).
"""

from __future__ import annotations

import json
import logging
import os
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from threading import Event
from typing import Any

import numpy as np

from app.loop import SWITCH, opened_window  # first: it imports imgui before glfw
from app.window import Window
from bench.holders import allocated, tell_holders
from bench.random_hand import RandomHand
from bench.zooming import until
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.keeping import memory
from engine.studio import worker as workers
from engine.studio.journalled.posts import Posts

import glfw  # isort: skip

TELL = 30.0  # seconds
HOLDERS = "INKFALL_HOLDERS"
SELDOM = 10  # times that it is told what the window holds, after which it is written down who holds arrays


def main(seconds: float, seed: int, folder: Path) -> None:
    window = opened_window()
    window.frame()
    sys.setswitchinterval(SWITCH)
    logging.getLogger("inkfall").addHandler(_Telling())
    sessions: list[Callable[[], Any]] = []
    window.connect(lambda before: _worker(window, before, sessions))
    window.pointers.mouse = hand = RandomHand(
        window.desk, np.random.default_rng(seed), folder, lambda: len(window.engine.worker._posted)
    )
    try:
        until(window, lambda: window.desk.known.ready and window.desk.known.scene is not None)
        _say(ready=True, budget=memory.budget() >> 20, renderer=window.ctx.info["GL_RENDERER"])
        _paint(window, hand, seconds, sessions)
    finally:
        _say(closing=True, files=sum(thread.name == "inkfall file" for thread in threading.enumerate()))
        window.hide()
        begun = time.monotonic()
        ended = window.engine.worker.close(60.0)
        window.close()
        _say(ended=ended, took=round(time.monotonic() - begun, 1))


def _worker(window: Window, before: Any, sessions: list[Callable[[], Any]]) -> workers.Worker:
    """The engine's thread, as `app.loop` begins it; `sessions` gets what tells the session that it paints."""

    def make(send: Any, post: Any, posts: Posts | None = None) -> Any:
        bench: Any = begin(send, post, posts)
        sessions.append(lambda: bench._studio.easel.session)
        return bench

    begin, workers._studio = workers._studio, make
    try:
        return workers.Worker(window.pace.told, posts=Posts(Journal(head_of_new())), before=before)
    finally:
        workers._studio = begin


def _paint(window: Window, hand: RandomHand, seconds: float, sessions: list[Callable[[], Any]]) -> None:
    """Frame after frame until the time is over; a thread beside wakes the window when the hand does the next thing."""
    works, over, now = hand.work(), Event(), time.monotonic()
    dues = [now]
    threading.Thread(target=_wake, args=(dues, over), daemon=True).start()
    end, telling, notes, told = now + seconds, now, -1, 0
    try:
        while (now := time.monotonic()) < end and not window.closed():
            while dues[0] <= now:
                dues[0] = max(dues[0], now - 0.1) + next(works)
            if now >= telling:
                telling += TELL
                _say(**_held(window, sessions), waited=round(hand.waited, 1), done=hand.done)
                told += 1
                if told % SELDOM == 0 and HOLDERS in os.environ:
                    tell_holders(Path(os.environ[HOLDERS], f"{told}.json"))
            if len(window.desk.notices.rows) != notes:
                notes = len(window.desk.notices.rows)
                for notice in window.desk.notices.rows:
                    _say(notice=notice.text, bad=notice.bad)
            window.wait(window.frame())
    finally:
        over.set()


def _wake(dues: list[float], over: Event) -> None:
    while not over.is_set():
        time.sleep(min(0.05, max(0.004, dues[0] - time.monotonic())))
        if time.monotonic() >= dues[0]:
            glfw.post_empty_event()


def _held(window: Window, sessions: list[Callable[[], Any]]) -> dict[str, Any]:
    """What the program says that it holds, bytes, and where the journal is."""
    session = sessions[-1]()
    from engine.session.held_pyramids import pyramids

    entry = window.engine.worker.entry
    files = [path.stat().st_size for path in entry.iterdir()] if entry is not None else []
    return {
        "records": sum(pyramid.nbytes for pyramid in pyramids(session.painting.root).values()),
        "history": session.history.held,
        "cache": session.cache.held,
        "steps": session.history.undo_count,
        "commands": len(session.log),
        "entry": sum(files),
        "waiting": len(window.engine.worker._posted),
        "malloc": allocated(),
        "threads": len(list(Path("/proc/self/task").iterdir())),
        "level": window.desk.view.level,
    }


class _Telling(logging.Handler):
    def emit(self, record: logging.LogRecord) -> None:
        if record.levelno >= logging.WARNING:
            _say(fault=logging.Formatter().format(record))


def _say(**told: object) -> None:
    print(json.dumps(told), flush=True)


if __name__ == "__main__":
    main(float(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]))
