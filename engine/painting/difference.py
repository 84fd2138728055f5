"""Where two paintings differ: found by comparing them, since what they share is the same object."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from engine.canvas import growth as growths
from engine.canvas.layers import Group, Layer
from engine.canvas.store import changed_rects
from engine.numeric.address import Rect
from engine.painting.value import Painting

Areas = Callable[[int], "list[Rect] | None"]


def areas(old: Painting, new: Painting) -> Areas:
    """Tells where two paintings differ, by level; None for anywhere."""
    pairs = _pairs(old.root, new.root)

    @cache  # it is asked for every tile on the screen
    def where(level: int) -> list[Rect] | None:
        if pairs is None:
            return None
        return [rect for a, b in pairs for rect in _changed(a, b, level)]

    return where


def _changed(old: Layer, new: Layer, level: int) -> list[Rect]:
    found = changed_rects(old.pyramid, new.pyramid, level)
    return found + growths.changed_rects(old.growth, new.growth, level) if old.growth is not new.growth else found


def _pairs(old: Group, new: Group) -> list[tuple[Layer, Layer]] | None:
    """Layers whose paint differs; None if the trees differ in anything else."""
    if old is new:
        return []
    if len(old.children) != len(new.children) or _plain(old) != _plain(new):
        return None
    out = []
    for a, b in zip(old.children, new.children, strict=True):
        if isinstance(a, Group) and isinstance(b, Group):
            inner = _pairs(a, b)
            if inner is None:
                return None
            out += inner
        elif isinstance(a, Layer) and isinstance(b, Layer) and _plain(a) == _plain(b):
            if a.pyramid is not b.pyramid and a.pyramid.uid != b.pyramid.uid:
                return None
            if a.pyramid is not b.pyramid or a.growth is not b.growth:
                out.append((a, b))
        else:
            return None
    return out


def _plain(node: Layer | Group) -> tuple[Any, ...]:
    """Returns what of a node shows, besides its paint."""
    return node.id, node.opacity, node.visible, node.blend, isinstance(node, Group) and node.isolated
