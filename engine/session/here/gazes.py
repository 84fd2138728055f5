"""Where on its layers a pixel looks: through placements, wrapped around, and behind how much that hides them."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from engine.canvas.layers import Group, Layer, Node, stacks, walk
from engine.canvas.placing.cells import repeated
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import SourcePart
from engine.canvas.placing.sampling import weights_at
from engine.canvas.placing.through import UNPLACED, Seen, looked_through
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.layer_mask import Mask
from engine.canvas.tile_cache import TileCache
from engine.checks.roles import AS_HEIGHT
from engine.numeric.address import Rect
from engine.numeric.similarity import Similarity
from engine.session.merging import PLAIN_BLEND
from engine.texture.placed import oriented

LEAST_SHARE = 1.0 / 255.0  # of a pixel that is seen
_ALPHA = 3
_FINER = 4  # levels by which a gaze may become finer to lie on whole pixels
_MEAN = 16  # pixels along a cell whose mean stands for it where a pixel is larger
_DEEPEST = 24  # placements that are looked through, one in another


@dataclass(frozen=True, eq=False, slots=True)
class Gaze:
    """Pixels of a level, and by how much each counts: float32 (h, w)."""

    level: int
    rect: Rect
    weights: np.ndarray

    @classmethod
    def of(cls, level: int, rect: Rect) -> Gaze:
        """Returns a gaze at pixels that count alike, together 1."""
        return cls(level, rect, np.full((rect.height, rect.width), 1.0 / rect.area, np.float32))

    def finer(self, levels: int) -> Gaze:
        """Returns the same by pixels so many levels finer."""
        if not levels:
            return self
        side = 1 << levels
        weights = self.weights.repeat(side, axis=0).repeat(side, axis=1) / np.float32(side * side)
        return Gaze(self.level + levels, self.rect.zoomed(levels), weights)

    def through(self, seen: Seen) -> Gaze | None:
        """Returns the pixels of a source that are seen so; None where it is too small to be."""
        if seen is UNPLACED:
            return self
        if seen.ends(self.level):
            return None
        finer = seen.finer(self.level)
        if finer is None or finer > _FINER:
            y, x = np.unravel_index(int(self.weights.argmax()), self.weights.shape)
            level, rect, weights = weights_at(seen.similarity, self.level, self.rect.x0 + int(x), self.rect.y0 + int(y))
            return Gaze(level, rect, weights * self.weights.sum())
        here = self.finer(finer)
        level, rect = source_of(seen.similarity, here.level, here.rect)
        return Gaze(level, rect, oriented(here.weights, seen.similarity.inverse()))

    def within(self, part: SourcePart) -> list[Gaze]:
        """Returns where a cell that is repeated is looked at."""
        here = self.finer(min(max(0, part.whole_from - self.level), _FINER))
        if here.level < part.whole_from:  # pixels larger than the cell
            whole = part
            level, cell = whole.level, whole.rect
            while max(cell.width, cell.height) > _MEAN:
                level, cell = level - 1, cell.zoomed(-1)
            found = Gaze.of(level, cell)
            return [Gaze(level, cell, found.weights * self.weights.sum())]
        cell, rect = part.rect.zoomed(here.level - part.level), here.rect
        out = []
        for row in range((rect.y0 - cell.y0) // cell.height, (rect.y1 - 1 - cell.y0) // cell.height + 1):
            for column in range((rect.x0 - cell.x0) // cell.width, (rect.x1 - 1 - cell.x0) // cell.width + 1):
                right, down = column * cell.width, row * cell.height
                met = Rect(cell.x0 + right, cell.y0 + down, cell.x1 + right, cell.y1 + down).intersect(rect)
                source = Rect(met.x0 - right, met.y0 - down, met.x1 - right, met.y1 - down)
                out.append(Gaze(here.level, source, here.weights[met.slices(rect)]))
        return out


def source_of(similarity: Similarity, level: int, rect: Rect) -> tuple[int, Rect]:
    """Returns the pixels of a source, and their level, that are shown in a rectangle by quarter turns: as many, where
    the move is by parts of pixels the first of them."""
    assert similarity.quarter is not None
    levels, quarters = similarity.quarter
    found = similarity.inverse().shown(rect, level, level + levels)
    width, height = (rect.height, rect.width) if quarters % 2 else (rect.width, rect.height)
    return level + levels, Rect.at(found.x0, found.y0, width, height)


class SeenLayer(NamedTuple):
    """A layer that is looked at in some places, each by itself; `weight`: how much of it is seen, 0..1, behind what
    hides it; `alpha`: its own there."""

    layer: Layer
    gazes: list[Gaze]
    weight: float
    alpha: float


SeenLayers = Generator[SeenLayer, None, float]


class Sightline:
    """Finds the layers of a tree that are seen at a place, from the topmost on.  `cache`: of its tiles."""

    def __init__(self, root: Group, cache: TileCache | None) -> None:
        self._root, self._read = root, partial(layer_planes, cache=cache)

    def sights(self, gaze: Gaze) -> Iterator[SeenLayer]:
        """Yields them."""
        return self._nodes(self._root.children, gaze, UNPLACED, 1.0, 0)

    def _nodes(self, nodes: Sequence[Node], gaze: Gaze, seen: Seen, weight: float, depth: int) -> SeenLayers:
        """Yields those of some nodes, bottom first; returns their alpha together."""
        left = 1.0
        for base, clipped in reversed(stacks(nodes)):
            land = not isinstance(base, Group) and base.role == AS_HEIGHT  # beside the picture: nothing hides it
            behind = weight * (1.0 if land else left) * base.opacity
            if not base.visible or behind < LEAST_SHARE:
                continue
            if clipped:
                behind *= yield from self._clipped(base, clipped, gaze, seen, behind, depth)
            alpha = yield from self._node(base, gaze, seen, behind, depth)
            left *= 1.0 - base.opacity * alpha if base.blend == PLAIN_BLEND and not land else 1.0
        return 1.0 - left

    def _clipped(
        self, base: Node, clipped: Sequence[Node], gaze: Gaze, seen: Seen, weight: float, depth: int
    ) -> SeenLayers:
        """Yields those of what is clipped to a node; returns how much of that they leave to be seen."""
        left, within = 1.0, _returned(self._node(base, gaze, seen, 1.0, depth))
        for node in reversed(clipped):
            if node.visible:
                alpha = yield from self._node(node, gaze, seen, weight * within * left * node.opacity, depth)
                left *= 1.0 - node.opacity * alpha if node.blend == PLAIN_BLEND else 1.0
        return left

    def _node(self, node: Node, gaze: Gaze, seen: Seen, weight: float, depth: int) -> SeenLayers:
        """Yields those of a node; returns its alpha."""
        if weight < LEAST_SHARE:
            return 0.0
        mask = Mask.of(node)
        shown = 1.0 if mask is None else _mean(mask.planes(self._read, gaze.level, gaze.rect, seen), gaze)
        if isinstance(node, Placement):
            alpha = yield from self._placed(node, gaze, seen, weight * shown, depth)
            return alpha * shown
        if isinstance(node, Group):
            alpha = yield from self._nodes(node.children, gaze, seen, weight * shown, depth)
            return alpha * shown
        picture = repeated(partial(self._read, node), node.wrap)
        alpha = _mean(looked_through(picture, gaze.level, gaze.rect, seen), gaze)
        there = gaze.through(seen)
        if there is not None:
            gazes = [there] if node.wrap is None else there.within(node.wrap)
            yield SeenLayer(node, gazes, weight * shown * _unclipped(gaze, seen), alpha)
        return alpha * shown

    def _placed(self, node: Placement, gaze: Gaze, seen: Seen, weight: float, depth: int) -> SeenLayers:
        through = seen.of(node)
        if depth == _DEEPEST or through.vanishes(gaze.level):
            return 0.0
        source: Node = self._root if node.of is None else next(one for one in walk(self._root) if one.id == node.of)
        if not node.repeat or node.part is None:
            return (yield from self._node(source, gaze, through, weight, depth + 1))
        there, alpha = gaze.through(through), 0.0
        for one in [] if there is None else there.within(node.part):
            alpha += yield from self._node(source, one, UNPLACED, weight * _unclipped(gaze, through), depth + 1)
        return alpha


def _mean(planes: np.ndarray | None, gaze: Gaze) -> float:
    return 0.0 if planes is None else float((planes[_ALPHA] * gaze.weights).sum())


def _unclipped(gaze: Gaze, seen: Seen) -> float:
    """Returns how much of a gaze the clips leave."""
    if not seen.clips:
        return 1.0
    part = seen.meets(gaze.level, gaze.rect)
    if part.empty:
        return 0.0
    ones = np.ones((4, part.height, part.width), np.float32)
    return min(1.0, _mean(seen.clipped(ones, gaze.level, part, gaze.rect), gaze) / max(float(gaze.weights.sum()), 1e-9))


def _returned(sights: SeenLayers) -> float:
    """Goes through all of them; returns what they return."""
    try:
        while True:
            next(sights)
    except StopIteration as done:
        found: float = done.value
        return found
