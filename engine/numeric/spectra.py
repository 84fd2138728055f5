"""Spectrum painting: an amplitude spectrum and phases become a sample of texture, and back (Lewis 1984, section 5.1).

Spectra are arrays (..., h, w) whose zero frequency lies in the middle, at [h // 2, w // 2]; row i, column j stand for
(i - h // 2) / h and (j - w // 2) / w cycles per pixel.  Frequencies are given as parts of the highest, half a cycle
per pixel.  Everything is float32 or complex64, of any size, odd ones included.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import ArrayFunctions, array_functions
from engine.numeric.hashing import fold_key, hash_plane

SPREAD = 0.36  # standard deviation of a texture of nominal range -1..1: one pixel in 200 leaves it
WINDOW = 0.28  # standard deviation of the radial window, in sides of the sample
_ROUNDING = 1e-6  # of the other part's size: ten times what a transform in float32 leaves of a part that is zero
_DOMAIN = 0x73706563  # "spec": tells these hashes from those of other textures

Phase = np.ndarray | int | None  # radians (..., h, w); the seed of random ones; zero everywhere
_AXES = (-2, -1)


def frequencies(height: int, width: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertical (h, 1) and horizontal (1, w) frequency in parts of the highest, -1..1; float32."""
    v = (np.arange(height) - height // 2) * (2.0 / height)
    u = (np.arange(width) - width // 2) * (2.0 / width)
    return v.astype(np.float32)[:, None], u.astype(np.float32)[None]


def radial_window(height: int, width: int | None = None, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the radial Gaussian that keeps a sample's edges out of the field: float32 (h, w), 1 in the middle.

    What is left at the rim, half a side from the middle, is taken off, so that the
    window ends at exactly zero (Lewis 1984, section 5.2).
    """
    width, exp = height if width is None else width, array_functions(arithmetic).exp
    y = (np.arange(height) + 0.5) / height - 0.5
    x = (np.arange(width) + 0.5) / width - 0.5
    squared = y[:, None] ** 2 + x[None] ** 2
    rim = exp(np.array([-0.125 / WINDOW**2]))
    window = (exp(-0.5 * squared / WINDOW**2) - rim) / (1.0 - rim)
    out: np.ndarray = np.maximum(window, 0.0).astype(np.float32)
    return out


def opposite(spectrum: np.ndarray) -> np.ndarray:
    """Returns the values at the opposite frequency, F(-u, -v), at each place."""
    rows, columns = ((2 * (n // 2) - np.arange(n)) % n for n in spectrum.shape[-2:])
    return spectrum[..., rows[:, None], columns[None]]


def symmetric(amplitude: np.ndarray) -> np.ndarray:
    """Returns both halves of a spectrum of which either was painted: the larger of F(u, v) and F(-u, -v)."""
    out: np.ndarray = np.maximum(amplitude, opposite(amplitude))
    return out


@lru_cache(maxsize=2)
def _random_phasors(height: int, width: int, seed: int, arithmetic: int) -> np.ndarray:
    """Returns two independent sets of phases, each F(-u, -v) = F*(u, v), as e^(i p) + i e^(i q): complex64 (h, w).

    The real and the imaginary part of the inverse transform are then two textures of the same amplitudes.
    """
    hashed = hash_plane(fold_key(_DOMAIN, seed), 0, 0, width, height)
    out = np.zeros((height, width), np.complex64)
    for shift, unit in ((8, 1.0), (40, 1.0j)):
        turns = ((hashed >> np.uint64(shift)) & np.uint64(0xFFFFFF)).astype(np.float32)
        # The difference of two even distributions on a circle is even again, and changes sign with the frequency.
        angles = (turns - opposite(turns)) * np.float32(2.0 * np.pi / (1 << 24))
        waves = array_functions(arithmetic).waves(angles)
        out += np.complex64(unit) * waves  # times 1 or i, which rounds nothing
    out.flags.writeable = False
    return out


def inverse(amplitude: np.ndarray, phase: Phase = None, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the inverse transform of a centred amplitude spectrum: complex64 (..., h, w).

    `phase`: radians, or the seed of random ones, or None for zero, which gathers all in the sample's middle.
    """
    own, spectrum = array_functions(arithmetic), np.asarray(amplitude, np.float32)
    height, width = spectrum.shape[-2:]
    if isinstance(phase, np.ndarray):
        angles = phase.astype(np.float32, copy=False)
        spectrum = own.turned(spectrum, own.waves(angles))
    elif phase is not None:
        spectrum = own.turned(spectrum, _random_phasors(height, width, int(phase), arithmetic))
    sample = own.ifft2(np.fft.ifftshift(spectrum, axes=_AXES))
    if phase is None:
        sample = np.fft.fftshift(sample, axes=_AXES)
    return sample.astype(np.complex64, copy=False)


def forward(image: np.ndarray, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the centred spectrum of real or complex pictures: complex64 (..., h, w).

    Of a real, asymmetric pattern it is itself a texture (the forward variant of section 5.1).
    """
    found = np.fft.fftshift(array_functions(arithmetic).fft2(np.asarray(image)), axes=_AXES)
    return found.astype(np.complex64, copy=False)


def _log(sample: np.ndarray, own: ArrayFunctions) -> np.ndarray:
    magnitude = own.size(sample)
    least = 1e-3 * float(own.mean(magnitude))
    return own.log(magnitude + np.float32(least if least > 0.0 else 1.0))


# What a texture takes of a complex sample: name -> complex64 (..., h, w) to float32.
PARTS: dict[str, Callable[[np.ndarray, ArrayFunctions], np.ndarray]] = {
    "real": lambda sample, own: np.real(sample),
    "imaginary": lambda sample, own: np.imag(sample),
    "magnitude": lambda sample, own: own.size(sample),
    "log": _log,
    "phase": lambda sample, own: own.angle(sample),
}


def _unrounded(sample: np.ndarray, own: ArrayFunctions) -> np.ndarray:
    """Returns a complex sample without a real or imaginary part that is nothing but rounding error: symmetric
    spectra have real transforms, whose phase is 0 or pi, and not -pi or pi as chance has it."""
    real, imaginary = (
        own.total(np.square(part, dtype=np.float64), axis=_AXES, keepdims=True) for part in (sample.real, sample.imag)
    )
    out = sample.copy()
    np.copyto(out.imag, 0.0, where=imaginary <= _ROUNDING**2 * real)
    np.copyto(out.real, 0.0, where=real <= _ROUNDING**2 * imaginary)
    return out


def normalised(values: np.ndarray, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns mean 0 (of each plane) and standard deviation SPREAD (of all planes together); float32, zeros if it is
    flat."""
    own, out = array_functions(arithmetic), np.asarray(values, np.float32)
    out = out - own.mean(out, axis=_AXES, keepdims=True, dtype=np.float64).astype(np.float32)
    size = float(np.abs(out).max(initial=0.0))
    if not size > 0.0 or not np.isfinite(size):
        return np.zeros_like(out)
    out /= np.float32(size)  # so that no square leaves the range of float32
    spread = float(np.sqrt(own.mean(np.square(out), dtype=np.float64)))
    result: np.ndarray = out * np.float32(SPREAD / spread)
    return result


def texture_of(
    amplitude: np.ndarray,
    phase: Phase = None,
    part: str = "real",
    forward: bool = False,
    arithmetic: int = LIBRARY,
) -> np.ndarray:
    """Returns the texture whose spectrum was painted: float32 like `amplitude`, mean 0, standard deviation SPREAD.

    It is not clipped to -1..1, and tiles without seams.  `part`: a row of PARTS.  With `forward`, `amplitude`
    is a pattern, mean taken off, and the texture a part of its spectrum (times the phases, if any).
    """
    given, own = np.asarray(amplitude, np.float32), array_functions(arithmetic)
    if not forward:
        return normalised(PARTS[part](_unrounded(inverse(given, phase, arithmetic), own), own), arithmetic)
    pattern = given - own.mean(given, axis=_AXES, keepdims=True)
    return normalised(PARTS[part](_unrounded(np.conj(inverse(pattern, phase, arithmetic)), own), own), arithmetic)


def image_spectrum(image: np.ndarray, window: bool = True, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the amplitude spectrum of pictures (..., h, w), means taken off: float32, centred.

    With `window`, their edges are kept out of it.
    """
    own, values = array_functions(arithmetic), np.asarray(image, np.float32)
    if window:
        weights = radial_window(values.shape[-2], values.shape[-1], arithmetic)
        total = max(float(own.total(weights)), 1e-9)
        values = (values - own.total(values * weights, axis=_AXES, keepdims=True) / np.float32(total)) * weights
    else:
        values = values - own.mean(values, axis=_AXES, keepdims=True)
    return own.size(forward(values, arithmetic))


def power(image: np.ndarray) -> np.ndarray:
    """Returns the power spectrum of pictures (..., h, w), means taken off: float64, centred; its mean is
    their variance."""
    values = np.asarray(image, np.float64)
    values = values - values.mean(axis=_AXES, keepdims=True)
    found = np.fft.fftshift(np.fft.fft2(values, axes=_AXES), axes=_AXES)
    out: np.ndarray = np.square(np.abs(found)) / (values.shape[-2] * values.shape[-1])
    return out


def radial_mean(spectrum: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(frequencies, means) of a centred spectrum (h, w) over rings one step of the longer side wide: float64 each.

    Frequencies in cycles per pixel, from the first ring beyond zero to 1/2.
    """
    height, width = spectrum.shape
    v, u = frequencies(height, width)
    longer = max(height, width)
    ring = np.rint(np.hypot(v, u) * (longer / 2.0)).astype(np.int64).ravel()
    count = np.bincount(ring)
    total = np.bincount(ring, weights=np.asarray(spectrum, np.float64).ravel())
    last = max(longer // 2, 1)
    rings = np.arange(1, last + 1)
    rings = rings[(rings < count.size) & (count[np.minimum(rings, count.size - 1)] > 0)]
    return rings / longer, total[rings] / count[rings]
