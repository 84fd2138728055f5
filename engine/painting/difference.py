"""Where two paintings differ: found by comparing them, since what they share is the same object."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any, NamedTuple

from engine.canvas import growth as growths
from engine.canvas.growth import Growth
from engine.canvas.heaps.heaps import NO_HEAP
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing import loops
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.through import Seen
from engine.canvas.placing.views import Views, mapped
from engine.canvas.selecting.mask_sheet import MaskSheet, sheet_of
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Change, changes_between
from engine.numeric.address import Rect
from engine.painting.value import Painting

Areas = Callable[[int], "list[Rect] | None"]


def areas(old: Painting, new: Painting) -> Areas:
    """Tells where two paintings differ, by level; None for anywhere."""
    pairs = _pairs(old.root, new.root)
    # Not the layers themselves: who asks for areas later does not want to hold the old painting until then.
    found = None if pairs is None else {b.id: _Changed.of(a, b) for a, b in pairs}
    views = Views(new.root)
    anywhere = any(b.wrap is not None or (views.any and _mask_elsewhere(new.root, b)) for _, b in pairs or ())

    @cache  # it is asked for every tile on the screen
    def where(level: int) -> list[Rect] | None:
        if found is None or anywhere:
            return None
        own = [rect for changed in found.values() for rect in changed.rects(level)]
        ways = views.of(level) if views.any else iter(())
        changed_ways = None if ways is None else [(found[layer], seen) for layer, seen in ways if layer in found]
        if changed_ways is None or any(seen.repeats for _, seen in changed_ways):
            return None
        return own + [rect for changed, seen in changed_ways for rect in changed.seen(seen, level)]

    return where


def _mask_elsewhere(root: Group, sheet: Layer) -> bool:
    return isinstance(sheet, MaskSheet) and loops.seen_elsewhere(root, sheet.name)


class _Changed(NamedTuple):
    """What two states of a layer do not share: commits, and what was painted with examples."""

    commits: tuple[Change, ...]
    old: Growth
    new: Growth

    @classmethod
    def of(cls, old: Layer, new: Layer) -> _Changed:
        """Compares two states of one line of history."""
        changes = [*changes_between(old.pyramid.last, new.pyramid.last)]
        if old.heaps is not new.heaps:
            for unit in {*old.heaps, *new.heaps}:
                before, after = (one.heaps.get(unit, NO_HEAP).last for one in (old, new))
                changes += changes_between(before, after)
        return cls(tuple(changes), old.growth, new.growth)

    def rects(self, level: int) -> list[Rect]:
        """Returns the rectangles of a level in which the states may differ."""
        found = [change.reach(level) for change in self.commits]
        return found + growths.changed_rects(self.old, self.new, level) if self.old is not self.new else found

    def seen(self, seen: Seen, level: int) -> list[Rect]:
        """Returns the rectangles of a level in which the states may differ where they are seen through placements."""
        at = level + seen.levels + (seen.finer(level) or 0)
        return [rect for changed in self.rects(at) if not (rect := mapped(changed, at, seen, level)).empty]


def _pairs(old: Group, new: Group) -> list[tuple[Layer, Layer]] | None:
    """Layers whose paint differs; None if the trees differ in anything else."""
    if old is new:
        return []
    if len(old.children) != len(new.children) or _plain(old) != _plain(new):
        return None
    out: list[tuple[Layer, Layer]] = []
    for a, b in zip(old.children, new.children, strict=True):
        if a.mask is not b.mask:
            if not _one_line(a.mask, b.mask):
                return None
            out.append((sheet_of(a), sheet_of(b)))
        if isinstance(a, Group) and isinstance(b, Group):
            inner = _pairs(a, b)
            if inner is None:
                return None
            out += inner
        elif isinstance(a, Layer) and isinstance(b, Layer) and _plain(a) == _plain(b):
            if a.pyramid is not b.pyramid and a.pyramid.uid != b.pyramid.uid:
                return None
            if any(heap.uid != b.heaps[unit].uid for unit, heap in a.heaps.items() if unit in b.heaps):
                return None
            if a.pyramid is not b.pyramid or a.growth is not b.growth or a.heaps is not b.heaps:
                out.append((a, b))
        elif not isinstance(a, Placement) or replace(a, mask=None) != replace(b, mask=None):
            return None
    return out


def _one_line(old: Selection | None, new: Selection | None) -> bool:
    """Tells whether two masks are states of one, which was painted on."""
    if old is None or new is None or (old.inverse, old.off, old.pose) != (new.inverse, new.off, new.pose):
        return False
    return old.pyramid.uid == new.pyramid.uid


def _plain(node: Node) -> tuple[Any, ...]:
    """Returns what of a node shows, besides its paint."""
    return (
        node.id,
        node.opacity,
        node.visible,
        node.blend,
        node.clip,
        isinstance(node, Layer) and node.wrap,
        isinstance(node, Group) and (node.isolated, node.paper),
    )
