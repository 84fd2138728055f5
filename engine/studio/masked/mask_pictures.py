"""Small pictures of masks for the panel of layers, made anew when a mask is another one."""

from __future__ import annotations

from functools import partial

import numpy as np

from engine.canvas import layers
from engine.canvas.layers import Node
from engine.canvas.placing.through import UNPLACED
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.layer_mask import Mask
from engine.canvas.selecting.mask_sheet import mask_of
from engine.canvas.selecting.selection import Selection
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.studio import requests as q
from engine.studio import results
from engine.studio.easel import Easel
from engine.studio.masked.greys import greys
from engine.studio.masked.mask_requests import picture_name
from engine.studio.stack.small_frame import small_frame


class MaskPictures(Owned):
    """It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._told: dict[str, tuple[Selection, Rect]] = {}
        self._root: object = None
        self._open: list[Node] = []
        self.handlers: q.Handlers = {}

    @property
    def pending(self) -> int:
        """Returns how many are to be made."""
        painting = self._easel.session.painting
        if painting.root is not self._root:
            self._root, frame = painting.root, painting.frame
            masked = [(node, mask) for node in layers.walk(painting.root) if (mask := mask_of(node)) is not None]
            self._told = {node.name: self._told[node.name] for node, _ in masked if node.name in self._told}
            self._open = [node for node, mask in masked if self._told.get(node.name) != (mask, frame)]
        return len(self._open)

    def step(self) -> None:
        """Makes the next."""
        node, frame = self._open.pop(), self._easel.session.painting.frame
        mask = mask_of(node)
        assert mask is not None
        self._told[node.name] = mask, frame
        level, area = small_frame(frame)
        read = partial(layer_planes, cache=self._easel.session.cache)
        shown = greys(Mask.told(node).planes(read, level, area, UNPLACED), area)
        pixels = np.full((area.height, area.width, 4), 255, np.uint8)
        pixels[..., :3] = np.rint(np.clip(shown[0], 0, 1) * 255)[..., None]
        self._easel.send(results.Picture(picture_name(node.name), results.frozen(pixels)))
