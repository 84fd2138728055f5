"""A picture laid down at once is what its commit makes."""

import numpy as np
import pytest
from strokes import ArrayEdit, fill

from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate
from engine.canvas.fold import fold
from engine.canvas.ground import laid, unchanged
from engine.canvas.store import Pyramid
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
