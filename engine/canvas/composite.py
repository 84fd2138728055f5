"""The one path from layers to pixels: screen, export and thumbnails composite here.

The tree is flattened once to a list of steps; then each block of `BLOCK` x `BLOCK` pixels runs through all of them
while it stays in the processor's cache.  Blocks lie on the grid of tiles, so a reader that keeps tiles hands them out
without a copy.  A rectangle no larger than two tiles of the screen is one block, and is drawn where it is wanted.  A
block is read from the top layer down, and reading stops at a layer that hides all below it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from engine.canvas.layers import Group, Layer, passes_through
from engine.numeric import blend
from engine.numeric.address import TILE, Rect

BLOCK = TILE
AT_ONCE = 8 * BLOCK * BLOCK  # pixels of a rectangle up to which it is one block


class Read(Protocol):
    """The pixels of a layer: float32 (4, h, w), premultiplied, not necessarily clamped; None where it is empty."""

    def __call__(self, layer: Layer, level: int, rect: Rect) -> np.ndarray | None: ...


@dataclass(frozen=True, slots=True)
class CompositeStep:
    """One operation on the picture so far: its source is a layer, or the steps of an isolated group.

    `over`: the operator is src-over.
    """

    row: blend.Blend
    opacity: np.float32
    source: Layer | tuple[CompositeStep, ...]
    over: bool

    @property
    def may_cover(self) -> bool:
        """Tells whether the step hides what lies below wherever it is opaque."""
        return self.over and self.opacity == 1


# What a block needs of a step: its pixels, (4, n) read-only, None if empty, or a list to be composited first.
_Found = list[tuple[CompositeStep, "np.ndarray | _Found | None"]]


def steps(root: Group) -> tuple[CompositeStep, ...]:
    """Returns what to composite, bottom first: invisible nodes left out, groups that pass through dissolved."""
    out: list[CompositeStep] = []
    for node in root.children:
        row = blend.BLENDS[node.blend]
        if not node.visible or (node.opacity == 0 and not row.outside):
            continue
        if isinstance(node, Group) and passes_through(node):
            out.extend(steps(node))
            continue
        source = node if isinstance(node, Layer) else steps(node)
        if source or row.outside:
            out.append(CompositeStep(row, np.float32(node.opacity), source, row.name == "src-over"))
    return tuple(out)


def blocks(root: Group, level: int, rect: Rect, read: Read) -> Iterator[tuple[Rect, np.ndarray | None]]:
    """(place, pixels) of every block of `rect`, row by row; together they tile it.

    The pixels are float32 (4, h, w), premultiplied, clamped for display (0 <= alpha <= 1, 0 <= colour <= alpha), valid
    until the next block is asked for; None where the picture is empty.  A pixel's value does not depend on `rect`.
    """
    plan = steps(root)
    buffers: list[np.ndarray] = []
    for y0 in range(rect.y0 - rect.y0 % BLOCK, rect.y1, BLOCK):
        for x0 in range(rect.x0 - rect.x0 % BLOCK, rect.x1, BLOCK):
            place = Rect.at(x0, y0, BLOCK, BLOCK).intersect(rect)
            if place.empty:
                continue
            pixels = _draw(_gather(plan, level, place, read), place.area, buffers, 0)
            yield place, None if pixels is None else pixels.reshape(4, place.height, place.width)


def composite(root: Group, level: int, rect: Rect, read: Read, out: np.ndarray | None = None) -> np.ndarray:
    """Returns the picture of `rect`: float32 (4, h, w), premultiplied and clamped for display; in `out` where it is
    given."""
    if out is None:
        out = np.empty((4, rect.height, rect.width), np.float32)
    if 0 < rect.area <= AT_ONCE and out.flags.c_contiguous:
        if _draw(_gather(steps(root), level, rect, read), rect.area, [out.reshape(-1)], 0) is None:
            out[:] = 0
        return out
    for place, pixels in blocks(root, level, rect, read):
        rows, columns = place.slices(rect)
        out[:, rows, columns] = 0 if pixels is None else pixels
    return out


def _gather(plan: tuple[CompositeStep, ...], level: int, rect: Rect, read: Read) -> _Found:
    """Returns the sources that matter for a block, bottom first; read from the top down to the first that covers it
    all."""
    found: _Found = []
    for step in reversed(plan):
        source: np.ndarray | _Found | None
        if isinstance(step.source, tuple):
            source = _gather(step.source, level, rect, read) or None
        else:
            planes = read(step.source, level, rect)
            source = None if planes is None else blend.flat(planes)
        if source is None and not step.row.outside:
            continue
        found.append((step, source))
        if step.may_cover and isinstance(source, np.ndarray) and source[3, 0] >= 1 and blend.opaque(source):
            break
    found.reverse()
    return found


def _draw(found: _Found, n: int, buffers: list[np.ndarray], depth: int) -> np.ndarray | None:
    """Returns the sources composited onto nothing: (4, n) in the buffer of this depth; None if it stayed empty."""
    if depth == len(buffers):
        buffers.append(np.empty(4 * max(n, BLOCK * BLOCK), np.float32))
    target = buffers[depth][: 4 * n].reshape(4, n)
    empty, i = True, 0
    while i < len(found):
        if _pair_at(found, i):  # two plain layers in one pass over memory
            (lower, below), (upper, above) = found[i : i + 2]
            both = blend.place_pair if empty else blend.over_pair
            assert isinstance(below, np.ndarray)
            assert isinstance(above, np.ndarray)
            both(target, below, above, lower.opacity, upper.opacity)
            empty = False
            i += 2
            continue
        step, source = found[i]
        if isinstance(source, list):
            group = _draw(source, n, buffers, depth + 1)
            source = None if group is None else blend.flat(group)
        empty = _apply(step, source, target, empty)
        i += 1
    return None if empty else target


def _pair_at(found: _Found, i: int) -> bool:
    if i + 1 >= len(found) or not (found[i][0].over and found[i + 1][0].over):
        return False
    return isinstance(found[i][1], np.ndarray) and isinstance(found[i + 1][1], np.ndarray)


def _apply(step: CompositeStep, source: np.ndarray | None, target: np.ndarray, empty: bool) -> bool:
    """Returns one source onto the target, which holds nothing yet if `empty`; whether it is empty afterwards."""
    if source is None:
        return empty or step.row.outside
    if not empty:
        step.row.kernel(target, source, step.opacity)
        return False
    if step.row.alone:
        blend.place(target, source, step.opacity)
    return not step.row.alone
