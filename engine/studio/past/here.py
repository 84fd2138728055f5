"""What was painted here: asked of the painting on the easel, and answered piece by piece, the newest strokes first."""

from __future__ import annotations

import time

from engine.brush.settings import textures_of
from engine.checks.owned import Owned
from engine.session.here.painted_here import CanvasPixel, PaintedHere, Search, ShownStroke
from engine.session.session import Session
from engine.studio.past import past_records as p
from engine.studio.past.trail import Trail
from engine.studio.requests import Handlers

_PIECE = 0.01  # seconds of looking at a time


class HereFinder(Owned):
    """Finds the strokes that show at a place.  It belongs to the engine's thread.

    The first of them are told at once, the others while nothing else waits.
    """

    def __init__(self, trail: Trail) -> None:
        self._trail = trail
        self._session, self._finder = trail.session, PaintedHere(trail.session.cache, trail.held)
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
        before = len(search.found)
        end = time.monotonic() + _PIECE
        self._search = None  # a fault ends it
        for some in search.strokes:
            search.found += [self._told(shown, search.session) for shown in some]
            if time.monotonic() > end:
                self._search = search
                break
        if self._search is None or len(search.found) > before:
            place, more = search.place, self._search is not None
            told = p.Here((place.level, place.x, place.y), tuple(search.found), more)
            trail.easel.send(told)

    def _begin(self, request: p.AskHere) -> None:
        trail = self._trail
        if trail.easel.live is not None:
            trail.easel.finish()
        trail.follow()
        if self._session is not trail.session:
            self._session, self._finder = trail.session, PaintedHere(trail.session.cache, trail.held)
        place, session = CanvasPixel(request.level, request.x, request.y), self._session
        self._search = _Open(place, session, self._finder.search(place, session.painting, session.steps))
        self.step()

    def _told(self, shown: ShownStroke, session: Session) -> p.HereStroke:
        stroke = shown.stroke
        seed = session.painting.seed if stroke.seed is None else stroke.seed
        return p.HereStroke(
            self._trail.row(shown.step), shown.layer, shown.share, seed, tuple(textures_of(stroke.brush))
        )


class _Open:
    """A search that goes on, and what it found."""

    def __init__(self, place: CanvasPixel, session: Session, strokes: Search) -> None:
        self.place, self.session, self.strokes = place, session, strokes
        self.found: list[p.HereStroke] = []
