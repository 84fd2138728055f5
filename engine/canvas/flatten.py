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
    """A plot as an edit of the finest level at which its example has detail: A = 1 - alpha, B = colour."""

    plot: Plot
    spares_alpha: bool = False

    @property
    def level(self) -> int:
        """Gives the level at which the plot's pixels become paint: its finest."""
        return self.plot.finest

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
        return None if found is None else Stamp(_ONE - found[3], found)


def flattened(layer: Layer, cache: TileCache | None = None, threads: Executor | None = None) -> Layer:
    """Returns the layer with all that was painted with examples as paint, settled first if it is not.

    Plot by plot, the bottom one first, at the finest level at which its example has detail; there, with one plot or
    with several of that level, no pixel changes; on the coarse grid none by more than half a step of it.
    """
    pyramid = layer.pyramid
    for plot in growths.settled(layer.growth, threads):
        pyramid = commit(pyramid, PlotEdit(plot), cache)
    return replace(layer, pyramid=pyramid, growth=())
