"""The kernels of textures with a structure, and of detail that is learnt of them, are loaded, or compiled where the
program is new, on a thread of their own: that takes longer than anybody holds a pen still."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from threading import Thread

from engine.makers import learning, with_structure
from engine.makers.heeger_bergen import Made

_LOOK = 0.03  # seconds that the engine's thread waits at a time, where nothing else is to be done


def waiting(done: float) -> Iterator[Made]:
    """Yields, as far as it is `done`, until all kernels are there."""
    thread = _thread()
    while thread.is_alive():
        thread.join(_LOOK)
        yield Made(done)


def _make_once() -> None:
    with_structure.make_once()
    learning.make_once()


@lru_cache(maxsize=1)
def _thread() -> Thread:
    made = Thread(target=_make_once, name="inkfall structure", daemon=True)
    made.start()
    return made
