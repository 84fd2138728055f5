"""Kernels that lay the dabs of a frame, against their plain forms."""

import numpy as np
import pytest

from engine.brush import coat, discs
from engine.numeric.grid import SNAP


@pytest.mark.parametrize("count", [1, 7, 400])
def test_runs_bring_the_pairs_of_a_tile_together_in_order(count):
    rng = np.random.default_rng(count)
    dabs = np.column_stack(
        [rng.uniform(-600, 600, (count, 2)), rng.uniform(1, 250, count), *([np.full(count, 0.5)] * 3)]
    )
    bounds = discs.no_bounds()
    found = discs.as_discs(dabs, 0.0, 0.0, bounds)
    room = 64 * count + 64
    codes, which, inside = np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room, np.bool_)
    total, following = discs.list_pairs(found, 0, codes, which, inside)
    assert following == count
    order = np.argsort(codes[:total], kind="stable")
    plain = [(int(codes[i]), int(which[i]), bool(inside[i])) for i in order]

    runs = np.empty((room, 5), np.int64)
    made, following = discs.list_runs(found, 0, codes, which, inside, runs)
    assert following == count
    told = []
    for first, last, x, y, full in runs[:made].tolist():
        code = ((y + discs.HALF) << 32) + x + discs.HALF
        part = [(code, int(which[i]), bool(inside[i])) for i in range(first, last)]
        assert full == sum(entry[2] for entry in part)
        told += part
    assert told == plain
    assert bounds[4] == found[:, discs.CEILING].max()


def test_textured_paint_in_one_pass():
    rng = np.random.default_rng(3)
    keep = (rng.integers(0, 65537, (128, 128)) / 65536).astype(np.float32)
    colours = rng.normal(0.5, 0.4, (3, 128, 128)).astype(np.float32)
    amplitudes = rng.normal(0, 0.3, 6).astype(np.float32)
    add = np.empty((10, 128, 128), np.float32)
    coat.load(keep, colours, amplitudes, add)
    weight = np.float32(1) - keep
    snapped = lambda values: (values + SNAP) - SNAP  # noqa: E731
    assert np.array_equal(add[3], weight)
    assert np.array_equal(add[:3], snapped(weight * colours))
    assert np.array_equal(add[4:], snapped(weight * amplitudes[:, None, None]))
    plain = np.empty((4, 128, 128), np.float32)
    coat.lay(keep, colours[:, 5, 7].copy(), plain)
    assert np.array_equal(plain[3], weight)
    assert np.array_equal(plain[:3], snapped(weight * colours[:, 5, 7, None, None]))
