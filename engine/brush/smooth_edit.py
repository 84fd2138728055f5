"""Edits of mode "smooth": A = 1 - M, B = M times the mean of what lies around, M being the stroke's coverage."""

from __future__ import annotations

import numpy as np

from engine.brush import coat
from engine.brush.covered import Covered
from engine.brush.stamp import Stamp
from engine.numeric.address import TILE, TileKey
from engine.texture.planes import COLOURS, Planes

_REACH_CAP = 32  # px: how far on each side a pass looks
_ALPHA = 3


class Smoothing(Covered):
    """Replaces what is there by its local mean at the stroke's level, and removes ink, and so all finer detail.

    The mean is over a window in proportion to the radius: two passes of a box that reaches a quarter of the radius,
    at most 32 px, to each side (Perlin & Velho 1995, section 6.1).
    """

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns A and B of a tile, as `Edit.stamp`; None where nothing changes."""
        assert self.read is not None
        keep = self.keep(key)
        if keep is None:
            return None
        reach = min(max(round(self.brush.radius / 4.0), 1), _REACH_CAP)
        around = self.read(key.rect.grown(2 * reach)).data[:COLOURS]
        mean = coat.local_mean(np.ascontiguousarray(around), reach)
        add = np.empty((COLOURS, TILE, TILE), np.float32)
        if self.locked:
            np.divide(mean[:_ALPHA], mean[_ALPHA], out=mean[:_ALPHA], where=mean[_ALPHA] > 0.0)
        weight = coat.weigh(keep, old.data[_ALPHA], self.locked, add[_ALPHA])
        coat.glaze(weight, mean[:_ALPHA], add[:_ALPHA])
        if not self.locked:
            coat.glaze(weight, mean[_ALPHA:], add[_ALPHA:])
        return Stamp(keep, add, plain=True)
