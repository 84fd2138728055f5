"""A mask seen alone, in place of the painting."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.canvas.layers import Group, walk
from engine.canvas.placing.through import UNPLACED
from engine.canvas.reading import Read
from engine.canvas.selecting.layer_mask import Mask
from engine.canvas.selecting.mask_sheet import mask_of
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.painting.difference import Areas
from engine.studio import requests as q
from engine.studio.masked.greys import greys
from engine.studio.masked.mask_requests import ShowMask


class MaskAlone(Owned):
    """It belongs to the engine's thread.  `changed` is told that all of the picture is another one."""

    def __init__(self, changed: Callable[[Areas], None]) -> None:
        self._name: str | None = None
        self._changed = changed
        self.handlers: q.Handlers = {ShowMask: self._show}

    @property
    def shown(self) -> bool:
        """Tells whether one may be seen in place of the painting."""
        return self._name is not None

    def forget(self) -> None:
        """Shows the painting."""
        self._name = None

    def picture(self, root: Group, level: int, whole: Rect, read: Read) -> np.ndarray | None:
        """Returns the mask that is to be seen alone, in greys, float32 (4, h, w); None where none is."""
        if self._name is None:
            return None
        node = next((node for node in walk(root) if node.name == self._name), None)
        if node is None or mask_of(node) is None:
            return None
        return greys(Mask.told(node).planes(read, level, whole, UNPLACED), whole)

    def _show(self, request: ShowMask) -> None:
        if request.name != self._name:
            self._name = request.name
            self._changed(lambda level: None)
