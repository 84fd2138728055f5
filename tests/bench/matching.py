"""Texture matched to an example: against the same method in plain Python, the published C code, and its transforms."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np

from bench import Figure, Skipped
from bench.clock import Work, best, seconds, slowness
from engine.numeric import histograms, steerable
from engine.numeric.address import Rect
from engine.numeric.colour_axes import axes_of
from engine.numeric.steerable import places
from engine.texture import matching, solid
from engine.texture.matching import Shape
from engine.texture.table import instance

REPEATS = 9
SHAPE = Shape("steerable", 4, 4)
TURNS = 5
SIDE = 256  # of the example
PUBLISHED = {256: 1.6, 512: 6.7}  # seconds that the C code of IPOL took, measured elsewhere
TIMES_FASTER = 10.0
TRANSFORMS = 2.5  # the match may take so many times as long as its transforms
PYRAMID_FASTER = 6.0
PREVIEW = 0.060  # seconds
TOGETHER = 1.3  # how many times faster two threads are, at least
CUBE = 64


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    repeats = 1 if small else REPEATS
    slow = slowness(1 if small else 25)
    for side in (32, 64) if small else (256, 512):
        example = _example(32 if small else SIDE)
        yield from _against_plain(example, side, repeats)
        yield _against_published(example, side, repeats, slow)
    yield _pyramid(32 if small else SIDE, repeats)
    side = 32 if small else 512
    yield _threads(example, side, repeats)
    yield _transforms(example, side, repeats)
    yield _preview(_example(side // 4), repeats)
    yield _solid(_example(side // 4), 16 if small else CUBE, repeats)
    yield _settling(_example(side // 4), 16 if small else CUBE, repeats)


def _example(side: int) -> np.ndarray:
    """Three rocks as red, green and blue: float32 (3, side, side) in 0..1."""
    planes = [
        instance("rock", {"period": 12, "seed": seed}, 0, 0).appearance(0, Rect.at(0, 0, side, side))[0]
        for seed in range(3)
    ]
    mixed = [planes[0], 0.8 * planes[0] + 0.2 * planes[1], 0.6 * planes[0] + 0.2 * planes[1] + 0.2 * planes[2]]
    return np.clip(0.5 + 0.5 * np.stack(mixed), 0.0, 1.0).astype(np.float32)


def _matched(example: np.ndarray, side: int, threads: Executor | None = None) -> np.ndarray:
    """From picture to picture."""
    pattern = matching.analysed(example, SHAPE.within((side, side)))
    start = matching.noise(pattern.colours.count, (side, side), 1)
    return matching.matched_colours(pattern, matching.matched(pattern, start, TURNS, threads))


def _against_plain(example: np.ndarray, side: int, repeats: int) -> Iterator[Figure | Skipped]:
    name = f"match {example.shape[1]} to {side}"
    try:
        theirs = plain(example, side)
    except ImportError as error:
        yield Skipped(f"{name}, plain", f"{error.name} is not installed")
        return
    taken = best(repeats, lambda: _matched(example, side))[0]
    other = min(seconds(theirs) for _ in range(min(repeats, 2)))
    bound = "pyrtools and skimage"
    yield Figure(f"{name}, plain", taken * 1e3, "ms", bound, other / taken, TIMES_FASTER, True, "one thread each")


def plain(example: np.ndarray, side: int) -> Work:
    """The same method with pyrtools' pyramid and skimage's histograms, as one would write it down."""
    from skimage.exposure import match_histograms

    pyramid = _published_pyramid()
    shape = SHAPE.within((side, side), example.shape[1:])
    axes = axes_of(example)

    def work() -> np.ndarray:
        out = np.empty((axes.count, side, side), np.float32)
        for k, plane in enumerate(axes.planes(example)):
            wanted = pyramid(plane, shape).pyr_coeffs
            found = match_histograms(np.random.default_rng(k).random((side, side)), plane)
            for _ in range(TURNS):
                made = pyramid(found, shape)
                for key, band in made.pyr_coeffs.items():
                    made.pyr_coeffs[key] = match_histograms(band, wanted[key])
                found = match_histograms(made.recon_pyr(), plane)
            out[k] = found
        return axes.colours(out)

    return work


def _pyramid(side: int, repeats: int) -> Figure | Skipped:
    """Built and collapsed, one grey picture."""
    name = f"steerable pyramid {side}"
    try:
        theirs = _published_pyramid()
    except ImportError as error:
        return Skipped(name, f"{error.name} is not installed")
    plane = _example(side)[0]
    shape = SHAPE.within(plane.shape)
    made = steerable.filters(side, side, shape.levels, shape.orientations)

    def own() -> None:
        steerable.collapse(steerable.build(plane, made), made)

    taken, other, floor = best(repeats, own, lambda: theirs(plane, shape).recon_pyr(), _bare(plane[None], made, 1))
    note = f"built and collapsed; its transforms alone would be {other / floor:.1f} x"
    return Figure(name, taken * 1e3, "ms", "pyrtools", other / taken, PYRAMID_FASTER, True, note)


def _bare(planes: np.ndarray, made: steerable.Filters, turns: int) -> Work:
    """The Fourier transforms of so many turns and nothing else."""
    sizes = [(made.size(place), made.mask(place).shape) for place in places(made.levels, made.orientations)]
    halves = [(size, np.zeros((len(planes), *shape), np.complex64)) for size, shape in sizes]

    def work() -> None:
        for _ in range(turns):
            half = steerable.spectrum(planes)
            for size, spectrum in halves:
                steerable.spectrum(steerable.image(spectrum, size))
            steerable.image(half, made.sizes[0])

    return work


def _published_pyramid() -> Callable[[np.ndarray, Shape], Any]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from pyrtools.pyramids import SteerablePyramidFreq
    return lambda plane, shape: SteerablePyramidFreq(plane, shape.levels, shape.orientations - 1, is_complex=False)


def _against_published(example: np.ndarray, side: int, repeats: int, slow: float) -> Figure:
    taken = best(repeats, lambda: _matched(example, side))[0]
    theirs = PUBLISHED.get(side, 0.1) * slow
    note = f"its figure of another run, as copying takes {slow:.2f} x as long; one thread"
    name = f"match {example.shape[1]} to {side}, published"
    return Figure(name, taken * 1e3, "ms", "the C code's, scaled", theirs / taken, TIMES_FASTER, True, note)


def _threads(example: np.ndarray, side: int, repeats: int) -> Figure:
    with ThreadPoolExecutor(2) as pool:
        one, two = best(repeats, lambda: _matched(example, side), lambda: _matched(example, side, pool))
    name = f"match {example.shape[1]} to {side}, two threads"
    return Figure(name, two * 1e3, "ms", "one thread", one / two, TOGETHER, True)


def _transforms(example: np.ndarray, side: int, repeats: int) -> Figure:
    """The turns alone against their Fourier transforms alone."""
    pattern = matching.analysed(example, SHAPE.within((side, side)))
    start = matching.noise(pattern.colours.count, (side, side), 1)
    made = matching.filters_for(start, pattern.shape)
    bands = {place: np.zeros((len(start), *made.size(place)), np.float32) for place in pattern.shape.places()}

    def tables() -> None:
        for _ in range(TURNS):
            for place, values in bands.items():
                for band, wanted in zip(values, pattern.bands, strict=True):
                    histograms.match(band, wanted[place])

    for place, values in bands.items():
        values[:] = np.random.default_rng(place.level + 9).standard_normal(values.shape)
    taken, floor, moved = best(
        repeats, lambda: matching.matched(pattern, start, TURNS), _bare(start, made, TURNS), tables
    )
    whole = 2 * sum(math.prod(made.size(place)) for place in bands) / side**2 + 2
    note = f"{TURNS * len(start)} x {whole:.1f} transforms of {side} x {side}; histograms take {moved / taken:.0%}"
    return Figure(f"turns at {side}", taken * 1e3, "ms", "their transforms", taken / floor, TRANSFORMS, note=note)


def _preview(example: np.ndarray, repeats: int) -> Figure:
    side = example.shape[1]
    taken = best(repeats, lambda: _matched(example, side))[0]
    return Figure(f"preview {side}", taken * 1e3, "ms", f"{PREVIEW * 1e3:.0f} ms", taken / PREVIEW, 1.0)


def _solid(example: np.ndarray, side: int, repeats: int) -> Figure:
    """One turn of a cube, without those of smaller ones, against the transforms of all its slices."""
    wanted = replace(solid.patterns(example, side, SHAPE), coarser=None)
    start = solid.noise(wanted.oriented.colours.count, side, 1)
    made = matching.filters_for(start, wanted.oriented.shape)

    def own() -> None:
        for _ in solid.matching(wanted, start, 1, settling=0):
            pass

    bare = _bare(start[0], made, len(solid.CUTS) * len(start))
    taken, floor = best(min(repeats, 5), own, bare)
    return Figure(f"a turn of a solid {side}", taken * 1e3, "ms", "its transforms", taken / floor, 2 * TRANSFORMS)


def _settling(example: np.ndarray, side: int, repeats: int) -> Figure:
    """A turn of settling a cube, against one of matching its slices."""
    wanted = replace(solid.patterns(example[:1], side, SHAPE), coarser=None)
    start = solid.noise(1, side, 1)

    def settled(turns: int) -> Work:
        def work() -> None:
            for _ in solid.matching(wanted, start, 1, settling=turns):
                pass

        return work

    matched, both = best(min(repeats, 5), settled(0), settled(TURNS))
    taken = (both - matched) / TURNS
    return Figure(f"a turn of settling {side}", taken * 1e3, "ms", "one of matching", taken / matched, 1.0)
