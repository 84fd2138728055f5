"""Edits of mode "raster": pic += d tex f(pic, ...), the painter's raster-op (Lewis 1984, section 6.1).

With the stroke's coverage M' and the brush's textures mixed to t, 0..1, the weight is w = M' t.  An op either aims at a
colour T and makes c + w (T - c) of c, in straight, encoded colours (module `op_targets`), or lays or takes paint with
A = 1 - w (module `op_paint`).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from engine.brush import op_paint, op_targets, ops, tones
from engine.brush.covered import Looks
from engine.brush.ink import Ink, Texture
from engine.brush.mixture import ONES, mixture
from engine.brush.operand import Operand, Operating, plane
from engine.brush.settings import Brush
from engine.brush.stamp import Stamp
from engine.numeric.address import TileKey
from engine.numeric.formula import variables
from engine.texture.image import ImageSource
from engine.texture.planes import Planes


class Raster(Operating):
    """Changes what is there by the brush's op, through its textures."""

    @staticmethod
    def ink_of(brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int) -> Ink | None:
        """Returns the mixture of textures that the op takes, as `Covered.ink_of`."""
        return mixture(brush, textures, level, seed)

    @staticmethod
    def looks(brush: Brush, ink: Ink | None) -> Looks:
        """At what the op asks for."""
        op = ops.chosen(brush.op)
        whole = f"the operation {op.row.name}" if op.row is not None and op.row.whole else ""
        pressure = op.tree is not None and "pressure" in variables(op.tree)
        return Looks(pressure, op.parameters.get("layer"), whole)

    @property
    def spares_alpha(self) -> bool:
        """Tells whether alpha stays as it is: under alpha lock, and for ops that lay no paint."""
        return self.locked or self.op.row is None or not self.op.row.lays

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns A and B of a tile, as `Edit.stamp`; None where nothing changes."""
        covered = plane(self.coverage, key)
        if covered is None:
            return None
        texture = self.mixture.tile(key)
        weight, free = np.empty_like(ONES), np.empty_like(ONES)
        if not tones.weigh(covered, ONES if self.op.by_texture else texture, weight, free):
            return None
        at, row = Operand(key, old, covered, texture, weight, free), self.op.row
        if row is not None and row.lays:
            return op_paint.KERNELS[row.kernel](self, at)
        return op_targets.change(self, at)
