"""Where a stroke on a layer that is repeated without end is laid: on the cell, over whose rim it comes in again."""

from __future__ import annotations

import numpy as np

from engine.brush.copies import Copies, Torus
from engine.brush.mask import Coverage
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import Layer
from engine.canvas.placing.cells import parts_by_cell, repeated
from engine.canvas.placing.pose import SourcePart
from engine.canvas.selecting.rims import tiled
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.torus_flood import with_repeats
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
    cell, rect = layer.wrap, cell_at(layer, level, "stroke")
    if cell is None or rect is None:
        return copies, origin
    x, y = rect.x0 + (origin[0] - rect.x0) % rect.width, rect.y0 + (origin[1] - rect.y0) % rect.height
    if max(rect.width, rect.height) > _FURTHEST:
        return copies, (x, y)
    spare = _spare(cell, level)
    corner = float(rect.x0 - x), float(rect.y0 - y)
    return Torus(copies, *corner, float(rect.width), float(rect.height), float(spare)), (x, y)


def cell_at(layer: Layer, level: int, what: str) -> Rect | None:
    """Returns the cell of a layer that wraps around, in pixels of a level; None of one that does not.  Refusal at
    levels at which it has no whole pixels."""
    cell = layer.wrap
    if cell is None:
        return None
    coarsest = cell.whole_from
    if level < coarsest:
        raise Refusal(
            f"{what}: found level {level} on {layer.name!r}, which wraps around, expected {coarsest} or finer, where"
            " its tile has whole pixels: zoom in"
        )
    return cell.rect.zoomed(level - cell.level)


def _spare(cell: SourcePart, level: int) -> int:
    rect = cell.rect.zoomed(level - cell.level)
    return max(1, min(_SPARE << max(0, level - cell.level), rect.width // 2, rect.height // 2))


def onto_torus(coverage: Coverage, layer: Layer, cell: Rect) -> Coverage:
    """Returns a coverage as it lies on a layer that wraps around: what is covered in any cell is covered in this one,
    and again where that is read beyond its rim."""
    assert layer.wrap is not None
    found = np.zeros((cell.height, cell.width), np.float32)
    for key, tile in coverage.tiles.items():
        for part, source in parts_by_cell(cell, key.rect.intersect(coverage.rect)):
            inside = tile[part.slices(key.rect)] if isinstance(tile, np.ndarray) else np.float32(tile)
            own = found[source.slices(cell)]
            np.maximum(own, inside, out=own)
    spare = _spare(layer.wrap, coverage.level)
    return tiled(coverage.level, cell.grown(spare), with_repeats(found, spare))


def around(layer: Layer, level: int, rect: Rect, cache: TileCache | None) -> Planes:
    """Returns a layer's own paint in a rectangle of a level; of one that wraps around, what lies beyond the rim of its
    cell is what lies within it at the other side, without its ink."""
    cell = layer.wrap
    if cell is None or level < cell.whole_from:
        return evaluate(layer.pyramid, level, rect, cache)
    whole = cell.rect.zoomed(level - cell.level)
    if whole.union(rect) == whole:
        return evaluate(layer.pyramid, level, rect, cache)

    def picture(at: int, part: Rect) -> np.ndarray:
        return evaluate(layer.pyramid, at, part, cache).rgba

    found = repeated(picture, cell)(level, rect)
    assert found is not None
    return Planes(found)
