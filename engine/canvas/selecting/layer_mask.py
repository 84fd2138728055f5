"""A layer's mask as compositing reads it: at any level, and through whatever the layer is seen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from engine.canvas.layers import Layer, Node
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.through import UNPLACED, Seen, looked_through
from engine.canvas.selecting.mask_sheet import MaskSheet, mask_of, sheet_of
from engine.canvas.selecting.selection import Selection
from engine.numeric.address import Rect
from engine.numeric.similarity import since

ReadSheet = Callable[[Layer, int, Rect], "np.ndarray | None"]  # the pixels of a layer or of a mask's sheet
_ALPHA = 3
_ONE = np.float32(1)


@dataclass(frozen=True, slots=True)
class Mask:
    """How far each place of a node shows; `sheet`: what is read of it; `moved`: how that is seen where the node is."""

    selection: Selection
    sheet: MaskSheet = field(compare=False)
    moved: Seen = UNPLACED

    @classmethod
    def of(cls, node: Node) -> Mask | None:
        """Returns the mask of a node, if it has one that is not put aside."""
        mask = mask_of(node)
        return None if mask is None or mask.off else cls(mask, sheet_of(node), moved_of(node))

    @classmethod
    def told(cls, node: Node) -> Mask:
        """Returns the mask of a node that has one, also where that is put aside."""
        mask = mask_of(node)
        assert mask is not None
        return cls(mask, sheet_of(node), moved_of(node))

    def planes(self, read: ReadSheet, level: int, rect: Rect, seen: Seen) -> np.ndarray | None:
        """Returns its pixels, (4, h, w), of which the alpha counts, where the node is seen so; None: nothing shows."""
        pixels = looked_through(lambda at, part: read(self.sheet, at, part), level, rect, self.moved.through(seen))
        if not self.selection.inverse:
            return pixels
        out = np.ones((4, rect.height, rect.width), np.float32)
        if pixels is not None:
            out[_ALPHA] = _ONE - pixels[_ALPHA]
        return out


def moved_of(node: Node) -> Seen:
    """Returns how the mask of a node is seen where the node lies: as it is, unless it went along with a placement."""
    mask = mask_of(node)
    if mask is None or mask.pose is None or not isinstance(node, Placement):
        return UNPLACED
    return Seen(since(mask.pose.similarity, node.pose.similarity))
