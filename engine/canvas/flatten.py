"""What was painted with examples as ordinary paint, so that any stroke may go over it."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas import growth as growths
from engine.canvas.commit import commit
from engine.canvas.growth import Plot
from engine.canvas.layers import Layer
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey
from engine.texture.planes import Planes

_ONE = np.float32(1.0)


@dataclass(frozen=True, eq=False)
class PlotEdit:
    """A plot as an edit of one of its levels, the one whose pixels become paint: A = 1 - alpha, B = colour.  `whole`:
    of what was learnt alone, below pixels of the example's own that are wholly opaque there."""

    plot: Plot
    level: int
    whole: bool = False
    spares_alpha: bool = False

    @cached_property
    def rect(self) -> Rect:
        """Gives the pixels of that level that the plot takes, and maybe some around."""
        return growths.bounds((self.plot,), self.level)

    @cached_property
    def tiles(self) -> list[TileKey]:
        """Gives the tiles on which the plot has pixels."""
        growth = (self.plot,)
        return [key for key in self.rect.tiles(self.level) if growths.meets(growth, self.level, key.rect)]

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Lays the plot's pixels over what is there, as `Edit.stamp`."""
        found = growths.planes((self.plot,), key.level, key.rect)
        if found is None:
            return None
        if self.whole:
            found = found * _opaque(found[3], 1 << self.level - self.plot.own_finest)
        return Stamp(_ONE - found[3], found)


def _opaque(alpha: np.ndarray, side: int) -> np.ndarray:
    """Tells which squares of so many pixels of a tile are opaque all over: bool (h, w)."""
    rows, columns = alpha.shape
    squares = (alpha == _ONE).reshape(rows // side, side, columns // side, side).all(axis=(1, 3))
    out: np.ndarray = squares.repeat(side, axis=0).repeat(side, axis=1)
    return out


def flattened(layer: Layer, cache: TileCache | None = None, threads: Executor | None = None) -> Layer:
    """Returns the layer with all that was painted with examples as paint, settled first if it is not.

    Plot by plot, the bottom one first, at the finest level at which its example has detail; there, with one plot or
    with several of that level, no pixel changes; on the coarse grid none by more than half a step of it.  The outline
    of an opaque example with learnt detail is that of its own pixels, so that it is the same from farther away.
    """
    pyramid = layer.pyramid
    for plot in growths.settled(layer.growth, threads):
        level = plot.own_finest if plot.outlined else plot.finest
        pyramid = commit(pyramid, PlotEdit(plot, level), cache)
        if level < plot.finest:
            pyramid = commit(pyramid, PlotEdit(plot, plot.finest, whole=True), cache)
    return replace(layer, pyramid=pyramid, growth=())
