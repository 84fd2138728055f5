"""What is selected, as the window knows it, and the shape that is being drawn."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from app.canvas.view import Place, View
from engine.numeric.address import Rect
from engine.studio.requests import Request
from engine.studio.selecting.ants_records import Ants, AskAnts

_GRAIN = 256  # px: the rectangle that is asked for begins and ends at multiples of these, so that it seldom changes


@dataclass(slots=True)
class SelectState:
    """`ants`: the rim, None before the engine told of it; `shape`: the corners of what is being drawn, `closed` where
    that is no line that still goes on; `amount`: pixels by which a selection is changed; `name`: to keep it under."""

    ants: Ants | None = None
    shape: list[Place] = field(default_factory=list)
    closed: bool = True
    amount: int = 8
    name: str = ""
    _asked: tuple[int, Rect] | None = None

    @property
    def selected(self) -> bool:
        """Tells whether anything in particular is selected."""
        return self.ants is not None and self.ants.selected

    @property
    def saved(self) -> tuple[str, ...]:
        """Gives the names of kept selections."""
        return self.ants.saved if self.ants is not None else ()

    def wants(self, post: Callable[[Request], None], view: View) -> None:
        """Asks for the rim in sight, when that is elsewhere than what was asked for."""
        level = view.shown_level
        x0, y0, x1, y1 = view.visible(level)
        area = Rect(x0 // _GRAIN * _GRAIN, y0 // _GRAIN * _GRAIN, -(-x1 // _GRAIN) * _GRAIN, -(-y1 // _GRAIN) * _GRAIN)
        if self._asked != (level, area):
            self._asked = level, area
            post(AskAnts(level, area))
