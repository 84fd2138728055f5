"""What the window asks of a fill that it has not decided on, and what it is told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from engine.numeric.address import Rect
from engine.painting.layering.onto_member import ONTO_PAINT

if TYPE_CHECKING:
    from engine.brush.settings import Brush
    from engine.painting.commands import DefineTexture


@dataclass(frozen=True, slots=True)
class TryFill:
    """Shows what a brush would make of the active layer, as far as it is selected, in a rectangle of a level, and
    changes nothing; None: the painting as it is.  The newest counts.  `texture`: what the brush paints with, if no
    texture of the painting; then the next is shown once this one is in sight.  `onto`: as of a fill."""

    brush: Brush | None
    level: int = 0
    area: Rect | None = None
    texture: DefineTexture | None = None
    onto: str = ONTO_PAINT


@dataclass(frozen=True, slots=True)
class Tried:
    """The level at which the whole of the layer is best filled."""

    layer: str
    level: int
