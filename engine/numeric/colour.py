"""The way between our planes and 8- or 16-bit pixels.

Planes are float32 (4, h, w), premultiplied and sRGB-encoded.  Files hold straight alpha; screens want it premultiplied.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

import numpy as np

from engine.numeric.blend import clamped, flat
from engine.numeric.grid import snap
from engine.numeric.kernel import dividing, forced
from engine.numeric.stand_in import or_plain

# A pixel is packed into one integer, so that loads and stores vectorise.

_LITTLE = sys.byteorder == "little"
_R8, _G8, _B8, _A8 = (np.uint32(8 * i if _LITTLE else 24 - 8 * i) for i in range(4))
_R16, _G16, _B16, _A16 = (np.uint64(16 * i if _LITTLE else 48 - 16 * i) for i in range(4))
_BYTE, _WORD = np.uint32(0xFF), np.uint64(0xFFFF)
_ZERO, _HALF, _ONE, _TOP8, _TINY = (np.float32(v) for v in (0, 0.5, 1, 255, 1e-30))
_PER_BYTE = np.float32(1 / 255)
_STEPS, _STEP = 65536.0, np.float32(2.0**-16)


@forced
def _clamp(value: np.float32, top: np.float32) -> np.float32:
    value = value if value > _ZERO else _ZERO  # in this order NaN becomes 0
    return value if value < top else top


@forced
def _byte(value: np.float32) -> np.uint32:
    """Nearest integer of 0..255, ties up; NaN gives 0."""
    return np.uint32(np.int32(_clamp(value, _TOP8) + _HALF))


@forced
def _word(value: float) -> np.uint64:
    """Nearest integer of 0..65535, ties up; NaN gives 0."""
    value = value if value > 0.0 else 0.0
    value = value if value < 65535.0 else 65535.0
    return np.uint64(np.int64(value + 0.5))


@dividing
def _straight8(planes: np.ndarray, out: np.ndarray) -> None:
    for i in range(out.size):
        a = _clamp(planes[3, i], _ONE)
        alpha = _byte(_TOP8 * a)
        scale = _TOP8 / (a if a > _TINY else _ONE)
        scale = scale if alpha > 0 else _ZERO
        r, g, b = _byte(planes[0, i] * scale), _byte(planes[1, i] * scale), _byte(planes[2, i] * scale)
        out[i] = (r << _R8) | (g << _G8) | (b << _B8) | (alpha << _A8)


@dividing
def _straight16(planes: np.ndarray, out: np.ndarray) -> None:
    for i in range(out.size):
        a = np.float64(_clamp(planes[3, i], _ONE))
        alpha = _word(65535.0 * a)
        scale = 65535.0 / (a if a > 1e-30 else 1.0)
        scale = scale if alpha > 0 else 0.0
        r, g, b = _word(planes[0, i] * scale), _word(planes[1, i] * scale), _word(planes[2, i] * scale)
        out[i] = (r << _R16) | (g << _G16) | (b << _B16) | (alpha << _A16)


def _plainly_premultiplied8(planes: np.ndarray, out: np.ndarray) -> None:
    """As `_premultiplied8`, plainly."""
    alpha = clamped(planes[3], _ONE)
    values = np.stack([*clamped(planes[:3], alpha), alpha])
    r, g, b, a = (clamped(_TOP8 * values, _TOP8) + _HALF).astype(np.uint32)
    out[:] = (r << _R8) | (g << _G8) | (b << _B8) | (a << _A8)


@or_plain(_plainly_premultiplied8)
@dividing
def _premultiplied8(planes: np.ndarray, out: np.ndarray) -> None:
    for i in range(out.size):
        a = _clamp(planes[3, i], _ONE)
        r, g, b = _clamp(planes[0, i], a), _clamp(planes[1, i], a), _clamp(planes[2, i], a)
        out[i] = (
            (_byte(_TOP8 * r) << _R8)
            | (_byte(_TOP8 * g) << _G8)
            | (_byte(_TOP8 * b) << _B8)
            | (_byte(_TOP8 * a) << _A8)
        )


@dividing
def _planes8(pixels: np.ndarray, out: np.ndarray) -> None:
    for i in range(pixels.size):
        p = pixels[i]
        a = snap(np.float32((p >> _A8) & _BYTE) * _PER_BYTE)
        scale = a * _PER_BYTE
        out[0, i] = snap(np.float32((p >> _R8) & _BYTE) * scale)
        out[1, i] = snap(np.float32((p >> _G8) & _BYTE) * scale)
        out[2, i] = snap(np.float32((p >> _B8) & _BYTE) * scale)
        out[3, i] = a


@dividing
def _planes16(pixels: np.ndarray, out: np.ndarray) -> None:
    for i in range(pixels.size):
        p = pixels[i]
        a = np.floor(np.float64((p >> _A16) & _WORD) * _STEPS / 65535.0 + 0.5)
        scale = a / 65535.0
        out[0, i] = np.float32(np.floor(np.float64((p >> _R16) & _WORD) * scale + 0.5)) * _STEP
        out[1, i] = np.float32(np.floor(np.float64((p >> _G16) & _WORD) * scale + 0.5)) * _STEP
        out[2, i] = np.float32(np.floor(np.float64((p >> _B16) & _WORD) * scale + 0.5)) * _STEP
        out[3, i] = np.float32(a) * _STEP


def _to_pixels(planes: np.ndarray, kernel: Callable[..., None], packed: type, channel: type) -> np.ndarray:
    if planes.ndim != 3 or len(planes) != 4:
        raise ValueError(f"pixels: found planes of shape {planes.shape}, expected (4, h, w)")
    _, height, width = planes.shape
    out = np.empty(height * width, packed)
    kernel(flat(planes), out)
    return out.view(channel).reshape(height, width, 4)


def _to_planes(pixels: np.ndarray, kernel: Callable[..., None], packed: type, channel: type) -> np.ndarray:
    if pixels.ndim != 3 or pixels.shape[2] != 4 or pixels.dtype != channel:
        expected = np.dtype(channel).name
        raise ValueError(f"pixels: found {pixels.dtype} of shape {pixels.shape}, expected {expected} (h, w, 4)")
    height, width, _ = pixels.shape
    out = np.empty((4, height, width), np.float32)
    words: np.ndarray = np.ascontiguousarray(pixels).reshape(-1).view(packed)
    words.setflags(write=False)
    kernel(words, out.reshape(4, -1))
    return out


def to_rgba8(planes: np.ndarray) -> np.ndarray:
    """Straight 8-bit RGBA (h, w, 4) of planes, clamped and rounded to nearest; all zero where alpha rounds to zero."""
    return _to_pixels(planes, _straight8, np.uint32, np.uint8)


def to_rgba16(planes: np.ndarray) -> np.ndarray:
    """Straight 16-bit RGBA, uint16 (h, w, 4) in the machine's byte order; otherwise as `to_rgba8`."""
    return _to_pixels(planes, _straight16, np.uint64, np.uint16)


def to_premul8(planes: np.ndarray) -> np.ndarray:
    """Premultiplied 8-bit RGBA (h, w, 4), colour <= alpha: what a screen's texture takes."""
    return _to_pixels(planes, _premultiplied8, np.uint32, np.uint8)


def from_rgba8(pixels: np.ndarray) -> np.ndarray:
    """Returns planes on the grid of straight 8-bit RGBA (h, w, 4).

    `to_rgba8` gives the same pixels back wherever alpha > 0: colour is scaled by the alpha that lies on the grid, and
    that is at least 257 steps, one more than there are colours.
    """
    return _to_planes(pixels, _planes8, np.uint32, np.uint8)


def from_rgba16(pixels: np.ndarray) -> np.ndarray:
    """Returns planes on the grid of straight uint16 RGBA (h, w, 4).

    `to_rgba16` gives alpha back, and colour where alpha is full; elsewhere colour to half a grid step over alpha.
    """
    return _to_planes(pixels, _planes16, np.uint64, np.uint16)
