"""The one path from layers to pixels: screen, export and thumbnails composite here.

The tree is flattened once to a list of steps; then each block of `BLOCK` x `BLOCK` pixels runs through all of them
while it stays in the processor's cache.  Blocks lie on the grid of tiles, so a reader that keeps tiles hands them out
without a copy.  A rectangle no larger than two tiles of the screen is one block, and is drawn where it is wanted.  A
block is read from the top layer down, and reading stops at a layer that hides all below it.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from functools import partial
from typing import cast

import numpy as np

from engine.canvas.layers import Group, Layer
from engine.canvas.merging.paper import Paper
from engine.canvas.placing import unrolled
from engine.canvas.placing.cells import repeated
from engine.canvas.placing.composite_steps import CompositeStep, Found, Leaf, Placed, Planned, Sources, steps_of
from engine.canvas.placing.drawn_copies import ABOVE_ALL, Above, Asking, Copies, Drawing
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.portions import Portions, Work, run_through
from engine.canvas.placing.self_copies import Tiles
from engine.canvas.placing.self_turns import Turns, turns_of
from engine.canvas.placing.through import UNPLACED, Seen, looked_coarser, looked_through, set_in
from engine.canvas.placing.unpainted import Unpainted
from engine.canvas.reading import Read
from engine.canvas.selecting.layer_mask import Mask
from engine.numeric import blend
from engine.numeric.address import TILE, Rect
from engine.numeric.atop import atop

BLOCK = TILE
AT_ONCE = 8 * BLOCK * BLOCK  # pixels of a rectangle up to which it is one block


def blocks(root: Group | Planned, level: int, rect: Rect, read: Read) -> Iterator[tuple[Rect, np.ndarray | None]]:
    """(place, pixels) of every block of `rect`, row by row; together they tile it.

    The pixels are float32 (4, h, w), premultiplied, clamped for display (0 <= alpha <= 1, 0 <= colour <= alpha), valid
    until the next block is asked for; None where the picture is empty.  A pixel's value does not depend on `rect`.
    """
    plan = steps_of(root)
    buffers: list[np.ndarray] = []
    for y0 in range(rect.y0 - rect.y0 % BLOCK, rect.y1, BLOCK):
        for x0 in range(rect.x0 - rect.x0 % BLOCK, rect.x1, BLOCK):
            place = Rect.at(x0, y0, BLOCK, BLOCK).intersect(rect)
            if place.empty:
                continue
            pixels = _draw(_gather(plan, level, place, read, UNPLACED), place.area, buffers, 0)
            yield place, None if pixels is None else pixels.reshape(4, place.height, place.width)


def composite(root: Group | Planned, level: int, rect: Rect, read: Read, out: np.ndarray | None = None) -> np.ndarray:
    """Returns the picture of `rect`: float32 (4, h, w), premultiplied and clamped for display; in `out` where it is
    given."""
    if out is None:
        out = np.empty((4, rect.height, rect.width), np.float32)
    if 0 < rect.area <= AT_ONCE and out.flags.c_contiguous:
        if _draw(_gather(steps_of(root), level, rect, read, UNPLACED), rect.area, [out.reshape(-1)], 0) is None:
            out[:] = 0
        return out
    for place, pixels in blocks(root, level, rect, read):
        out[:, *place.slices(rect)] = 0 if pixels is None else pixels
    return out


def _gather(plan: tuple[CompositeStep, ...], level: int, rect: Rect, read: Read, seen: Seen) -> Found:
    """Returns the sources that matter for a block.  `seen`: through which similarity all of them are."""
    asking, planes = _asking(plan), None
    try:
        while True:
            planes = _pixels(asking.send(planes)[0], level, rect, read, seen)
    except StopIteration as done:
        return cast("Found", done.value)


def _asking(plan: tuple[CompositeStep, ...], around: Above | None = ABOVE_ALL) -> Asking[Leaf, Found]:
    """Asks for the pixels of sources, from the top down to the first that covers all; returns what matters, bottom
    first.  `around`: what lies above the group that the plan is of, if it is known."""
    found: Found = []
    for step in reversed(plan):
        source: np.ndarray | Found | None
        above = None
        if around is not None and step.over:
            above = Above(around.share * float(step.opacity), (*around.found, found))
        if isinstance(step.source, tuple):
            source = (yield from _asking(step.source, above)) or None
        else:
            planes = yield step.source, above
            source = None if planes is None else blend.flat(planes)
        if source is None and not step.row.outside:
            continue
        if source is None and isinstance(step.source, Mask):
            return []  # nothing of the node shows
        found.append((step, source))
        if _covers(step, source):
            break
    found.reverse()
    return found


def _tiles_of(sources: Sources, layers: Read, loop: Copies) -> Tiles[Leaf, Found]:
    """Returns the tiles of nodes that hold copies of one another."""
    unpainted = Unpainted()

    def copy(source: Leaf) -> Placement | None:
        return source.placement if isinstance(source, Placed) and source.of in loop else None

    def read(source: Leaf, level: int, rect: Rect, seen: Seen) -> np.ndarray | None:
        with _all_of_it(sources):  # it is kept
            return found(source, level, rect, seen)

    def found(source: Leaf, level: int, rect: Rect, seen: Seen) -> np.ndarray | None:
        paint, there = (source.sheet, source.moved.through(seen)) if isinstance(source, Mask) else (source, seen)
        if not isinstance(paint, Layer) or (paint, level, rect, there) not in unpainted:
            return _pixels(source, level, rect, layers, seen)
        return _pixels(source, level, rect, _nothing, seen) if isinstance(source, Mask) else None

    return Tiles(loop, Drawing(lambda of: _asking(sources.steps(of)), copy, read, _drawn), sources.portions)


def _all_of_it(sources: Sources) -> AbstractContextManager[None]:
    """Makes no portions of what is asked for meanwhile."""
    return nullcontext() if sources.portions is None else sources.portions.all_of_it()


def _nothing(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
    """Reads layers in which nothing lies."""
    del layer, level, rect
    return None


def _covers(step: CompositeStep, source: np.ndarray | Found | None) -> bool:
    """Tells whether a step hides all that lies below: by opaque pixels, or by such behind a mask that hides nothing."""
    if not step.may_cover:
        return False
    if not isinstance(source, list):
        return source is not None and bool(source[3, 0] >= 1) and blend.opaque(source)
    if len(source) != 2 or not source[1][0].cuts or not _covers(*source[0]):
        return False
    mask = source[1][1]
    return isinstance(mask, np.ndarray) and bool(mask[3, 0] == 1) and bool((mask[3] == 1).all())


def _pixels(source: Leaf, level: int, rect: Rect, read: Read, seen: Seen) -> np.ndarray | None:
    """Returns the pixels of a layer, or what a placement shows, through a similarity: (4, h, w), None if empty."""
    if isinstance(source, Paper):
        return source.planes(rect)
    if isinstance(source, Mask):
        return source.planes(read, level, rect, seen)
    if isinstance(source, Layer):
        return looked_through(repeated(partial(read, source), source.wrap), level, rect, seen)
    if seen.similarity.quarter is not None:  # exact placements in one another are one
        last, inner = source.sources.end(source.placement)
        source, seen = Placed(last, source.sources), inner.through(seen)
    sources, of, through = source.sources, source.of, seen.of(source.placement)
    tiles = sources.tiles(of, partial(_tiles_of, sources, read))
    if tiles is not None:
        return looked_coarser(tiles.of(of), level, rect, through)
    if sources.is_own(source.placement):
        return _turns(source, level, rect, read, seen)
    lies = None if sources.shared is None else sources.shared.lies(of, level, through)
    if lies is None:
        return _through(source, level, rect, read, through)
    part = lies.intersect(rect)
    pixels = None if part.empty else _through(source, level, part, read, through)
    return None if pixels is None else set_in(pixels, part, rect)


def _through(source: Placed, level: int, rect: Rect, read: Read, through: Seen) -> np.ndarray | None:
    """Returns what a placement shows that does not show itself: (4, h, w), None if empty."""
    sources, of, plan = source.sources, source.of, source.steps
    if not source.placement.repeat and not through.whole(level) and sources.turns(of):
        # What is turned in it is not sampled twice, but once, through both similarities.
        part = Rect(0, 0, 0, 0) if through.ends(level) else through.meets(level, rect)
        pixels = None if part.empty else _picture(plan, level, part, read, through.unclipped)
        return None if pixels is None else through.clipped(pixels, level, part, rect)

    def picture(at: int, part: Rect) -> np.ndarray | None:
        return _picture(plan, at, part, read, UNPLACED)

    def whole(at: int, part: Rect) -> np.ndarray | None:
        with _all_of_it(sources):
            return picture(at, part)

    cell = source.placement.part if source.placement.repeat else None
    shown = sources.shared.kept(of, whole) if sources.shared is not None and sources.shared.keeps(of) else picture
    return looked_through(repeated(shown, cell), level, rect, through)


def _turns(source: Placed, level: int, rect: Rect, read: Read, outer: Seen) -> np.ndarray | None:
    """As `_pixels`, of a placement that lies in what it shows: turn by turn, each read straight through all of them.

    What lies above it is read inwards, what lies below outwards, from the innermost turn on that holds all of the
    rectangle, until less than 2^-12 of a pixel is left to be seen.
    """
    part = outer.meets(level, rect)
    if part.empty:
        return None
    turns, plan = turns_of(source.placement, outer.unclipped), source.sources.opened(source.of)
    at = source.sources.own(source.of)
    assert at is not None
    own, below, above = plan[at], plan[:at], plan[at + 1 :]

    def drawn(plan: tuple[CompositeStep, ...], turn: int, shown: Rect) -> np.ndarray | None:
        reading = source.sources.sparing(read) if plan is above else read  # most of a turn shows through
        return _drawn(_gather(plan, level, shown, reading, turns[turn].unclipped), shown, False)

    def both(turn: int, shown: Rect, inner: np.ndarray | None) -> np.ndarray | None:
        under, over = (_gather(steps, level, shown, read, turns[turn].unclipped) for steps in (below, above))
        middle: Found = [] if inner is None else [(own, blend.flat(inner))]
        return _drawn([*under, *middle, *over], shown, False)

    plainly, portions = all(step.over for step in above), source.sources.portions
    about, mask = (source.placement, outer.unclipped, level, part), own.shown[1]
    if mask is not None:
        pixels = _by_now(portions, about, _cut_turns(source.sources, turns, (below, own, above), level, part, read))
    elif own.opacity != 1 or not plainly:
        share, first = own.opacity if plainly else np.float32(1), 0 if portions is None else portions.turns
        pixels = _by_now(portions, about, lambda: unrolled.all_turns(turns, level, part, both, share, first))
    else:

        def of(plan: tuple[CompositeStep, ...]) -> unrolled.Draw:
            return lambda turn, shown, _: drawn(plan, turn, shown)

        pixels = _by_now(portions, ("below", *about), lambda: unrolled.lying_below(turns, level, part, of(below)))
        if above:
            layers = _resting(source.sources, above)
            work = partial(unrolled.lying_above, turns, layers, level, part, of(above), source.sources.unpainted)
            pixels = unrolled.laid_over(_by_now(portions, ("above", *about), work), pixels)
    return None if pixels is None else outer.clipped(pixels, level, part, rect)


def _cut_turns(
    sources: Sources,
    turns: Turns,
    parts: tuple[tuple[CompositeStep, ...], CompositeStep, tuple[CompositeStep, ...]],
    level: int,
    rect: Rect,
    read: Read,
) -> Callable[[], Work]:
    """Returns what makes the turns of a placement with a mask, whose step lies between some others."""
    (below, own, above), portions = parts, sources.portions
    mask, plainly = own.shown[1], all(step.over for step in above)
    assert mask is not None

    def gathered(plan: tuple[CompositeStep, ...], turn: int, shown: Rect) -> Found:
        reading = sources.sparing(read) if plainly and plan is above else read  # most of a turn shows through
        return _gather(plan, level, shown, reading, turns[turn].unclipped)

    def under(turn: int, shown: Rect, inner: np.ndarray | None) -> np.ndarray | None:
        del inner
        return _drawn(gathered(below, turn, shown), shown, False)

    def around(turn: int, shown: Rect, inner: np.ndarray | None) -> np.ndarray | None:
        found = gathered(above, turn, shown)
        if plainly:
            return unrolled.laid_over(_drawn(found, shown, False), inner)
        middle: Found = [] if inner is None else [(replace(own, opacity=np.float32(1)), blend.flat(inner))]
        return _drawn([*middle, *found], shown, False)

    def left(turn: int, shown: Rect) -> np.ndarray:
        planes = _pixels(mask, level, shown, read, turns[turn].unclipped)
        alpha = np.zeros((shown.height, shown.width), np.float32) if planes is None else planes[3]
        return own.opacity * alpha

    first = _whole_turns(sources, turns, mask, above, level, rect) if plainly and own.opacity == 1 else 0
    few = 0 if portions is None else portions.turns
    return partial(unrolled.cut_turns, turns, level, rect, left, (under, around), first, few)


def _whole_turns(
    sources: Sources, turns: Turns, mask: Mask, above: tuple[CompositeStep, ...], level: int, rect: Rect
) -> int:
    """Returns how many turns, from the outermost on, hold a rectangle, are left whole by the mask on the next one, and
    have nothing above that."""
    first, layers = turns.holding(level, rect), _resting(sources, above)
    if layers is None or mask.sheet.id == sources.painted:
        return 0
    first = min(first, turns.whole(mask, level, rect))
    return min(first, turns.empty(layers, level, rect)) if layers and first else first


def _resting(sources: Sources, above: tuple[CompositeStep, ...]) -> list[Layer] | None:
    """Returns the layers of steps; None if other things are among them, or a stroke in progress lies on one."""
    found = unrolled.only_layers(step.source for step in above)
    return None if found is None or any(layer.id == sources.painted for layer in found) else found


def _by_now(portions: Portions | None, key: Hashable, begun: Callable[[], Work]) -> np.ndarray | None:
    return run_through(begun()) if portions is None else portions.shown(key, begun)


def _picture(plan: tuple[CompositeStep, ...], level: int, rect: Rect, read: Read, seen: Seen) -> np.ndarray | None:
    """Returns a source's picture: (4, h, w), its own where it is one layer, None where it is empty."""
    return _drawn(_gather(plan, level, rect, read, seen), rect, len(plan) == 1)


def _drawn(found: Found, rect: Rect, own: bool = True) -> np.ndarray | None:
    """Returns the sources composited onto nothing: (4, h, w), with `own` those of a single one; None: empty."""
    if own and len(found) == 1 and found[0][0].may_cover and isinstance(found[0][1], np.ndarray):
        return found[0][1].reshape(4, rect.height, rect.width)
    pixels = _draw(found, rect.area, [], 0)
    return None if pixels is None else pixels.reshape(4, rect.height, rect.width)


def _draw(found: Found, n: int, buffers: list[np.ndarray], depth: int) -> np.ndarray | None:
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


def _pair_at(found: Found, i: int) -> bool:
    if i + 1 >= len(found) or not (found[i][0].over and found[i + 1][0].over):
        return False
    return isinstance(found[i][1], np.ndarray) and isinstance(found[i + 1][1], np.ndarray)


def _apply(step: CompositeStep, source: np.ndarray | None, target: np.ndarray, empty: bool) -> bool:
    """Returns one source onto the target, which holds nothing yet if `empty`; whether it is empty afterwards."""
    if source is None:
        return empty or step.row.outside
    if step.atop:
        if not empty:
            atop(step.row, target, source, step.opacity)
        return empty
    if not empty:
        step.row.kernel(target, source, step.opacity)
        return False
    if step.row.alone:
        blend.place(target, source, step.opacity)
    return not step.row.alone
