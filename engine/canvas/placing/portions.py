"""Pictures of many turns, some turns at a time: shown as they are by then, gone on with when they are asked for again.

What is made at last is the same, to the bit, as what is made at once.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Hashable, Iterator
from contextlib import contextmanager
from typing import TypeAlias, TypeVar

import numpy as np

_KEPT = 256  # pictures that are gone on with
# Yields after each turn what there is to show by then, which is written to later on; returns all.
Work: TypeAlias = "Generator[np.ndarray | None, None, np.ndarray | None]"

_KeptT = TypeVar("_KeptT")


class Portions:
    """Pictures of which so many `turns` are made at a time.  It belongs to one thread."""

    def __init__(self, turns: int) -> None:
        self.turns = turns
        self._begun: dict[Hashable, Work] = {}
        self._done: dict[Hashable, np.ndarray | None] = {}  # parts of pictures that are not
        self._used: set[Hashable] = set()
        self._whole, self._cut = True, False

    def picture(self, made: Callable[[], np.ndarray]) -> tuple[np.ndarray, bool]:
        """Returns a picture as far as it is made, and whether that is all."""
        self._used, self._cut = set(), False
        with self._having(False):
            out = made()
        if self._cut and len(self._used) > _KEPT // 2:
            return made(), True  # it would not come to an end
        if not self._cut:
            for key in self._used:
                self._done.pop(key, None)
        return out, not self._cut

    def shown(self, key: Hashable, begun: Callable[[], Work]) -> np.ndarray | None:
        """Returns what there is of a part by now, a new array.  Within another one, and outside `picture`, all of
        it."""
        if self._whole:
            return run_through(begun())
        self._used.add(key)
        if key not in self._done:
            work = self._begun.pop(key, None) or begun()
            with self._having(True):
                by_now, done = _advanced(work, self.turns)
            if not done:
                _keep(self._begun, key, work)
                self._cut = True
                return None if by_now is None else by_now.copy()
            _keep(self._done, key, by_now)
        found = self._done[key]
        return None if found is None else found.copy()

    def forget(self) -> None:
        """Other pixels are read from now on."""
        self._begun, self._done = {}, {}

    @contextmanager
    def all_of_it(self) -> Iterator[None]:
        """Makes all of what is asked for meanwhile, as it is to be kept."""
        with self._having(True):
            yield

    @contextmanager
    def _having(self, whole: bool) -> Iterator[None]:
        before, self._whole = self._whole, whole
        try:
            yield
        finally:
            self._whole = before


def _keep(held: dict[Hashable, _KeptT], key: Hashable, one: _KeptT) -> None:
    while len(held) >= _KEPT:
        del held[next(iter(held))]
    held[key] = one


def run_through(work: Work) -> np.ndarray | None:
    """Returns what work comes to."""
    while True:
        by_now, done = _advanced(work, 1 << 30)
        if done:
            return by_now


def _advanced(work: Work, turns: int) -> tuple[np.ndarray | None, bool]:
    """Goes on with work for some turns; returns what there is, and whether it is all."""
    by_now: np.ndarray | None = None
    try:
        for _ in range(turns):
            by_now = next(work)
    except StopIteration as done:
        found: np.ndarray | None = done.value
        return found, True
    return by_now, False
