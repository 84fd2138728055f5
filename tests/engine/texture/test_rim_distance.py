"""How far inside a region its pixels lie: against steps counted plainly."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.texture.example.rim_distance import rim_distance

WAYS = [(j, i, 3 if i == 0 or j == 0 else 4) for j in (-1, 0, 1) for i in (-1, 0, 1) if i or j]


def plain(mask, width, n):
    """From pixel to pixel until nothing changes."""
    far = min(254, max(3, (3 * width) >> n))
    out = np.where(mask > 0, far, 0)
    while True:
        padded, nearer = np.pad(out, 1, constant_values=far), out.copy()
        for j, i, step in WAYS:
            nearer = np.minimum(nearer, padded[1 + j : 1 + j + len(out), 1 + i : 1 + i + len(out[0])] + step)
        if (nearer == out).all():
            return np.minimum(255, out * 32 // far * 8)
        out = nearer


@settings(deadline=None, max_examples=30)
@given(st.integers(1, 30), st.integers(1, 30), st.integers(3, 160), st.integers(0, 4), st.integers(0, 99))
def test_it_is_the_fewest_steps_to_the_outside(height, wide, width, n, seed):
    random = np.random.default_rng(seed)
    mask = (random.random((height, wide)) < random.choice([0.5, 0.95, 1.0])).astype(np.uint8)
    out = np.empty_like(mask)
    rim_distance(mask, width, n, out)
    assert (out == plain(mask, width, n)).all()
