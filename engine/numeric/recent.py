"""What was made of something smaller, and is kept for a while in case that it is asked for again."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Made = TypeVar("Made")


class Recent(Generic[Made]):
    """What was made of late, bounded by bytes: the oldest is forgotten first.  Safe for several threads.

    `least`: bytes that stay, whoever wants room.
    """

    def __init__(self, most: Callable[[], int], least: int = 0) -> None:
        self._most, self._least, self._held = most, least, 0
        self._made: OrderedDict[Hashable, tuple[Made, int]] = OrderedDict()
        self._lock = threading.Lock()

    def get(self, key: Hashable) -> Made | None:
        """Returns what was made for a key, None if it is not known any more."""
        with self._lock:
            found = self._made.get(key)
            if found is None:
                return None
            self._made.move_to_end(key)
            return found[0]

    def keep(self, key: Hashable, made: Made, nbytes: int) -> None:
        """Keeps what was made for a key."""
        with self._lock:
            self._drop(key)
            self._made[key] = made, nbytes
            self._held += nbytes
            forgotten = self._evict(self._most())
        self._let_go(forgotten)

    def shrink(self, by: int) -> None:
        """Forgets so many bytes, as far as there are any."""
        with self._lock:
            forgotten = self._evict(max(self._held - by, self._least))
        self._let_go(forgotten)

    @property
    def held(self) -> int:
        """Returns the bytes that are held now."""
        return self._held

    def _evict(self, most: int) -> list[tuple[Hashable, Made]]:
        forgotten = list[tuple[Hashable, Made]]()
        while self._held > most and len(self._made) > 1:
            key, (made, _) = next(iter(self._made.items()))
            forgotten.append((key, made))
            self._drop(key)
        return forgotten

    def _let_go(self, forgotten: list[tuple[Hashable, Made]]) -> None:
        """Does nothing more with what is forgotten for want of room."""

    def forget(self, key: Hashable) -> None:
        """Forgets what nobody asks for any more."""
        with self._lock:
            self._drop(key)

    def _drop(self, key: Hashable) -> None:
        found = self._made.pop(key, None)
        self._held -= found[1] if found is not None else 0
