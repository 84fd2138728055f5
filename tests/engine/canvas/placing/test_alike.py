"""Where all pixels that tell of a place are the same, sampling takes one of them: to the bit what the weights make."""

from unittest.mock import patch

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas.placing import sampling
from engine.canvas.placing.pose import Pose
from engine.numeric.address import Rect

TAPS = 4
SCALES = st.sampled_from([(0.8660254037844387, 0.5), (1.3, 0.0), (0.6, -0.45), (1.0, 1e-9)])


def patched(seed: int, on_grid: bool):
    """Large patches of one colour each on nothing, some of them of values beyond those of colours; (4, 96, 96)."""
    chance = np.random.default_rng(seed)
    out = np.zeros((4, 96, 96), np.float32)
    for _ in range(6):
        x, y, width, height = chance.integers(0, 90, 2).tolist() + chance.integers(1, 60, 2).tolist()
        colour = np.rint(chance.uniform(-0.4, 2.3, 4) * 65536) / 65536 if on_grid else chance.uniform(0, 1, 4)
        out[:, y : y + height, x : x + width] = colour.astype(np.float32)[:, None, None]
    return out


@given(st.integers(0, 2**32), st.booleans(), SCALES, st.booleans())
@settings(max_examples=25, deadline=None)
def test_sampling_of_flat_paint_is_what_all_weights_make(seed, on_grid, turned, cut):
    pixels = patched(seed, on_grid)
    pose = Pose(at=(3, -5), turned=turned)
    part = Rect(10, 12, 80, 71) if cut else None

    def picture(level, rect):
        rows, columns = (np.clip(np.arange(*span), 0, 95) for span in ((rect.y0, rect.y1), (rect.x0, rect.x1)))
        return pixels[:, rows[:, None], columns]

    shown = sampling.sampled(picture, pose.similarity, 0, Rect(-20, -20, 60, 70), part)
    sample = sampling._sample

    def weighed(source, alike, *others):
        sample(source, np.zeros_like(alike), *others)

    with patch.object(sampling, "_sample", weighed):
        plainly = sampling.sampled(picture, pose.similarity, 0, Rect(-20, -20, 60, 70), part)
    assert (shown is None) == (plainly is None)
    assert shown is None or shown.tobytes() == plainly.tobytes()


@given(st.integers(0, 2**32), st.booleans(), st.integers(1, 96), st.integers(1, 96))
@settings(max_examples=25, deadline=None)
def test_places_are_alike_where_all_of_sixteen_pixels_are(seed, on_grid, width, height):
    pixels = np.ascontiguousarray(patched(seed, on_grid)[:, :height, :width])
    pixels.flags.writeable = False  # as what is sampled is: it is compiled once
    found = np.empty((height, width), np.uint8)
    sampling._find_alike(pixels, found)
    if not found.any():
        return  # few are, and none was looked for
    padded = np.pad(pixels, ((0, 0), (0, TAPS), (0, TAPS)), "edge")
    around = np.lib.stride_tricks.sliding_window_view(padded, (TAPS, TAPS), axis=(1, 2))[:, :height, :width]
    same = (around == pixels[..., None, None]).all(axis=(0, 3, 4))
    plain = ((np.rint(pixels * 65536) == pixels * 65536) & (abs(pixels) <= 2)).all(axis=0)
    assert np.array_equal(found != 0, same & plain)
