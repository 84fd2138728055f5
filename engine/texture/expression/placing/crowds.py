"""How large things are in their own places, and what they come to from afar."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from engine.texture.expression.placing.centre_line import STRAIGHT_LINE, CentreLine
from engine.texture.expression.placing.homes import Standing, numbers_of, told_at
from engine.texture.expression.placing.placed_things import CHILD, OUTER, OWN_A, OWN_B, STROKE_TOLD, Thing, X, Y

THINGS_TRIED, APART = 12, 4.0  # things looked at, and units between them
_SEEN, _MARGIN = 0.004, 1.5
FADED_AWAY, _CLEAR = 1.25, 2.5  # pixels: things that are smaller are not drawn, those that are larger are drawn wholly
_EVEN = 4  # samples along a side of a thing from afar
Spots = tuple[np.ndarray, np.ndarray]  # x, y


def extent_of_thing(thing: Thing) -> tuple[float, float, float, float]:
    """Returns the box, in a thing's own places, outside which none of its kind has anything; the same for all."""
    left, top, right, bottom = thing.measured[:4]
    return left, top, right, bottom


def some(thing: Thing) -> Standing:
    """Returns some things of a kind, as they are by themselves, beside one another, `APART` from each to the next."""
    n = np.arange(THINGS_TRIED)
    one = np.ones(THINGS_TRIED)
    x, y = ((n * m % THINGS_TRIED / THINGS_TRIED - 0.5) * 1.4 for m in (5, 7))
    ids, asked, none = (n * 7919.0 + 12.0, n * 104729.0 + 5.0), _asked_at(thing, x, y), 0.0 * one
    return Standing(n * APART, none, one, one, none, *ids, asked, none)


def _asked_at(thing: Thing, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Returns what things ask of what holds them at some places in that, and this of what holds it: (k, n)."""
    holder, told = thing.holder, _about_places(x, y)
    assert holder is not None
    if holder.deep:
        told |= {OUTER + k: row for k, row in enumerate(_asked_at(holder, 0.7 * y, 0.7 * x))}
    return numbers_of(thing.asked, told, x.size)


def _about_places(x: np.ndarray, y: np.ndarray) -> dict[int, np.ndarray]:
    n = np.arange(x.size)
    told = {X: x, Y: y, OWN_A: n * 7.0, OWN_B: n * 13.0}
    return told | dict(zip(STROKE_TOLD.values(), (x + 4.0, y, 0.0 * x, 1.0 + 0.0 * x), strict=True))


def seen_box(seen: np.ndarray) -> tuple[float, float, float, float]:
    """Returns the box of what was seen of some things, alpha (side, side) over -1..1, and a little around."""
    there, step = seen > _SEEN, 2.0 / len(seen)
    if not there.any():
        return 0.0, 0.0, 0.0, 0.0
    columns, rows = np.flatnonzero(there.any(axis=0)), np.flatnonzero(there.any(axis=1))
    low = (columns[0] - _MARGIN) * step - 1.0, (rows[0] - _MARGIN) * step - 1.0
    high = (columns[-1] + 1.0 + _MARGIN) * step - 1.0, (rows[-1] + 1.0 + _MARGIN) * step - 1.0
    return max(low[0], -1.0), max(low[1], -1.0), min(high[0], 1.0), min(high[1], 1.0)


def usual_size(thing: Thing) -> float:
    """Returns the largest size of things in some places of what holds them."""
    middles = np.arange(9) / 4.0 - 1.0
    x, y = np.tile(middles, 9), np.repeat(middles, 9)
    told = _about_places(x, y) | {OUTER + k: row for k, row in enumerate(_asked_at(thing, x, y))}
    assert thing.spec is not None
    return float(numbers_of(thing.places, told, x.size)[1].max()) * (1.0 + thing.spec.vary)


def octave_of(width: float) -> int:
    """Returns the half octave in which a width lies."""
    part, whole = np.frexp(width)
    return 2 * (int(whole) - 1) + (1 if part >= 0.7071067811865476 else 0)


def thing_looks(
    thing: Thing, octave: int, place: Spots, ids: tuple[np.ndarray, np.ndarray], outer: np.ndarray,
    within: Mapping[int, np.ndarray] = MappingProxyType({}),
) -> np.ndarray:  # fmt: skip
    """Returns what things look like at places of their own: float32 (4, n).

    `within`: pictures of what is within them; of what is not among these, as a crowd.
    """
    made = thing.look(octave)
    told: dict[int, np.ndarray] = {X: place[0], Y: place[1], OWN_A: ids[0], OWN_B: ids[1], **within}
    told |= {OUTER + k: row for k, row in enumerate(outer)}
    for number, child in enumerate(thing.children.values()):
        first = CHILD + 4 * number
        if first not in told and any(first <= kind < first + 4 for kind in made.takes):
            seen = as_crowd(child, place, ids, outer)
            told |= {first + c: _NO if seen is None else seen[c] for c in range(4)}
    count = place[0].size
    pictures = np.zeros((max(1, len(made.takes)), 1, count))
    for plane, kind in zip(pictures, made.takes, strict=False):
        plane[:] = told[kind]
    nowhere = np.zeros((1, count))
    return made.program.over(nowhere, nowhere, max(count, 1), pictures)


def as_crowd(
    thing: Thing, place: Spots, ids: tuple[np.ndarray, np.ndarray], outer: np.ndarray, pixel: float = 1e9,
    line: CentreLine = STRAIGHT_LINE,
) -> np.ndarray | None:  # fmt: skip
    """Returns what a crowd of things comes to, as far as they are too small to be drawn one by one, where a pixel is so
    wide: float64 (4, n), or None where nothing of them.

    `place`: in what holds them; `ids`, `outer`: of that.
    """
    spec, count = thing.spec, place[0].size
    assert spec is not None
    left, top, right, bottom = extent_of_thing(thing)
    if spec.along or right <= left:
        return None
    holder = Standing(*(_NO,) * 5, *ids, outer, _NO)
    asked, told = told_at(thing, holder, *place, line)
    told |= {OUTER + k: row for k, row in enumerate(asked)} | {OWN_A: _NO, OWN_B: _NO}
    where, size = numbers_of(thing.places, told, count)[:2]
    size = np.maximum(size, 1e-6)
    wide, high = right - left, bottom - top
    blurred = 1.0 - part_seen(size * (max(wide, high) / pixel))
    which = np.flatnonzero((where > 0.0) & (blurred > 0.0))
    if not which.size:
        return None
    mean = _mean_look(thing, asked[:, which])
    spread = spec.per * size[which]
    left_over = 1.0 - np.minimum(where[which] * spread * spread * (wide * high) * mean[3] / 8.0, 1.0)
    square = left_over * left_over
    square = square * square
    cover = (1.0 - square * square) * blurred[which]
    out = np.zeros((4, count))
    out[:, which] = mean * (cover / np.maximum(mean[3], 1e-9))
    return out


def _mean_look(thing: Thing, asked: np.ndarray) -> np.ndarray:
    """Returns what things come to, each of another kind by what it asks of what holds it, (k, n): float64 (4, n)."""
    left, top, right, bottom = extent_of_thing(thing)
    wide, high, count, many = right - left, bottom - top, asked.shape[1], _EVEN * _EVEN
    n = np.arange(many)
    x = left + wide * ((n % _EVEN) + 0.5) / _EVEN
    y = top + high * ((n // _EVEN) + 0.5) / _EVEN
    numbers = (n * 5 % many) * 7919.0 + 12.0, (n * 11 % many) * 104729.0 + 5.0
    octave = octave_of(max(wide, high) / _EVEN)
    if not asked.size:
        count = 1
    spots, own = ((np.tile(a, count), np.tile(b, count)) for a, b in ((x, y), numbers))
    seen = thing_looks(thing, octave, spots, own, np.repeat(asked, many, axis=1))
    seen = np.clip(seen, 0.0, 1.0).astype(np.float64).reshape(4, count, many)
    mean = seen[:, :, 0]
    for k in range(1, many):
        mean = mean + seen[:, :, k]
    return np.broadcast_to(mean / many, (4, asked.shape[1]))


def part_seen(pixels: np.ndarray) -> np.ndarray:
    """Returns how much of things that are so large is drawn one by one."""
    part = np.clip((pixels - FADED_AWAY) / (_CLEAR - FADED_AWAY), 0.0, 1.0)
    seen: np.ndarray = part * part * (3.0 - 2.0 * part)
    return seen


_NO = np.zeros(1)
