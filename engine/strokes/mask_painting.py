"""Painting on a mask: what a brush does to a picture in greys, in which white shows and black hides."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from engine.brush.stamp import Edit, Stamp
from engine.canvas import layers
from engine.canvas.layers import Layer
from engine.canvas.selecting.mask_sheet import MaskSheet, sheet_of
from engine.numeric.address import Rect, TileKey
from engine.painting.layering.onto_member import ONTO_MASK
from engine.painting.value import Painting, Refusal, layer_for
from engine.texture.planes import COLOURS, Planes

_ALPHA = 3
_ONE = np.float32(1)
_WEIGHTS = np.float32(54 / 256), np.float32(183 / 256), np.float32(19 / 256)  # of red, green and blue in what is bright


def sheet_for(painting: Painting, name: str | None, onto: str, what: str = "stroke") -> tuple[Painting, Layer]:
    """Returns what a stroke, or `what` else, goes to: a layer, as `layer_for`, or `onto` a mask that one."""
    if onto != ONTO_MASK:
        return layer_for(painting, name, what)
    wanted = painting.active if name is None else name
    if wanted is None:
        raise Refusal(f"{what}: found no layer, expected one with a mask")
    if layers.is_locked(painting.root, wanted):
        raise Refusal(f"{what}: found layer {wanted!r} locked, expected one that is not")
    node = layers.find(painting.root, wanted)
    sheet = sheet_of(node)
    if node.mask is not None and node.mask.pose is not None:
        raise Refusal(f"{what}: found the mask of {wanted!r} turned or scaled with it, expected it laid anew")
    return painting, sheet


def insist_on_paint(sheet: Layer, what: str) -> None:
    """Refusal if it is a mask, on which nothing grows."""
    if isinstance(sheet, MaskSheet):
        raise Refusal(f"{what}: found the mask of {sheet.name!r}, expected a layer to grow an example on")


def greys_of(old: Planes, sheet: Layer) -> Planes:
    """Returns what a brush sees: the paint of a layer itself, a mask in greys."""
    if not isinstance(sheet, MaskSheet):
        return old
    alpha = old.data[_ALPHA]
    data = np.empty((COLOURS, *alpha.shape), np.float32)
    data[:_ALPHA] = _ONE - alpha if sheet.inverse else alpha
    data[_ALPHA] = _ONE
    return Planes(data)


def greys_read(read: Callable[[Rect], Planes], sheet: Layer) -> Callable[[Rect], Planes]:
    """Returns what reads the same as a brush sees it."""
    return (lambda rect: greys_of(read(rect), sheet)) if isinstance(sheet, MaskSheet) else read


def edit_of(edit: Edit, sheet: Layer) -> Edit:
    """Returns an edit as it changes a layer, itself, or a mask: its alpha by how bright the edit makes the greys."""
    return _OntoMask(edit, sheet) if isinstance(sheet, MaskSheet) else edit


@dataclass(frozen=True, eq=False)
class _OntoMask:
    """v' = A v + Y(B), v being how far a place shows, and Y how bright a colour is; where the mask is `inverse`, of
    1 - v.  Ink ends as pixels of the level."""

    edit: Edit
    sheet: MaskSheet
    spares_alpha: bool = False
    _made: dict[int, tuple[Stamp, Stamp]] = field(default_factory=dict, repr=False)

    @property
    def level(self) -> int:
        """As `Edit.level`."""
        return self.edit.level

    @property
    def tiles(self) -> Sequence[TileKey]:
        """As `Edit.tiles`."""
        return self.edit.tiles

    @property
    def rect(self) -> Rect:
        """As `Edit.rect`."""
        return self.edit.rect

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """As `Edit.stamp`."""
        found = self.edit.stamp(key, greys_of(old, self.sheet))
        if found is None:
            return None
        known = self._made.get(id(found))
        if known is None or known[0] is not found:
            known = self._made[id(found)] = found, self._changed(found)
        return known[1]

    def _changed(self, stamp: Stamp) -> Stamp:
        red, green, blue = (weight * plane for weight, plane in zip(_WEIGHTS, stamp.add[:_ALPHA], strict=True))
        bright = np.rint((red + green + blue) * np.float32(65536)) / np.float32(65536)
        add = np.zeros((COLOURS, *bright.shape), np.float32)
        add[_ALPHA] = _ONE - stamp.keep - bright if self.sheet.inverse else bright
        return Stamp(stamp.keep, add, plain=stamp.plain)
