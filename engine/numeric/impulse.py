"""Sampled impulse responses: windowed pieces of a photograph, several averaged in the frequency domain.

Lewis 1984, section 5.3.  A windowed sample of a texture is an estimate of the impulse response that makes it of white
noise.  Averaging the power spectra of several samples (the modified periodogram: Welch 1967) lowers the estimate's
variance; the window stays as large as the lowest frequencies of the texture ask for, and no larger.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.analysis import autocorrelation, middle
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import ArrayFunctions, array_functions
from engine.numeric.prediction import noise_at
from engine.numeric.spectra import normalised

_SMALLEST, USUAL, LARGEST = 32, 128, 512  # pixels along a window: chosen without being asked for, and allowed
PHASES = ("window", "zero", "random")
_LOOKED_AT = 512  # pixels along the part from which a window's size is chosen
_ENOUGH = 0.15  # of the autocorrelation: less of it is taken for none
_TAPER = 0.25  # of each side of a piece that fades
_GOLDEN = (0.7548776662466927, 0.5698402909980532)  # Roberts 2018: the most even sequence of points in a square


def suggested_window(planes: np.ndarray, arithmetic: int = LIBRARY) -> int:
    """Returns a window that holds the lowest frequencies of a picture (c, h, w), from its autocorrelation: eight times
    the distance at which that is gone, since the radial window leaves the middle half of it; no more than USUAL, nor
    than the picture's shorter side."""
    own = array_functions(arithmetic)
    grey = own.mean(middle(np.moveaxis(planes, 0, -1), _LOOKED_AT), axis=-1)
    shorter = min(grey.shape)
    found = np.abs(autocorrelation(grey, arithmetic))
    y, x = (np.arange(n) - float(n // 2) for n in grey.shape)
    distance = np.rint(own.distance(y[:, None], x[None])).astype(np.int64)
    inside = distance <= max(1, shorter // 3)
    count = np.bincount(distance[inside])
    near = np.bincount(distance[inside], weights=found[inside]) / np.maximum(count, 1)
    reach = int(np.flatnonzero(near > _ENOUGH).max(initial=1)) + 1
    out: int = max(1, min(max(8 * reach, _SMALLEST), USUAL, *planes.shape[1:]))
    return out


def impulse_response(
    planes: np.ndarray, window: int, average: int, phase: str = "window", seed: int = 0, arithmetic: int = LIBRARY
) -> np.ndarray:
    """Returns the impulse response of a picture float32 (c, h, w): float32 (c, n, m), mean 0, deviation
    `spectra.SPREAD`.

    n and m are `window`, or a side of the picture where that is shorter.  The amplitudes are the root of the mean
    power of `average` pieces, for each channel; the phases are common to all channels, so that colours stay together:
    those of the piece in the middle, or zero, which gathers the response in its middle, or random.
    ValueError names what is out of range.
    """
    if not (1 <= window <= LARGEST and 1 <= average <= 4096 and phase in PHASES):
        raise ValueError(f"impulse: found window {window}, average {average}, phase {phase!r}")
    size = min(window, planes.shape[1]), min(window, planes.shape[2])
    if average == 1 and phase == "window":
        top, left = corners(planes.shape[1:], size, 1)[0]
        return normalised(planes[:, top : top + size[0], left : left + size[1]], arithmetic)
    own = array_functions(arithmetic)
    taper = np.outer(_tapered(size[0], own), _tapered(size[1], own)).astype(np.float32)
    power = np.zeros((len(planes), *size))
    first: np.ndarray | None = None
    for top, left in corners(planes.shape[1:], size, average):
        found = own.fft2(_levelled(planes[:, top : top + size[0], left : left + size[1]], taper, own))
        power += own.size(found) ** 2
        first = found if first is None else first
    assert first is not None
    amplitude = np.sqrt(power / average)
    amplitude[:, 0, 0] = 0.0
    if phase == "window":
        together = first.sum(axis=0)
        length = own.size(together)
        common: np.ndarray = np.where(length > 1e-20, together / np.maximum(length, 1e-20), 1.0)
        # Where channels are opposed, as in red and blue patches, a channel follows against the common phase.
        sign = np.where(own.turned(first, np.conj(common)).real < 0.0, -1.0, 1.0)
        return normalised(own.ifft2(own.turned(amplitude * sign, common)).real, arithmetic)
    turn: np.ndarray = np.ones(size, complex)
    if phase == "random":
        angle = own.angle(own.fft2(noise_at(seed, 0, 0, (1, *size))[0]))
        turn = np.exp(1j * angle) if arithmetic == LIBRARY else own.waves(angle)
    return normalised(np.fft.fftshift(own.ifft2(own.turned(amplitude, turn)).real, axes=(1, 2)), arithmetic)


def corners(shape: tuple[int, ...], size: tuple[int, int], count: int) -> list[tuple[int, int]]:
    """Top left corners (y, x) of `count` pieces of a picture (h, w): the middle one, then evenly scattered ones."""
    room = shape[0] - size[0], shape[1] - size[1]
    scattered = [
        tuple(int((0.5 + i * step) % 1.0 * (free + 1)) for step, free in zip(_GOLDEN, room, strict=True))
        for i in range(1, count)
    ]
    return [(room[0] // 2, room[1] // 2), *((y, x) for y, x in scattered)]


def _tapered(n: int, own: ArrayFunctions) -> np.ndarray:
    """Returns a window (n,) that is flat in the middle and ends in halves of a cosine (Tukey's)."""
    at = np.minimum((np.arange(n) + 0.5) / (n * _TAPER), 1.0)
    half = 0.5 - 0.5 * own.cos(np.pi * at)
    out: np.ndarray = np.minimum(half, half[::-1])
    return out


def _levelled(piece: np.ndarray, taper: np.ndarray, own: ArrayFunctions) -> np.ndarray:
    """Returns a piece (c, h, w) under the taper, its mean under it taken off."""
    means = own.total(piece * taper, axis=(1, 2), keepdims=True) / max(float(own.total(taper)), 1e-9)
    out: np.ndarray = (piece - means) * taper
    return out
