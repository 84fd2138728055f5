"""What a session holds beside its painting, and of the painting itself, kept within the budget of memory."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable

from engine import spare_memory
from engine.canvas.layers import Group
from engine.canvas.tile_cache import TileCache
from engine.checks.owned import Owned
from engine.keeping import large_pages, memory
from engine.session.coding.made_again import forget_made
from engine.session.history import History
from engine.session.paging import Paging

SMALLEST_CACHE = 16 << 20  # bytes of evaluated tiles that are worth more than the room they take
_APART = 32 << 20  # bytes that the process grows by before it is looked after again
_PASSING = 256 << 20  # bytes that come and go at once, as a save takes them, for which there is room: at most these
_PASSING_PART = 4  # and of the budget such a part
_LONG = 0.1  # seconds of the processor of what is looked at for how much came and went.  Where that was more than there
# is room for, as much is left for the next, up to such a part of the budget again;
_FORGOTTEN_PART = 64  # and such a part of it less after each
_GROWN = 64 << 20  # bytes that the process grows by before what is free of them is given back at rest
_GROWN_PART = 16  # or such a part of what it took: a look for what is free takes the longer the more there is
_CALM = 1.0  # seconds since somebody looked until then: what is seen next takes a third less time where it finds pages
_SWOLLEN = 24 << 20  # bytes that came beside evaluated tiles, with which nobody waits so long
_PAGED_AT_ONCE = 8 << 20  # bytes of records made smaller at once: as many as a command seldom stores
_UNFELT = 0.02  # seconds of the processor that a command may take longer for it, which no hand feels,
_UNFELT_PART = 20  # or such a part of what it took
_SPARED_PARTS = 4  # of what it may take: where but one of them is left, pages are spared until two are
_AGAIN = 2.0  # seconds after which it is, at the latest
_REST = 50  # of the time that a look took, such a multiple of it
_SOONER = 15  # where the process has grown meanwhile; as all strokes come and go by more


def _most() -> int:
    """Returns the bytes that the process may take before it is looked after."""
    return memory.budget() + memory.PROGRAM - _APART - _passing()


def _passing() -> int:
    """Returns the bytes that may come and go at once."""
    return min(_PASSING, memory.budget() // _PASSING_PART)


class Room(Owned):
    """Looks after the memory of the process.  It belongs to the session's thread.

    `history`: the session's, as it is now.
    """

    def __init__(self, cache: TileCache, history: History) -> None:
        self._cache, self.history = cache, history
        self._share = cache.budget  # bytes that it may take where there is room
        self._least = max(min(memory.cache_share(), cache.budget) // 4, SMALLEST_CACHE)  # and where there is none
        self._paging = Paging()
        self._left = 0  # bytes resident when it was looked after last
        self._looked = -_AGAIN  # when that was
        self._took = 0.0  # seconds, then
        self._since = 0.0  # seconds of this thread's processor until it was asked for last
        self._evicted = 0  # bytes that the cache had evicted when pages were given back at rest
        self._settled = 0  # bytes resident then, or fewer since
        self._beside: float = math.inf  # of them, but for evaluated tiles
        self._passed = 0  # bytes that came and went with something of late, at most
        self._sparing = False  # whether pages of large arrays go back as soon as they are freed
        self._grown = False  # whether it is time for that again
        self._swollen = False  # also while somebody looks
        self._calm = 0.0  # when nobody has looked at the painting for long
        self.aside: Iterable[Callable[[], Iterable[Group]]] = ()  # what tell of other states that somebody keeps

    def keep_within(self, root: Group) -> None:
        """Gives free pages back, lets evaluated tiles go, and makes records of the layers `root` smaller, where the
        process takes more than the budget: by and by, so that nothing that is done takes much longer for it."""
        held = memory.resident()
        if time.thread_time() - self._since > _LONG:
            self._passed = max(memory.peak() - held, self._passed - self._passed // _FORGOTTEN_PART)
        most = _most() - min(max(self._passed - _passing(), 0), memory.budget() // _PASSING_PART)
        cache = self._cache  # which grows while a long command is carried out, and nobody looks after it
        cache.budget = min(max(cache.held + most - held, self._least), self._share)
        self._settled, self._beside = min(self._settled, held), min(self._beside, held - cache.held)
        self._grown = held - self._settled > self._worth(_GROWN)
        self._swollen = held - cache.held - self._beside > _SWOLLEN
        self._spare(held, most)
        if held <= most:
            self.history.tight = False
        if self._due(held, most):
            if self._made_room(root, most) > _passing() // 2:
                self._page(True)  # else by and by, from the next command on
            self._left = memory.resident()
            self._took = time.monotonic() - self._looked
        elif self._paging.wanted > 0 or self.history.tight:
            self._page(False)
        if held < most // 2:  # beyond, every small page counts
            large_pages.ask_ahead(held)
        self._since = time.thread_time()

    def _made_room(self, root: Group, most: int) -> int:
        """Gives free pages back, and lets go of what can be made again where that is not enough; returns the bytes that
        the process takes beyond `most` still, which records are to give from now on."""
        large_pages.forgo()
        memory.give_back()
        cache, over = self._cache, memory.resident() - most
        self.history.tight = over > 0
        if over > 0:
            forget_made(over)
            cache.shrink(max(cache.held - over, self._least))
            memory.give_back()
            over = memory.resident() - most
        self._paging.want(root, cache.level, max(over, 0), [state for told in self.aside for state in told()])
        return over

    def _page(self, crowded: bool) -> None:
        """Makes records smaller, then old steps, for as long as took what was done since it was asked for last, so that
        it keeps up with what is stored; never long, unless the process is crowded."""
        now = time.thread_time()
        worked = now - self._since
        seconds = worked if crowded else min(worked, max(_UNFELT, worked / _UNFELT_PART))
        self._paging.step(max(_PAGED_AT_ONCE, int(_PAGED_AT_ONCE * seconds / _UNFELT)), seconds)
        while self.history.tight and time.thread_time() < now + seconds and self.history.pending:
            self.history.step()  # who never rests has none made smaller else but by the newest

    def _spare(self, held: int, most: int) -> None:
        """Has pages of large arrays go back as soon as they are freed where little room is left, which is slower."""
        part = held * _SPARED_PARTS
        if part > most * (_SPARED_PARTS - 1) and not self._sparing:
            self._sparing = True
            spare_memory(True)
        elif part < most * (_SPARED_PARTS - 2) and self._sparing:
            self._sparing = False
            spare_memory(False)

    def _worth(self, least: int) -> int:
        """Returns the bytes beyond which a look for what is free is worth its time, `least` at least."""
        return max(least, self._settled // _GROWN_PART)

    def _due(self, held: int, most: int) -> bool:
        """Tells whether it is time to look after the memory of a process that holds so many bytes: it holds too much,
        and more than it was left with, or that is some time ago.  Of what came and went since, as a save does, the
        system had nothing back: where that leaves little room, it is time at once."""
        if held <= most:
            return False
        now = time.monotonic()
        rest = max(_AGAIN, self._took * _REST)
        if held > self._left + _APART:
            rest = self._took * _SOONER if held <= most + _passing() // 2 else 0.0
        if now - self._looked < rest:
            return False
        self._looked = now
        return True

    def looked(self) -> None:
        """Somebody looks at the painting, and may soon look at what lies beside."""
        self._calm = time.monotonic() + _CALM

    @property
    def due(self) -> float | None:
        """Tells when free pages are to be given back, by the monotonic clock; None where that is not to be waited
        for."""
        waits = self._free and not self._swollen and time.monotonic() < self._calm
        return self._calm if waits else None

    @property
    def _free(self) -> bool:
        """Tells whether a look for free pages is worth its time."""
        return self._grown or self._cache.evicted - self._evicted > self._worth(_APART)

    @property
    def pending(self) -> int:
        """Counts what is to be made smaller, or given back, while nothing else is to be done."""
        free = self._free and (self._swollen or time.monotonic() >= self._calm)
        return self.history.pending + int(self._paging.wanted > 0) + int(free)

    def step(self) -> None:
        """Does the next piece of it."""
        if self._paging.wanted > 0:
            self._paging.step(seconds=_UNFELT / 2)
        elif self.history.pending:
            self.history.step()
        else:
            self._evicted = self._cache.evicted
            large_pages.forgo()
            memory.give_back()
            self._settled, self._grown, self._swollen = memory.resident(), False, False
            self._beside = self._settled - self._cache.held
