"""What was painted here: asked of the painting on the easel."""

from __future__ import annotations

from engine.brush.settings import textures_of
from engine.checks.owned import Owned
from engine.session.painted_here import CanvasPixel, PaintedHere, ShownStroke
from engine.studio.past import past_records as p
from engine.studio.past.trail import Trail
from engine.studio.requests import Handlers


class HereFinder(Owned):
    """Finds the strokes that show at a place.  It belongs to the engine's thread."""

    def __init__(self, trail: Trail) -> None:
        self._trail = trail
        self._session, self._finder = trail.session, PaintedHere(trail.session.cache)
        self.handlers: Handlers = {p.AskHere: self._find}

    def _find(self, request: p.AskHere) -> None:
        trail = self._trail
        if trail.easel.live is not None:
            trail.easel.finish()
        trail.follow()
        if self._session is not trail.session:
            self._session, self._finder = trail.session, PaintedHere(trail.session.cache)
        place, session = CanvasPixel(request.level, request.x, request.y), self._session
        found = self._finder.at(place, session.painting, session.steps)
        trail.easel.send(p.Here((place.level, place.x, place.y), tuple(map(self._told, found))))

    def _told(self, shown: ShownStroke) -> p.HereStroke:
        stroke = shown.stroke
        seed = self._session.painting.seed if stroke.seed is None else stroke.seed
        return p.HereStroke(
            self._trail.row(shown.step), shown.layer, shown.share, seed, tuple(textures_of(stroke.brush))
        )
