"""Rock: a function of place, with its stated spectrum, that neither fades nor drifts at any depth."""

import functools
import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.address import Rect
from engine.numeric.detail import add_expanded, parents
from engine.numeric.hashing import MASK32, MASK64, fold_key, mixed
from engine.texture.rock import PEAK, SPREAD, Rock, octave_variance

ORIGINS = st.one_of(st.integers(-300, 300), st.integers(-(2**90), 2**90))
H = st.floats(0, 1)
FAR = 3**52 * 2  # some place well beyond 2^64


def expand(p: np.ndarray) -> np.ndarray:
    """E of (h + 2, w + 2) in float64, by its definition."""
    out = np.empty((2 * p.shape[0] - 4, 2 * p.shape[1] - 4))
    c = p[1:-1, 1:-1]
    for r, v in enumerate((p[:-2], p[2:])):
        for s, h in enumerate((slice(0, -2), slice(2, None))):
            out[r::2, s::2] = (9 * c + 3 * v[:, 1:-1] + 3 * p[1:-1, h] + v[:, h]) / 16
    return out


def noise(rock: Rock, level: int, rect: Rect) -> np.ndarray:
    """One octave, pixel by pixel in Python: block noise of variance 1."""
    out = np.empty((rect.height, rect.width))
    fold = functools.cache(fold_key)
    octave = fold_key(0x726F636B, rock.seed, rock.base, level)
    for j in range(rect.height):
        for i in range(rect.width):
            x, y = (rect.x0 + i) & ~1, (rect.y0 + j) & ~1
            h = mixed(((y & MASK32) << 32 | (x & MASK32)) ^ fold(octave, x >> 32, y >> 32)) & MASK64
            a, b, c = (((h >> (21 * k)) & 0x1FFFFF) / 2**20 - 1 + 2.0**-21 for k in range(3))
            right, below = (rect.x0 + i) & 1, (rect.y0 + j) & 1
            out[j, i] = ((a + b + c, a - b - c), (-a + b - c, -a - b + c))[below][right]
    return out


def cascade(rock: Rock, level: int, rect: Rect, factors: np.ndarray) -> np.ndarray:
    """sum of factors[m] E^m n_(level - m), by recursion."""
    values = noise(rock, level, rect) * factors[0]
    if factors.size > 1:
        above = parents(rect).evened()
        rows, columns = parents(rect).slices(above)
        values += expand(cascade(rock, level - 1, above, factors[1:])[rows, columns])
    return values


@settings(deadline=None, max_examples=8)
@given(ORIGINS, ORIGINS, H, st.integers(0, 70), st.floats(2, 64), st.integers(-5, 5))
def test_compiled_cascade_against_plain(x, y, roughness, up, period, seed):
    rock = Rock(3, period, roughness, seed)
    rect = Rect.at(x, y, 8, 6).evened()
    plain = cascade(rock, 3 + up, rect, rock.weights(3 + up))
    assert np.abs(rock.appearance(3 + up, rect)[0] - plain).max() < 3e-6


@pytest.mark.parametrize("edge", [0, 1 << 32, -(1 << 70)])
@pytest.mark.parametrize("level", [7, 40])
def test_across_the_boundaries_of_keys(edge, level):
    rock = Rock(0, 8.0, 0.5, 1)
    rect = Rect.at(edge - 6, edge - 4, 12, 8)
    plain = cascade(rock, level, rect, rock.weights(level))
    assert np.abs(rock.appearance(level, rect)[0] - plain).max() < 3e-6


@settings(deadline=None, max_examples=60)
@given(ORIGINS, ORIGINS, H, st.integers(1, 200), st.floats(2, 4096), st.data())
def test_any_rectangle_holds_the_same_values(x, y, roughness, up, period, data):
    rock = Rock(-4, period, roughness, 9)
    whole = Rect.at(x, y, 61, 50)
    a, b = sorted(data.draw(st.lists(st.integers(0, 61), min_size=2, max_size=2, unique=True)))
    c, d = sorted(data.draw(st.lists(st.integers(0, 50), min_size=2, max_size=2, unique=True)))
    part = Rect(x + a, y + c, x + b, y + d)
    rows, columns = part.slices(whole)
    for values in (rock.appearance, rock.bandpass):
        small = values(up - 4, part)
        assert (small == values(up - 4, whole)[:, rows, columns]).all()
        assert small.dtype == np.float32
        assert small.flags.c_contiguous


@settings(deadline=None, max_examples=30)
@given(ORIGINS, ORIGINS, H, st.integers(1, 200), st.floats(2, 4096))
def test_bandpass_is_what_expand_leaves_out(x, y, roughness, up, period):
    rock = Rock(0, period, roughness, 2)
    rect = Rect.at(x, y, 40, 36).evened()
    coarse = rock.appearance(up - 1, parents(rect))[0].astype(np.float64)
    assert np.abs(expand(coarse) + rock.bandpass(up, rect)[0] - rock.appearance(up, rect)[0]).max() < 3e-6


@settings(deadline=None, max_examples=8)
@given(st.integers(-(2**40), 2**40), st.integers(-(2**40), 2**40), H, st.floats(2, 500))
def test_a_cascade_of_40_levels_reproduces_s(x, y, roughness, period):
    rock = Rock(0, period, roughness, 4)
    rects = [Rect.at((x << 40) + 12345678, (y << 40) - 7654321, 24, 20).evened()]
    for _ in range(40):
        rects.append(parents(rects[-1]).evened())
    values = rock.appearance(0, rects[40])[0].astype(np.float64)
    for level in range(1, 41):
        rows, columns = parents(rects[40 - level]).slices(rects[41 - level])
        values = expand(values[rows, columns]) + rock.bandpass(level, rects[40 - level])[0]
    assert np.abs(values - rock.appearance(40, rects[0])[0]).max() < 1e-5


@pytest.mark.parametrize("roughness", [0.0, 0.3, 1.0])
def test_the_first_ten_octaves_only_add_noise(roughness):
    """Down to depth 10 each level adds its own octave, 2^-H of the one before, and nothing else."""
    rock = Rock(1, 2.0, roughness)
    gains = [rock.changes(depth) for depth in range(1, 11)]
    assert all(g.size == 1 for g in gains)
    ratios = np.array([b[0] / a[0] for a, b in itertools.pairwise(gains)])
    assert np.abs(ratios - 2**-roughness).max() < 1e-6


@pytest.mark.parametrize("period", [2.0, 4096.0])
@pytest.mark.parametrize("roughness", [0.0, 0.5, 1.0])
def test_spread_and_length_of_the_cascade(roughness, period):
    rock = Rock(0, period, roughness)
    for depth in (rock.settled, rock.settled + 1, rock.settled + 3, 30, 200):
        w = rock.weights(rock.root + depth).astype(np.float64)
        variance = sum(v * v * octave_variance(m) for m, v in enumerate(w))
        assert abs(np.sqrt(variance) - SPREAD) < 1e-6
        assert rock.changes(rock.root + depth).size <= 31  # the kernel's shifts are right up to there
    assert np.argmax(Rock(0, 2.0, 0.5).weights(200)) == PEAK


def test_s_varies_steadily_with_the_period():
    rect = Rect.at(11, -500, 200, 200)
    periods = 2 ** np.linspace(4.9, 6.1, 25)
    fields = [Rock(0, float(p), 0.5, 3).appearance(0, rect) for p in periods]
    for a, b in itertools.pairwise(fields):
        assert np.sqrt(((a - b) ** 2).mean()) < 0.05


def test_octave_variance_against_a_sample():
    rect = Rect.at(0, 0, 256, 256)
    for age in (0, 1, 4):
        factors = np.zeros(age + 1, np.float32)
        factors[age] = 1.0
        sample = Rock(0, 2.0, 0.5, 1)._cascade(20, rect, factors)
        assert abs(sample.var() / octave_variance(age) - 1) < 0.1


def spectrum(rock: Rock, level: int, place: int, n: int = 1024) -> np.ndarray:
    """Power under a Hann window."""
    s = rock.appearance(level, Rect.at(place, -place, n, n))[0].astype(np.float64)
    window = np.hanning(n)
    return np.abs(np.fft.rfft2((s - s.mean()) * window[:, None] * window)) ** 2


@pytest.mark.parametrize("roughness", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("level", [9, 90])
def test_amplitude_spectrum_falls_as_one_plus_h(roughness, level):
    n = 1024
    power = sum(
        spectrum(Rock(0, 2.0, roughness, seed), level, seed * 7777 + (FAR if level > 64 else 0)) for seed in range(4)
    )
    fx, fy = np.fft.rfftfreq(n)[None], np.fft.fftfreq(n)[:, None]
    f = np.hypot(fx, fy)
    bins = np.geomspace(2**-7, 2**-2.5, 19)
    centres, amplitudes, sides = [], [], []
    for lo, hi in itertools.pairwise(bins):
        ring = (f >= lo) & (f < hi)
        centres.append(np.log(np.sqrt(lo * hi)))
        amplitudes.append(np.log(power[ring].mean()) / 2)
        sides.append(np.log(power[ring & (np.abs(fx) > 2 * np.abs(fy))].mean()))
        sides[-1] -= np.log(power[ring & (np.abs(fy) > 2 * np.abs(fx))].mean())
    assert abs(np.polyfit(centres, amplitudes, 1)[0] + 1 + roughness) < 0.06
    assert abs(np.mean(sides[4:])) < 0.1  # as strong along x as along y


def test_no_grid_shows():
    """Steps across the borders of coarse blocks are as large as steps inside them."""
    s = np.concatenate([Rock(0, 2.0, 0.5, seed).appearance(9, Rect.at(0, 0, 512, 512))[0] for seed in range(4)])
    step = np.abs(np.diff(s.astype(np.float64), axis=1)) ** 2
    border = (np.arange(511) + 1) % 32 == 0
    assert abs(step[:, border].mean() / step[:, ~border & (np.arange(511) % 2 == 1)].mean() - 1) < 0.06


def views(rock: Rock, level: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(level)
    found = []
    for _ in range(count):
        x, y = (int(rng.integers(-(2**40), 2**40)) << max(0, level - 30) for _ in range(2))
        s = rock.appearance(level, Rect.at(x, y, 256, 256))
        found.append((s.std(), s.mean()))
    return tuple(np.array(found).T)


@pytest.mark.parametrize("roughness", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("period", [8.0, 200.0])
def test_contrast_and_mean_stay_in_their_band_at_every_depth(roughness, period):
    """In any view of 256 x 256 pixels, from the base to level 200.  Around the tenth octave a smooth rock (H = 1) is
    at its faintest, as its spectrum says; from some six levels later on it has come back for good."""
    rock = Rock(0, period, roughness, 3)
    for level in (0, 2, 4, 6, 8, 10, 12, 14, 16, 20, 40, 120, 200):
        contrast, mean = views(rock, level, 5)
        settled = level - rock.root >= rock.settled + 6
        assert contrast.min() > (0.08 if settled else 0.25 * 2 ** (-3.4 * roughness))
        assert contrast.max() < 0.7
        assert np.abs(mean).max() < 1.25
        assert abs(mean.mean()) < 0.8


def test_seeds_bases_and_levels_are_unrelated():
    rect = Rect.at(0, 0, 256, 256)
    rocks = [Rock(0, 2.0, 0.0, 1), Rock(0, 2.0, 0.0, 2), Rock(1, 4.0, 0.0, 1)]
    fields = [r.bandpass(level, rect)[0] for r in rocks for level in (4, 5)]
    for i, a in enumerate(fields):
        for b in fields[:i]:
            assert abs((a * b).mean() / (a.std() * b.std())) * 256 < 5


def test_nothing_to_add_at_the_base_and_above():
    rock = Rock(5, 16.0)
    assert rock.bandpass(5, Rect.at(0, 0, 8, 8)) is None
    assert rock.bandpass(-9, Rect.at(0, 0, 8, 8)) is None
    with pytest.raises(ValueError, match="coarser than the base level 5"):
        rock.appearance(4, Rect.at(0, 0, 8, 8))


def test_lasting_rock_is_the_same_down_to_the_settled_depth_and_keeps_its_octaves_beyond():
    renewed, lasting = Rock(3, 40.0, 0.8, 5), Rock(3, 40.0, 0.8, 5, renew=False)
    rect = Rect.at(1000, -700, 24, 24)
    assert renewed.key != lasting.key
    deep = lasting.root + lasting.settled
    for level in range(4, deep + 1):
        assert np.array_equal(lasting.bandpass(level, rect), renewed.bandpass(level, rect))
    assert np.array_equal(lasting.appearance(deep, rect), renewed.appearance(deep, rect))
    sizes = [lasting.bandpass(level, rect).std() for level in range(deep - 2, deep + 30)]
    assert np.allclose(np.diff(np.log2(sizes)), -0.8, atol=0.25)
    assert lasting.bandpass(deep + 1, rect).std() < renewed.bandpass(deep + 1, rect).std()


@pytest.mark.parametrize("level", [20, 29, 47])
def test_lasting_rock_is_what_it_adds_up_to_at_any_depth(level):
    rock, rect = Rock(0, 40.0, 0.7, 5, renew=False), Rect.at(700 << level - 10, 300 << level - 10, 20, 16)
    seen = rock.appearance(level, rect)
    above = rock.appearance(level - 1, parents(rect))
    carried = np.zeros_like(seen)
    add_expanded(carried, above)
    assert np.allclose(seen, carried + rock.bandpass(level, rect), atol=1e-5)
    part = Rect(rect.x0 + 3, rect.y0 + 5, rect.x1 - 2, rect.y1 - 1)
    assert np.array_equal(rock.appearance(level, part), seen[:, *part.slices(rect)])
