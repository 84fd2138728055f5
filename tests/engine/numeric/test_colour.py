"""Conversions between planes and pixels."""

import subprocess
import sys

import numpy as np
import pytest

from engine.numeric import colour
from engine.numeric.grid import Q, snapped


def every_pair(top):
    """All (colour, alpha) pairs as pixels (top+1, top+1, 4), colour in all channels, differently."""
    alpha, value = np.mgrid[0 : top + 1, 0 : top + 1]
    return np.stack([value, top - value, (value * 7) % (top + 1), alpha], axis=-1)


def test_every_8_bit_pixel_comes_back():
    pixels = every_pair(255).astype(np.uint8)
    planes = colour.from_rgba8(pixels)
    expected = np.where(pixels[..., 3:] > 0, pixels, 0)
    assert np.array_equal(colour.to_rgba8(planes), expected)


def test_planes_of_pixels_are_on_the_grid_and_displayable():
    for planes in (
        colour.from_rgba8(every_pair(255).astype(np.uint8)),
        colour.from_rgba16(np.random.default_rng(0).integers(0, 65536, (300, 200, 4)).astype(np.uint16)),
    ):
        assert np.array_equal(planes, snapped(planes))
        assert planes.min() >= 0
        assert (planes[:3] <= planes[3]).all()
        assert planes[3].max() == 1


def test_every_16_bit_alpha_and_opaque_colour_comes_back():
    ramp = np.arange(65536, dtype=np.uint16).reshape(256, 256)
    full = np.full_like(ramp, 65535)
    opaque = np.stack([ramp, ramp[::-1], ramp.T, full], axis=-1)
    assert np.array_equal(colour.to_rgba16(colour.from_rgba16(opaque)), opaque)
    alpha = np.stack([full, 0 * ramp, full, ramp], axis=-1)
    alpha[0, 0] = 0
    assert np.array_equal(colour.to_rgba16(colour.from_rgba16(alpha)), alpha)


def test_16_bit_colour_is_kept_to_half_a_step_of_the_grid():
    pixels = np.random.default_rng(1).integers(1, 65536, (300, 300, 4)).astype(np.uint16)
    back = colour.to_rgba16(colour.from_rgba16(pixels)).astype(np.float64)
    alpha = pixels[..., 3:] / 65535
    error = np.abs(back[..., :3] - pixels[..., :3]) * alpha / 65535
    assert error.max() <= 0.5 * Q + 0.5 / 65535 + 1e-9


def plain(planes, top):
    """Straight pixels in float64, not rounded, but zero where alpha rounds to zero."""
    planes = planes.astype(np.float64)
    alpha = np.clip(planes[3], 0, 1)
    straight = np.divide(planes[:3], alpha, out=np.zeros_like(planes[:3]), where=alpha > 0)
    pixels = np.moveaxis(top * np.concatenate([np.clip(straight, 0, 1), alpha[None]]), 0, -1)
    return np.where(pixels[..., 3:] >= 0.5, pixels, 0)


@pytest.mark.parametrize("seed", range(3))
def test_conversions_agree_with_plain_ones(seed):
    planes = snapped(np.random.default_rng(seed).normal(0.5, 0.6, (4, 211, 97)))
    for convert, top, slack in ((colour.to_rgba8, 255, 1e-4), (colour.to_rgba16, 65535, 1e-9)):
        assert np.abs(convert(planes) - plain(planes, top)).max() <= 0.5 + slack
    alpha = np.clip(planes[3], 0, 1)
    expected = np.floor(255 * np.concatenate([np.clip(planes[:3], 0, alpha), alpha[None]]) + 0.5)
    assert np.array_equal(colour.to_premul8(planes), np.moveaxis(expected, 0, -1))


def test_wild_values_become_displayable_pixels():
    planes = np.array([[np.nan, 16, -16, 0.5], [0, 1, 2, 3], [1, np.nan, 0, 1], [np.nan, 2, 0.5, 1e-9]], np.float32)
    assert colour.to_rgba8(planes[:, None])[0].tolist() == [
        [0, 0, 0, 0],
        [255, 255, 0, 255],
        [0, 255, 0, 128],
        [0, 0, 0, 0],
    ]
    assert colour.to_premul8(planes[:, None])[0].tolist()[1:3] == [[255, 255, 0, 255], [0, 128, 0, 128]]
    assert colour.to_rgba16(planes[:, None])[0, 1].tolist() == [65535, 65535, 0, 65535]


def test_views_of_any_layout_are_taken():
    planes = snapped(np.random.default_rng(4).random((4, 40, 50)))
    part = planes[:, 5:30, 7:21]
    assert np.array_equal(colour.to_rgba8(part), colour.to_rgba8(planes)[5:30, 7:21])
    pixels = colour.to_rgba8(planes)
    assert np.array_equal(colour.from_rgba8(pixels[::2, ::-1]), colour.from_rgba8(pixels)[:, ::2, ::-1])


def test_wrong_shapes_are_named():
    with pytest.raises(ValueError, match=r"found planes of shape \(3, 2, 2\), expected \(4, h, w\)"):
        colour.to_rgba8(np.zeros((3, 2, 2), np.float32))
    with pytest.raises(ValueError, match=r"found uint8 of shape \(2, 2, 4\), expected uint16 \(h, w, 4\)"):
        colour.from_rgba16(np.zeros((2, 2, 4), np.uint8))


def test_the_first_kernel_loads_no_linear_algebra():
    """Which takes 24 MB, and its time."""
    told = "import sys, numpy as np; from engine.numeric.colour import to_premul8; "
    told += "to_premul8(np.zeros((4, 8, 8), np.float32)); print('scipy.linalg' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", told], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
