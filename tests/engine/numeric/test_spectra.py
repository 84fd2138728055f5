"""Spectra: the textures that they become have the amplitudes that were painted, at any size."""

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric import spectra
from engine.numeric.shapes import SHAPES, drawn

SIZES = st.tuples(st.integers(1, 40), st.integers(1, 40))


def painted(size, seed=0):
    return np.random.default_rng(seed).random(size, np.float32)


@settings(deadline=None, max_examples=40)
@given(SIZES, st.integers(0, 2**70))
def test_random_phases_keep_the_amplitudes_of_both_parts(size, seed):
    amplitude = spectra.symmetric(painted(size))
    sample = spectra.inverse(amplitude, seed)
    again = spectra.inverse(amplitude, seed)
    assert (sample == again).all()
    for part in (sample.real, sample.imag):
        assert np.abs(np.abs(spectra.forward(part)) - amplitude).max() < 1e-5


def test_random_parts_and_seeds_are_unrelated():
    amplitude = drawn("noise", (128, 128), {"b": 0.0})
    first, second = spectra.inverse(amplitude, 1), spectra.inverse(amplitude, 2)
    for a, b in ((first.real, first.imag), (first.real, second.real)):
        assert abs(np.corrcoef(a.ravel(), b.ravel())[0, 1]) < 0.03
    assert abs(float((first.real**3).mean()) / float(first.real.std() ** 3)) < 0.1  # and even about zero


@settings(deadline=None, max_examples=40)
@given(SIZES)
def test_opposite_frequencies_are_those_of_a_real_picture(size):
    found = spectra.forward(painted(size))
    assert np.abs(spectra.opposite(found) - np.conj(found)).max() < 1e-4
    both = spectra.symmetric(painted(size))
    assert (spectra.opposite(both) == both).all()
    assert (both >= painted(size)).all()


def test_zero_phase_gathers_in_the_middle_and_is_real():
    for size in ((64, 48), (33, 21)):
        sample = spectra.inverse(drawn("ring", size, {}))
        assert np.abs(sample.imag).max() < 1e-6
        assert np.unravel_index(sample.real.argmax(), size) == (size[0] // 2, size[1] // 2)


def test_painted_phases_are_taken_as_they_are():
    amplitude, phase = painted((24, 31)), painted((24, 31), 1) * 6 - 3
    sample = spectra.inverse(amplitude, phase)
    found = spectra.forward(sample)
    assert np.abs(found - amplitude * np.exp(1j * phase)).max() < 1e-5


@pytest.mark.parametrize("part", sorted(spectra.PARTS))
@pytest.mark.parametrize("forward", [False, True])
@pytest.mark.parametrize("size", [(64, 64), (31, 50), (3, 40, 25)])
def test_textures_are_normalised(part, forward, size):
    texture = spectra.texture_of(painted(size), 5, part, forward)
    assert texture.dtype == np.float32
    assert texture.shape == size
    assert np.abs(texture.mean((-2, -1))).max() < 1e-5
    assert abs(texture.std() - spectra.SPREAD) < 1e-4


@pytest.mark.parametrize(
    "amplitude", [np.zeros((8, 8)), np.ones((1, 1)), np.full((4, 5), 1e-38), np.full((9, 9), 1e30)]
)
def test_nothing_painted_is_flat_and_never_a_nan(amplitude):
    for part in spectra.PARTS:
        assert np.isfinite(spectra.texture_of(amplitude, None, part)).all()
    assert not spectra.texture_of(np.zeros((8, 8)), 1).any()


@pytest.mark.parametrize("phase", ["zero", "odd"])
@pytest.mark.parametrize("size", [(64, 64), (3, 31, 50)])
def test_what_symmetry_leaves_nothing_of_is_flat_and_no_rounding_error(phase, size):
    amplitude = spectra.symmetric(painted(size))
    turned = painted(size[-2:], 1)
    given = None if phase == "zero" else 6 * (turned - spectra.opposite(turned))
    assert not spectra.texture_of(amplitude, given, "imaginary").any()
    angle = spectra.texture_of(amplitude, given, "phase").reshape(-1, *size[-2:])
    assert [len(np.unique(plane)) for plane in angle] == [2] * len(angle)  # 0 and pi
    assert spectra.texture_of(amplitude, 7, "imaginary").std() > 0.3
    centred = spectra.symmetric(painted(size, 2))
    assert not spectra.texture_of(centred, None, "imaginary", True).any()


def test_the_forward_variant_is_the_transform_of_the_pattern():
    pattern = painted((20, 33))
    texture = spectra.texture_of(pattern, None, "imaginary", True)
    middle = np.fft.ifftshift(pattern - pattern.mean())
    plain = np.fft.fftshift(np.fft.fft2(middle)).imag
    assert np.corrcoef(texture.ravel(), plain.ravel())[0, 1] > 0.9999


@settings(deadline=None, max_examples=60)
@given(st.sampled_from(sorted(SHAPES)), SIZES, st.data())
def test_shapes_of_any_size_and_numbers(name, size, data):
    numbers = {q.name: data.draw(st.floats(q.lo, q.hi)) for q in SHAPES[name].parameters}
    shape = drawn(name, size, numbers)
    assert shape.dtype == np.float32
    assert shape.shape == size
    assert np.isfinite(shape).all()
    assert shape.min() >= 0
    assert shape.max() <= 1
    assert (spectra.opposite(shape) == shape).all()
    assert shape[size[0] // 2, size[1] // 2] == 0


def test_points_lie_on_both_sides_and_dense_wide_ones_are_a_matter_of_a_moment():
    found = drawn("points", (64, 64), {"spacing": 0.25})
    for i in range(-4, 4):
        assert i == 0 or found[32, 32 + 8 * i] == found[32 + 8 * i, 32] == np.float32(1 / abs(i))
    began = time.process_time()
    drawn("points", (512, 512), {"spacing": 0.02, "width": 0.5})
    assert time.process_time() - began < 2.0  # it took 4 s


def test_a_ring_lies_at_its_frequency_and_noise_falls_as_it_says():
    where, means = spectra.radial_mean(drawn("ring", (256, 200), {"frequency": 0.3}))
    assert abs(where[means.argmax()] - 0.15) < 0.005
    where, means = spectra.radial_mean(drawn("noise", (512, 512), {"b": 1.5, "from": 0.0, "to": 1.5}))
    slope = np.polyfit(np.log(where[2:200]), np.log(means[2:200]), 1)[0]
    assert abs(slope + 1.5) < 0.02


@settings(deadline=None, max_examples=30)
@given(SIZES)
def test_power_sums_to_the_variance(size):
    image = painted(size)
    assert abs(spectra.power(image).mean() - image.astype(np.float64).var()) < 1e-6
    where, means = spectra.radial_mean(spectra.power(image))
    assert where.shape == means.shape
    assert (np.diff(where) > 0).all()


def test_radial_mean_of_white_noise_is_flat():
    image = np.random.default_rng(3).standard_normal((200, 310))
    where, means = spectra.radial_mean(spectra.power(image))
    assert where[-1] == 0.5
    assert abs(means[20:] - 1).max() < 0.5
    assert abs(means[20:].mean() - 1) < 0.03


def test_the_window_ends_at_zero():
    for height, width in ((64, 64), (33, 80)):
        window = spectra.radial_window(height, width)
        assert window.shape == (height, width)
        assert window.max() > 0.99
        assert max(window[0].max(), window[-1].max(), window[:, 0].max(), window[:, -1].max()) < 0.03
        assert (window == window[::-1, ::-1]).all()


def test_the_spectrum_of_an_image_peaks_where_it_repeats():
    y, x = np.mgrid[:90, :120]
    image = np.sin(2 * np.pi * x / 8) + 0.02 * y  # a ramp, whose edges would be a cross
    found = spectra.image_spectrum(image)
    row, column = np.unravel_index(found[:, 60:].argmax(), (90, 60))
    assert (row, column) == (45, 15)
    assert found[30, 60] < 0.01 * found.max()
    assert spectra.image_spectrum(image, window=False)[30, 60] > spectra.image_spectrum(np.sin(x), window=False)[30, 60]
