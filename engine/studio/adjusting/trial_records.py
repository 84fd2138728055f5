"""What the window asks of a fill that it has not decided on, and what it is told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from engine.numeric.address import Rect

if TYPE_CHECKING:
    from engine.brush.settings import Brush


@dataclass(frozen=True, slots=True)
class TryFill:
    """Shows what a brush would make of the active layer, as far as it is selected, in a rectangle of a level, and
    changes nothing; None: the painting as it is.  The newest counts."""

    brush: Brush | None
    level: int = 0
    area: Rect | None = None


@dataclass(frozen=True, slots=True)
class Tried:
    """The level at which the whole of the layer is best filled."""

    layer: str
    level: int
