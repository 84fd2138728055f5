"""What a session holds beside its painting, kept within the budget of memory."""

from __future__ import annotations

from engine.canvas.evaluate import TileCache
from engine.checks.owned import Owned
from engine.keeping import memory
from engine.session.history import History

SMALLEST_CACHE = 16 << 20  # bytes of evaluated tiles that are worth more than the room they take
_APART = 32 << 20  # bytes that the process grows by before it is looked after again


class Room(Owned):
    """Looks after the memory of the process.  It belongs to the session's thread.

    `history`: the session's, as it is now.
    """

    def __init__(self, cache: TileCache, history: History) -> None:
        self._cache, self.history = cache, history
        self._left = 0  # bytes resident when it was looked after last
        self._evicted = 0  # bytes that the cache had evicted then

    def keep_within(self) -> None:
        """Gives free pages back, and lets evaluated tiles go, if the process takes more than the budget."""
        most = memory.budget() + memory.PROGRAM
        if memory.resident() <= max(most, self._left + _APART):
            return
        memory.give_back()
        cache, over = self._cache, memory.resident() - most
        if over > 0:
            cache.shrink(max(cache.held - over, SMALLEST_CACHE))
            memory.give_back()
        self._left = memory.resident()

    @property
    def pending(self) -> int:
        """Counts what is to be made smaller, or given back, while nothing else is to be done."""
        return self.history.pending + int(self._cache.evicted - self._evicted > _APART)

    def step(self) -> None:
        """Does the next piece of it."""
        if self.history.pending:
            self.history.step()
            return
        self._evicted = self._cache.evicted
        memory.give_back()
