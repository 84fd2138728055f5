"""What is selected, as the window knows it, and the shape that is being drawn."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

from app.canvas.view import Place, View
from app.desk.colours import RGB
from engine.numeric.address import Rect
from engine.numeric.similarity import Similarity
from engine.painting.select_commands import Select, Whole
from engine.studio.requests import Do, Request
from engine.studio.selecting.ants_records import Ants, AskAnts
from engine.studio.selecting.tint_records import AskTint, Tint

_GRAIN = 8  # the rectangle that is asked for begins and ends at multiples of 2^8 px, so that it seldom changes


class CopiedHere(NamedTuple):
    """What was copied last, which the painting of the number `serial` holds; `mark`: the line on the system's clipboard
    that stands for it."""

    serial: int
    mark: str


@dataclass(slots=True)
class SelectState:
    """`ants`: the rim, None before the engine told of it; `shape`: the corners of what is being drawn, `closed` where
    that is no line that still goes on; `amount`: pixels by which a selection is changed, `change`: how; `copied`: what
    was copied here, None before; `carried`: by what the rim is seen elsewhere, until the engine tells of it there;
    `masking`: what strokes paint is the selection, seen as a tint of `mask_colour`, 0..1, `mask_part` of it; `tint`:
    where that lies, None before the engine told of it."""

    ants: Ants | None = None
    shape: list[Place] = field(default_factory=list)
    closed: bool = True
    amount: int = 8
    change: str = "grow"
    copied: CopiedHere | None = None
    carried: Similarity | None = None
    masking: bool = False
    mask_colour: RGB = (1.0, 0.0, 0.0)
    mask_part: float = 0.5
    tint: Tint | None = None
    _tinted: tuple[int, Rect] | None = None
    _asked: tuple[int, Rect] | None = None
    _awaited: bool | None = None  # whether something will be selected, until the engine tells so

    @property
    def selected(self) -> bool:
        """Tells whether anything in particular is selected, or will be by what was asked for last."""
        if self._awaited is not None:
            return self._awaited
        return self.ants is not None and self.ants.selected

    @property
    def saved(self) -> tuple[str, ...]:
        """Gives the names of kept selections."""
        return self.ants.saved if self.ants is not None else ()

    def choose(self, post: Callable[[Request], None], command: Select) -> None:
        """Selects; what the next key press may do follows from it at once."""
        self._awaited = command.source != Whole("none")
        post(Do(command))

    def hear(self, ants: Ants) -> None:
        """Takes over what the engine tells."""
        self.ants, self.carried = ants, None
        if self._awaited == ants.selected:
            self._awaited = None

    def wants(self, post: Callable[[Request], None], view: View, by: Similarity | None = None) -> None:
        """Asks for the rim in sight, and for the mask, when they are elsewhere than what was asked for.  `by`: through
        which the rim is seen while what is selected floats: what comes into sight so may lie outside it."""
        level = view.shown_level
        area = _grained(view.visible(level))
        at = level if by is None else level + by.like_levels
        sought = at, area if by is None else _grained(by.box(area, level, at, 1))
        if self._asked != sought:
            self._asked = sought
            post(AskAnts(*sought))
        masked = (level, area) if self.masking else None
        if self._tinted != masked:
            self._tinted = masked
            post(AskTint(level, area if self.masking else None))
            self.tint = self.tint if self.masking else None


def _grained(rect: Rect) -> Rect:
    """Returns a rectangle that holds one and seldom changes with it."""
    return rect.zoomed(-_GRAIN).zoomed(_GRAIN)
