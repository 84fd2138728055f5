"""The steerable pyramid: oriented bands of octaves of frequency, self-inverting (Heeger & Bergen 1995, section 3.1).

Simoncelli, Freeman, Adelson & Heeger 1992, "Shiftable multi-scale transforms"; the filters are raised cosines of the
logarithm of the frequency, as in Portilla & Simoncelli 2000, times cosines of the orientation to the power K - 1.
Everything happens among frequencies: a band is the spectrum times a mask, cut to the frequencies that it has, so any
size will do, edges are circular, and squares of all masks add up to one.  Only real transforms are made.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from engine.numeric import real_fourier
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.kernel import kernel

Change = Callable[["Place", np.ndarray], None]

_CACHED = 1 << 21  # pixels: filters of larger pictures are made anew each time
_AXES = (-2, -1)


@dataclass(frozen=True, slots=True)
class Place:
    """A subband: `level` 0 is the finest, -1 the high-pass residue, `levels` the low-pass residue; `orientation` k of
    K answers waves that run at the angle pi k / K from the x axis."""

    level: int
    orientation: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Filters:
    """The masks for pictures of one size, each for the half of the frequencies that a real transform keeps.

    `high` (H, W//2 + 1); `bands[l]` (K, h, w//2 + 1) for l = 0 (the full size) to levels - 1; `low` for the last of
    `sizes`, which are (h, w) of each level and of the low-pass residue, each half the one before, rounded up.
    `arithmetic`: in which they were made, and pictures are transformed.
    """

    levels: int
    orientations: int
    sizes: tuple[tuple[int, int], ...]
    high: np.ndarray
    bands: tuple[np.ndarray, ...]
    low: np.ndarray
    arithmetic: int = LIBRARY

    @property
    def odd(self) -> bool:
        """Tells whether the oriented filters are odd functions (edges), which have imaginary spectra, or even ones
        (bars)."""
        return self.orientations % 2 == 0

    def mask(self, place: Place) -> np.ndarray:
        """Gives what a subband's place is multiplied with in the spectrum."""
        if place.level < 0:
            return self.high
        return self.low if place.level == self.levels else self.bands[place.level][place.orientation]

    def size(self, place: Place) -> tuple[int, int]:
        """Gives the size of a subband, as `sizes`."""
        return self.sizes[max(place.level, 0)]

    def turned(self, place: Place) -> bool:
        """Tells whether the band's spectrum is imaginary times its mask."""
        return self.odd and 0 <= place.level < self.levels


def places(levels: int, orientations: int) -> list[Place]:
    """Returns all subbands, from fine to coarse."""
    oriented = [Place(level, k) for level in range(levels) for k in range(orientations)]
    return [Place(-1), *oriented, Place(levels)]


def most_levels(height: int, width: int) -> int:
    """Tells how many levels a picture has room for: the low-pass residue is 4 pixels or more on its shorter side."""
    return max(0, int(max(min(height, width), 1)).bit_length() - 3)


def filters(height: int, width: int, levels: int, orientations: int, arithmetic: int = LIBRARY) -> Filters:
    """Returns the masks for pictures of `height` x `width`; kept for a while, if they are not too large."""
    if min(height, width, orientations) < 1 or not 0 <= levels <= most_levels(height, width):
        raise ValueError(
            f"steerable pyramid: found {levels} levels, {orientations} orientations for {height} x {width}"
        )
    made = _cached if height * width <= _CACHED else _made
    return made(height, width, levels, orientations, arithmetic)


def _made(height: int, width: int, levels: int, orientations: int, arithmetic: int) -> Filters:
    sizes = [(height, width)]
    for _ in range(levels):
        sizes.append((-(-sizes[-1][0] // 2), -(-sizes[-1][1] // 2)))
    high, _ = _split(_logarithm(height, width, height, width, arithmetic)[0], arithmetic)
    bands = []
    for level, (h, w) in enumerate(sizes[:-1]):
        logarithm, angle = _logarithm(height, width, h, w, arithmetic)
        bands.append(masks(logarithm, angle, level, levels, orientations, arithmetic))
    (low,) = masks(*_logarithm(height, width, *sizes[-1], arithmetic), levels, levels, orientations, arithmetic)
    fine, *oriented, coarse = (_kept(mask) for mask in (high, *bands, low))
    return Filters(levels, orientations, tuple(sizes), fine, tuple(oriented), coarse, arithmetic)


def masks(
    logarithm: np.ndarray, angle: np.ndarray, level: int, levels: int, orientations: int, arithmetic: int = LIBRARY
) -> np.ndarray:
    """Returns the masks of the subbands of a level, 0 to `levels` (the low-pass residue), at any frequencies (...):
    log2 of them in parts of the highest along an axis, and their direction.  float64 (K, ...), K being 1 for the
    residue."""
    if level == levels:
        return _split(logarithm + level, arithmetic)[1][None]
    radial = _split(logarithm + level, arithmetic)[1] * _split(logarithm + level + 1, arithmetic)[0]
    return np.stack([radial * _angular(angle, k, orientations, arithmetic) for k in range(orientations)])


def _kept(mask: np.ndarray) -> np.ndarray:
    out = mask.astype(np.float32)
    out.flags.writeable = False
    return out


_cached = lru_cache(maxsize=6)(_made)


def _logarithm(height: int, width: int, h: int, w: int, arithmetic: int) -> tuple[np.ndarray, np.ndarray]:
    """log2 of the frequency in parts of the highest of (height, width), and its direction, at the lowest (h, w)."""
    rows = np.arange(h)
    v = np.where(rows < -(-h // 2), rows, rows - h)[:, None] * (2.0 / height)
    u = np.arange(w // 2 + 1)[None] * (2.0 / width)
    own, radius = array_functions(arithmetic), array_functions(arithmetic).distance(v, u)
    return own.log2(np.maximum(radius, 1e-9)), own.arctan2(*np.broadcast_arrays(v, u))


def _split(logarithm: np.ndarray, arithmetic: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the high-pass and the low-pass half of a split at the octave below log2 = 0; their squares add up to
    one."""
    turn = (np.pi / 2.0) * np.clip(logarithm + 1.0, 0.0, 1.0)
    own = array_functions(arithmetic)
    low = own.cos(turn)
    return own.sin(turn), np.where(logarithm >= 0.0, 0.0, low)  # exactly zero where the next level has no frequencies


def _angular(angle: np.ndarray, k: int, orientations: int, arithmetic: int) -> np.ndarray:
    order = orientations - 1
    scale = 2.0**order * math.factorial(order) / math.sqrt(orientations * math.factorial(2 * order))
    cosine = array_functions(arithmetic).cos(angle - np.pi * k / orientations)
    if arithmetic == LIBRARY:
        return scale * (-1.0) ** (orientations // 2) * cosine**order
    out = np.full_like(cosine, -scale if orientations // 2 % 2 else scale)
    for _ in range(order):
        out *= cosine
    return out


def spectrum(images: np.ndarray, arithmetic: int = LIBRARY) -> np.ndarray:
    """Half of the spectrum of real pictures (..., h, w): complex64 (..., h, w//2 + 1)."""
    if arithmetic != LIBRARY:
        return real_fourier.rfft2(images)
    from scipy.fft import rfft2

    out: np.ndarray = rfft2(np.asarray(images, np.float32), axes=_AXES)
    return out


def image(half: np.ndarray, size: tuple[int, int], spent: bool = False, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the pictures (..., *size) of half a spectrum: float32.  `spent`: the spectrum may be written over."""
    if arithmetic != LIBRARY:
        return real_fourier.irfft2(half, size, spent)
    from scipy.fft import irfft2

    out: np.ndarray = irfft2(half, s=size, axes=_AXES, overwrite_x=spent)
    return out


def band(half: np.ndarray, made: Filters, place: Place) -> np.ndarray:
    """Returns one subband of pictures whose half spectra (n, H, W//2 + 1) are given: float32 (n, h, w).

    Its values are those of the filtered picture: a smaller band is a sampling of it.
    """
    size = made.size(place)
    mask = made.mask(place)
    out = np.empty((half.shape[0], *mask.shape), np.complex64)
    turn = np.float32(1.0 if made.turned(place) else 0.0)
    scale = np.float32(math.prod(size) / math.prod(made.sizes[0]))
    _masked(half.view(np.float32), mask, scale, turn, out.view(np.float32))
    return image(out, size, True, made.arithmetic)


def give(total: np.ndarray, halves: np.ndarray, made: Filters, place: Place) -> None:
    """Adds to half spectra (n, h, w//2 + 1) of pictures as large as a subband what its own, `halves`, give them."""
    turn = np.float32(1.0 if made.turned(place) else 0.0)
    _add_masked(total.view(np.float32), made.mask(place), np.float32(1.0), turn, halves.view(np.float32))


def build(images: np.ndarray, made: Filters) -> dict[Place, np.ndarray]:
    """Returns the pyramid of pictures (..., H, W), float32: subbands (..., h, w) by their place."""
    planes = np.ascontiguousarray(images, np.float32).reshape(-1, *made.sizes[0])
    half = spectrum(planes, made.arithmetic)
    found = {place: band(half, made, place) for place in places(made.levels, made.orientations)}
    return {place: values.reshape(*images.shape[:-2], *values.shape[-2:]) for place, values in found.items()}


def collapse(pyramid: dict[Place, np.ndarray], made: Filters) -> np.ndarray:
    """Returns the pictures (..., H, W) again: of an untouched pyramid the same, to 1e-6 of their size."""
    leading = pyramid[Place(-1)].shape[:-2]
    total = np.zeros((math.prod(leading), *made.high.shape), np.complex64)
    for place in places(made.levels, made.orientations):
        values = pyramid[place]
        _give(total, spectrum(values.reshape(-1, *values.shape[-2:]), made.arithmetic), made, place)
    return image(total, made.sizes[0], True, made.arithmetic).reshape(*leading, *made.sizes[0])


def changed(
    images: np.ndarray, made: Filters, change: Change, threads: Executor | None = None
) -> Generator[float, None, np.ndarray]:
    """Yields pictures (n, H, W) whose subbands went through `change(place, values (n, h, w))`, which writes into
    `values`.

    As `build`, the changes, and `collapse`, but a subband is held no longer than needed.  Tells how large a part is
    done, 0..1, and returns the pictures.  With `threads`, several subbands are worked on at once; they are added up in
    the same order, so the result is the same bit for bit.
    """
    half = spectrum(np.ascontiguousarray(images, np.float32), made.arithmetic)
    total = np.zeros_like(half)

    def part(place: Place) -> np.ndarray:
        values = band(half, made, place)
        change(place, values)
        return spectrum(values, made.arithmetic)

    order = places(made.levels, made.orientations)
    sizes = [math.prod(made.size(place)) for place in order]
    done = 0
    for place, size, found in zip(order, sizes, _mapped(part, order, threads), strict=True):
        _give(total, found, made, place)
        done += size
        yield done / sum(sizes)
    return image(total, made.sizes[0], True, made.arithmetic)


def finished(steps: Generator[float, None, np.ndarray]) -> np.ndarray:
    """Returns what such a generator returns in the end."""
    while True:
        try:
            next(steps)
        except StopIteration as stop:
            out: np.ndarray = stop.value
            return out


def _mapped(work: Callable[[Place], np.ndarray], items: list[Place], threads: Executor | None) -> Iterator[np.ndarray]:
    return map(work, items) if threads is None else threads.map(work, items)


def _give(total: np.ndarray, half: np.ndarray, made: Filters, place: Place) -> None:
    """Adds what the half spectra of a subband (n, h, w//2 + 1) contribute to those of the pictures."""
    turn = np.float32(1.0 if made.turned(place) else 0.0)
    scale = np.float32(math.prod(made.sizes[0]) / math.prod(made.size(place)))
    _add_masked(total.view(np.float32), made.mask(place), scale, turn, half.view(np.float32))


@kernel
def _masked(spectra: np.ndarray, mask: np.ndarray, scale: np.float32, turn: np.float32, out: np.ndarray) -> None:
    """out (n, h, 2c) = the lowest frequencies of spectra (n, H, 2C) times mask (h, c), pairs being complex numbers;
    with turn = 1 times i as well."""
    height, (h, c) = spectra.shape[1], mask.shape
    for n in range(spectra.shape[0]):
        for j in range(h):
            line = spectra[n, j if 2 * j < h else height - h + j]
            row = mask[j]
            into = out[n, j]
            if turn > np.float32(0.0):
                for i in range(c):
                    m = row[i] * scale
                    into[2 * i] = -m * line[2 * i + 1]
                    into[2 * i + 1] = m * line[2 * i]
            else:
                for i in range(c):
                    m = row[i] * scale
                    into[2 * i] = m * line[2 * i]
                    into[2 * i + 1] = m * line[2 * i + 1]


@kernel
def _add_masked(total: np.ndarray, mask: np.ndarray, scale: np.float32, turn: np.float32, spectra: np.ndarray) -> None:
    """total (n, H, 2C) += spectra (n, h, 2c) times mask (h, c), at the lowest frequencies; with turn = 1 times -i."""
    height, (h, c) = total.shape[1], mask.shape
    for n in range(spectra.shape[0]):
        for j in range(h):
            line = total[n, j if 2 * j < h else height - h + j]
            row = mask[j]
            given = spectra[n, j]
            if turn > np.float32(0.0):
                for i in range(c):
                    m = row[i] * scale
                    line[2 * i] += m * given[2 * i + 1]
                    line[2 * i + 1] -= m * given[2 * i]
            else:
                for i in range(c):
                    m = row[i] * scale
                    line[2 * i] += m * given[2 * i]
                    line[2 * i + 1] += m * given[2 * i + 1]
