"""The method of Ritter et al. 2006, sections 4 to 6: pixels in scanline order, each the better of what a search through
the example's data and one through what continues its neighbours finds.  Slow; the reference for quality.

Neighbourhoods have two levels: the pixels above and to the left, and all around the one they lie under a level coarser.
Pixels on a line x + 4 y = t need only those with a smaller t, so that they are searched for together, with the result
of scanline order.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from engine.numeric.halving import halved_region
from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.kernel import Array, Int, inner, kernel
from engine.numeric.neighbourhood import (
    FULL,
    RADIUS,
    ROW,
    SIDE,
    middle_apart_within,
    ones,
    others_apart_within,
    region_bits,
    weights,
)
from engine.texture.example.exemplar import COUNTS, PAD, ExampleLevel, Exemplar

AXES = 24  # of the vectors that are searched
_SAMPLES = 4000  # of which the axes are found
_SLOPE = RADIUS + 1
_DOMAIN = 0x7363616E
_MISSING = -1
_FAR = np.int64(1 << 60)


class Layer(NamedTuple):
    """A level of the example or of what is made, padded by PAD: `compared`, `care` int16, flat (-1 inside); `region`;
    `bits`: its 7 x 7 shapes; `names`: int32 (h, w), where its pixels come from."""

    compared: np.ndarray
    care: np.ndarray
    region: np.ndarray
    bits: np.ndarray
    names: np.ndarray


# As kernels take them: the layers of the example, this level and the coarser, then those that are made, the window
# and the penalty.
Levels = tuple[Layer, Layer, Layer, Layer, np.ndarray, int]


@dataclass(frozen=True, slots=True, eq=False)
class Data:
    """What is searched: `tree` over the vectors of the pixels `inner`, whose neighbourhoods lie wholly inside, and
    `mean` and `axes` of these; `rims`: the other pixels, by how many pixels of both levels are inside, and where each
    count begins."""

    tree: Any
    inner: np.ndarray
    mean: np.ndarray
    axes: np.ndarray
    rims: np.ndarray
    starts: np.ndarray


def filled(exemplar: Exemplar, region: np.ndarray, seed: int) -> np.ndarray:
    """Returns the example's pixels, RGBA (h, w, 4) of its type, over a region, bool (h, w); 0 elsewhere."""
    regions = [region]
    for _ in exemplar.levels[1:]:
        regions.append(halved_region(regions[-1]))
    above = made = None
    for n in reversed(range(len(regions))):
        made = _made(regions[n], exemplar.boundary)
        _fill(exemplar, n, made, above, seed)
        above = made
    assert made is not None
    height, width = region.shape
    names = made.names[PAD : PAD + height, PAD : PAD + width]
    out = np.zeros((height, width, 4), exemplar.pixels.dtype)
    out[region] = exemplar.pixels[(names[region] >> 16) - PAD, (names[region] & 0xFFFF) - PAD]
    return out


def _made(region: np.ndarray, boundary: bool) -> Layer:
    padded = np.pad(region, PAD).astype(np.uint8)
    care = np.repeat(np.negative(padded, dtype=np.int16).reshape(-1), 4)
    names = np.full(padded.shape, _MISSING, np.int32)
    return Layer(np.zeros(4 * padded.size, np.int16), care, padded, _shapes(padded, boundary), names)


def _shapes(padded: np.ndarray, boundary: bool) -> np.ndarray:
    if not boundary:
        return np.where(padded > 0, FULL, np.uint64(0))
    out = np.zeros(padded.shape, np.uint64)
    region_bits(padded, out)
    return out


def _layer(level: ExampleLevel) -> Layer:
    care = np.repeat(np.negative(level.region, dtype=np.int16).reshape(-1), 4)
    return Layer(level.compared.reshape(-1), care, level.region, level.bits, np.zeros((0, 0), np.int32))


def _fill(exemplar: Exemplar, n: int, made: Layer, above: Layer | None, seed: int) -> None:
    """Makes one level."""
    given = exemplar.parameters
    own = _layer(exemplar.levels[n])
    coarser = _layer(exemplar.levels[n + 1]) if above is not None else own
    target = above if above is not None else made
    window = _windows(given.neighbourhood, above is not None)
    penalty = int(min(given.e_max * 0.5**n, 16.0) * 65025 * 8)
    data = _data(own, coarser, window, above is not None)
    levels = own, coarser, made, target, window, penalty
    closeness = int(256 * (1.0 + given.kappa * 2.0**-n))
    height, width = made.region.shape
    hashes = hash_plane(fold_key(_DOMAIN, seed, n), 0, 0, width, height)
    rows, columns = np.nonzero(made.region)
    fronts = columns + _SLOPE * rows
    order = np.argsort(fronts, kind="stable")
    rows, columns = rows[order], columns[order]
    cuts = np.flatnonzero(np.diff(fronts[order])) + 1
    for y, x in zip(np.split(rows, cuts), np.split(columns, cuts), strict=True):
        found, energy = np.full(len(y), _MISSING, np.int32), np.full(len(y), _FAR)
        _continued(y, x, levels, found, energy)
        asked = (hashes[y, x] % np.uint64(given.every) == 0) | (found == _MISSING)
        inner = asked & (len(data.inner) > 0) & _is_inner(made, target, above is not None, y, x)
        if inner.any():
            vectors = _vectors(made, target, window, above is not None, y[inner], x[inner])
            near = data.tree.query((vectors - data.mean) @ data.axes, eps=1.0)[1]
            _compare(y, x, np.flatnonzero(inner), data.inner[near], levels, closeness, found, energy)
        _searched(y, x, np.flatnonzero(asked & ~inner), data.rims, data.starts, levels, closeness, hashes, found)
        _put(y, x, found, own, made)


def _windows(side: int, two: bool) -> np.ndarray:
    """Weights of the pixels made before, and of those a level coarser: int16 (2 * 7 * 32)."""
    full = weights(side)
    causal = full.reshape(SIDE, SIDE + 1, 4).copy()
    causal[RADIUS, RADIUS:] = 0
    causal[RADIUS + 1 :] = 0
    return np.concatenate([causal.reshape(-1), full * np.int16(two)])


def _is_inner(made: Layer, above: Layer, two: bool, y: np.ndarray, x: np.ndarray) -> np.ndarray:
    inside = made.bits[y, x] == FULL
    out: np.ndarray = inside & (above.bits[_up(y), _up(x)] == FULL) if two else inside
    return out


def _up(places: np.ndarray) -> np.ndarray:
    return (places + PAD) >> 1


def _vectors(own: Layer, above: Layer, window: np.ndarray, two: bool, y: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Weighted values of two-level neighbourhoods: float32 (n, V)."""
    root = np.sqrt(window.astype(np.float32)).reshape(2, SIDE, SIDE + 1, 4)
    parts = []
    for k, (layer, rows, columns) in enumerate(((own, y, x), (above, _up(y), _up(x)))[: 1 + two]):
        values = layer.compared.reshape(*layer.region.shape, 4)
        for dy, dx in zip(*np.nonzero(root[k, :, :, 0]), strict=True):
            parts.append(values[rows + dy - RADIUS, columns + dx - RADIUS] * root[k, dy, dx, 0])
    return np.concatenate(parts, axis=1).astype(np.float32)


def _data(own: Layer, above: Layer, window: np.ndarray, two: bool) -> Data:
    from scipy.spatial import cKDTree

    y, x = np.nonzero(own.region)
    names = ((y << 16) | x).astype(np.int32)
    inner = _is_inner(own, above, two, y, x)
    counts = np.bitwise_count(own.bits[y, x]).astype(np.int64)
    counts += np.bitwise_count(above.bits[_up(y), _up(x)]) if two else 0
    rims = ~inner if not inner.all() else inner
    order = np.argsort(counts[rims], kind="stable")
    starts = np.searchsorted(counts[rims][order], np.arange(2 * COUNTS))
    if not inner.any():
        none = np.zeros(0)
        return Data(None, none, none, none, names[rims][order], starts)
    vectors = _vectors(own, above, window, two, y[inner], x[inner])
    mean = vectors.mean(axis=0)
    sample = vectors[:: max(1, len(vectors) // _SAMPLES)] - mean
    axes = np.linalg.eigh(sample.T @ sample)[1][:, ::-1][:, :AXES]
    return Data(cKDTree((vectors - mean) @ axes), names[inner], mean, axes, names[rims][order], starts)


@inner
def _energy(y: Int, x: Int, name: Int, levels: Levels, least: Int) -> Int:
    """Of two-level neighbourhoods, or some number from `least` on."""
    own, coarser, made, above, window, penalty = levels
    row, column = name >> 16, name & 0xFFFF
    e = np.int64(penalty) * ones(made.bits[y, x] ^ own.bits[row, column])
    e = _apart(made, y, x, own, row, column, window, 0, e, least)
    py, px, prow, pcolumn = (y + PAD) >> 1, (x + PAD) >> 1, (row + PAD) >> 1, (column + PAD) >> 1
    if window[SIDE * ROW + 3 * ROW + 3 * 4] == 0:
        return e
    e += np.int64(penalty) * ones(above.bits[py, px] ^ coarser.bits[prow, pcolumn])
    return _apart(above, py, px, coarser, prow, pcolumn, window, SIDE * ROW, e, least)


@inner
def _apart(
    made: Layer, y: Int, x: Int, own: Layer, row: Int, column: Int, window: np.ndarray, first: Int, e: Int, least: Int
) -> Int:
    if e >= least:
        return e
    width, other = 4 * made.region.shape[1], 4 * own.region.shape[1]
    i = (y - RADIUS) * width + 4 * (x - RADIUS)
    j = (row - RADIUS) * other + 4 * (column - RADIUS)
    e += middle_apart_within(made.compared, i, width, own.compared, j, other, window, first, made.care)
    if e < least:
        e += others_apart_within(made.compared, i, width, own.compared, j, other, window, first, made.care)
    return e


@kernel
def _continued(ys: np.ndarray, xs: np.ndarray, levels: Levels, found: np.ndarray, energy: np.ndarray) -> None:
    """Makes the coherence search (Ashikhmin 2001) for the pixels of a line."""
    own, made = levels[0], levels[2]
    for k in range(ys.size):
        for n in range(24):
            dy, dx = n // SIDE - RADIUS, n % SIDE - RADIUS
            source = made.names[ys[k] + dy, xs[k] + dx]
            if source < 0:
                continue
            row, column = (source >> 16) - dy, (source & 0xFFFF) - dx
            if row >= own.region.shape[0] or not 0 <= column < own.region.shape[1] or own.region[row, column] == 0:
                continue
            name = np.int32(row << 16 | column)
            if name != found[k]:
                e = _energy(ys[k], xs[k], name, levels, energy[k])
                if e < energy[k]:
                    found[k], energy[k] = name, e


@kernel
def _compare(
    ys: Array, xs: Array, which: Array, near: Array, levels: Levels, closeness: Int, found: Array, energy: Array
) -> None:
    """Takes what the data search found where it is so much nearer than what continues the neighbours."""
    for i in range(which.size):
        k = which[i]
        e = _energy(ys[k], xs[k], near[i], levels, _FAR)
        if found[k] < 0 or e * closeness < energy[k] * 256:
            found[k], energy[k] = near[i], e


@kernel
def _searched(
    ys: Array,
    xs: Array,
    which: Array,
    rims: Array,
    starts: Array,
    levels: Levels,
    closeness: Int,
    hashes: Array,
    found: Array,
) -> None:
    """Makes the data search at the rim: all with as many pixels inside, or with the next fewer and more."""
    made, above = levels[2], levels[3]
    two = levels[4][SIDE * ROW + 3 * ROW + 3 * 4] != 0
    most = starts.size - 2
    for i in range(which.size):
        k = which[i]
        y, x = ys[k], xs[k]
        count = ones(made.bits[y, x])
        if two:
            count += ones(above.bits[(y + PAD) >> 1, (x + PAD) >> 1])
        fewer = more = min(count, most)
        while fewer > 0 and starts[fewer] == starts[fewer + 1]:
            fewer -= 1
        while more < most and starts[more] == starts[more + 1]:
            more += 1
        least, best = _FAR, np.int32(_MISSING)
        if found[k] >= 0:
            best, least = found[k], _energy(y, x, found[k], levels, _FAR) * 256 // closeness  # type: ignore[assignment]
        for c in range(fewer, more + 1):
            size = starts[c + 1] - starts[c]
            for j in range(size):
                name = rims[starts[c] + (j + np.int64(hashes[y, x] >> np.uint64(40))) % size]
                e = _energy(y, x, name, levels, least)
                if e < least:
                    least, best = e, name  # type: ignore[assignment]
        found[k] = best


@kernel
def _put(ys: np.ndarray, xs: np.ndarray, found: np.ndarray, own: Layer, made: Layer) -> None:
    for k in range(ys.size):
        made.names[ys[k], xs[k]] = found[k]
        i = 4 * (ys[k] * made.region.shape[1] + xs[k])
        j = 4 * ((found[k] >> 16) * own.region.shape[1] + (found[k] & 0xFFFF))
        for c in range(4):
            made.compared[i + c] = own.compared[j + c]
