"""The pictures of what placements show: small ones where there are many, which share what is looked up for them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from engine.archive.others.stack_entries import Bases, pictured_alone
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.composite_steps import Planned, Sources, steps
from engine.canvas.placing.placement import Placement
from engine.numeric.address import Rect
from engine.painting.rendering import Stop, keeping, strips


class PlacementPictures:
    """Those of a tree, at a `level`, within a `frame` of it; `bases`: what limits them."""

    def __init__(self, root: Group, bases: Bases, level: int, frame: Rect) -> None:
        self._root, self._bases, self._level, self._frame = root, bases, level, frame
        self._sources, self._elsewhere = Sources(root), keeping()

    def place(self, placement: Placement) -> Rect:
        """Returns the pixels of the picture of what a placement shows: those of the frame that it may lie on."""
        place = self._frame
        if placement.part is not None and not placement.repeat:
            part = placement.part
            place = place.intersect(placement.pose.similarity.shown(part.rect, part.level, self._level))
        if self._sources.shared is not None:
            last, inner = self._sources.end(placement)
            lies = self._sources.shared.lies(last.of, self._level, inner.of(last))
            place = place if lies is None else place.intersect(lies)
        return Rect.at(self._frame.x0, self._frame.y0, 1, 1) if place.empty else place

    def drawn(self, node: Layer | Placement, place: Rect, cancelled: Stop) -> Iterator[np.ndarray]:
        """Yields the picture of a node from the top, as `strips`."""
        alone = pictured_alone(node, self._bases, self._root)
        return strips(Planned(alone, steps(alone, self._sources)), self._level, place, cancelled, self._elsewhere)
