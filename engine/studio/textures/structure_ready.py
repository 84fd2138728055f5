"""The kernels of textures with a structure, of detail that is learnt of them, and of written textures, are loaded, or
compiled where the program is new, on a thread of their own: that takes longer than anybody holds a pen still."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from threading import Thread

from engine.makers import learning, with_structure
from engine.makers.heeger_bergen import Made
from engine.texture.expression import programs

_LOOK = 0.03  # seconds that the engine's thread waits at a time, where nothing else is to be done


def waiting(done: float) -> Iterator[Made]:
    """Yields, as far as it is `done`, until all kernels are there."""
    for _ in _waiting(_thread(_make_once)):
        yield Made(done)


def waiting_for_written() -> Iterator[None]:
    """Yields until the kernels of written textures are there."""
    yield from _waiting(_thread(programs.make_kernels))


def _waiting(thread: Thread) -> Iterator[None]:
    while thread.is_alive():
        thread.join(_LOOK)
        yield


def _make_once() -> None:
    with_structure.make_once()
    learning.make_once()


@lru_cache(maxsize=2)
def _thread(make: Callable[[], None]) -> Thread:
    made = Thread(target=make, name="inkfall structure", daemon=True)
    made.start()
    return made
