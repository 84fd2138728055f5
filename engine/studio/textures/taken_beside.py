"""Steps that a thread of their own takes: one of them may last longer than a stroke may wait."""

from __future__ import annotations

from collections.abc import Iterator
from queue import Empty, SimpleQueue
from threading import Event, Thread
from typing import TypeVar

Step = TypeVar("Step")
_LOOK = 0.02  # seconds that the engine's thread waits at a time, where nothing else is to be done


def taken_beside(steps: Iterator[Step]) -> Iterator[Step | None]:
    """Yields what `steps` do, and None while there is nothing new.  They end with the next one that is due when nobody
    wants any more."""
    told: SimpleQueue[list[Step] | BaseException] = SimpleQueue()
    unwanted = Event()

    def work() -> None:
        try:
            for step in steps:
                if unwanted.is_set():
                    return
                told.put([step])
            told.put([])
        except BaseException as error:  # it is raised where it is waited for
            told.put(error)

    Thread(target=work, name="inkfall texture", daemon=True).start()
    try:
        while True:
            try:
                found = told.get(timeout=_LOOK)
            except Empty:
                yield None
                continue
            if isinstance(found, BaseException):
                raise found
            if not found:
                return
            yield found[0]
    finally:
        unwanted.set()
