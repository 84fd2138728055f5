"""Files on their way: each is written on a thread of its own, from a painting as it was, and the window hears of it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial

from engine.painting.grown import settled
from engine.painting.value import Painting
from engine.studio import results

TELL = 0.1  # seconds between two results about one file, at least


class Writers:
    """`start` and `close` are called from one thread; `send` from any."""

    def __init__(self, send: Callable[[results.Result], None]) -> None:
        self._send = send
        self._threads: list[threading.Thread] = []
        self._lock = threading.Lock()
        self._going: dict[int, tuple[bool, float, float]] = {}  # saving?, how far grown, when that was told
        self._count = 0

    def start(self, write: Callable[[Painting], None], painting: Painting, saving: bool) -> None:
        """Has a painting grown to its end and given to `write`; `saving`: to the painting's own file."""
        self._count += 1
        with self._lock:
            self._going[self._count] = saving, 1.0, 0.0
            self._tell()
        run = partial(self._run, self._count, write, painting)
        self._threads = [thread for thread in self._threads if thread.is_alive()]
        self._threads.append(threading.Thread(target=run, name="inkfall file", daemon=False))
        self._threads[-1].start()

    def close(self) -> None:
        """Waits for all of them."""
        for thread in self._threads:
            thread.join()

    def _run(self, job: int, write: Callable[[Painting], None], painting: Painting) -> None:
        try:
            write(settled(painting, tell=partial(self._grown, job)))
        except Exception as error:
            self._send(results.Note(str(error).partition("\n")[0] or type(error).__name__, bad=True))
        finally:
            with self._lock:
                del self._going[job]
                self._tell()

    def _grown(self, job: int, part: float) -> None:
        now = time.monotonic()
        with self._lock:
            saving, _, told = self._going[job]
            if part >= 1.0 or now - told >= TELL:
                self._going[job] = saving, part, now
                self._tell()

    def _tell(self) -> None:
        """In turn, so that the last one sent is the newest."""
        going = self._going.values()
        saving, grown = any(job[0] for job in going), min((job[1] for job in going), default=1.0)
        self._send(results.Writing(len(going), saving, grown))
