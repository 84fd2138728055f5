"""The functions of whole arrays that each arithmetic has: elementary ones, Fourier transforms, products of complex
numbers, sums."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from engine.numeric import elementary, fourier, sums
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.functions import Functions, functions

_OfOne = Callable[[np.ndarray], np.ndarray]
_OfTwo = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True, slots=True)
class ArrayFunctions:
    """`powers`: of what is at least 0; `distance` of (x, y) from (0, 0); `turned`: complex numbers, or real ones, times
    others of the size 1; `size`, `angle`: of complex numbers; `waves`: e^(i x); `fft2`, `ifft2`: along the
    last two axes; `total`, `mean`: with `axis`, `dtype` and `keepdims` by name, as NumPy's, ours worked out in float64
    whatever the `dtype`; `single`: functions of single floats."""

    single: Functions
    exp: _OfOne
    expm1: _OfOne
    log: _OfOne
    log1p: _OfOne
    log2: _OfOne
    sin: _OfOne
    cos: _OfOne
    powers: Callable[[np.ndarray, float], np.ndarray]
    arctan2: _OfTwo
    distance: _OfTwo
    size: _OfOne
    angle: _OfOne
    waves: _OfOne
    turned: _OfTwo
    fft2: _OfOne
    ifft2: _OfOne
    total: Callable[..., np.ndarray]
    mean: Callable[..., np.ndarray]


def _library_waves(angles: np.ndarray) -> np.ndarray:
    out: np.ndarray = np.cos(angles) + np.complex64(1j) * np.sin(angles)
    return out


def _distance(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Of any shapes that fit; worked out in float64."""
    far: np.ndarray = np.sqrt(np.square(x, dtype=np.float64) + np.square(y, dtype=np.float64))
    return far.astype(np.result_type(x, y))


def _size(values: np.ndarray) -> np.ndarray:
    return _distance(values.real, values.imag)


def _angle(values: np.ndarray) -> np.ndarray:
    return elementary.angles(values.imag, values.real)


def _waves(angles: np.ndarray) -> np.ndarray:
    out = np.empty(angles.shape, np.complex64 if angles.dtype == np.float32 else np.complex128)
    out.real, out.imag = elementary.mapped(elementary.cos, angles), elementary.mapped(elementary.sin, angles)
    return out


def _turned(values: np.ndarray, waves: np.ndarray) -> np.ndarray:
    out = np.empty(np.broadcast_shapes(values.shape, waves.shape), np.result_type(values, waves))
    a, b, c, d = values.real, values.imag, waves.real, waves.imag
    out.real, out.imag = a * c - b * d, a * d + b * c
    return out


_AXES = (-2, -1)
_ROWS = {
    LIBRARY: ArrayFunctions(
        functions(LIBRARY),
        np.exp,
        np.expm1,
        np.log,
        np.log1p,
        np.log2,
        np.sin,
        np.cos,
        np.power,
        np.arctan2,
        np.hypot,
        np.abs,
        np.angle,
        _library_waves,
        np.multiply,
        partial(np.fft.fft2, axes=_AXES),
        partial(np.fft.ifft2, axes=_AXES),
        np.sum,
        np.mean,
    ),
    EVERYWHERE: ArrayFunctions(
        functions(EVERYWHERE),
        partial(elementary.mapped, elementary.exp),
        partial(elementary.mapped, elementary.expm1),
        partial(elementary.mapped, elementary.log),
        partial(elementary.mapped, elementary.log1p),
        partial(elementary.mapped, elementary.log2),
        partial(elementary.mapped, elementary.sin),
        partial(elementary.mapped, elementary.cos),
        elementary.powers,
        elementary.angles,
        _distance,
        _size,
        _angle,
        _waves,
        _turned,
        fourier.fft2,
        fourier.ifft2,
        sums.total,
        sums.mean,
    ),
}


def array_functions(arithmetic: int) -> ArrayFunctions:
    """Returns the functions of an arithmetic."""
    return _ROWS[arithmetic]
