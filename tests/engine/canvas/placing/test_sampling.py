"""What a placement shows that is turned or scaled: each pixel is weighed of 4 x 4, to the bit."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numba import config

from engine.canvas.placing import sampling
from engine.canvas.placing.pose import Pose
from engine.numeric.address import Rect
from engine.numeric.grid import snap

TAPS = 4
SCALES = st.sampled_from([(0.8660254037844387, 0.5), (1.3, 0.0), (0.6, -0.45), (1.0, 1e-9)])
SPAN = 97
SHOWN = Rect(-20, -20, 60, 70)


def weighed(pixels, similarity, x, y):
    """One pixel, all sums in their order."""
    level, rect, weights = sampling.weights_at(similarity, 0, x, y)
    half, table = 1 << 31, sampling._table(round(sampling.density(similarity) * 16))
    u, v = (value - (1 << 39) + half for value in similarity.back((2 * x + 1, 2 * y + 1), 0, level, sampling.BITS))
    across, down = table[(u >> 32) & 255], table[(v >> 32) & 255]
    np.testing.assert_array_equal(weights, down[:, None] * across)
    out = np.zeros(4, np.float32)
    for j in range(TAPS):
        row = np.zeros(4, np.float32)
        for i in range(TAPS):
            row += across[i] * pixels[:, (rect.y0 + j) % SPAN, (rect.x0 + i) % SPAN]
        out += down[j] * row
    alpha = min(max(np.float32(snap(out[3])), np.float32(0)), np.float32(1))
    return [*(min(max(np.float32(snap(value)), np.float32(0)), alpha) for value in out[:3]), alpha]


@given(st.integers(0, 2**32), SCALES, st.lists(st.tuples(st.integers(-20, 59), st.integers(-20, 69)), max_size=20))
@settings(max_examples=20, deadline=None)
def test_a_pixel_is_weighed_of_sixteen_to_the_bit(seed, turned, places):
    pose = Pose(at=(9, -8), turned=turned)
    pixels = np.random.default_rng(seed).uniform(-0.2, 1.2, (4, SPAN, SPAN)).astype(np.float32)

    def picture(level, rect):
        assert level == sampling.source_level(pose.similarity, 0)
        rows, columns = (np.arange(*span) % SPAN for span in ((rect.y0, rect.y1), (rect.x0, rect.x1)))
        return pixels[:, rows[:, None], columns]

    found = sampling.sampled(picture, pose.similarity, 0, SHOWN, None)
    for x, y in places:
        np.testing.assert_array_equal(found[:, y + 20, x + 20], weighed(pixels, pose.similarity, x, y))
    assert found.min() >= 0
    assert found.max() <= 1
    assert not config.SLP_VECTORIZE  # other kernels are compiled as ever
