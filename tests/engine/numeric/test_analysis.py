"""Spectra and autocorrelation: of known textures, of any size, and against the plain definitions."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.analysis import Analysis, autocorrelation, brightness, power_spectrum
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY


def picture(grey: np.ndarray) -> np.ndarray:
    out = np.empty((*grey.shape, 4), np.uint8)
    out[..., :3] = np.rint(np.clip(grey, 0, 1) * 255)[..., None]
    out[..., 3] = 255
    return out


def waves(height, width, period):
    return 0.5 + 0.3 * np.sin(2 * np.pi * np.arange(width) / period)[None].repeat(height, 0)


def test_a_wave_has_its_peak_at_its_frequency():
    power = power_spectrum(waves(96, 120, 10).astype(np.float32))
    v, u = np.unravel_index(power.argmax(), power.shape)
    assert (v - 48, abs(u - 60)) == (0, 12)
    assert power.mean() == pytest.approx(0.045, rel=0.05)


def test_the_autocorrelation_of_a_wave_is_the_wave():
    found = autocorrelation(waves(64, 80, 16).astype(np.float32))
    assert found[32, 40] == pytest.approx(1.0)
    assert found[32, 48] == pytest.approx(-1.0, abs=0.05)
    assert found[0, 56] == pytest.approx(1.0, abs=0.05)


@given(st.integers(1, 7), st.integers(1, 8), st.integers(0, 99), st.sampled_from([LIBRARY, EVERYWHERE]))
@settings(deadline=None, max_examples=40)
def test_the_autocorrelation_is_what_its_definition_says(height, width, seed, arithmetic):
    grey = np.random.default_rng(seed).random((height, width), np.float32)
    found = autocorrelation(grey, arithmetic)
    values = grey.astype(float) - grey.astype(float).mean()
    if (values**2).mean() < 1e-14:
        assert not found.any()
        return
    for j in range(height):
        for i in range(width):
            dy, dx = j - height // 2, i - width // 2
            pairs = [
                values[y, x] * values[y + dy, x + dx]
                for y in range(height)
                for x in range(width)
                if 0 <= y + dy < height and 0 <= x + dx < width
            ]
            assert found[j, i] == pytest.approx(np.mean(pairs) / (values**2).mean(), abs=1e-5)


@pytest.mark.parametrize("size", [(1, 1), (1, 9), (2, 3), (5, 1), (33, 47), (1100, 20)])
@pytest.mark.parametrize("flat", [True, False])
def test_pictures_of_any_size(size, flat):
    grey = np.full(size, 0.5) if flat else np.random.default_rng(1).random(size)
    found = Analysis(picture(grey))
    assert found.power.shape == found.autocorrelation.shape == found.all_pole.shape == (min(size[0], 1024), size[1])
    for values in (found.power, found.autocorrelation, found.all_pole, *found.radial):
        assert np.isfinite(values).all()
    assert found.predictor.stable
    assert found.slope is None or np.isfinite(found.slope)
    assert found.regions >= found.colours >= 1


def test_the_all_pole_spectrum_follows_the_measured_one():
    rng = np.random.default_rng(2)
    noise = rng.standard_normal((200, 200))
    smooth = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3))
    found = Analysis(picture(0.5 + 0.04 * smooth))
    _, measured, fitted = found.radial
    assert np.corrcoef(np.log(measured[3:60]), np.log(fitted[3:60]))[0, 1] > 0.9
    assert found.all_pole.mean() == pytest.approx(found.power.mean(), rel=0.2)


def test_the_slope_of_1_over_f():
    rng = np.random.default_rng(4)
    f = np.hypot(np.fft.fftfreq(256)[:, None], np.fft.fftfreq(256)[None])
    f[0, 0] = 1.0
    texture = np.fft.ifft2(np.fft.fft2(rng.standard_normal((256, 256))) / f**1.5).real
    assert Analysis(picture(0.5 + 0.1 * texture / texture.std())).slope == pytest.approx(1.5, abs=0.12)


def test_brightness_takes_alpha_and_depth_into_account():
    pixels = np.array([[[255, 255, 255, 255], [255, 0, 0, 255], [255, 255, 255, 0]]], np.uint8)
    assert brightness(pixels)[0] == pytest.approx([1.0, 0.2126, 0.0])
    assert brightness(pixels.astype(np.uint16) * 257) == pytest.approx(brightness(pixels), abs=1e-6)
