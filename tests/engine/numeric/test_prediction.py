"""Linear prediction: it finds the filter that made a texture, stays stable, and continues the texture."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.poles import pole_radius
from engine.numeric.prediction import RADIUS, fit, half_plane, noise_at


def made(taps: dict[tuple[int, int], float], shape: tuple[int, int], seed: int = 1) -> np.ndarray:
    """A texture by the plain recursion."""
    noise = np.random.default_rng(seed).standard_normal((shape[0] + 40, shape[1] + 40))
    out = np.zeros_like(noise)
    for y in range(4, out.shape[0]):
        for x in range(4, out.shape[1] - 4):
            out[y, x] = noise[y, x] + sum(a * out[y + dy, x + dx] for (dy, dx), a in taps.items())
    return out[40:, 20:-20].astype(np.float32)


TAPS = {(0, -1): 0.5, (-1, 0): 0.4, (-1, 1): -0.2, (-1, -1): 0.1}


def test_the_filter_of_a_texture_is_found_again():
    found = fit(made(TAPS, (120, 120)), 2)
    assert found.stable
    assert found.shrunk == 1.0
    assert found.residual == pytest.approx([1.0], abs=0.03)
    for (dy, dx), value in zip(found.offsets, found.coefficients[0], strict=True):
        assert value == pytest.approx(TAPS.get((int(dy), int(dx)), 0.0), abs=0.04)


def test_the_spectrum_has_the_variance_and_the_shape_of_the_texture():
    texture = made(TAPS, (128, 128))
    power = fit(texture, 2).spectrum(128, 128)[0]
    assert power.mean() == pytest.approx(texture.var(), rel=0.1)
    measured = np.fft.fftshift(np.abs(np.fft.fft2(texture - texture.mean())) ** 2 / texture.size)
    blocks = [p.reshape(16, 8, 16, 8).mean(axis=(1, 3)).ravel() for p in (power, measured)]
    assert np.corrcoef(np.log(blocks))[0, 1] > 0.95


def test_an_unstable_fit_is_shrunk_and_says_so():
    """Values that grow to the right and down can only be foretold by an unstable filter."""
    y, x = np.mgrid[0:24, 0:24]
    found = fit((1.2 ** (y + x) * np.cos(x)).astype(np.float32), 2)
    assert found.shrunk < 1.0
    assert found.radius <= RADIUS
    assert found.stable
    quiet = np.zeros((1, 400, 64), np.float32)
    out = found.continue_into(quiet, np.ones((400, 64), bool), quiet)
    assert np.isfinite(out).all()


@pytest.mark.parametrize(("value", "stable"), [(0.98, True), (1.02, False)])
@pytest.mark.parametrize("place", [(0, -1), (-1, 0), (-1, 1), (-2, -1)])
@pytest.mark.parametrize("arithmetic", [LIBRARY, EVERYWHERE])
def test_the_pole_of_a_single_coefficient_is_known(place, value, stable, arithmetic):
    offsets = half_plane(2)
    taps = np.where((offsets == place).all(axis=1), value, 0.0)
    assert (pole_radius(2, offsets, taps, arithmetic) < 1.0) == stable


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 8), st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.integers(0, 999))
def test_poles_are_found_without_eigenvalues(reach, size, gaps, seed):
    """To the eigenvalues' own error, which grows where poles meet."""
    offsets, drawn = half_plane(reach), np.random.default_rng(seed)
    taps = size * drawn.standard_normal(len(offsets)) * (drawn.random(len(offsets)) >= gaps)
    right = pole_radius(reach, offsets, taps)
    assert pole_radius(reach, offsets, taps, EVERYWHERE) == pytest.approx(
        right, rel=1e-7, abs=1e-2 if right < 0.1 else 0
    )


def test_a_filter_is_nearly_the_same_in_both_arithmetics():
    y, x = np.mgrid[0:24, 0:24]
    for sample in ((1.2 ** (y + x) * np.cos(x)).astype(np.float32), made(TAPS, (40, 50))):
        one, other = (fit(sample, 2, arithmetic) for arithmetic in (LIBRARY, EVERYWHERE))
        assert other.shrunk == one.shrunk
        assert other.radius == pytest.approx(one.radius, rel=1e-6)
        assert np.allclose(other.coefficients, one.coefficients, rtol=1e-6)
        assert np.allclose(other.mixing, one.mixing, rtol=1e-6)


def plain(p, values, mask, noise, origin=(0, 0)):
    """`continue_into` without a kernel."""
    channels, height, width = values.shape
    out = values.astype(np.float64)
    for c in range(channels):
        for y in range(height):
            for x in range(width):
                if not mask[y, x]:
                    continue
                total = p.mean[c] + p.mixing[c] @ noise[:, y, x]
                for (dy, dx), a in zip(p.offsets.tolist(), p.coefficients[c], strict=True):
                    v, u = y + dy, x + dx
                    inside = v >= 0 and 0 <= u < width and (not mask[v, u] or (v, u) < (y, x))
                    row, column = (v + origin[1]) % p.sample.shape[1], (u + origin[0]) % p.sample.shape[2]
                    before = out[c, v, u] if inside else p.sample[c, row, column]
                    total += a * (before - p.mean[c])
                out[c, y, x] = total
    return out


def test_the_kernel_does_as_the_plain_form():
    rng = np.random.default_rng(3)
    p = fit(rng.random((3, 20, 17), np.float32), 2)
    values = rng.random((3, 13, 11), np.float32)
    mask = rng.random((13, 11)) < 0.6
    noise = noise_at(5, -3, 7, values.shape)
    out = p.continue_into(values, mask, noise, origin=(-3, 7 + 10**30))
    assert np.allclose(out, plain(p, values, mask, noise, (-3, 7 + 10**30)), atol=1e-5)
    assert np.array_equal(out[:, ~mask], values[:, ~mask])
    assert np.array_equal(out, p.continue_into(values, mask, noise, origin=(-3, 7 + 10**30)))


def test_what_is_unknown_is_not_used_as_memory():
    p = fit(made(TAPS, (40, 40)), 2)
    values = np.full((1, 8, 8), 1e6, np.float32)
    mask = np.zeros((8, 8), bool)
    mask[3:6, 3:6] = True
    out = p.continue_into(values, mask, np.zeros_like(values), known=np.zeros((8, 8), bool))
    assert np.abs(out[0][mask]).max() < 10
    assert (out[0][~mask] == 1e6).all()


def test_a_continued_texture_is_like_its_sample():
    texture = made(TAPS, (100, 100))
    p = fit(texture, 2)
    out = p.continue_into(
        np.zeros((1, 100, 100), np.float32), np.ones((100, 100), bool), noise_at(1, 0, 0, (1, 100, 100))
    )
    assert out.std() == pytest.approx(texture.std(), rel=0.15)
    assert out.mean() == pytest.approx(texture.mean(), abs=0.25)


def test_colours_vary_together_as_in_the_sample():
    grey = made(TAPS, (64, 64))
    tint = made(TAPS, (64, 64), 2)
    p = fit(np.stack([grey, grey + 0.3 * tint, -grey]), 1)
    shape = (3, 80, 80)
    out = p.continue_into(np.zeros(shape, np.float32), np.ones(shape[1:], bool), noise_at(9, 0, 0, shape))
    assert np.allclose(np.corrcoef(out.reshape(3, -1)), np.corrcoef(p.sample.reshape(3, -1)), atol=0.06)


@given(st.integers(1, 9), st.integers(1, 9), st.integers(1, 4), st.booleans())
@settings(deadline=None, max_examples=30)
def test_samples_of_any_size_give_a_stable_filter(height, width, reach, flat):
    sample = (
        np.full((height, width), 0.5, np.float32) if flat else np.random.default_rng(height).random((height, width))
    )
    p = fit(sample, reach)
    assert p.stable
    assert p.reach <= reach
    values = np.zeros((1, 5, 6), np.float32)
    assert np.isfinite(p.continue_into(values, np.ones((5, 6), bool), values)).all()


def test_noise_is_of_the_place_and_white():
    whole = noise_at(7, -5, 2**40, (2, 64, 80))
    assert np.array_equal(noise_at(7, 5, 2**40 + 3, (2, 20, 30)), whole[:, 3:23, 10:40])
    assert abs(whole.mean()) < 0.03
    assert whole.std() == pytest.approx(1.0, abs=0.03)
    assert abs(np.corrcoef(whole.reshape(2, -1))[0, 1]) < 0.05


@pytest.mark.parametrize("sample", [np.zeros((0, 4)), np.full((3, 3), np.nan), np.zeros((2, 2, 2, 2))])
def test_what_is_no_sample_is_refused(sample):
    with pytest.raises(ValueError, match="prediction"):
        fit(sample)
