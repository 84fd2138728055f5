"""What a stroke does to the heights that lie beside the paint of its layer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from engine.brush import edits
from engine.brush.covered import Covered, Read
from engine.brush.ink import Ink
from engine.brush.mask import Coverage
from engine.brush.modes import HEAPS_UP
from engine.brush.settings import Brush
from engine.brush.stamp import Stamp
from engine.canvas.heaps import heaping
from engine.canvas.layers import Layer
from engine.canvas.selecting.mask_sheet import MaskSheet
from engine.canvas.tile_cache import TileCache
from engine.checks.roles import AS_HEIGHT
from engine.numeric.address import Rect, TileKey
from engine.texture.planes import Planes

NO_EDITS: heaping.Edits = {}
_EMPTY = Rect(0, 0, 0, 0)


@dataclass(frozen=True, slots=True)
class HeapPlan:
    """`laid`: the height that the stroke lays, in pixels of its level; None: it changes what lies there.  `only`: its
    paint goes nowhere."""

    laid: float | None
    only: bool

    def edits(
        self, layer: Layer, brush: Brush, coverage: Coverage, ink: Ink | None, cache: TileCache | None
    ) -> heaping.Edits:
        """Returns the edits of the layer's heaps by a stroke that covers so much."""
        made = edits.class_of(brush.mode)
        rough = ink if self.only else None

        def edit(read: Read) -> Covered:
            return made(coverage, brush, None, False, read)

        return heaping.edits_of(layer.heaps, coverage.level, self.laid, edit, rough, cache)


def heap_plan(brush: Brush, layer: Layer) -> HeapPlan | None:
    """Returns what strokes of a brush do to the heaps of a layer; None for nothing."""
    does = brush.row.heaps
    if not does or isinstance(layer, MaskSheet):
        return None
    only = layer.role == AS_HEIGHT and brush.height is not None
    if does == HEAPS_UP:
        laid = brush.heaps if only else None if layer.role == AS_HEIGHT else brush.impasto or None
        return None if laid is None else HeapPlan(laid, only)
    return HeapPlan(None, only) if only or layer.heaps else None


@dataclass(frozen=True, slots=True)
class Untouched:
    """The edit of a level that changes nothing."""

    level: int
    tiles: Sequence[TileKey] = ()
    rect: Rect = _EMPTY
    spares_alpha: bool = False

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """As `Edit.stamp`."""
        return None
