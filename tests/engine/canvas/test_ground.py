"""A picture laid down at once is what its commit makes."""

import numpy as np
import pytest
from strokes import ArrayEdit, fill

from engine.canvas.attenuate import fold
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate, shown
from engine.canvas.ground import laid, unchanged
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.colour import from_rgba8


def picture(width, height, seed=0):
    rng = np.random.default_rng(seed)
    pixels = rng.integers(0, 256, (height, width, 4), np.uint8)
    pixels[: height // 3, : width // 2, 3] = 0
    pixels[height // 2 :, width // 3 :] = (200, 40, 90, 255)
    return from_rgba8(pixels)


@pytest.mark.parametrize(("width", "height", "x", "y"), [(1, 1, 0, 0), (301, 203, -77, 35), (128, 256, 128, -128)])
def test_the_records_are_those_of_the_commit(width, height, x, y):
    values = picture(width, height)
    rect = Rect.at(x, y, width, height)
    fast = laid(lambda part: values[:, *part.slices(rect)], rect)
    slow = commit(Pyramid(), ArrayEdit(0, x, y, np.zeros((height, width), np.float32), values))
    pairs = list(zip(fast.all_records(), slow.all_records(), strict=True))
    assert pairs
    for (key, a), (other, b) in pairs:
        assert (key, a.rect, a.data.dtype) == (other, b.rect, b.data.dtype)
        assert (a.data == b.data).all()
    assert (evaluate(fast, 0, rect).data == values).all()


@pytest.mark.parametrize("level", [-3, -1, 0, 1, 3])
def test_a_ground_shows_its_picture_before_its_finest_residuals_are_made(level):
    values = from_rgba8(np.random.default_rng(1).integers(0, 256, (700, 800, 4), np.uint8))
    rect = Rect.at(-77, 35, 800, 700)
    ground = laid(lambda part: values[:, *part.slices(rect)], rect, b"png")
    slow = commit(Pyramid(), ArrayEdit(0, -77, 35, np.zeros((700, 800), np.float32), values))
    at = Rect(-90, 20, 730, 740).zoomed(level)
    at = at.intersect(Rect.at(at.x1 - 600, at.y1 - 600, 600, 600))
    expected = evaluate(slow, level, at).data
    for cache in (None, TileCache(1 << 24)):
        assert (evaluate(ground, level, at, cache).data == expected).all()
    assert (shown(ground, level, at) == expected).all()
    assert to_be_made(ground) == 5 * 4 + 2 * 1  # all tiles of two levels that lie within the picture
    painted = commit(ground, fill(0, 150, 200, 20, 20))
    assert 16 < to_be_made(painted) < 22
    again = commit(slow, fill(0, 150, 200, 20, 20))
    assert (evaluate(painted, level, at).data == evaluate(again, level, at).data).all()


def to_be_made(pyramid):
    """How many records have no data yet."""
    missing = 0
    for _, record in pyramid.all_records():
        try:
            object.__getattribute__(record, "held")
        except AttributeError:
            missing += 1
    return missing


def test_paint_changes_only_the_records_it_touches():
    values = picture(700, 500)
    rect = Rect.at(0, 0, 700, 500)
    ground = laid(lambda part: values[:, *part.slices(rect)], rect, b"png")
    painted = fold(commit(ground, fill(0, 10, 10, 20, 20)))
    kept = [unchanged(painted, key, record) for key, record in painted.all_records()]
    assert painted.ground is ground.ground
    assert 0 < kept.count(False) < len(kept) / 2
    assert all(unchanged(ground, key, record) for key, record in ground.all_records())


def test_a_picture_of_nothing_is_nothing():
    rect = Rect.at(5, 5, 40, 40)
    assert not laid(lambda part: np.zeros((4, part.height, part.width), np.float32), rect).levels
