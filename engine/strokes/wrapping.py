"""Where a stroke on a layer that is repeated without end is laid: on the cell, over whose rim it comes in again."""

from __future__ import annotations

import numpy as np

from engine.brush.copies import Copies, Torus
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import Layer
from engine.canvas.placing.cells import repeated, whole_from
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting.value import Refusal
from engine.texture.planes import Planes

_SPARE = 8  # pixels beyond the rim, of the coarser of stroke and cell, that finer levels may read
_FURTHEST = 1 << 30  # px along a cell: beyond, nothing comes in on the other side


def wrapped(
    layer: Layer, level: int, origin: tuple[int, int], copies: Copies
) -> tuple[Copies | Torus, tuple[int, int]]:
    """Returns how the dabs of a stroke are laid again, and its origin, by whole periods in the cell.

    Refusal at levels at which the cell has no whole pixels.
    """
    cell = layer.wrap
    if cell is None:
        return copies, origin
    coarsest = whole_from(cell)
    if level < coarsest:
        raise Refusal(
            f"stroke: found level {level} on {layer.name!r}, which wraps around, expected {coarsest} or finer, where"
            " its tile has whole pixels: zoom in"
        )
    rect = cell.rect.zoomed(level - cell.level)
    x, y = rect.x0 + (origin[0] - rect.x0) % rect.width, rect.y0 + (origin[1] - rect.y0) % rect.height
    if max(rect.width, rect.height) > _FURTHEST:
        return copies, (x, y)
    spare = max(1, min(_SPARE << max(0, level - cell.level), rect.width // 2, rect.height // 2))
    corner = float(rect.x0 - x), float(rect.y0 - y)
    return Torus(copies, *corner, float(rect.width), float(rect.height), float(spare)), (x, y)


def around(layer: Layer, level: int, rect: Rect, cache: TileCache | None) -> Planes:
    """Returns a layer's own paint in a rectangle of a level; of one that wraps around, what lies beyond the rim of its
    cell is what lies within it at the other side, without its ink."""
    cell = layer.wrap
    if cell is None or level < whole_from(cell):
        return evaluate(layer.pyramid, level, rect, cache)
    whole = cell.rect.zoomed(level - cell.level)
    if whole.union(rect) == whole:
        return evaluate(layer.pyramid, level, rect, cache)

    def picture(at: int, part: Rect) -> np.ndarray:
        return evaluate(layer.pyramid, at, part, cache).rgba

    found = repeated(picture, cell)(level, rect)
    assert found is not None
    return Planes(found)
