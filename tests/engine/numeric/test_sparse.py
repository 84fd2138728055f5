"""The field of sparse convolution: a function of place, white where its points are, as loud as it is computed to be."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.address import Rect
from engine.numeric.hashing import MASK32, MASK64, fold_key, mixed
from engine.numeric.pyramid import reduce
from engine.numeric.sparse import Impulse, Noise, field, reach, spread

ORIGINS = st.one_of(
    st.integers(-300, 300),
    st.integers(-(2**90), 2**90),
    st.sampled_from([(1 << 32) - 30, (1 << 36) - 20, -(1 << 45) - 9, 16 * (1 << 32) - 25, -25]),
)
SHAPES = st.tuples(st.sampled_from([1, 3]), st.integers(1, 40), st.integers(1, 40))
NOISES = st.builds(Noise, st.integers(0, MASK64), st.floats(0.5, 30.0), st.sampled_from([0, 2, 3, 5, 256]))


def response(shape, seed=0):
    return np.random.default_rng(seed).standard_normal(shape).astype(np.float32)


def weight(g, levels):
    bits = g >> 40
    if levels < 2:
        size = 0.5 + (bits >> 1) * (np.sqrt(11.25) - 1.5) / 2 / 2**23
        return size if bits & 1 else -size
    return (((bits * levels) >> 24) - (levels - 1) / 2) * np.sqrt(12 / (levels**2 - 1))


def plain(copied, noise, rect):
    """The field by its definition, point by point in Python: float64."""
    channels, height, width = copied.shape
    h, w = max(8, height // 2), max(8, width // 2)
    out = np.zeros((channels, rect.height + 2 * height, rect.width + 2 * width))
    mean = noise.density * (w * h / (width * height))
    for j in range((rect.y0 - height) // h, (rect.y1 + height) // h + 1):
        for i in range((rect.x0 - width) // w, (rect.x1 + width) // w + 1):
            key = fold_key(noise.key, i >> 32, j >> 32)
            cell = mixed(((j & MASK32) << 32 | (i & MASK32)) ^ key)
            for n in range(int(mean) + ((mixed(cell) >> 40) / 2**24 < mean - int(mean))):
                g = mixed((cell + (n + 1) * 0x9E3779B97F4A7C15) & MASK64)
                x = i * w + ((g & 0xFFFFF) * w >> 20) - width // 2 - rect.x0 + width
                y = j * h + ((g >> 20 & 0xFFFFF) * h >> 20) - height // 2 - rect.y0 + height
                if 0 <= x <= rect.width + width and 0 <= y <= rect.height + height:
                    out[:, y : y + height, x : x + width] += weight(g, noise.levels) * copied
    return out[:, height : height + rect.height, width : width + rect.width]


@settings(deadline=None, max_examples=25)
@given(ORIGINS, ORIGINS, SHAPES, NOISES)
def test_compiled_field_against_plain(x, y, shape, noise):
    copied = response(shape)
    rect = Rect.at(x, y, 13, 9)
    found = field(Impulse.of(copied), noise, rect)
    assert found.dtype == np.float32
    assert np.abs(found - plain(copied, noise, rect)).max() < 1e-4


@settings(deadline=None, max_examples=25)
@given(ORIGINS, ORIGINS, SHAPES, NOISES, st.integers(0, 6), st.data())
def test_any_rectangle_holds_the_same_bits(x, y, shape, noise, coarser, data):
    impulse = Impulse.of(response(shape))
    impulse = impulse.seen(coarser) if coarser else impulse
    whole = Rect.at(x, y, 61, 50)
    a, b = sorted(data.draw(st.lists(st.integers(0, 61), min_size=2, max_size=2, unique=True)))
    c, d = sorted(data.draw(st.lists(st.integers(0, 50), min_size=2, max_size=2, unique=True)))
    part = Rect(x + a, y + c, x + b, y + d)
    rows, columns = part.slices(whole)
    assert (field(impulse, noise, part) == field(impulse, noise, whole)[:, rows, columns]).all()


@settings(deadline=None, max_examples=30)
@given(ORIGINS, ORIGINS, SHAPES, NOISES, st.integers(1, 3))
def test_coarser_levels_are_the_means_of_finer_ones(x, y, shape, noise, coarser):
    impulse = Impulse.of(response(shape))
    rect = Rect.at(x, y, 12, 10)
    fine = field(impulse, noise, rect.zoomed(coarser))
    for _ in range(coarser):
        fine = reduce(fine)
    assert np.abs(field(impulse.seen(coarser), noise, rect) - fine).max() < 2e-4


@pytest.mark.parametrize("levels", [0, 2, 3, 16])
@pytest.mark.parametrize("density", [1.0, 10.0, 60.0])
def test_the_spread_is_known_before_the_field_is_made(density, levels):
    copied = response((3, 24, 17))
    found = field(Impulse.of(copied), Noise(9, density, levels), Rect.at(5, 7, 1000, 1000))
    assert abs(found.std() / spread(copied, density) - 1) < 0.05
    assert abs(found.mean() / found.std()) < 0.02


@pytest.mark.parametrize("levels", [2, 3, 7])
def test_weights_are_quantised(levels):
    dot = np.ones((1, 1, 1), np.float32)
    found = field(Impulse.of(dot), Noise(1, 0.05, levels), Rect.at(0, 0, 400, 400))
    lone = np.unique(found[np.abs(found) <= (levels - 1) * 3.5 / levels])
    steps = lone / np.sqrt(12 / (levels**2 - 1)) + (levels - 1) / 2
    assert len({round(float(s) * 2) for s in steps}) >= levels
    assert np.abs(steps * 2 - np.rint(steps * 2)).max() < 1e-4


def test_points_are_white():
    """The field of a single pixel is its points: no frequency stands out, no place repeats, and seeds differ."""
    dot = Impulse.of(np.ones((1, 1, 1), np.float32))
    rect = Rect.at(-700, 300, 512, 512)
    a, b = (field(dot, Noise(seed, 0.2), rect)[0].astype(np.float64) for seed in (1, 2))
    power = np.square(np.abs(np.fft.fft2(a))) / a.size / a.var()
    blocks = power.reshape(16, 32, 16, 32).mean((1, 3))
    assert abs(blocks - 1).max() < 0.2
    assert abs(np.corrcoef(a.ravel(), b.ravel())[0, 1]) < 0.01


def test_points_outside_the_extent_are_left_out():
    impulse, noise, rect = Impulse.of(response((1, 20, 12))), Noise(3, 8.0), Rect.at(40, -9, 60, 50)
    around = reach(impulse, rect)
    everywhere = np.ones((around.height, around.width), np.uint8)
    assert (field(impulse, noise, rect, everywhere) == field(impulse, noise, rect)).all()
    left = everywhere.copy()
    left[:, 30:] = 0
    found = field(impulse, noise, rect, left)
    assert not (found == field(impulse, noise, rect)).all()
    edge = around.x0 + 30 - rect.x0
    assert found[:, :, : edge - 12].any()
    assert (found[:, :, edge + 6 :] == 0).all()
    part = Rect(50, 0, 70, 20)
    rows, columns = reach(impulse, part).slices(around)
    there = field(impulse, noise, part, np.ascontiguousarray(left[rows, columns]))
    rows, columns = part.slices(rect)
    assert (there == found[:, rows, columns]).all()


def test_nothing_is_asked_for():
    assert field(Impulse.of(response((3, 4, 4))), Noise(1, 10.0), Rect(5, 5, 5, 9)).shape == (3, 4, 0)
