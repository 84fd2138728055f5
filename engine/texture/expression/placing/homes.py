"""Where things stand: on a jittered grid, or along a line, each by its hash alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from engine.numeric import elementary
from engine.texture.expression.placing.centre_line import CentreLine
from engine.texture.expression.placing.placed_things import (
    LESSENED,
    OUTER,
    OWN_A,
    OWN_B,
    STROKE_TOLD,
    Placing,
    Thing,
    X,
    Y,
)

_ROUNDS = np.uint32(0x9E3779B1), np.uint32(0x85EBCA77), np.uint32(0xC2B2AE3D), np.uint32(0x27D4EB2F)
_LOW = np.uint32((1 << 24) - 1)
_PART = 2.0**-24
_MOST = 400_000  # things of one stroke that are looked at
_DENSE = 8  # per unit: how often the size of what stands along a line is asked
_JITTER = 2.5
_AROUND = 3.0  # units about a stroke in which its things stand
UnitBox = tuple[float, float, float, float]


@dataclass(frozen=True, eq=False, slots=True)
class Standing:
    """Things that stand somewhere, float64 (n,) each: their places in the whole texture, sizes, directions (cos, sin)
    there, numbers; `outer`: what they ask of what holds them, (k, n); `depth`: by which they lie on one another."""

    x: np.ndarray
    y: np.ndarray
    size: np.ndarray
    cos: np.ndarray
    sin: np.ndarray
    first: np.ndarray
    second: np.ndarray
    outer: np.ndarray
    depth: np.ndarray

    def of(self, which: np.ndarray | slice) -> Standing:
        """Returns some of them."""
        return Standing(
            self.x[which], self.y[which], self.size[which], self.cos[which], self.sin[which], self.first[which],
            self.second[which], self.outer[:, which], self.depth[which],
        )  # fmt: skip


_ONE, _NONE = np.ones(1), np.zeros(1)
WHOLE_TEXTURE = Standing(_NONE, _NONE, _ONE, _ONE, _NONE, _NONE, _NONE, np.zeros((0, 1)), _NONE)


def numbers_of(made: Placing, told: dict[int, np.ndarray], count: int) -> np.ndarray:
    """Returns what a program tells at some places: float64 (channels, n); `told`: its pictures, (n,) or one number."""
    if not made.program.channels:
        return np.empty((0, count))
    pictures = np.empty((max(1, len(made.takes)), 1, count))
    pictures[:] = 0.0
    for plane, kind in zip(pictures, made.takes, strict=False):
        plane[:] = told[kind]
    nowhere = np.zeros((1, count))
    return made.program.over(nowhere, nowhere, max(count, 1), pictures).astype(np.float64) * LESSENED


def hashed(key: int, x: np.ndarray | int, y: np.ndarray | int) -> np.ndarray:
    """Returns hashes of pairs of whole numbers: uint32."""
    with np.errstate(over="ignore"):
        h = _whole(x) * _ROUNDS[0] ^ np.uint32(key & 0xFFFFFFFF)
        h = (h ^ (h >> np.uint32(15))) * _ROUNDS[1]
        h = (h ^ _whole(y) * _ROUNDS[2]) * _ROUNDS[3]
        h = (h ^ (h >> np.uint32(13))) * _ROUNDS[1]
        return np.asarray(h ^ (h >> np.uint32(16)))


def _whole(x: np.ndarray | int) -> np.ndarray:
    return np.asarray(np.asarray(x, np.int64) & 0xFFFFFFFF).astype(np.uint32)


def _chance(ids: tuple[np.ndarray, np.ndarray], number: int) -> np.ndarray:
    return (hashed(0x51ED270B + number, *ids) & _LOW).astype(np.float64) * _PART


def _ids(thing: Thing, holder: Standing, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns two numbers for each thing: they differ from those of all others."""
    key = int(hashed(thing.number ^ thing.texts.seed, int(holder.first[0]), int(holder.second[0])))
    return (hashed(key, column, row) & _LOW).astype(np.int64), (hashed(~key, row, column) & _LOW).astype(np.int64)


def told_at(
    thing: Thing, holder: Standing, x: np.ndarray, y: np.ndarray, line: CentreLine
) -> tuple[np.ndarray, dict[int, np.ndarray]]:
    """Returns what a thing asks of what holds it, where it stands there, (k, n); and what is told there.

    `holder`: one, or as many as there are places."""
    told = {X: x, Y: y, OWN_A: holder.first, OWN_B: holder.second}
    told |= {OUTER + k: row for k, row in enumerate(holder.outer)}
    if thing.deep == 1 and (_follows(thing.asked) or _follows(thing.places)):
        told |= {STROKE_KINDS[n]: row for n, row in enumerate(line.about(x, y))}
    return numbers_of(thing.asked, told, x.size), told


STROKE_KINDS = tuple(STROKE_TOLD[name] for name in ("along", "across", "heading", "size"))


def _follows(made: Placing) -> bool:
    return any(kind in STROKE_KINDS for kind in made.takes)


def scattered(thing: Thing, holder: Standing, box: UnitBox, line: CentreLine) -> Standing:
    """Returns the things that stand within a box of their holder's places; the sizes of those that may reach in from
    outside are not known here."""
    spec = thing.spec
    assert spec is not None
    columns = np.arange(int(np.floor(box[0] * spec.per)), int(np.floor(box[2] * spec.per)) + 1)
    rows = np.arange(int(np.floor(box[1] * spec.per)), int(np.floor(box[3] * spec.per)) + 1)
    if columns.size * rows.size > _MOST:
        rows = rows[: max(1, _MOST // columns.size)]
    column, row = np.tile(columns, rows.size), np.repeat(rows, columns.size)
    ids = _ids(thing, holder, column, row)
    jitter = min(1.0, _JITTER * spec.vary)
    x = (column + 0.5 + jitter * (_chance(ids, 1) - 0.5)) / spec.per
    y = (row + 0.5 + jitter * (_chance(ids, 2) - 0.5)) / spec.per
    return _standing(thing, holder, (x, y), ids, line)


def in_row(thing: Thing, line: CentreLine) -> Standing:
    """Returns the things along a line, each `per` times its size from the next one."""
    spec = thing.spec
    assert spec is not None
    dense = np.arange(0.0, line.length + 1.0 / _DENSE, 1.0 / _DENSE)
    x, y = line.at(dense)[:2]
    outer, told = told_at(thing, WHOLE_TEXTURE, x, y, line)
    told |= {OUTER + k: row for k, row in enumerate(outer)} | {OWN_A: _NONE, OWN_B: _NONE}
    size = np.maximum(numbers_of(thing.places, told, dense.size)[1], 1.0 / 64.0)
    steps = 1.0 / (size * spec.per * _DENSE)
    counted = np.concatenate([[0.0], np.cumsum(0.5 * (steps[1:] + steps[:-1]))])
    wanted = np.arange(max(1, int(counted[-1] + 0.5)))[: _MOST // 16]
    ids = _ids(thing, WHOLE_TEXTURE, wanted, np.zeros_like(wanted))
    place = wanted + 0.5 + 0.5 * spec.vary * (_chance(ids, 1) - 0.5)
    place = np.minimum(place, counted[-1])
    k = np.clip(np.searchsorted(counted, place, side="right") - 1, 0, counted.size - 2)
    part = (place - counted[k]) / np.maximum(counted[k + 1] - counted[k], 1e-12)
    along = np.minimum(dense[k] + part / _DENSE, line.length)
    x, y = line.at(along)[:2]
    return _standing(thing, WHOLE_TEXTURE, (x, y), ids, line)


def _standing(
    thing: Thing, holder: Standing, place: tuple[np.ndarray, np.ndarray], ids: tuple[np.ndarray, np.ndarray],
    line: CentreLine,
) -> Standing:  # fmt: skip
    """Returns those of the things that are there, as the whole texture has them."""
    spec, (x, y) = thing.spec, place
    assert spec is not None
    outer, told = told_at(thing, holder, x, y, line)
    first, second = (one.astype(np.float64) for one in ids)
    told |= {OUTER + k: row for k, row in enumerate(outer)} | {OWN_A: first, OWN_B: second}
    where, size, turn = numbers_of(thing.places, told, x.size)
    size = size * (1.0 + spec.vary * (2.0 * _chance(ids, 3) - 1.0))
    there = (_chance(ids, 4) < where) & (size > 1e-4)
    x, y, size, turn, first, second = (one[there] for one in (x, y, size, turn, first, second))
    cos, sin = _turned(turn)
    hx, hy, hs, hc, hn = (one[0] for one in (holder.x, holder.y, holder.size, holder.cos, holder.sin))
    return Standing(
        hx + hs * (hc * x - hn * y), hy + hs * (hn * x + hc * y), hs * size, hc * cos - hn * sin, hn * cos + hc * sin,
        first, second, outer[:, there], y,
    )  # fmt: skip


def _turned(degrees: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    if not degrees.any():
        return np.ones_like(degrees), np.zeros_like(degrees)
    angles = degrees * (math.pi / 180.0)
    return elementary.mapped(elementary.cos, angles), elementary.mapped(elementary.sin, angles)


def all_about(line: CentreLine) -> UnitBox:
    """Returns the box in which a stroke's things stand."""
    left, top, right, bottom = line.box
    return left - _AROUND, top - _AROUND, right + _AROUND, bottom + _AROUND
