"""Where else a layer is seen: through placements of it, of groups that hold it, and of what shows those in turn."""

from __future__ import annotations

from collections.abc import Iterator

from engine.canvas.layers import Group
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.through import UNPLACED, Seen
from engine.numeric.address import Rect

_MOST = 1000  # ways to look through that are gone; beyond, anything may show anything
_AROUND = 3  # pixels of a source beside one that its sampling reads


class Views:
    """The placements of a tree, without its paint."""

    def __init__(self, root: Group) -> None:
        self._root = root.id
        self._within: dict[int, tuple[int | Placement, ...]] = {}
        self.any = self._take(root)

    def _take(self, group: Group) -> bool:
        """Takes in a group; returns whether it holds a placement."""
        found = False
        self._within[group.id] = tuple(node if isinstance(node, Placement) else node.id for node in group.children)
        for node in group.children:
            if isinstance(node, Placement):
                self._within[node.id] = (node,)
            found |= isinstance(node, Placement) or (isinstance(node, Group) and self._take(node))
        return found

    def of(self, level: int, node: int | None = None) -> Iterator[tuple[int, Seen]] | None:
        """Returns layers and how each is seen at a level, besides where it lies itself; None if there are too many
        ways.  `node`: the id of the placement through which alone one looks."""
        found: list[tuple[int, Seen]] = []
        waiting: list[tuple[int, Seen]] = [(self._root if node is None else node, UNPLACED)]
        for _ in range(_MOST + len(self._within)):
            if not waiting:
                return iter(found)
            at, seen = waiting.pop()
            for inner in self._within[at]:
                if not isinstance(inner, Placement):
                    if inner in self._within:
                        waiting.append((inner, seen))
                    elif seen is not UNPLACED:
                        found.append((inner, seen))
                    continue
                through, source = seen.of(inner), self._root if inner.of is None else inner.of
                if through.vanishes(level):
                    continue
                if source in self._within:
                    waiting.append((source, through))
                else:
                    found.append((source, through))
        return None

    def shown(self, layer: int, at: int, rect: Rect, level: int) -> list[Rect] | None:
        """Returns where a rectangle of a layer at level `at` is seen at a level, besides where it is; None:
        anywhere."""
        ways = self.of(level)
        seen_by = None if ways is None else [seen for number, seen in ways if number == layer]
        if seen_by is None or any(seen.repeats for seen in seen_by):
            return None
        out = [mapped(rect, at, seen, level) for seen in seen_by]
        return [found for found in out if not found.empty]


def mapped(rect: Rect, at: int, seen: Seen, level: int) -> Rect:
    """Returns the pixels of a level that can see a rectangle of level `at` of a source."""
    return seen.meets(level, seen.similarity.shown(rect.grown(_AROUND), at, level).grown(1))
