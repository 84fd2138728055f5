"""Steps of a texture that a thread of its own takes: one of them may last longer than a stroke may wait."""

from __future__ import annotations

from collections.abc import Iterator
from queue import Empty, SimpleQueue
from threading import Event, Thread

from engine.makers.heeger_bergen import Made

_LOOK = 0.02  # seconds that the engine's thread waits at a time, where nothing else is to be done


def made_beside(steps: Iterator[Made]) -> Iterator[Made]:
    """Yields what `steps` do, and how far they are while there is nothing new.  They end with the next one that is due
    when nobody wants any more."""
    told: SimpleQueue[Made | BaseException | None] = SimpleQueue()
    unwanted = Event()

    def work() -> None:
        try:
            for made in steps:
                if unwanted.is_set():
                    return
                told.put(made)
            told.put(None)
        except BaseException as error:  # it is raised where it is waited for
            told.put(error)

    Thread(target=work, name="inkfall texture", daemon=True).start()
    done = 0.0
    try:
        while True:
            try:
                made = told.get(timeout=_LOOK)
            except Empty:
                yield Made(done)
                continue
            if made is None:
                return
            if isinstance(made, BaseException):
                raise made
            done = made.done
            yield made
    finally:
        unwanted.set()
