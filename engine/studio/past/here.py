"""What was painted here: asked of the painting on the easel, and answered piece by piece, the newest strokes first."""

from __future__ import annotations

import time

from engine.brush.settings import textures_of
from engine.checks.owned import Owned
from engine.session.here.painted_here import CanvasPixel, PaintedHere, Search, ShownStroke
from engine.session.session import Session
from engine.studio.past import past_records as p
from engine.studio.past.found_again import FoundAgain
from engine.studio.past.trail import Trail
from engine.studio.requests import Handlers

_PIECE = 0.01  # seconds of looking at a time


class HereFinder(Owned):
    """Finds the strokes that show at a place.  It belongs to the engine's thread.

    The first of them are told at once, the others while nothing else waits; so is the log played anew where what a fill
    covered cannot be told otherwise.
    """

    def __init__(self, trail: Trail) -> None:
        self._trail = trail
        self._follow()
        self._search: _Open | None = None
        self.handlers: Handlers = {p.AskHere: self._begin}

    @property
    def pending(self) -> int:
        """Counts the pieces of open work."""
        return int(self._search is not None)

    def step(self) -> None:
        """Looks for more strokes, and tells of all that were found."""
        search, trail = self._search, self._trail
        if search is None or search.session is not trail.easel.session:
            self._search = None  # another painting is on the easel
            return
        if search.playing:
            self._search = None  # a fault ends it
            self._play(search)
            return
        before = len(search.found)
        end = time.monotonic() + _PIECE
        self._search = None  # a fault ends it
        for some in search.strokes:
            search.found += [self._told(shown, search.session) for shown in some]
            if time.monotonic() > end:
                self._search = search
                break
        if self._search is None and self._again.wanted and not search.again:
            search.playing = self._again.begin()
            self._search = search if search.playing else None
        if self._search is None or (len(search.found) > before and not search.again):
            place, more = search.place, self._search is not None
            found = tuple(sorted(search.found, key=lambda one: -one.step.index))
            trail.easel.send(p.Here((place.level, place.x, place.y), found, more))

    def _begin(self, request: p.AskHere) -> None:
        trail = self._trail
        if trail.easel.live is not None:
            trail.easel.finish()
        trail.follow()
        if self._session is not trail.session:
            self._follow()
        self._look(CanvasPixel(request.level, request.x, request.y))
        self.step()

    def _follow(self) -> None:
        trail = self._trail
        self._session, self._again = trail.session, FoundAgain(trail.session, trail.held, trail.states)
        self._finder = PaintedHere(trail.session.cache, self._again.held)

    def _look(self, place: CanvasPixel, again: bool = False) -> None:
        session = self._session
        self._search = _Open(place, session, self._finder.search(place, session.painting, session.steps), again)

    def _play(self, search: _Open) -> None:
        """Plays a piece of the log; where that is done, looks at the place again."""
        end = time.monotonic() + _PIECE
        while self._again.play():
            if time.monotonic() > end:
                self._search = search
                return
        self._finder = PaintedHere(search.session.cache, self._again.held)
        self._look(search.place, True)

    def _told(self, shown: ShownStroke, session: Session) -> p.HereStroke:
        stroke = shown.stroke
        seed = session.painting.seed if stroke.seed is None else stroke.seed
        return p.HereStroke(
            self._trail.row(shown.step), shown.layer, shown.share, seed, tuple(textures_of(stroke.brush))
        )


class _Open:
    """A search that goes on, and what it found."""

    def __init__(self, place: CanvasPixel, session: Session, strokes: Search, again: bool) -> None:
        self.place, self.session, self.strokes = place, session, strokes
        self.playing, self.again = False, again  # the log is played for it; it is looked for the second time
        self.found: list[p.HereStroke] = []
