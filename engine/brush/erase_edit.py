"""Edits of mode "erase": A = 1 - M, B = 0, M being the stroke's coverage on the grid."""

from __future__ import annotations

import numpy as np

from engine.brush.covered import Covered
from engine.brush.stamp import Stamp
from engine.numeric.address import TILE, TileKey
from engine.texture.planes import COLOURS, Planes

_NOTHING = np.zeros((COLOURS, TILE, TILE), np.float32)


class Erasing(Covered):
    """Takes away colour, alpha, ink and all finer detail.  Under alpha lock there is nothing it may take."""

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns A and B of a tile, as `Edit.stamp`; None where nothing changes."""
        keep = None if self.locked else self.keep(key)
        return None if keep is None else Stamp(keep, _NOTHING, plain=True)
