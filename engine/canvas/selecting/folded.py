"""What is selected as a layer that is repeated without end meets it: in any of its cells, as on a torus in all."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import reduce

import numpy as np

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.placing.cells import parts_by_cell
from engine.canvas.placing.filled import filled_levels
from engine.canvas.placing.pose import SourcePart
from engine.canvas.selecting.selection import Selection
from engine.canvas.tile_cache import TileCache
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect, TileKey

MOST_CELLS = 1 << 10  # that a selection reaches over
_FEW = 64  # tiles by which it is told where that lies
_CACHE = 16 << 20
_ALPHA = 3


@dataclass(frozen=True, eq=False, slots=True)
class Folded:
    """A selection on a layer whose cell is `wrap`: of one that is `inverse`, what is not selected in any cell is not in
    all.  Where the cell has no whole pixels, and in such cells beyond the selection, it is as it lies."""

    selection: Selection
    wrap: SourcePart
    _bounds: dict[int, Rect] = field(default_factory=dict, repr=False)

    def part(self, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray | float:
        """As `Selection.part`.  FieldError if what is selected reaches over too many cells."""
        own = self.selection
        bounds = self._bounds.get(level)
        if bounds is None:
            bounds = self._bounds[level] = _reach(own, level)
        if level < self.wrap.whole_from or bounds.empty:
            return own.part(level, rect, cache)
        cell = self.wrap.rect.zoomed(level - self.wrap.level)
        across = (bounds.x0 - cell.x0) // cell.width, -((cell.x0 - bounds.x1) // cell.width)
        down = (bounds.y0 - cell.y0) // cell.height, -((cell.y0 - bounds.y1) // cell.height)
        count = (across[1] - across[0]) * (down[1] - down[0])
        if count > MOST_CELLS:
            raise FieldError("selection", f"one over {count} tiles of the layer", f"at most {MOST_CELLS}")
        out = np.full((rect.height, rect.width), float(own.inverse), np.float32)
        for here, source in parts_by_cell(cell, rect):
            inside = out[here.slices(rect)]
            for row in range(*down):
                for column in range(*across):
                    x, y = column * cell.width, row * cell.height
                    there = Rect(source.x0 + x, source.y0 + y, source.x1 + x, source.y1 + y)
                    if not there.intersect(bounds).empty:
                        (np.minimum if own.inverse else np.maximum)(inside, own.part(level, there, cache), out=inside)
        return float(out[0, 0]) if (out == out[0, 0]).all() else out

    def chosen(self, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray:
        """As `Selection.chosen`."""
        return np.broadcast_to(np.greater_equal(self.part(level, rect, cache), 0.5), (rect.height, rect.width)).copy()


def _reach(selection: Selection, level: int) -> Rect:
    """Returns pixels of a level outside which all is as it is far away, found at that level or a coarser one."""
    pyramid, cache = selection.pyramid, TileCache(_CACHE)
    found: dict[TileKey, Rect] = {}

    def filled(key: TileKey) -> bool:
        value = evaluate_sparse(pyramid, key.level, key.rect, cache)
        if value is None:
            return False
        (rows,), (columns,) = (value.data[_ALPHA].any(axis=axis).nonzero() for axis in (1, 0))
        if len(rows):
            x, y = key.rect.x0, key.rect.y0
            found[key] = Rect(x + int(columns[0]), y + int(rows[0]), x + int(columns[-1]) + 1, y + int(rows[-1]) + 1)
        return len(rows) > 0

    out, start = Rect(0, 0, 0, 0), pyramid.coarsest
    if start is None or start > level:
        return out
    for k, tiles in filled_levels(lambda k: pyramid.levels.get(k, ()), filled, start, level):
        inner = reduce(Rect.union, (found[key] for key in tiles), Rect(0, 0, 0, 0))
        out = inner if k == level or inner.empty else inner.grown(2).zoomed(level - k)
        if len(tiles) > _FEW:
            break
    return out
