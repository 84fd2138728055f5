"""The residual kernels against their plain forms."""

import numpy as np
import pytest

from engine.canvas import kernels
from engine.canvas.compact import compact
from engine.numeric.address import Rect
from engine.numeric.pyramid import expand


def on_grid(rng, *shape, largest=1.0):
    return (rng.integers(-int(largest * 65536), int(largest * 65536) + 1, shape) / 65536).astype(np.float32)


@pytest.mark.parametrize("largest", [0.2, 3.0])
def test_first_residual_is_what_is_left_of_the_values(largest):
    rng = np.random.default_rng(7)
    coarse = on_grid(rng, 7, 12, 15, largest=largest)
    around = on_grid(rng, 7, 13, 20, largest=largest)
    value = around[:, 2:12, 5:19]
    touched = (rng.random((10, 14)) < 0.4).astype(np.uint8)
    touched[:2] = touched[:, :3] = touched[9] = 0
    planes = np.array([0, 1, 2, 3, -1, 5, 4])
    data, used = np.full((7, 10, 14), 99, np.int32), np.full(7, 99, np.int32)
    bits, y0, y1, x0, x1 = kernels.first_residual(around, (2, 5), coarse, (2, 3), planes, touched, data, used)

    window = np.stack([coarse[p] if p >= 0 else np.zeros_like(coarse[0]) for p in planes])[:, 2:9, 3:12]
    plain = np.where(touched, np.rint((value - expand(window)) * 65536), 0).astype(np.int32)
    assert np.array_equal(data, plain)
    rows, columns = np.flatnonzero(plain.any((0, 2))), np.flatnonzero(plain.any((0, 1)))
    assert (y0, y1, x0, x1) == (rows[0], rows[-1] + 1, columns[0], columns[-1] + 1)
    assert (bits < 1 << 15) == (abs(plain).max() < 1 << 15)
    assert np.array_equal(used != 0, plain.any((1, 2)))

    again = np.empty(7, np.int32)
    assert kernels.extent(plain, again) == (bits, y0, y1, x0, x1)
    assert np.array_equal(again, used)


def test_first_residual_of_nothing():
    nothing = np.zeros((4, 8, 8), np.float32)
    data, used = np.empty((4, 8, 8), np.int32), np.empty(4, np.int32)
    touched = np.ones((8, 8), np.uint8)
    coarse = np.zeros((4, 6, 6), np.float32)
    extent = kernels.first_residual(nothing, (0, 0), coarse, (0, 0), np.arange(4), touched, data, used)
    assert extent[0] == 0
    assert not data.any()
    assert compact(Rect(0, 0, 8, 8), data, (), 1, (extent, used)) is None


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
    old, new, changed = np.ones((4, 6, 9), np.float32), np.empty((4, 6, 9), np.float32), np.empty((6, 9), np.uint8)
    add, planes = np.zeros((4, 6, 9), np.float32), np.arange(4)
    assert kernels.apply_stamp(old, keep, add, planes, True, False, new, changed) == (2, 5, 3, 8)
    assert np.array_equal(changed != 0, keep != 1.0)


@pytest.mark.parametrize("kernel", [kernels.residual.compiled, kernels.residual.plain])
def test_a_residual_is_written_where_it_is_touched(kernel):
    rng = np.random.default_rng(3)
    value, predicted = on_grid(rng, 4, 12, 12), on_grid(rng, 4, 6, 8)
    touched = (rng.random((6, 8)) < 0.3).astype(np.uint8)
    before = np.zeros((4, 10, 11), np.int32)
    before[1, 9, 0] = -5
    data, used = before.copy(), np.empty(4, np.int32)
    changed, *extent = kernel(value, (3, 1), predicted, touched, (2, 3), data, used)
    wanted, measured = before.copy(), np.empty(4, np.int32)
    new = np.rint((value[:, 3:9, 1:9] - predicted) * 65536).astype(np.int32)
    wanted[:, 2:8, 3:11] = np.where(touched, new, 0)
    assert changed
    assert np.array_equal(data, wanted)
    assert tuple(extent) == kernels.extent(wanted, measured)
    assert np.array_equal(used, measured)
    assert not kernel(value, (3, 1), predicted, touched, (2, 3), data, used)[0]
