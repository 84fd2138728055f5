"""Places as the window knows them: where one has been, whether there is paint in sight, the map."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from app.desk.places.visited import Trail
from engine.numeric.address import Rect
from engine.studio.requests import Request, Seek
from engine.studio.results import PaintMap, Scene, Sought


@dataclass(slots=True)
class PlaceState:
    """`sought`: what is known of the paint in sight; `map`: where there is paint; `typed`: the text of the small field
    in which a place is typed, None while it is closed; `fault`: what is wrong with it."""

    trail: Trail = field(default_factory=Trail)
    sought: Sought | None = None
    map: PaintMap | None = None
    typed: str | None = None
    fault: str = ""
    _asked: tuple[int, Rect, Scene | None] | None = None
    _serial: int | None = None

    def seek(self, post: Callable[[Request], None], level: int, area: Rect, scene: Scene | None) -> None:
        """Asks whether there is paint in `area` of a level, when that or the painting has changed."""
        if scene is not None and scene.serial != self._serial:
            self._serial = scene.serial
            self.trail.forget()
        if self._asked is None or self._asked[:2] != (level, area) or self._asked[2] is not scene:
            self._asked = level, area, scene
            post(Seek(level, area))

    @property
    def lost(self) -> bool:
        """Tells whether there is no paint in sight, but elsewhere."""
        found, asked = self.sought, self._asked
        if found is None or asked is None or (found.level, found.area) != asked[:2]:
            return False
        return not found.in_sight and found.nearest is not None
