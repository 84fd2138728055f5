"""What a picture is made of: power spectrum, autocorrelation, all-pole spectrum, distinct colours and their regions.

Lewis 1984, figures 1 and 4.  Spectra are of the brightness (Rec. 709 weights on encoded values, times alpha), 0..1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from engine.numeric import real_fourier
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.prediction import Predictor, fit
from engine.numeric.regions import colour_count, false_colours, packed, region_count
from engine.numeric.spectra import radial_mean, radial_window

ANALYSED_SIDE = 1024  # pixels: of what is larger, the middle is looked at
_REACH = 4
_WEIGHTS = (0.2126, 0.7152, 0.0722)


@dataclass(frozen=True)
class Analysis:
    """The facts of a picture, uint8 or uint16 RGBA (h, w, 4), not premultiplied; each is found when it is asked for."""

    pixels: np.ndarray

    @cached_property
    def packed(self) -> np.ndarray:
        """Gives the pixels as one number each, as `packed`."""
        return packed(self.pixels)

    @cached_property
    def colours(self) -> int:
        """Tells how many different colours there are."""
        return colour_count(self.packed)

    @cached_property
    def regions(self) -> int:
        """Tells how many regions of one colour there are, pixels being neighbours left, right, above and below."""
        return region_count(self.packed)

    @cached_property
    def false_coloured(self) -> np.ndarray:
        """uint8 RGBA (h, w, 4)."""
        return false_colours(self.packed)

    @cached_property
    def grey(self) -> np.ndarray:
        """Returns the brightness of the middle, at most ANALYSED_SIDE x ANALYSED_SIDE pixels of it: float32 (h, w)."""
        return brightness(middle(self.pixels, ANALYSED_SIDE))

    @cached_property
    def power(self) -> np.ndarray:
        """Gives the power spectrum of the grey picture, as `power_spectrum`."""
        return power_spectrum(self.grey)

    @cached_property
    def autocorrelation(self) -> np.ndarray:
        """Gives the autocorrelation of the grey picture, as `autocorrelation`."""
        return autocorrelation(self.grey)

    @cached_property
    def predictor(self) -> Predictor:
        """Returns the all-pole filter fitted to the brightness."""
        return fit(self.grey, _REACH)

    @cached_property
    def all_pole(self) -> np.ndarray:
        """Returns the spectrum of that filter, as `power`."""
        out: np.ndarray = self.predictor.spectrum(*self.grey.shape)[0]
        return out

    @cached_property
    def radial(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Frequencies in cycles per pixel, the mean power of each ring, and that of the all-pole spectrum."""
        frequencies, means = radial_mean(self.power)
        return frequencies, means, radial_mean(self.all_pole)[1]

    @cached_property
    def slope(self) -> float | None:
        """Returns the b of amplitudes that fall as 1/f^b, by least squares over the rings; None if there are too
        few."""
        frequencies, means, _ = self.radial
        good = means > 1e-14
        if good.sum() < 4:
            return None
        x, y = np.log(frequencies[good]), np.log(means[good])
        x = x - x.mean()
        return float(-0.5 * (x * y).sum() / (x * x).sum())


def middle(pixels: np.ndarray, side: int) -> np.ndarray:
    """Returns the middle of a picture (h, w, ...), at most `side` pixels along each side."""
    top, left = (max(0, n - side) // 2 for n in pixels.shape[:2])
    return pixels[top : top + side, left : left + side]


def brightness(pixels: np.ndarray) -> np.ndarray:
    """Luma times alpha, 0..1: float32 (h, w) of straight uint8 or uint16 RGBA (h, w, 4)."""
    full = float(np.iinfo(pixels.dtype).max)
    out = np.zeros(pixels.shape[:2], np.float32)
    for c, weight in enumerate(_WEIGHTS):
        out += pixels[..., c] * np.float32(weight / full)
    return out * (pixels[..., 3] / np.float32(full))


def power_spectrum(grey: np.ndarray) -> np.ndarray:
    """Returns the power spectrum of (h, w) under a radial window: float64 (h, w), zero frequency at [h // 2, w // 2].

    It is scaled so that its mean is, as nearly as the window lets one tell, the variance.
    """
    window = radial_window(*grey.shape).astype(np.float64)
    values = grey.astype(np.float64)
    values -= (values * window).sum() / max(window.sum(), 1e-12)
    found = np.fft.fftshift(np.abs(np.fft.fft2(values * window)) ** 2)
    out: np.ndarray = found / max((window**2).sum(), 1e-12)
    return out


def autocorrelation(grey: np.ndarray, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the correlation of a picture (h, w) with itself, displaced: float64 (h, w), the displacement (0, 0) at
    [h // 2, w // 2], where it is 1; all 0 for a flat picture.

    Each displacement's sum is divided by the number of pixels that overlap, so it does not fade with distance.
    """
    height, width = grey.shape
    own = array_functions(arithmetic)
    values = grey.astype(np.float64) - own.mean(grey, dtype=np.float64)
    variance = float(own.mean(values**2))
    if variance < 1e-14:
        return np.zeros(grey.shape)
    sums = _correlated(values) if arithmetic == LIBRARY else _correlated_everywhere(values)
    dy = np.arange(height) - height // 2
    dx = np.arange(width) - width // 2
    overlap = (height - np.abs(dy))[:, None] * (width - np.abs(dx))[None]
    out: np.ndarray = sums[dy][:, dx] / overlap / variance
    return out


def _correlated(values: np.ndarray) -> np.ndarray:
    """Returns the sums of the products of a picture (h, w) with itself, displaced, around a circle: (2h, 2w)."""
    size = 2 * values.shape[0], 2 * values.shape[1]
    return np.fft.irfft2(np.abs(np.fft.rfft2(values, size)) ** 2, size)


def _correlated_everywhere(values: np.ndarray) -> np.ndarray:
    """As `_correlated`, in float32, the same on every processor.  The circle is as long as transforms are fast."""
    padded = np.zeros([real_fourier.fast_length(2 * n) for n in values.shape], np.float32)
    padded[: values.shape[0], : values.shape[1]] = values
    found = real_fourier.rfft2(padded)
    power = np.square(found.real) + np.square(found.imag)
    return real_fourier.irfft2(power.astype(np.complex64), padded.shape, True)
