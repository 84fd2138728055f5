"""How far a texture is from the joint statistics of its example: the yardstick of textures with a structure.

Plain float64 NumPy, by no code of the engine's.  Portilla & Simoncelli's statistics (2000), all planes of colour
together: of six kinds (autocorrelations of the low-passes and of the bands' magnitudes; what magnitudes, and real
parts, have in common within a scale, and with their parents) the difference in parts of the example's own size, at the
scale where that is largest; and their mean.  0 for the example itself; 0.5 to 1 for most textures with the right
histograms and no structure.  It counts no shapes: look at the pictures, too.
"""

from __future__ import annotations

import math

import numpy as np

SCALES, ORIENTATIONS, SIDE = 4, 4, 7

Statistics = dict[str, list[np.ndarray]]


def yardstick(example: np.ndarray, texture: np.ndarray) -> float:
    """Of pictures (h, w, C), 0..1."""
    return float(np.mean(list(differences(example, texture).values())))


def differences(example: np.ndarray, texture: np.ndarray) -> dict[str, float]:
    """Of each kind."""
    mean, axes = _axes(example)
    one, other = (_statistics(np.moveaxis((picture - mean) @ axes, -1, 0)) for picture in (example, texture))
    return {kind: max(_apart(a, b) for a, b in zip(found, other[kind], strict=True)) for kind, found in one.items()}


def _apart(one: np.ndarray, other: np.ndarray) -> float:
    if one.ndim == 3:  # lags: as far as both reach
        one, other = (_middle(each, min(one.shape[1], other.shape[1])) for each in (one, other))
    return float(np.linalg.norm(one - other) / (np.linalg.norm(one) + 1e-12))


def _middle(lags: np.ndarray, side: int) -> np.ndarray:
    cut = (lags.shape[1] - side) // 2
    return lags[:, cut : cut + side, cut : cut + side]


def _axes(picture: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    pixels = picture.reshape(-1, picture.shape[-1]).astype(np.float64)
    variances, vectors = np.linalg.eigh(np.atleast_2d(np.cov(pixels.T)))
    kept = variances > max(variances[-1] * 1e-5, 1e-9)
    return pixels.mean(axis=0), vectors[:, kept] / np.sqrt(variances[kept])


def _statistics(planes: np.ndarray) -> Statistics:
    spectra = np.fft.fft2(planes - planes.mean(axis=(1, 2), keepdims=True))
    levels = min(SCALES, int(math.log2(min(planes.shape[1:]))) - 3)
    spectra = spectra * _split(_frequencies(*planes.shape[1:])[0])[1]
    bands, lows = [], []
    for _ in range(levels):
        logarithm, angle = _frequencies(*spectra.shape[1:])
        high, low = _split(logarithm + 1.0)
        lows.append(np.fft.ifft2(spectra * _split(logarithm)[1]).real)
        bands.append(np.concatenate([np.fft.ifft2(spectra * high * _towards(angle, k)) for k in range(ORIENTATIONS)]))
        spectra = _halved(spectra * low)
    return _of(bands, lows)


def _of(bands: list[np.ndarray], lows: list[np.ndarray]) -> Statistics:
    found: Statistics = {name: [] for name in ("lows", "lags", "sizes", "parts", "sizes above", "parts above")}
    for level, (band, low) in enumerate(zip(bands, lows, strict=True)):
        pixels = band[0].size
        sizes = np.abs(band) - np.abs(band).mean(axis=(1, 2), keepdims=True)
        flat, real = sizes.reshape(len(band), -1), band.real.reshape(len(band), -1)
        found["lows"].append(_lags(low - low.mean(axis=(1, 2), keepdims=True)))
        found["lags"].append(_lags(sizes))
        found["sizes"].append(flat @ flat.T / pixels)
        found["parts"].append(real @ real.T / pixels)
        if level + 1 < len(bands):
            parent = _doubled(bands[level + 1], band.shape[1:])
            size = np.abs(parent)
            turned = (parent * parent / (size + 1e-12)).reshape(len(band), -1)
            size = (size - size.mean(axis=(1, 2), keepdims=True)).reshape(len(band), -1)
            found["sizes above"].append(flat @ size.T / pixels)
            found["parts above"].append(np.hstack([real @ turned.real.T, real @ turned.imag.T]) / pixels)
    return found


def _frequencies(height: int, width: int) -> tuple[np.ndarray, np.ndarray]:
    """log2 of them in parts of the highest, and their direction."""
    v, u = np.fft.fftfreq(height)[:, None] * 2.0, np.fft.fftfreq(width)[None] * 2.0
    return np.log2(np.maximum(np.hypot(v, u), 1e-9)), np.arctan2(*np.broadcast_arrays(v, u))


def _split(logarithm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    turn = np.pi / 2.0 * np.clip(logarithm + 1.0, 0.0, 1.0)
    return np.sin(turn), np.where(logarithm >= 0.0, 0.0, np.cos(turn))


def _towards(angle: np.ndarray, k: int) -> np.ndarray:
    """One side of a direction: bands are complex."""
    order = ORIENTATIONS - 1
    scale = 2.0**order * math.factorial(order) / math.sqrt(ORIENTATIONS * math.factorial(2 * order))
    return 2.0 * scale * np.clip(np.cos(angle - np.pi * k / ORIENTATIONS), 0.0, None) ** order


def _halved(spectra: np.ndarray) -> np.ndarray:
    _, height, width = spectra.shape
    middle = np.fft.fftshift(spectra, axes=(1, 2))
    top, left = height // 4, width // 4
    return np.fft.ifftshift(middle[:, top : top + height // 2, left : left + width // 2], axes=(1, 2)) / 4.0


def _doubled(planes: np.ndarray, size: tuple[int, ...]) -> np.ndarray:
    height, width = planes.shape[1:]
    spectra = np.zeros((len(planes), *size), complex)
    top, left = size[0] // 2 - height // 2, size[1] // 2 - width // 2
    spectra[:, top : top + height, left : left + width] = np.fft.fftshift(np.fft.fft2(planes), axes=(1, 2)) * 4.0
    return np.fft.ifft2(np.fft.ifftshift(spectra, axes=(1, 2)))


def _lags(planes: np.ndarray) -> np.ndarray:
    power = np.abs(np.fft.fft2(planes)) ** 2 / planes[0].size
    found = np.fft.fftshift(np.fft.ifft2(power).real, axes=(1, 2))
    reach = min(SIDE // 2, planes.shape[1] // 8)
    y, x = planes.shape[1] // 2, planes.shape[2] // 2
    return found[:, y - reach : y + reach + 1, x - reach : x + reach + 1]
