"""Histogram matching: values are moved, keeping their order, until they are distributed as those of an example.

Heeger & Bergen 1995, section 3.2.  An example is given as its sorted values: its cumulative distribution, turned
round.  That of the values to be moved is a table of 256 bins with straight lines between them (`match`), or every
value's exact rank (`match_by_rank`).  Everything is float32 and finite; results never leave the example's range.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import inlined, inner, kernel

BINS = 256

_DIGIT = 11  # bits that one pass of the radix sort looks at
_SIZE = 1 << _DIGIT
_ZERO = np.float32(0.0)
_ONE = np.float32(1.0)


def sorted_values(values: np.ndarray) -> np.ndarray:
    """Returns all values of an array in rising order: float32 (n,)."""
    keys = _keys(np.ascontiguousarray(values, np.float32).reshape(-1))
    _sort(keys, np.empty_like(keys))
    return _values(keys)


def quantiles(ordered: np.ndarray, count: int) -> np.ndarray:
    """`count` sorted values distributed as the sorted `ordered` (n,), the least and the largest kept: float32."""
    if count == ordered.size:
        return ordered
    places = np.linspace(0.0, ordered.size - 1.0, count) if count > 1 else np.array([(ordered.size - 1) / 2.0])
    out: np.ndarray = np.interp(places, np.arange(ordered.size), ordered).astype(np.float32)
    return out


def blended(a: np.ndarray, b: np.ndarray, weight: float) -> np.ndarray:
    """Returns a distribution between two, both as sorted values: at `weight` 0 it is a, at 1 it is b; float32 (n,).

    Values of the same rank are averaged, so the distance from a, in the sense of `distance`, grows as the weight.
    """
    count = max(a.size, b.size)
    weight = min(max(weight, 0.0), 1.0)
    if weight in (0.0, 1.0):
        return b if weight else a
    return quantiles(a, count) * np.float32(1.0 - weight) + quantiles(b, count) * np.float32(weight)


def distance(a: np.ndarray, b: np.ndarray) -> float:
    """Tells how far values must be moved, on average, to turn one distribution into the other, both given as sorted
    values: the 1-Wasserstein distance."""
    count = max(a.size, b.size)
    ranks = (np.arange(count) + 0.5) / count
    given = (np.interp(ranks, (np.arange(v.size) + 0.5) / v.size, v) for v in (a, b))
    return float(np.abs(np.subtract(*given)).mean())


def match(values: np.ndarray, ordered: np.ndarray, bins: int = BINS) -> None:
    """Moves `values`, C-contiguous float32 of any shape, in place, to the distribution of `ordered` (n,), sorted."""
    _check(values)
    match_rows(values.reshape(1, -1), ordered, bins)


def match_rows(values: np.ndarray, ordered: np.ndarray, bins: int = BINS) -> None:
    """As `match`, each of the rows of `values`, C-contiguous float32 (m, ...), by itself."""
    _check(values)
    if values.size:
        rows = values.reshape(values.shape[0], -1)
        ordered = np.ascontiguousarray(ordered, np.float32)
        _match_rows(rows, rows.min(axis=1), rows.max(axis=1), ordered, np.empty((4, bins), np.int64))


def match_by_rank(values: np.ndarray, ordered: np.ndarray) -> None:
    """As `match`, exactly: the value of rank r of n becomes the example's at (r + 1/2)/n; equal values stay equal."""
    _check(values)
    flat = values.reshape(-1)
    keys = _keys(flat)
    order = np.empty(flat.size, np.uint32)
    _sort_with_places(keys, np.empty_like(keys), order, np.empty_like(order))
    _place_by_rank(flat, keys, order, np.ascontiguousarray(ordered, np.float32))


def _check(values: np.ndarray) -> None:
    if not values.flags.c_contiguous or values.dtype != np.float32:
        raise ValueError(f"match: found {values.dtype} {values.strides}, expected C-contiguous float32")


@inlined
def _at(ordered: np.ndarray, part: float) -> np.float32:
    """Returns the sorted values at a part 0..1 of them all."""
    place = min(max(part * ordered.size - 0.5, 0.0), ordered.size - 1.0)
    k = min(np.int64(place), ordered.size - 2) if ordered.size > 1 else 0
    low = ordered[k]  # type: ignore[index]
    if ordered.size == 1:
        return low  # type: ignore[no-any-return]
    return min(np.float32(low + (ordered[k + 1] - low) * (place - k)), ordered[k + 1])  # type: ignore[operator]  # rounding might go beyond


@kernel
def _match_rows(rows: np.ndarray, lows: np.ndarray, highs: np.ndarray, ordered: np.ndarray, counts: np.ndarray) -> None:
    bins = counts.shape[1]
    start = np.empty(bins, np.float32)
    step = np.empty(bins, np.float32)
    for n in range(rows.shape[0]):
        row, low = rows[n], lows[n]
        scale = np.float32(bins) / (highs[n] - low) if highs[n] > low else _ZERO
        if not (scale > _ZERO and scale < np.float32(np.inf)):
            row[:] = _at(ordered, 0.5)
            continue
        _count(row, low, scale, counts)
        _fill_table(start, step, counts, row.size, ordered)
        _look_up(row, low, scale, start, step)


@inner
def _count(row: np.ndarray, low: np.float32, scale: np.float32, counts: np.ndarray) -> None:
    """counts[0] = how many values fall into each bin.  Four tables by turns: equal neighbours would wait for one
    another's sum."""
    counts[:] = 0
    last = np.int32(counts.shape[1] - 1)
    first, second, third, fourth = counts[0], counts[1], counts[2], counts[3]
    even = row.size // 4 * 4
    for i in range(0, even, 4):
        first[np.uint32(min(np.int32((row[i] - low) * scale), last))] += 1
        second[np.uint32(min(np.int32((row[i + 1] - low) * scale), last))] += 1
        third[np.uint32(min(np.int32((row[i + 2] - low) * scale), last))] += 1
        fourth[np.uint32(min(np.int32((row[i + 3] - low) * scale), last))] += 1
    for i in range(even, row.size):
        first[np.uint32(min(np.int32((row[i] - low) * scale), last))] += 1
    for k in range(counts.shape[1]):
        first[k] += second[k] + third[k] + fourth[k]


@inner
def _fill_table(start: np.ndarray, step: np.ndarray, counts: np.ndarray, total: int, ordered: np.ndarray) -> None:
    """start[k] = the example's value where as large a part of it lies below as of the values below bin k; step[k] = the
    way from there to start[k + 1], rounded so that no bin ends above the next one's start."""
    below = counts[0, 0]
    start[0] = ordered[0]
    for k in range(start.size):
        after = ordered[ordered.size - 1]
        if k + 1 < start.size:
            after = _at(ordered, below / total)
            start[k + 1] = after
            below += counts[0, k + 1]
        way = np.float32(after - start[k])
        while np.float32(start[k] + way) > after:
            way = np.nextafter(way, _ZERO)
        step[k] = way


@inner
def _look_up(row: np.ndarray, low: np.float32, scale: np.float32, start: np.ndarray, step: np.ndarray) -> None:
    last = np.int32(start.size - 1)
    for i in range(row.size):
        t = (row[i] - low) * scale
        k = min(np.int32(t), last)
        row[i] = start[np.uint32(k)] + step[np.uint32(k)] * min(t - np.float32(k), _ONE)


@kernel
def _place_by_rank(values: np.ndarray, keys: np.ndarray, order: np.ndarray, ordered: np.ndarray) -> None:
    start = 0
    while start < keys.size:
        stop = start + 1
        while stop < keys.size and keys[stop] == keys[start]:
            stop += 1
        value = _at(ordered, 0.5 * (start + stop) / keys.size)
        for i in range(start, stop):
            values[order[i]] = value
        start = stop


def _keys(values: np.ndarray) -> np.ndarray:
    """uint32 numbers that are ordered as float32 values are (-0 as +0): the sign bit set, or all bits turned."""
    keys = (values + _ZERO).view(np.uint32)
    negative = keys >> np.uint32(31)
    keys ^= (-negative.view(np.int32)).view(np.uint32) | np.uint32(0x80000000)
    return keys


def _values(keys: np.ndarray) -> np.ndarray:
    positive = keys >> np.uint32(31)
    out: np.ndarray = (keys ^ ((positive.view(np.int32) - np.int32(1)).view(np.uint32) | np.uint32(0x80000000))).view(
        np.float32
    )
    return out


@inner
def _starts(keys: np.ndarray) -> np.ndarray:
    """Tells where each digit's run begins, for the three passes of the sort: int64 (3, 2^11)."""
    starts = np.zeros((3, _SIZE), np.int64)
    for i in range(keys.size):
        for turn in range(3):
            starts[turn, (keys[i] >> np.uint32(_DIGIT * turn)) & np.uint32(_SIZE - 1)] += 1
    for turn in range(3):
        total = 0
        for digit in range(_SIZE):
            count = starts[turn, digit]
            starts[turn, digit] = total
            total += count
    return starts


@kernel
def _sort(keys: np.ndarray, spare: np.ndarray) -> None:
    """Sorts keys (n,) by their digits from the lowest, stably; `spare` is as large."""
    starts = _starts(keys)
    source, target = keys, spare
    for turn in range(3):
        for i in range(source.size):
            digit = (source[i] >> np.uint32(_DIGIT * turn)) & np.uint32(_SIZE - 1)
            target[starts[turn, digit]] = source[i]
            starts[turn, digit] += 1
        source, target = target, source
    for i in range(keys.size):
        keys[i] = source[i]


@kernel
def _sort_with_places(keys: np.ndarray, spare: np.ndarray, order: np.ndarray, spare_order: np.ndarray) -> None:
    """As `_sort`; `order` becomes the place that each key came from."""
    starts = _starts(keys)
    for i in range(order.size):
        order[i] = i
    source, target, from_, to = keys, spare, order, spare_order
    for turn in range(3):
        for i in range(source.size):
            digit = (source[i] >> np.uint32(_DIGIT * turn)) & np.uint32(_SIZE - 1)
            place = starts[turn, digit]
            target[place] = source[i]
            to[place] = from_[i]
            starts[turn, digit] = place + 1
        source, target, from_, to = target, source, to, from_
    for i in range(keys.size):
        keys[i], order[i] = source[i], from_[i]
