"""Square patches on a torus: kernels that find which of an example's patches a place is most like, and lay them down.

Pictures are float32 (h, w, C), colours as in a plane of distances.  `source` int32 (h, w, 2): the pixel of the example
in the middle of the patch of each place.  Patches are odd, 2 r + 1 pixels wide; their middles lie r or more within the
example.  What is chosen hangs on nothing but what was there before, so the order of places does not matter.
"""

from __future__ import annotations

import numpy as np

from engine.numeric import elementary
from engine.numeric.in_parts import in_parts
from engine.numeric.kernel import Array, Int, Real, dividing, inner, kernel

_WIDTH = 3.2  # patches are so many deviations of their weights wide
_FAR = np.float32(3e38)


def weights_of(side: int) -> np.ndarray:
    """Returns how much the pixels of a patch count: float32 (side, side), 1 in all."""
    places = np.arange(side) - (side - 1) / 2.0
    line = elementary.mapped(elementary.exp, -0.5 * np.square(places * (_WIDTH / side)))
    line = line / float(sum(line))
    return (line[:, None] * line[None]).astype(np.float32)


def gathered(picture: np.ndarray, side: int, around: bool, weights: np.ndarray) -> np.ndarray:
    """Returns the patches of a picture as columns, float32 (side side C, places), times the roots of their weights;
    `around`: those of all places of a torus, else those that lie within, from the top left on."""
    reach = side // 2
    if around:
        height, width = picture.shape[:2]
        rows, columns = (np.arange(-reach, n + reach) % n for n in (height, width))
        picture = picture[rows][:, columns]
    height, width = picture.shape[0] - side + 1, picture.shape[1] - side + 1
    out = np.empty((side, side, picture.shape[2], height, width), np.float32)
    roots = np.sqrt(weights)
    for y in range(side):
        for x in range(side):
            part = picture[y : y + height, x : x + width].transpose(2, 0, 1)
            np.multiply(part, roots[y, x], out=out[y, x])
    return out.reshape(-1, height * width)


def laid_down(example: np.ndarray, source: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Returns the picture (h, w, C) that all patches make together, averaged where they overlap."""
    out = np.zeros((*source.shape[:2], example.shape[2]), np.float32)
    in_parts(lambda first, last: _lay(example, source, weights, first, last, out), len(out), out.size * weights.size)
    return out


def coherent(picture: np.ndarray, example: np.ndarray, source: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Returns for each place the best of its own source and those of its neighbours, moved on as far as they are."""
    out = np.empty_like(source)
    values = picture.size * weights.size
    in_parts(lambda first, last: _choose(picture, example, source, weights, first, last, out), len(out), values)
    return out


def quilted(
    example: np.ndarray, size: tuple[int, int], block: tuple[int, int, float], chances: np.ndarray
) -> np.ndarray:
    """Returns a torus (*size, C) of square blocks (side, overlap, tolerance): each is one that agrees with those beside
    it as well as any, or nearly; among these `chances` (rows, columns) of 0..1 choose."""
    side, _, tolerance = block
    out = np.zeros((*size, example.shape[2]), np.float32)
    rows, columns = (np.arange(count) * n // count for n, count in zip(size, chances.shape, strict=True))
    _quilt(example, out, np.zeros(size, np.bool_), rows, columns, side, np.float32(tolerance), chances)
    return out


@dividing
def _lay(example: Array, source: Array, weights: Array, start: Int, end: Int, out: Array) -> None:
    height, width, channels = out.shape
    side = weights.shape[0]
    reach = side // 2
    total = np.float32(0.0)
    for a in range(side):
        for b in range(side):
            total += weights[a, b]
    for y in range(start, end):
        for a in range(side):
            row = source[(y + reach - a) % height]
            for b in range(side):
                by, dy, dx = weights[a, b] / total, a - reach, b - reach
                at = (reach - b) % width
                for x in range(width):
                    n = np.uint32(row[at, 0] + dy)
                    m = np.uint32(row[at, 1] + dx)
                    for c in range(channels):
                        out[y, x, c] += by * example[n, m, c]
                    at += 1
                    if at == width:
                        at = 0


@inner
def _unlike(picture: Array, example: Array, y: Int, x: Int, n: Int, m: Int, weights: Array, best: Real) -> Real:
    """Tells how far the patch around (y, x) is from that around (n, m) of the example, or something above `best`."""
    height, width, channels = picture.shape
    side = weights.shape[0]
    reach = side // 2
    total = np.float32(0.0)
    for a in range(side):
        v = y + a - reach
        if v < 0 or v >= height:
            v %= height
        for b in range(side):
            u = x + b - reach
            if u < 0 or u >= width:
                u %= width
            part = np.float32(0.0)
            for c in range(channels):
                apart = picture[v, u, c] - example[np.uint32(n + a - reach), np.uint32(m + b - reach), c]
                part += apart * apart
            total += part * weights[a, b]
        if total >= best:
            return total
    return total


@kernel
def _choose(picture: Array, example: Array, source: Array, weights: Array, start: Int, end: Int, out: Array) -> None:
    height, width = source.shape[:2]
    reach = weights.shape[0] // 2
    bottom, right = example.shape[0] - 1 - reach, example.shape[1] - 1 - reach
    for y in range(start, end):
        for x in range(width):
            n = min(max(source[y, x, 0], reach), bottom)
            m = min(max(source[y, x, 1], reach), right)
            best = _unlike(picture, example, y, x, n, m, weights, _FAR)
            for k in range(9):
                dy, dx = k // 3 - 1, k % 3 - 1
                i, j = source[(y + dy) % height, (x + dx) % width]
                i, j = i - dy, j - dx
                if i < reach or j < reach or i > bottom or j > right or (i == n and j == m):
                    continue
                far = _unlike(picture, example, y, x, i, j, weights, best)
                if far < best:
                    best, n, m = far, i, j
            out[y, x, 0], out[y, x, 1] = n, m


@kernel
def _quilt(
    example: Array, out: Array, known: Array, rows: Array, columns: Array, side: int, tolerance: Real, chances: Array
) -> None:
    wide = example.shape[1] - side + 1
    costs = np.empty((example.shape[0] - side + 1) * wide, np.float32)
    for i in range(rows.size):
        for j in range(columns.size):
            least = _FAR
            for k in range(costs.size):
                costs[k] = _disagreement(example, out, known, rows[i], columns[j], k // wide, k % wide, side)
                least = min(least, costs[k])
            most, count = least * tolerance, 0
            for k in range(costs.size):
                count += costs[k] <= most
            rank, k = min(int(chances[i, j] * count), count - 1), 0
            while costs[k] > most or rank > 0:
                rank -= costs[k] <= most
                k += 1
            _put(example, out, known, rows[i], columns[j], k // wide, k % wide, side)


@inner
def _disagreement(example: Array, out: Array, known: Array, y: Int, x: Int, n: Int, m: Int, side: int) -> Real:
    height, width, channels = out.shape
    total = np.float32(0.0)
    for a in range(side):
        for b in range(side):
            v, u = (y + a) % height, (x + b) % width
            if known[v, u]:
                for c in range(channels):
                    apart = out[v, u, c] - example[n + a, m + b, c]
                    total += apart * apart
    return total


@inner
def _put(example: Array, out: Array, known: Array, y: Int, x: Int, n: Int, m: Int, side: int) -> None:
    """Lays a block down, half over what is there."""
    height, width, channels = out.shape
    for a in range(side):
        for b in range(side):
            v, u = (y + a) % height, (x + b) % width
            for c in range(channels):
                value = example[n + a, m + b, c]
                out[v, u, c] = (out[v, u, c] + value) * np.float32(0.5) if known[v, u] else value
    for a in range(side):
        for b in range(side):
            known[(y + a) % height, (x + b) % width] = True
