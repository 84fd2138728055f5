"""Small pictures of layers for the panel of layers, made anew when a layer is another one."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing.placement import Placement
from engine.canvas.reading import layer_planes
from engine.checks.owned import Owned
from engine.numeric.colour import to_premul8
from engine.painting.value import Painting
from engine.studio import requests as q
from engine.studio import results
from engine.studio.easel import Easel
from engine.studio.stack.small_frame import small_frame
from engine.studio.stack.stack_requests import layer_picture

_GREY = 120  # under what is not painted
_MANY = 16  # layers of a group: of more no picture is made, which would take too long at once
_Seen = tuple[object, ...]  # what a picture hangs on


class LayerPictures(Owned):
    """It belongs to the engine's thread.  What is painted is shown; masks, opacity and blend modes are not."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._told: dict[str, _Seen] = {}
        self._painting: Painting | None = None
        self._open: list[Node] = []
        self.handlers: q.Handlers = {}

    @property
    def pending(self) -> int:
        """Returns how many are to be made; none while the pen is down."""
        painting = self._easel.session.painting
        if self._easel.live is not None:
            return 0
        if painting is not self._painting:
            shown = {node.name: node for node in layers.walk(painting.root) if _is_shown(node)}
            self._told = {name: seen for name, seen in self._told.items() if name in shown}
            old = [node for name, node in shown.items() if not _same(self._told.get(name), _hangs_on(node, painting))]
            self._painting, self._open = painting, old
        return len(self._open)

    def step(self) -> None:
        """Makes the next, the top-most first."""
        node, painting = self._open.pop(), self._easel.session.painting
        self._told[node.name] = _hangs_on(node, painting)
        level, area = small_frame(painting.frame)
        plain = replace(node, mask=None)
        read = partial(layer_planes, cache=self._easel.session.cache)
        pixels = composite(layers.alone(plain, painting.root), level, area, read)
        self._easel.send(results.Picture(layer_picture(node.name), results.frozen(_on_grey(to_premul8(pixels)))))


def _on_grey(pixels: np.ndarray) -> np.ndarray:
    """Returns pixels, uint8 (h, w, 4), over a grey on which white, black and the colour of paper show, opaque."""
    out = pixels.copy()
    out[..., :3] += ((255 - pixels[..., 3:].astype(np.uint16)) * _GREY // 255).astype(np.uint8)
    out[..., 3] = 255
    return out


def _is_shown(node: Node) -> bool:
    """Tells whether a picture is made of a node: not of what may take long."""
    if isinstance(node, Group):
        inside = list(layers.walk(node))
        return len(inside) <= _MANY and not any(isinstance(one, Placement) for one in inside)
    return isinstance(node, Layer)


def _hangs_on(node: Node, painting: Painting) -> _Seen:
    """Returns the objects from which the picture of a node follows."""
    inside = layers.walk(node) if isinstance(node, Group) else (node,)
    seen = [part for one in inside for part in _parts(one, node)]
    return (painting.frame, *seen)


def _parts(node: Node, of: Node) -> tuple[object, ...]:
    own = (node.pyramid, node.growth, node.wrap) if isinstance(node, Layer) else ()
    return own if node is of else (*own, node.visible, node.opacity, node.blend, node.clip, node.mask)


def _same(one: _Seen | None, other: _Seen) -> bool:
    return one is not None and len(one) == len(other) and all(a is b or a == b for a, b in zip(one, other, strict=True))
