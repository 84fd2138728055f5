"""The residual kernels against their plain forms."""

import numpy as np
import pytest

from engine.brush.stamp import Stamp
from engine.canvas import kernels
from engine.canvas.compact import blank_found, compact, trimmed
from engine.canvas.dither import NO_DITHER
from engine.canvas.front import blank_marks
from engine.canvas.rising import counting, lifting, spreading
from engine.canvas.rising.spans import spans_of, within
from engine.numeric.address import Rect
from engine.numeric.grid import FINE_STEP, snapped
from engine.numeric.pyramid import expand

_NO_COLOUR = np.empty(0, np.float32)


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
    about = planes, True, False, new, marks, FINE_STEP, NO_DITHER
    assert kernels.apply_stamp(old, keep, add, _NO_COLOUR, *about) == (2, 5, 3, 8)
    assert np.array_equal(marks[0] != 0, keep != 1.0)
    assert marks[1].tolist() == [[9, 0], [9, 0], [7, 8], [9, 0], [3, 4], [9, 0]]


@pytest.mark.parametrize("rounded", [False, True])
def test_a_stamp_of_one_colour_is_that_of_its_paint(rounded):
    rng = np.random.default_rng(4)
    keep = np.where(rng.random((6, 9)) < 0.5, on_grid(rng, 1, 6, 9)[0] * np.float32(0.25) + np.float32(0.5), 1)
    old, colour = on_grid(rng, 7, 6, 9, largest=0.9), np.array([0.3, 0.61, 0.9], np.float32)
    stamp, planes = Stamp(snapped(keep), colour), np.array([0, 1, 2, 3, -1, -1, -1])
    noise = np.where(keep < 1, np.float32(0.00013), np.float32(0)) if rounded else NO_DITHER
    found = []
    for kernel in (kernels.apply_stamp.compiled, kernels.apply_stamp.plain):
        for told in (_NO_COLOUR, colour):
            new, marks = np.empty_like(old), blank_marks(6, 9)
            kernel(old, stamp.keep, stamp.add, told, planes, True, False, new, marks, FINE_STEP, noise)
            found.append(new.tobytes())
    assert len(set(found)) == 1


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


def in_larger(touched):
    """Marks of a tile as a part of those of a level, two pixels down and four to the right."""
    height, width = touched.shape
    marks, spans = np.zeros((height + 3, width + 6), np.uint8), np.zeros((height + 3, 3, 2), np.int32)
    marks[2:-1, 4:-2] = touched
    spans[2:-1, 1] = even_spans(touched) + 4
    spans[:, 2] = width, width + 6
    return marks, spans


@pytest.mark.parametrize("kernel", both(counting.renew))
@pytest.mark.parametrize("largest", [0.2, 3.0])
def test_a_renewed_residual_is_what_is_left_of_the_values(kernel, largest):
    rng = np.random.default_rng(11)
    value, coarse = on_grid(rng, 7, 13, 30, largest=largest), on_grid(rng, 7, 12, 19, largest=largest)
    touched, planes = scattered(rng, 10, 26), np.array([0, 1, 2, 3, -1, 5, 4])
    before = rng.integers(-32767, 32768, (7, 12, 28)).astype(np.int16)
    data, row = before.copy(), np.empty(26, np.int32)
    marks, part, told = in_larger(touched), (2, 10, 1, -1, -2, 4), np.empty((10, 2), np.uint8)
    arguments = value, (0, -1), coarse, (1, 1), planes, marks, part, row, data, told, FINE_STEP
    changed, bits, full = kernel(*arguments)

    window = np.stack([coarse[p] if p >= 0 else np.zeros_like(coarse[0]) for p in planes])[:, 2:9, 3:18]
    new = np.rint((value[:, 2:12, 3:29] - expand(window)) * 65536).astype(np.int32)
    wanted = before.astype(np.int32)
    wanted[:, 1:11, 2:28] = np.where(touched, new, wanted[:, 1:11, 2:28])
    assert changed
    assert full
    assert np.array_equal(told, even_spans(touched))
    assert (bits < 1 << 15) == (abs(wanted).max() < 1 << 15) == (largest < 1.0)
    if largest < 1.0:
        assert np.array_equal(data, wanted)
        assert not kernel(*arguments)[0]
        data[:, 0] = 0
        assert not kernel(*arguments)[2]


@pytest.mark.parametrize("kernel", both(counting.edges))
def test_the_edges_of_small_integers_are_those_of_large_ones(kernel):
    data = np.zeros((7, 9, 11), np.int16)
    used, wanted = np.empty((2, 7), np.int32)
    assert kernel(data, used)[0] == 0
    data[1, 3, 4], data[5, 6, 2] = -32767, 1
    assert kernel(data, used)[1:] == counting.extent(data.astype(np.int32), wanted)[1:] == (3, 7, 2, 5)
    assert (used != 0).tolist() == (wanted != 0).tolist()
    record = trimmed(Rect(8, 16, 19, 25), data, (), 3, False)
    assert record.rect == Rect(10, 19, 13, 23)
    assert np.array_equal(record.data, data[:, 3:7, 2:5])


def test_what_fills_its_rectangle_is_the_record():
    data = np.zeros((4, 9, 11), np.int16)
    data[0, 0, 5] = data[1, 8, 5] = data[2, 4, 0] = data[3, 4, 10] = 7
    assert trimmed(Rect(8, 16, 19, 25), data, (), 3, True).data is data
    data = data.copy()
    data[0, 0] = 0
    assert trimmed(Rect(8, 16, 19, 25), data, (), 3, False).data.shape == (4, 5, 11)


@pytest.mark.parametrize("kernel", both(counting.crop))
def test_what_lies_off_the_spans_counts_for_nothing(kernel):
    rng = np.random.default_rng(5)
    data, marked = rng.integers(1, 99, (4, 10, 12)).astype(np.int32), scattered(rng, 10, 12)
    out = np.empty((3, 6, 5), np.int16)
    kernel(data, spans_of(marked), np.array([0, 3, 1]), (2, 3), out)
    wanted = np.where(within(spans_of(marked), 12), data, 0)[[0, 3, 1], 2:8, 3:8]
    assert np.array_equal(out, wanted)


@pytest.mark.parametrize("kernel", both(spreading.spread))
def test_children_of_what_moved_are_touched(kernel):
    rng = np.random.default_rng(6)
    moved, out = 2 * scattered(rng, 12, 140), scattered(rng, 16, 200)
    parents = moved, np.stack([spans_of(moved[:, :70]), spans_of(moved[:, 70:]) + 70], axis=1)
    spans = np.stack([spans_of(out[:, :28]), spans_of(out[:, 28:156]) + 28, spans_of(out[:, 156:]) + 156], axis=1)
    wanted = out.copy()
    for y in range(16):
        for x in range(200):
            j, i = 2 + y // 2, 3 + x // 2
            there = moved[np.ix_([j, j + 2 * (y % 2) - 1], [i, i + 2 * (x % 2) - 1])]
            wanted[y, x] |= there.max()
    kernel(parents, (1, 2), (out, spans), 100)
    assert np.array_equal(out, wanted)
    for tile, (first, last) in enumerate([(0, 28), (28, 156), (156, 200)]):
        some = wanted[:, first:last].any(axis=1)
        assert np.array_equal(spans[some, tile], even_spans(wanted[:, first:last])[some] + first)
        assert not spans[~some, tile].any()


@pytest.mark.parametrize("kernel", both(spreading.boxes))
def test_extents_are_told_tile_by_tile(kernel):
    spans = np.zeros((40, 2, 2), np.int32)
    spans[[3, 9, 30], 0], spans[9, 1] = [(4, 8), (2, 5), (6, 7)], (60, 61)
    found = np.full((2, 2, 4), -1, np.int32)
    kernel(spans, 128 - 20, found)
    assert found.tolist() == [[[3, 10, 2, 8], [9, 10, 60, 61]], [[30, 31, 6, 7], [0, 0, 0, 0]]]


def level_of(rng, height, width, strips):
    """A level that nothing changed yet, with any A."""
    spans = np.full((height, strips, 2), (1 << 30, 0), np.int32)
    return on_grid(rng, height, width), np.zeros((height, width), np.uint8), spans


def lifted(which, spares):
    """What two patches beside one another make of two levels above, one of them blank before."""
    rng = np.random.default_rng(8)
    here, above = level_of(rng, 16, 26, 2), level_of(rng, 12, 18, 1)
    values, coarser = abs(on_grid(rng, 7, 16, 26)), on_grid(rng, 2, 7, 12, 18)
    spare, means, seen = (np.empty((2, 7, 64), np.float32), np.empty(64, np.uint8)), on_grid(rng, 2, 7, 12, 12), []
    blank = np.full(7, -1), np.array([0, 1, 2, 3, -1, 4, 5])
    for strip, maps in ((0, blank), (1, (np.arange(7), np.arange(7)))):
        marked = scattered(rng, 24, 24)
        old, new, keep = on_grid(rng, 7, 24, 24), on_grid(rng, 7, 24, 24), on_grid(rng, 24, 24)
        left = 2 + 11 * strip
        lower, within = which(lifting.lower), (means, (2, left & ~1))
        lower((old, new), maps, keep, (marked, spans_of(marked)), (2, 2, 11, 3, left, strip), within, here, FINE_STEP)
        window, onto = (2, 14, strip, strip + 1, 2, 3, 0, 0), (coarser, (0, 0))
        arguments = within, here, values, window, onto, above, spare, spares, FINE_STEP, NO_DITHER
        seen.append(which(lifting.climb)(*arguments))
    return [*seen, values, *settled(here), *settled(above), coarser[:, :, above[1] != 0]]


def settled(level):
    """Of a level, A where anything is marked, the marks, and the columns."""
    return level[0][level[1] != 0], level[1], level[2]


@pytest.mark.parametrize("spares", [False, True])
def test_compiled_and_plain_lifts_agree(spares):
    """Where anything is marked, and at the pixels beside it."""
    seen = [lifted(which, spares) for which in (lambda kernel: kernel.compiled, lambda kernel: kernel.plain)]
    for one, other in zip(*seen, strict=True):
        assert np.array_equal(one, other)
    assert min(seen[0][:2]) > 0
    assert seen[0][4].any()
    assert seen[0][7].any()


@pytest.mark.parametrize("kernel", both(lifting.place_changed))
def test_what_changed_is_put_in_its_place(kernel):
    rng = np.random.default_rng(9)
    values, marked, out = on_grid(rng, 5, 9, 12), scattered(rng, 9, 12), on_grid(rng, 4, 14, 22)
    wanted = out.copy()
    inside = within(spans_of(marked), 12)
    wanted[:, 1:10, 2:14][:, inside] = np.stack([values[0], values[2], np.zeros_like(values[0]), values[4]])[:, inside]
    kernel(values, np.array([0, 2, -1, 4]), spans_of(marked), out, 1, 2)
    assert np.array_equal(out, wanted)
