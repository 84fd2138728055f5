"""The residual kernels against their plain forms."""

import numpy as np
import pytest

from engine.canvas import kernels
from engine.canvas.compact import blank_found, compact, trimmed
from engine.canvas.dither import NO_DITHER
from engine.canvas.front import blank_marks
from engine.canvas.rising import counting, lifting
from engine.canvas.rising.spans import spans_of, within
from engine.numeric.address import Rect
from engine.numeric.grid import FINE_STEP
from engine.numeric.pyramid import expand


def on_grid(rng, *shape, largest=1.0):
    return (rng.integers(-int(largest * 65536), int(largest * 65536) + 1, shape) / 65536).astype(np.float32)


def even_spans(marks):
    return (spans_of(marks) + np.array([0, 1]) & ~1).astype(np.int32)


@pytest.mark.parametrize("largest", [0.2, 3.0])
def test_first_residual_is_what_is_left_of_the_values(largest):
    rng = np.random.default_rng(7)
    coarse = on_grid(rng, 7, 12, 15, largest=largest)
    around = on_grid(rng, 7, 13, 20, largest=largest)
    value = around[:, 2:12, 5:19]
    touched = (rng.random((10, 14)) < 0.4).astype(np.uint8)
    touched[:2] = touched[:, :3] = touched[9] = 0
    planes = np.array([0, 1, 2, 3, -1, 5, 4])
    data, marks = np.full((7, 10, 14), 99, np.int32), (touched, even_spans(touched))
    found = used, _, _ = blank_found(data)
    bits, y0, y1, x0, x1 = counting.first_residual(
        around, (2, 5), coarse, (2, 3), planes, marks, data, found, FINE_STEP
    )
    data[:, ~within(marks[1], 14)] = 0

    window = np.stack([coarse[p] if p >= 0 else np.zeros_like(coarse[0]) for p in planes])[:, 2:9, 3:12]
    plain = np.where(touched, np.rint((value - expand(window)) * 65536), 0).astype(np.int32)
    assert np.array_equal(data, plain)
    rows, columns = np.flatnonzero(plain.any((0, 2))), np.flatnonzero(plain.any((0, 1)))
    assert (y0, y1, x0, x1) == (rows[0], rows[-1] + 1, columns[0], columns[-1] + 1)
    assert (bits < 1 << 15) == (abs(plain).max() < 1 << 15)
    assert np.array_equal(used != 0, plain.any((1, 2)))

    again = np.empty(7, np.int32)
    assert counting.extent(plain, again) == (bits, y0, y1, x0, x1)
    assert np.array_equal(again, used)


def test_first_residual_of_nothing():
    nothing = np.zeros((4, 8, 8), np.float32)
    data = np.empty((4, 8, 8), np.int32)
    touched = np.ones((8, 8), np.uint8)
    coarse, found = np.zeros((4, 6, 6), np.float32), blank_found(data)
    marks = touched, spans_of(touched)
    extent = counting.first_residual(nothing, (0, 0), coarse, (0, 0), np.arange(4), marks, data, found, FINE_STEP)
    assert extent[0] == 0
    assert not data.any()
    assert compact(Rect(0, 0, 8, 8), data, (), 1, (extent, found[0])) is None


@pytest.mark.parametrize(
    ("value", "kind"), [(32767, np.int16), (-32767, np.int16), (32768, np.int32), (-40000, np.int32)]
)
def test_a_record_takes_the_smaller_integers_that_hold_it(value, kind):
    data = np.zeros((4, 8, 8), np.int32)
    data[1, 3, 5] = value
    data[0, 4, 2] = 1
    record = compact(Rect(0, 0, 8, 8), data, (), 1)
    assert record.data.dtype == kind
    assert record.rect == Rect(2, 3, 6, 5)
    assert np.array_equal(record.data, data[:, 3:5, 2:6])


def test_what_a_stamp_changes_is_measured():
    keep = np.ones((6, 9), np.float32)
    keep[2, 7] = keep[4, 3] = 0.5
    old, new, marks = np.ones((4, 6, 9), np.float32), np.empty((4, 6, 9), np.float32), blank_marks(6, 9)
    add, planes = np.zeros((4, 6, 9), np.float32), np.arange(4)
    assert kernels.apply_stamp(old, keep, add, planes, True, False, new, marks, FINE_STEP, NO_DITHER) == (2, 5, 3, 8)
    assert np.array_equal(marks[0] != 0, keep != 1.0)
    assert marks[1].tolist() == [[9, 0], [9, 0], [7, 8], [9, 0], [3, 4], [9, 0]]


@pytest.mark.parametrize("kernel", [counting.residual.compiled, counting.residual.plain])
def test_a_residual_is_written_where_it_is_touched(kernel):
    rng = np.random.default_rng(3)
    value, predicted = on_grid(rng, 4, 12, 12), on_grid(rng, 4, 6, 8)
    touched = (rng.random((6, 8)) < 0.3).astype(np.uint8)
    before = np.zeros((4, 10, 11), np.int32)
    before[1, 9, 0] = -5
    data, used = before.copy(), np.empty(4, np.int32)
    changed, *extent = kernel(value, (3, 1), predicted, touched, (2, 3), data, used, FINE_STEP)
    wanted, measured = before.copy(), np.empty(4, np.int32)
    new = np.rint((value[:, 3:9, 1:9] - predicted) * 65536).astype(np.int32)
    wanted[:, 2:8, 3:11] = np.where(touched, new, 0)
    assert changed
    assert np.array_equal(data, wanted)
    assert tuple(extent) == counting.extent(wanted, measured)
    assert np.array_equal(used, measured)
    assert not kernel(value, (3, 1), predicted, touched, (2, 3), data, used, FINE_STEP)[0]


def both(kernel):
    return [kernel.compiled, kernel.plain]


def scattered(rng, *shape):
    """Marks in some rows of an array, none at its sides."""
    marked = (rng.random(shape) < 0.2).astype(np.uint8)
    marked[::3] = marked[:, :2] = marked[:, -5:] = 0
    return marked


@pytest.mark.parametrize("kernel", both(counting.renew))
@pytest.mark.parametrize("largest", [0.2, 3.0])
def test_a_renewed_residual_is_what_is_left_of_the_values(kernel, largest):
    rng = np.random.default_rng(11)
    value, coarse = on_grid(rng, 7, 13, 30, largest=largest), on_grid(rng, 7, 12, 19, largest=largest)
    touched, planes = scattered(rng, 10, 26), np.array([0, 1, 2, 3, -1, 5, 4])
    before = rng.integers(-32767, 32768, (7, 12, 28)).astype(np.int16)
    data, row = before.copy(), np.empty(26, np.int32)
    marks = touched, even_spans(touched)
    changed, bits = kernel(value, (2, 3), coarse, (2, 3), planes, marks, row, (1, 2), data, FINE_STEP)

    window = np.stack([coarse[p] if p >= 0 else np.zeros_like(coarse[0]) for p in planes])[:, 2:9, 3:18]
    new = np.rint((value[:, 2:12, 3:29] - expand(window)) * 65536).astype(np.int32)
    wanted = before.astype(np.int32)
    wanted[:, 1:11, 2:28] = np.where(touched, new, wanted[:, 1:11, 2:28])
    assert changed
    assert (bits < 1 << 15) == (abs(wanted).max() < 1 << 15) == (largest < 1.0)
    if largest < 1.0:
        assert np.array_equal(data, wanted)
        assert not kernel(value, (2, 3), coarse, (2, 3), planes, marks, row, (1, 2), data, FINE_STEP)[0]


@pytest.mark.parametrize("kernel", both(counting.edges))
def test_the_edges_of_small_integers_are_those_of_large_ones(kernel):
    data = np.zeros((7, 9, 11), np.int16)
    used, wanted = np.empty((2, 7), np.int32)
    assert kernel(data, used)[0] == 0
    data[1, 3, 4], data[5, 6, 2] = -32767, 1
    assert kernel(data, used)[1:] == counting.extent(data.astype(np.int32), wanted)[1:] == (3, 7, 2, 5)
    assert (used != 0).tolist() == (wanted != 0).tolist()
    record = trimmed(Rect(8, 16, 19, 25), data, (), 3)
    assert record.rect == Rect(10, 19, 13, 23)
    assert np.array_equal(record.data, data[:, 3:7, 2:5])


@pytest.mark.parametrize("kernel", both(counting.crop))
def test_what_lies_off_the_spans_counts_for_nothing(kernel):
    rng = np.random.default_rng(5)
    data, marked = rng.integers(1, 99, (4, 10, 12)).astype(np.int32), scattered(rng, 10, 12)
    out = np.empty((3, 6, 5), np.int16)
    kernel(data, spans_of(marked), np.array([0, 3, 1]), (2, 3), out)
    wanted = np.where(within(spans_of(marked), 12), data, 0)[[0, 3, 1], 2:8, 3:8]
    assert np.array_equal(out, wanted)


@pytest.mark.parametrize("kernel", both(lifting.spread))
def test_children_of_what_moved_are_touched(kernel):
    rng = np.random.default_rng(6)
    moved, out = 2 * scattered(rng, 12, 16), scattered(rng, 16, 20)
    wanted, spans = out.copy(), np.empty((16, 2), np.int32)
    for y in range(16):
        for x in range(20):
            j, i = 2 + y // 2, 3 + x // 2
            there = moved[np.ix_([j, j + 2 * (y % 2) - 1], [i, i + 2 * (x % 2) - 1])]
            wanted[y, x] |= there.max()
    assert kernel(moved, 1, 2, out, spans) == wanted.any()
    assert np.array_equal(out, wanted)
    assert np.array_equal(spans[out.any(axis=1)], even_spans(wanted)[out.any(axis=1)])
    assert (spans[~out.any(axis=1)] == [20, 0]).all()


def lowered(rng, planes, height, width):
    """What `lower` writes into: marked nowhere, any values."""
    spans = np.full((height, 2), (1 << 30, 0), np.int32)
    return (
        on_grid(rng, 2, planes, height, width),
        on_grid(rng, height, width),
        np.zeros((height, width), np.uint8),
        spans,
    )


@pytest.mark.parametrize("spares", [False, True])
def test_compiled_and_plain_lifts_agree(spares):
    """Of two neighbours, one blank before; where anything is marked, and at the pixels beside it."""
    seen = []
    for which in (lambda kernel: kernel.compiled, lambda kernel: kernel.plain):
        rng = np.random.default_rng(8)
        into = lowered(rng, 7, 12, 20)
        for left, maps in ((0, (np.full(7, -1), np.array([0, 1, 2, 3, -1, 4, 5]))), (8, (np.arange(7), np.arange(7)))):
            marked = scattered(rng, 24, 24)
            old, new, keep = on_grid(rng, 7, 24, 24), on_grid(rng, 7, 24, 24), on_grid(rng, 24, 24)
            window = 2, 2, 11, 10, 1, left + 1
            which(lifting.lower)((old, new), maps, keep, (marked, spans_of(marked)), window, into, FINE_STEP)
        around, values, marks = abs(on_grid(rng, 7, 15, 25)), np.zeros((2, 7, 12, 20), np.float32), blank_marks(12, 20)
        extent = which(lifting.climb)(into, spares, around, (2, 3), values, marks, FINE_STEP, NO_DITHER)
        inside = within(marks[1], 20)
        assert np.array_equal(inside & (marks[0] != 0), marks[0] != 0)
        out = np.zeros((7, 14, 22), np.float32)
        which(lifting.place_changed)(values[1], np.arange(7), marks[1], out, 1, 2)
        seen.append([extent, values[:, :, inside], into[1][inside], into[2], into[3], *marks, out])
    for one, other in zip(*seen, strict=True):
        assert np.array_equal(one, other)
    assert 0 < seen[0][0][1] <= 12
