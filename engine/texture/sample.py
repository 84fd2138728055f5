"""A sample of texture at its own resolution: its pyramid, its impulse response, and its finest octaves by themselves.

Lewis 1984, sections 5.2 and 5.3.  A sample travels as a picture whose red, green and blue are s = (S + 1)/2; it is grey
where the three are equal.  Its *native* level is the first on which it is no smaller than its own pixels.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.functions import functions
from engine.numeric.memo import remembered
from engine.numeric.pyramid import reduce
from engine.numeric.sparse import Impulse
from engine.numeric.spectra import frequencies, radial_window
from engine.texture.image import ImageSource, stretched
from engine.texture.octaves import Continuation
from engine.texture.raster import row_bands

LARGEST = 2048  # pixels along a side of an impulse response
_SLIVER = 16  # a sample is not enlarged beyond so many times its pixels
_FAINT = 1e-3  # an octave below this part of the strongest one's energy is empty


@remembered
def coloured(source: ImageSource) -> bool:
    """Tells whether the picture's channels differ."""
    parts = (source.planes(band) for band in row_bands(source.width, source.height)) if source.there else ()
    return any(not ((part[0] == part[1]).all() and (part[0] == part[2]).all()) for part in parts)


@remembered
def finer(source: ImageSource, period: int, largest: int | None = None) -> int:
    """Tells how many levels finer than one on which the sample is `period` pixels wide its native level is; or
    coarser, < 0.

    `largest`: the native size is at most so many pixels along a side.
    """
    width, height = source.width, source.height
    shape = height / width
    n = 0
    while _wide(period, n) < width and _wide(period, n + 1) ** 2 * shape <= _SLIVER * width * height:
        n += 1
    while _wide(period, n) >= 2 * width and _wide(period, n) > 2:
        n -= 1
    while largest is not None and max(1.0, shape) * _wide(period, n) > largest and _wide(period, n) > 2:
        n -= 1
    return n


def _wide(period: int, n: int) -> int:
    return period << n if n >= 0 else max(1, round(period / (1 << -n)))


def _native(source: ImageSource, period: int, n: int) -> np.ndarray:
    """S at the native level, `n` levels finer than the base: float32 (1 or 3, h, w); divisible as often as it must."""
    width, shape = _wide(period, n), source.height / source.width
    height = max(1, round(period * shape)) << n if n > 0 else max(1, round(width * shape))
    planes = stretched(source, (height, width), np.arange(height), np.arange(width))
    return 2.0 * planes[: 3 if coloured(source) else 1] - np.float32(1.0)


@dataclass(frozen=True, eq=False, slots=True)
class Tile:
    """`mean`: of each channel, float32 (c, 1, 1); `levels`: S less that, from the base level to the native one (which
    alone there is if it is the coarser one), float32 (c, h, w); `top`: its finest octaves."""

    mean: np.ndarray
    levels: tuple[np.ndarray, ...]
    top: np.ndarray
    form: Continuation


@remembered
def tile(source: ImageSource, period: int, arithmetic: int = LIBRARY) -> Tile:
    """Gives the pyramid of a sample that is tiled with a period in pixels of its base level; kept for the next call."""
    n = finer(source, period)
    native = _native(source, period, n)
    mean = _mean(native, arithmetic)
    native = native - mean
    levels = [native]
    for _ in range(n):
        levels.append(reduce(levels[-1]))
    for plane in levels:
        plane.flags.writeable = False
    return Tile(mean, tuple(reversed(levels)), *_top(native, arithmetic))


@dataclass(frozen=True, eq=False, slots=True)
class Response:
    """`mean`: the sample's, float32 (c, 1, 1); `own`: its impulse response at the native level, of energy 1 per
    channel and area of the sample."""

    mean: np.ndarray
    own: Impulse


@remembered
def sample_response(source: ImageSource, period: int, arithmetic: int = LIBRARY) -> Response:
    """Returns the zero-mean sample under the radial Gaussian window."""
    native = _native(source, period, finer(source, period, LARGEST))
    own = _windowed(native, arithmetic)
    energy = _held(own, arithmetic) / native.size
    own *= np.float32(functions(arithmetic).power(energy, -0.5) if energy > 1e-10 else 0.0)
    return Response(_mean(native, arithmetic), Impulse.of(own))


@remembered
def finest(source: ImageSource, period: int, arithmetic: int = LIBRARY) -> tuple[Impulse, Continuation]:
    """Returns the finest octaves of the impulse response, at the native level, and how they continue it.  Only who
    zooms in needs them."""
    top, form = _top(sample_response(source, period, arithmetic).own.phases[0, 0], arithmetic)
    held = _held(top, arithmetic)
    top = _windowed(top, arithmetic)
    left = _held(top, arithmetic)
    top *= np.float32(functions(arithmetic).power(held / left, 0.5) if left > 0.0 else 0.0)
    return Impulse.of(top), form


TURNS = 16  # of a sample whose copies are turned


def _turned(planes: np.ndarray, turn: float, arithmetic: int) -> Iterator[np.ndarray]:
    """Yields `planes` (c, h, w) turned by angles spread evenly over so much of a whole turn, around their middle, in
    squares as large as their longer side; as strong as they are."""
    height, width = planes.shape[1:]
    side, own, held = max(height, width), functions(arithmetic), _held(planes, arithmetic)
    around = np.pad(planes, ((0, 0), (1, 1), (1, 1))).astype(np.float64)
    off = np.arange(side) + 0.5 - side / 2.0
    for n in range(TURNS):
        angle = 2.0 * math.pi * turn * ((n + 0.5) / TURNS - 0.5)
        cosine, sine = own.cos(angle), own.sin(angle)
        x = np.clip(off[None] * cosine + off[:, None] * sine + (width / 2.0 + 0.5), 0.0, width + 0.999)
        y = np.clip(off[:, None] * cosine - off[None] * sine + (height / 2.0 + 0.5), 0.0, height + 0.999)
        i, j = x.astype(np.int64), y.astype(np.int64)
        u, v = x - i, y - j
        top = around[:, j, i] * (1.0 - u) + around[:, j, i + 1] * u
        low = around[:, j + 1, i] * (1.0 - u) + around[:, j + 1, i + 1] * u
        found = (top * (1.0 - v) + low * v).astype(np.float32)
        left = _held(found, arithmetic)
        yield found * np.float32(math.sqrt(held / left) if left > 0.0 else 0.0)


@remembered
def turned_responses(
    source: ImageSource, period: int, turn: float, arithmetic: int = LIBRARY, octave: bool = False
) -> tuple[Impulse, ...]:
    """Returns the impulse response of a sample, or its finest octaves, turned by several angles."""
    plain = finest(source, period, arithmetic)[0] if octave else sample_response(source, period, arithmetic).own
    return tuple(map(Impulse.of, _turned(plain.phases[0, 0], turn, arithmetic)))


@remembered
def turned_seen(
    source: ImageSource, period: int, turn: float, coarser: int, arithmetic: int = LIBRARY
) -> tuple[Impulse, ...]:
    """Returns the same some levels above the native one."""
    return tuple(one.seen(coarser) for one in turned_responses(source, period, turn, arithmetic))


def _windowed(planes: np.ndarray, arithmetic: int) -> np.ndarray:
    """`planes` (c, h, w) under the window, their means under it taken off."""
    window, total = radial_window(planes.shape[1], planes.shape[2], arithmetic), array_functions(arithmetic).total
    weight = np.float32(max(float(total(window, dtype=np.float64)), 1e-9))
    out: np.ndarray = (planes - total(planes * window, axis=(1, 2), keepdims=True) / weight) * window
    return out


@remembered
def seen(source: ImageSource, period: int, coarser: int, arithmetic: int = LIBRARY) -> Impulse:
    """Returns the impulse response some levels above the native one."""
    return sample_response(source, period, arithmetic).own.seen(coarser)


def _mean(planes: np.ndarray, arithmetic: int) -> np.ndarray:
    return array_functions(arithmetic).mean(planes, axis=(1, 2), keepdims=True, dtype=np.float64).astype(np.float32)


def _held(planes: np.ndarray, arithmetic: int) -> float:
    """Returns the energy of planes."""
    return float(array_functions(arithmetic).total(np.square(planes, dtype=np.float64)))


def _top(planes: np.ndarray, arithmetic: int) -> tuple[np.ndarray, Continuation]:
    """Returns the octaves of (periodic) `planes` (c, h, w) from the finest down to the highest that is not empty.

    Of 1/f noise that is the finest alone; of a ring at a period of 16 pixels, all down to the ring.
    """
    own, (_, height, width) = array_functions(arithmetic), planes.shape
    v, u = frequencies(height, width)
    f = np.fft.ifftshift(own.distance(u, v))
    spectrum = own.fft2(planes)
    power = np.square(own.size(spectrum)).sum(0, dtype=np.float64)
    octave = np.ceil(own.log2(np.maximum(f, 1e-9))).clip(-40, 0)
    held = np.array([float(own.total(power[octave == -i])) for i in range(max(1, max(height, width).bit_length() - 1))])
    lowest = int(np.argmax(held >= _FAINT * held.max()))
    edge = 2.0 ** (-lowest - 1)  # passed from there on, half way at 1/1.2 of it, nothing below 1/1.44
    passed = np.clip(1.0 + own.log(np.maximum(f, 1e-9) / edge) / own.log(np.array([1.44])), 0.0, 1.0)
    part = np.square(own.sin(0.5 * np.pi * passed)).astype(np.float32)
    out = own.ifft2(own.turned(spectrum, part)).real
    whole = float(own.total(power))
    strength = float(own.total(power * np.square(part))) / whole if whole > 0.0 else 0.0
    middle = float(own.total(held * np.arange(held.size))) / max(float(own.total(held)), 1e-30)
    form = Continuation(round(functions(arithmetic).power(strength, 0.5), 6), round(1.0 + middle, 3), 1.0 + lowest)
    return np.ascontiguousarray(out, np.float32), form
