"""Spectral textures: a painted spectrum to its preview, and the endless field against convolving dense noise."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from bench import Figure, Skipped
from bench.clock import best
from engine.numeric.address import Rect
from engine.numeric.shapes import drawn
from engine.numeric.sparse import Impulse, Noise, field
from engine.numeric.spectra import radial_window, texture_of

REPEATS = 15
FRAME = 1.0 / 60.0
SIDE = 256  # of the spectrum
SAMPLE = 64
DENSITY = 10.0
TOGETHER = 1024  # pixels along a side of the square that the fields made one after the other cover
TIMES_FASTER = {1024: 12.0, 128: 20.0}


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    yield _preview(1 if small else REPEATS)
    for side, limit in TIMES_FASTER.items():
        yield from _field(side, limit, 1 if small else 2 * REPEATS)


def _preview(repeats: int) -> Figure:
    """An amplitude of 256 x 256 with random phases, as the bytes that the window shows."""
    amplitude = drawn("ring", (SIDE, SIDE), {})

    def own() -> np.ndarray:
        grey = np.clip(texture_of(amplitude, 1) * 127.5 + 128.0, 0.0, 255.0).astype(np.uint8)
        out = np.full((SIDE, SIDE, 4), 255, np.uint8)
        out[..., :3] = grey[..., None]
        return out

    [taken] = best(repeats, own)
    return Figure(f"spectrum preview {SIDE}", taken * 1e3, "ms", "a frame of 16.7 ms", taken / FRAME, 1.0)


def _field(side: int, limit: float, repeats: int) -> Iterator[Figure | Skipped]:
    """A grey field of 64 x 64 samples at 10 points an area, somewhere far out; theirs: dense noise, same size.

    First against convolving noise that is there already, with zeros around it; then with noise around it, so that every
    pixel is one of an endless field; then against the work that gives the same: the noise is made too.
    """
    name = f"endless field {side}"
    try:
        from scipy.signal import oaconvolve
    except ImportError:
        yield Skipped(name, "scipy is not installed")
        return
    random = np.random.default_rng(1)
    sample = random.standard_normal((SAMPLE, SAMPLE)).astype(np.float32) * radial_window(SAMPLE)
    impulse, noise, count = Impulse.of(sample[None]), Noise(5, DENSITY), (TOGETHER // side) ** 2
    places = [Rect.at((1 << 40) + 77 + side * i, -9000, side, side) for i in range(count)]
    dense = random.standard_normal((side, side)).astype(np.float32)
    around = side + SAMPLE - 1
    wide = random.standard_normal((around, around)).astype(np.float32)

    def own() -> None:
        for rect in places:
            field(impulse, noise, rect)

    def given() -> None:
        for _ in places:
            oaconvolve(dense, sample, mode="same")

    def wider() -> None:
        for _ in places:
            oaconvolve(wide, sample, mode="valid")

    def whole() -> None:
        for _ in places:
            oaconvolve(random.standard_normal((around, around), dtype=np.float32), sample, mode="valid")

    taken, theirs, around_it, all_of_it = best(repeats, own, given, wider, whole)
    speed, bound = count * side * side / taken / 1e6, f"scipy's oaconvolve of {side} x {side}"
    note = "one thread; their noise is given, ours makes its points from the place"
    yield Figure(name, speed, "Mpixel/s", bound, theirs / taken, limit, True, note)
    note = "one thread; their noise is given, and no pixel lacks a neighbour"
    yield Figure(f"{name}, noise around", speed, "Mpixel/s", bound, around_it / taken, limit, True, note)
    note = "one thread; both make their noise, and no pixel lacks a neighbour"
    yield Figure(f"{name}, noise made", speed, "Mpixel/s", bound, all_of_it / taken, limit, True, note)
