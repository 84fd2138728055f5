"""Placed things as pictures: of a rectangle of pixels, whatever else is looked at.

Those in front are drawn first, so that what they hide is not drawn at all.  Things smaller than a pixel or two fade
into what a crowd of them comes to (`measuring.as_crowd`).
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect
from engine.texture.expression.placing.centre_line import STRAIGHT_LINE, CentreLine
from engine.texture.expression.placing.crowds import (
    APART,
    FADED_AWAY,
    THINGS_TRIED,
    as_crowd,
    extent_of_thing,
    octave_of,
    part_seen,
    seen_box,
    some,
    thing_looks,
    usual_size,
)
from engine.texture.expression.placing.front_first import from_front, lay_behind, open_boxes
from engine.texture.expression.placing.homes import WHOLE_TEXTURE, Standing, UnitBox, all_about, in_row, scattered
from engine.texture.expression.placing.placed_things import CHILD, STROKE_TOLD, Thing
from engine.texture.expression.programs import Program, draw_program

_AT_ONCE = 1 << 15  # pixels that are drawn together
_KEPT = 64
_NOWHERE = Rect(0, 0, 0, 0)
_BESIDE = 1.5  # units about a stroke in which shows what goes by its line
_SIDE = 32  # pixels of a thing that is measured


class LineSight(NamedTuple):
    """`pixel`: its width in units; `origin`: the pixel where the units begin; `line`: the stroke's."""

    pixel: float
    origin: tuple[int, int]
    line: CentreLine

    def middles(self, first: int, last: int, axis: int) -> np.ndarray:
        """Returns where the middles of pixels lie, in units."""
        start = first - self.origin[axis]
        return (np.arange(start, start + last - first) + 0.5) * self.pixel


def scenery(made: Program, rect: Rect, sight: LineSight) -> np.ndarray:
    """Returns the pictures that the program of a whole texture takes: float64 (n, h side, w side)."""
    side = made.side
    out = np.zeros((max(1, len(made.takes)), rect.height * side, rect.width * side))
    whole, known = made.whole, dict[int, np.ndarray]()
    assert isinstance(whole, Thing)
    told = dict(zip(STROKE_TOLD.values(), _about(rect, sight, side), strict=True)) if _follows(made) else {}
    for plane, kind in zip(out, made.takes, strict=False):
        if kind >= CHILD:
            number, channel = divmod(kind - CHILD, 4)
            if number not in known:
                child = list(whole.children.values())[number]
                measure(child)
                known[number] = drawn_within(child, WHOLE_TEXTURE, rect, sight)
            plane[:] = known[number][channel].repeat(side, axis=0).repeat(side, axis=1)
        else:
            plane[:] = told[kind]
    return out


def _follows(made: Program) -> bool:
    return any(kind in STROKE_TOLD.values() for kind in made.takes)


def _about(rect: Rect, sight: LineSight, side: int) -> np.ndarray:
    fine = LineSight(sight.pixel / side, (sight.origin[0] * side, sight.origin[1] * side), sight.line)
    xs, ys = fine.middles(rect.x0 * side, rect.x1 * side, 0), fine.middles(rect.y0 * side, rect.y1 * side, 1)
    found = sight.line.about(np.tile(xs, ys.size), np.repeat(ys, xs.size))
    return found.reshape(4, ys.size, xs.size)


def drawn_within(thing: Thing, holder: Standing, rect: Rect, sight: LineSight) -> np.ndarray:
    """Returns the things within one holder, as a rectangle of pixels shows them: float32 (4, h, w)."""
    out = np.zeros((4, rect.height, rect.width), np.float32)
    box = extent_of_thing(thing)
    if box[2] > box[0]:
        standing = _standing(thing, holder, rect, sight)
        if standing.x.size:
            _lay_near(thing, standing, box, (rect, sight), out)
        _lay_far(thing, holder, rect, sight, out)
    return out


def bounds_of_line(made: Program, sight: LineSight) -> Rect:
    """Returns the pixels in which what a stroke laid may show: its things, and what goes by its line near that."""
    return changed_box(made, sight, None)


def changed_box(made: Program, sight: LineSight, before: LineSight | None) -> Rect:
    """Returns the pixels in which it may show otherwise than `before`, when the stroke was not as long."""
    whole = made.whole
    assert whole is None or isinstance(whole, Thing)
    found = _pixels(_near(sight.line, None if before is None else before.line), sight) if _follows(made) else _NOWHERE
    for child in () if whole is None else whole.children.values():
        measure(child)
        old = _apart(child, before, sight)
        for standing, others in ((_of_stroke(child, sight.line), old), (old, _of_stroke(child, sight.line))):
            found = found.union(_box_of_others(child, standing, others, sight))
    return found


def _apart(child: Thing, before: LineSight | None, sight: LineSight) -> Standing:
    return WHOLE_TEXTURE.of(slice(0, 0)) if before is None else _of_stroke(child, before.line)


def _box_of_others(child: Thing, standing: Standing, others: Standing, sight: LineSight) -> Rect:
    """Returns where things show that are not among others."""
    if not standing.x.size or extent_of_thing(child)[2] <= extent_of_thing(child)[0]:
        return _NOWHERE
    told = [
        set(zip(*(v.tolist() for v in (one.x, one.y, one.size, one.first)), strict=True)) for one in (standing, others)
    ]
    new = told[0] - told[1]
    rows = zip(*(v.tolist() for v in (standing.x, standing.y, standing.size, standing.first)), strict=True)
    which = np.array([row in new for row in rows])
    if not which.any():
        return _NOWHERE
    boxes = _boxes(standing.of(which), extent_of_thing(child), sight)
    low, high = boxes[:, :2].min(axis=0).tolist(), boxes[:, 2:].max(axis=0).tolist()
    return Rect(low[0], low[1], high[0], high[1])


def _near(line: CentreLine, before: CentreLine | None) -> UnitBox:
    """Returns the box of a line; of what is new of it, where it was there before."""
    same = 0
    if before is not None:
        a, b = line.told, before.told
        most = min(len(a), len(b)) // 3
        same = next((k for k in range(most) if a[3 * k : 3 * k + 3] != b[3 * k : 3 * k + 3]), most)
    left, top, right, bottom = CentreLine(line.told[3 * max(same - 2, 0) :]).box
    if before is not None and before.told[3 * max(same - 2, 0) :]:
        other = CentreLine(before.told[3 * max(same - 2, 0) :]).box
        left, top, right, bottom = (
            min(left, other[0]), min(top, other[1]), max(right, other[2]), max(bottom, other[3])
        )  # fmt: skip
    return left - _BESIDE, top - _BESIDE, right + _BESIDE, bottom + _BESIDE


def _pixels(box: UnitBox, sight: LineSight) -> Rect:
    low, high = ([int(np.floor(v / sight.pixel)) for v in pair] for pair in (box[:2], box[2:]))
    x, y = sight.origin
    return Rect(x + low[0] - 1, y + low[1] - 1, x + high[0] + 2, y + high[1] + 2)


# ---- one by one ------------------------------------------------------------------------------------------------------


def _standing(thing: Thing, holder: Standing, rect: Rect, sight: LineSight) -> Standing:
    """Returns the things that may be seen in a rectangle, the front ones first."""
    spec = thing.spec
    assert spec is not None
    if thing.deep == 1 and (spec.along or sight.line is not STRAIGHT_LINE):
        return _of_stroke(thing, sight.line)
    found = scattered(thing, holder, _within(thing, holder, rect, sight), sight.line)
    most = holder.size[0] * _reach(thing)
    found = replace(found, size=np.minimum(found.size, most))
    return found.of(from_front(found.depth, found.first))


@lru_cache(_KEPT)
def _of_stroke(thing: Thing, line: CentreLine) -> Standing:
    spec = thing.spec
    assert spec is not None
    found = in_row(thing, line) if spec.along else scattered(thing, WHOLE_TEXTURE, all_about(line), line)
    return found.of(from_front(found.depth, found.first))


def _within(thing: Thing, holder: Standing, rect: Rect, sight: LineSight) -> UnitBox:
    """Returns the box of a holder's places in which things may stand that reach into a rectangle."""
    xs = (np.array([rect.x0, rect.x1, rect.x0, rect.x1]) - sight.origin[0]) * sight.pixel - holder.x[0]
    ys = (np.array([rect.y0, rect.y0, rect.y1, rect.y1]) - sight.origin[1]) * sight.pixel - holder.y[0]
    cos, sin, size = holder.cos[0], holder.sin[0], holder.size[0]
    x, y = (cos * xs + sin * ys) / size, (cos * ys - sin * xs) / size
    reach = _reach(thing)
    left, top, right, bottom = x.min() - reach, y.min() - reach, x.max() + reach, y.max() + reach
    if holder is not WHOLE_TEXTURE:
        left, top, right, bottom = max(left, -1.0), max(top, -1.0), min(right, 1.0), min(bottom, 1.0)
    return left, top, right, bottom


def _reach(thing: Thing) -> float:
    """Returns how far things reach from where they stand, at most: larger ones are no larger than that."""
    return 2.0 if thing.deep == 1 else 1.5 * float(thing.measured[4])


def _lay_near(thing: Thing, standing: Standing, box: UnitBox, seen: tuple[Rect, LineSight], out: np.ndarray) -> None:
    rect, sight = seen
    pixels = standing.size * (max(box[2] - box[0], box[3] - box[1]) / sight.pixel)
    part = part_seen(pixels).astype(np.float32)
    boxes = _boxes(standing, box, sight)
    boxes[:, 0::2] = np.clip(boxes[:, 0::2], rect.x0, rect.x1) - rect.x0
    boxes[:, 1::2] = np.clip(boxes[:, 1::2], rect.y0, rect.y1) - rect.y0
    area = (boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])
    which = np.flatnonzero((area > 0) & (part > 0.0))
    first = 0
    while first < which.size:
        last = first + max(1, int(np.searchsorted(np.cumsum(area[which[first:]]), _AT_ONCE, side="right")))
        now = which[first:last]
        there = np.zeros(now.size, np.uint8)
        open_boxes(np.ascontiguousarray(boxes[now]), out, there)
        now = now[there > 0]
        if now.size:
            planes = _looks(thing, standing.of(now), boxes[now], seen)
            lay_behind(planes, np.ascontiguousarray(boxes[now]), part[now], out)
        first = last


def _boxes(standing: Standing, box: UnitBox, sight: LineSight) -> np.ndarray:
    """Returns the pixels in which things may show: int64 (n, 4), of first and last column and row."""
    left, top, right, bottom = box
    mx, my, hx, hy = 0.5 * (left + right), 0.5 * (top + bottom), 0.5 * (right - left), 0.5 * (bottom - top)
    cos, sin, size = standing.cos, standing.sin, standing.size
    x, y = standing.x + size * (cos * mx - sin * my), standing.y + size * (sin * mx + cos * my)
    wide = size * (np.abs(cos) * hx + np.abs(sin) * hy) / sight.pixel + 1.0
    high = size * (np.abs(sin) * hx + np.abs(cos) * hy) / sight.pixel + 1.0
    x, y = x / sight.pixel, y / sight.pixel
    found = np.stack([x - wide, y - high, x + wide + 1.0, y + high + 1.0], axis=1)
    start = np.array([*sight.origin, *sight.origin], np.int64)
    whole: np.ndarray = np.clip(np.floor(found), -(2.0**50), 2.0**50).astype(np.int64) + start
    return whole


def _looks(thing: Thing, standing: Standing, boxes: np.ndarray, seen: tuple[Rect, LineSight]) -> np.ndarray:
    """Returns what things look like in their boxes, one after another: float32 (4, n)."""
    wide = boxes[:, 2] - boxes[:, 0]
    counts = wide * (boxes[:, 3] - boxes[:, 1])
    starts = np.cumsum(counts) - counts
    octaves = _octaves(standing.size, seen[1].pixel)
    out = np.empty((4, int(counts.sum())), np.float32)
    for octave in sorted(set(octaves.tolist())):
        which = np.flatnonzero(octaves == octave)
        pixels = np.concatenate([np.arange(starts[k], starts[k] + counts[k]) for k in which])
        owner = np.repeat(which, counts[which])
        inner = pixels - starts[owner]
        columns, rows = boxes[owner, 0] + inner % wide[owner], boxes[owner, 1] + inner // wide[owner]
        out[:, pixels] = _looked_at(thing, standing, octave, (which, owner, columns, rows), seen)
    return out


def _octaves(sizes: np.ndarray, pixel: float) -> np.ndarray:
    return np.array([octave_of(pixel / size) for size in sizes.tolist()], np.int64)


def _looked_at(
    thing: Thing, standing: Standing, octave: int,
    where: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray], seen: tuple[Rect, LineSight],
) -> np.ndarray:  # fmt: skip
    """`where`: the things; of each pixel its thing, column and row."""
    (which, owner, columns, rows), (rect, sight) = where, seen
    start = rect.x0 - sight.origin[0], rect.y0 - sight.origin[1]
    dx = (columns + start[0] + 0.5) * sight.pixel - standing.x[owner]
    dy = (rows + start[1] + 0.5) * sight.pixel - standing.y[owner]
    cos, sin, size = standing.cos[owner], standing.sin[owner], standing.size[owner]
    place = (cos * dx + sin * dy) / size, (cos * dy - sin * dx) / size
    within: dict[int, np.ndarray] = {}
    for number, child in enumerate(thing.children.values()):
        if _is_near(child, standing, which, sight):
            parts = [_piece(child, standing.of(slice(k, k + 1)), (columns, rows, owner), k, seen) for k in which]
            planes = np.concatenate(parts, axis=1)
            within |= {CHILD + 4 * number + c: planes[c] for c in range(4)}
    ids = standing.first[owner], standing.second[owner]
    return thing_looks(thing, octave, place, ids, standing.outer[:, owner], within)


def _piece(
    child: Thing,
    holder: Standing,
    pixels: tuple[np.ndarray, np.ndarray, np.ndarray],
    k: int,
    seen: tuple[Rect, LineSight],
) -> np.ndarray:
    """Returns what is within one thing, over its box: (4, n)."""
    columns, rows, owner = pixels
    mine = owner == k
    x, y = columns[mine], rows[mine]
    rect, sight = seen
    place = Rect(rect.x0 + int(x[0]), rect.y0 + int(y[0]), rect.x0 + int(x[-1]) + 1, rect.y0 + int(y[-1]) + 1)
    return drawn_within(child, holder, place, sight).reshape(4, -1)


def _is_near(child: Thing, standing: Standing, which: np.ndarray, sight: LineSight) -> bool:
    """Tells whether some of what is within these is drawn one by one."""
    box = extent_of_thing(child)
    largest = float(standing.size[which].max()) * child.measured[4]
    return largest * max(box[2] - box[0], box[3] - box[1]) / sight.pixel > FADED_AWAY


def measure(thing: Thing) -> None:
    """Finds out how large a thing and those within it are, once."""
    if thing.measured:
        return
    for child in thing.children.values():
        measure(child)
    thing.measured = (-1.0, -1.0, 1.0, 1.0, 1.0)
    seen = np.zeros((_SIDE, _SIDE), np.float32)
    standing, half = some(thing), _SIDE // 2
    sight = LineSight(2.0 / _SIDE, (0, 0), STRAIGHT_LINE)
    for k in range(THINGS_TRIED):
        left = round(APART * k / sight.pixel) - half
        rect, one = Rect(left, -half, left + _SIDE, half), standing.of(slice(k, k + 1))
        boxes = np.array([[0, 0, _SIDE, _SIDE]], np.int64)
        seen = np.maximum(seen, _looks(thing, one, boxes, (rect, sight))[3].reshape(_SIDE, _SIDE))
    thing.measured = (*seen_box(seen), usual_size(thing))


# ---- as a crowd ------------------------------------------------------------------------------------------------------


def _lay_far(thing: Thing, holder: Standing, rect: Rect, sight: LineSight, out: np.ndarray) -> None:
    """Lays what is too small to be seen behind the rest."""
    spec = thing.spec
    assert spec is not None
    if spec.along:
        return
    xs, ys = sight.middles(rect.x0, rect.x1, 0) - holder.x[0], sight.middles(rect.y0, rect.y1, 1) - holder.y[0]
    dx, dy = np.tile(xs, ys.size), np.repeat(ys, xs.size)
    cos, sin, size = holder.cos[0], holder.sin[0], holder.size[0]
    place = (cos * dx + sin * dy) / size, (cos * dy - sin * dx) / size
    planes = as_crowd(thing, place, (holder.first, holder.second), holder.outer, sight.pixel / float(size), sight.line)
    if planes is not None:
        whole = np.array([[0, 0, rect.width, rect.height]], np.int64)
        lay_behind(planes.astype(np.float32), whole, np.ones(1, np.float32), out)


def drawn_plainly(made: Program, rect: Rect, period: Fraction) -> np.ndarray:
    """As `draw_program`; of a text that places things as if a stroke ran straight below the first period."""
    if made.whole is None:
        return draw_program(made, rect, period)
    return drawn_whole(made, rect, LineSight(float(1 / period), (0, 0), STRAIGHT_LINE))


def drawn_whole(made: Program, rect: Rect, sight: LineSight) -> np.ndarray:
    """Returns a texture's means over the pixels of a rectangle: float32 (channels, h, w)."""
    side = made.side
    xs = _samples(rect.x0 - sight.origin[0], rect.width, side, sight.pixel)
    ys = _samples(rect.y0 - sight.origin[1], rect.height, side, sight.pixel)
    shape = ys.size, xs.size
    places = by_samples(np.stack([np.broadcast_to(xs, shape), np.broadcast_to(ys[:, None], shape)]), side)
    out = made.over(places[0], places[1], max(rect.width, 1), by_samples(scenery(made, rect, sight), side))
    return out.reshape(-1, rect.height, rect.width)


def by_samples(planes: np.ndarray, side: int) -> np.ndarray:
    """Returns planes of samples, (n, h side, w side), by the samples of each pixel: (n, side side, h w)."""
    high, wide = planes.shape[1] // side, planes.shape[2] // side
    parts = planes.reshape(-1, high, side, wide, side).transpose(0, 2, 4, 1, 3)
    return np.ascontiguousarray(parts).reshape(-1, side * side, high * wide)


def _samples(first: int, count: int, side: int, pixel: float) -> np.ndarray:
    return (np.arange(first * side, (first + count) * side) + 0.5) * (pixel / side)
