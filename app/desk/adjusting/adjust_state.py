"""The adjustment that is looked at before it is done."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.painting.fill_command import Fill
from engine.studio.adjusting.trial_records import Tried, TryFill
from engine.studio.requests import Do, Request


@dataclass(slots=True)
class AdjustState:
    """`tried`: what is on the screen, None where that is the painting; `best`: at which level the layer is filled."""

    tried: TryFill | None = None
    best: Tried | None = None

    def look(self, post: Callable[[Request], None], brush: Brush, level: int, area: Rect) -> None:
        """Shows what a brush would make of the layer in sight."""
        wanted = TryFill(brush, level, area)
        if wanted != self.tried:
            self.tried = wanted
            post(wanted)

    def leave(self, post: Callable[[Request], None]) -> None:
        """Shows the painting as it is."""
        if self.tried is not None:
            self.tried = None
            post(TryFill(None))

    def done(self, post: Callable[[Request], None]) -> None:
        """Does what is on the screen to all of the layer, as far as it is selected."""
        if self.tried is not None and self.tried.brush is not None and self.best is not None:
            post(Do(Fill(self.tried.brush, level=self.best.level, whole=True)))
            self.tried = None
