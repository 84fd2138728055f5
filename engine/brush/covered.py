"""What all edits of strokes share: where the stroke covers, and with what."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from engine.brush.ink import Ink
from engine.brush.mask import Coverage
from engine.brush.settings import Brush
from engine.numeric.address import Rect, TileKey
from engine.texture.planes import Planes

Read = Callable[[Rect], Planes]  # the old values of a rectangle of the stroke's level


@dataclass(frozen=True, eq=False)
class Covered:
    """An edit of the tiles that a stroke covers.  `locked`: under alpha lock."""

    coverage: Coverage
    brush: Brush
    ink: Ink | None
    locked: bool
    read: Read | None

    @property
    def level(self) -> int:
        return self.coverage.level

    @property
    def tiles(self) -> tuple[TileKey, ...]:
        return self.coverage.keys

    @property
    def rect(self) -> Rect:
        return self.coverage.rect
