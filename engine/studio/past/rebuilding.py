"""States of the painting that the history does not hold any more: its log played anew, from the nearest that is kept.

A state is kept every 200 steps or 3 seconds of playing, in turn forgotten when together they hold too much.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from itertools import pairwise

from engine.canvas.layers import Group
from engine.canvas.tile_cache import TileCache
from engine.keeping import memory
from engine.painting import commands as c
from engine.painting.recording import undo_reach
from engine.painting.value import Painting
from engine.session.apply import STEPS
from engine.session.differing import difference
from engine.session.history import History
from engine.session.replay import stays_within
from engine.session.session import Session

STEPS_APART, SECONDS_APART = 200, 3.0
PLAYED_AT_ONCE = 0.02  # seconds of playing at a time
_CACHE_BYTES = 64 << 20  # of tiles evaluated while commands are played anew, at most,
_CACHE_PART = 8  # and of what those on the screen may take


class KeptStates:
    """Paintings by how many commands of the log led to them."""

    def __init__(self, base: Painting) -> None:
        self._states: dict[int, Painting] = {0: base}
        self._alone: dict[int, int] = {0: 0}  # bytes that each holds and the one before does not
        self.held, self._most = 0, memory.states_share()

    def keep(self, count: int, painting: Painting) -> None:
        """Keeps the painting after the first `count` commands."""
        before = max((n for n in self._states if n < count), default=None)
        if count in self._states or before is None:
            return
        gained = difference(self._states[before].root, painting.root)[1]
        self._states[count], self._alone[count] = painting, gained
        self.held += gained
        if self.held > self._most:
            self._only(sorted(self._states))  # the history may have coded much of them
        if self.held > self._most:
            self._only([0, *sorted(self._states)[2::2]])  # every other one

    def roots(self) -> list[Group]:
        """Returns the layers of all that are kept."""
        return [painting.root for painting in self._states.values()]

    def nearest(self, log: Sequence[c.Command], count: int, least: int | None = None) -> tuple[int, Painting]:
        """Returns the latest state from which the first `count` commands can be played on, and how many led to it: at
        most `least`, if that is given."""
        for n in sorted((n for n in self._states if n <= (count if least is None else least)), reverse=True):
            if stays_within(log[n:count]):
                return n, self._states[n]
        return 0, self._states[0]

    def _only(self, kept: Sequence[int]) -> None:
        """Forgets all but some, and counts anew what each of those holds alone."""
        self._states = {n: self._states[n] for n in kept}
        self._alone = {0: 0}
        for before, n in pairwise(kept):
            self._alone[n] = difference(self._states[before].root, self._states[n].root)[1]
        self.held = sum(self._alone.values())


class Rebuilding:
    """Plays the first `count` commands of a session's log, piece by piece, those from `first` on among what it plays.
    FileError or Refusal where one cannot be done.

    `held`: bytes of what the new session's undo may hold; None for a quarter of what a session's may.
    """

    def __init__(
        self, of: Session, states: KeptStates, count: int, first: int | None = None, held: int | None = None
    ) -> None:
        self._log, self._states, self._of, self._count = of.log, states, of, count
        self.at, painting = self._states.nearest(self._log, count, first)
        self._begun = self.at
        reach = undo_reach(self._log[self.at : count], STEPS)
        history = History(memory.history_share() // 4 if held is None else held, max(reach, 1))
        history.lessens = False  # what is kept of its states stands by itself, and is counted so
        cache = TileCache(min(_CACHE_BYTES, memory.cache_share() // _CACHE_PART))
        self.session = Session(painting, cache, folder=of.folder, history=history)
        self._steps, self._since = 0, time.monotonic()

    @property
    def done(self) -> bool:
        """Tells whether the state is reached."""
        return self.at >= self._count

    @property
    def part(self) -> float:
        """Tells how far it is, 0..1."""
        return 1.0 if self.done else (self.at - self._begun) / (self._count - self._begun)

    def play(self) -> None:
        """Plays the next command."""
        command = self._log[self.at]
        lent = None
        if isinstance(command, c.DefineTexture):  # its file may be gone, and its picture is still here
            lent = self._of.around().pictures.get(command.arguments.get("sha", ""))
        self.session.do(command, lent)
        self.at += 1
        self._steps += type(command) in STEPS
        if self._steps >= STEPS_APART or time.monotonic() > self._since + SECONDS_APART:
            self._states.keep(self.at, self.session.painting)
            self._steps, self._since = 0, time.monotonic()
