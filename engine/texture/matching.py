"""Texture matched to an example: noise is coerced until its subbands are distributed as the example's.

Heeger & Bergen 1995, sections 3.3 to 3.5.  A picture here is float32 (C, h, w) in 0..1: grey, RGB, or premultiplied
RGBA, whose alpha is a band like the others.  What is made tiles without seams.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from engine.numeric import histograms, laplacian, steerable
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.colour_axes import ColourAxes, axes_of
from engine.numeric.grid import snapped
from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.real_fourier import fast_length
from engine.numeric.steerable import Change, Place, places

LEVELS, ORIENTATIONS, ITERATIONS = 4, 4, 5
PYRAMIDS = ("steerable", "laplacian")

_DOMAIN = 0x6D617463  # "matc": tells these hashes from those of other textures
_FAINT = 1e-3  # of a start picture's spread: noise that tells equal values apart

Bands = dict[Place, np.ndarray]  # the sorted values of each subband
Match = Callable[[np.ndarray, np.ndarray], None]  # moves values, in place, to a distribution


@dataclass(frozen=True, slots=True)
class Shape:
    """Which pyramid: `kind` one of PYRAMIDS; `orientations` mean something to the steerable one only; `arithmetic`: in
    which pictures are taken apart."""

    kind: str = "steerable"
    levels: int = LEVELS
    orientations: int = ORIENTATIONS
    arithmetic: int = LIBRARY

    def places(self) -> list[Place]:
        """Gives the places of all subbands, the finest first."""
        if self.kind == "steerable":
            return places(self.levels, self.orientations)
        return [Place(level) for level in range(self.levels + 1)]

    def within(self, *sizes: tuple[int, ...]) -> Shape:
        """With no more levels than all these pictures have room for."""
        most = min(laplacian.most_levels(size) for size in sizes)
        return replace(self, levels=min(self.levels, most))


class Colours(Protocol):
    """How planes (R, h, w), R = `count`, become colours (C, h, w)."""

    @property
    def count(self) -> int:
        """Counts the axes of colour."""
        ...

    def colours(self, planes: np.ndarray) -> np.ndarray:
        """Gives the colours (C, h, w) of planes (R, h, w) along the axes: float32."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Pattern:
    """What is matched of an example: its colours, and for each of their axes the sorted values of `pixels` and of each
    subband.  Where `pixels` is None, only the subbands are."""

    colours: Colours
    shape: Shape
    pixels: tuple[np.ndarray, ...] | None
    bands: tuple[Bands, ...]


@dataclass(frozen=True, slots=True)
class Step:
    """How far a match has come: `done` 0..1, and after each iteration the texture as planes (R, h, w) along the axes
    of the pattern's colours."""

    done: float
    planes: np.ndarray | None = None


def analysed(picture: np.ndarray, shape: Shape, axes: ColourAxes | None = None) -> Pattern:
    """Returns the pattern of an example (C, h, w), mirrored at its edges, along given axes or its own."""
    axes = axes or axes_of(picture, shape.arithmetic)
    shape = shape.within(picture.shape[1:])
    planes = axes.planes(picture)
    pixels = tuple(histograms.sorted_values(plane) for plane in planes)
    return Pattern(axes, shape, pixels, tuple(_bands(plane, shape) for plane in planes))


def _bands(plane: np.ndarray, shape: Shape) -> Bands:
    """Returns the sorted values of the subbands of a plane (h, w)."""
    if shape.kind == "laplacian":
        pyramid = laplacian.build(plane, shape.levels, edges="reflected")
        return {Place(level): histograms.sorted_values(band) for level, band in enumerate(pyramid)}
    mirrored, within = _mirrored(plane, 4 << shape.levels)
    made = filters_for(mirrored, shape)
    half = steerable.spectrum(mirrored[None], shape.arithmetic)
    found = {}
    for place in shape.places():
        band = steerable.band(half, made, place)[0]
        rows, columns = (_cut(axis, n) for axis, n in zip(within, band.shape, strict=True))
        found[place] = histograms.sorted_values(band[rows, columns])
    return found


def _mirrored(plane: np.ndarray, reach: int) -> tuple[np.ndarray, list[tuple[float, float]]]:
    """Returns a plane with its mirror images around it, `reach` pixels of them or half its size on each side, and
    what part of each axis is its own.  Sizes are such that transforms are fast."""
    sides, within = [], []
    for n in plane.shape:
        margin = min(reach, n // 2)
        total = 2 * n if margin == n // 2 else fast_length(n + 2 * margin)
        sides.append((margin, total - n - margin))
        within.append((margin / total, (margin + n) / total))
    return np.pad(plane, sides, mode="symmetric"), within


def _cut(within: tuple[float, float], count: int) -> slice:
    start = round(within[0] * count)
    return slice(start, max(round(within[1] * count), start + 1))


def matching(
    pattern: Pattern,
    start: np.ndarray,
    iterations: int = ITERATIONS,
    threads: Executor | None = None,
    exact: bool = False,
) -> Iterator[Step]:
    """Yields the steps that make planes `start` (R, h, w) like the pattern.  The last has the finished texture; any
    may be the last that is asked for.  `exact`: by rank instead of tables, which takes twice as long."""
    shape = pattern.shape.within(start.shape[1:])
    if shape.levels < pattern.shape.levels:
        raise ValueError(
            f"matching: found a pattern of {pattern.shape.levels} levels, expected {shape.levels} or fewer"
        )
    match = histograms.match_by_rank if exact else histograms.match
    planes = np.array(start, np.float32)
    _match_pixels(planes, pattern, match)
    turns = iterations if len(planes) else 0
    for turn in range(turns):
        inside = _iterated(planes, pattern, match, threads)
        planes = yield from _told(inside, turn, turns)
        _match_pixels(planes, pattern, match)
        yield Step((turn + 1) / turns, planes)
    if not turns:
        yield Step(1.0, planes)


def _told(inside: Generator[float, None, np.ndarray], turn: int, turns: int) -> Generator[Step, None, np.ndarray]:
    """Yields the parts of one turn as steps of all; returns its planes."""
    while True:
        try:
            yield Step((turn + next(inside)) / turns)
        except StopIteration as stop:
            out: np.ndarray = stop.value
            return out


def matched(
    pattern: Pattern, start: np.ndarray, iterations: int = ITERATIONS, threads: Executor | None = None
) -> np.ndarray:
    """Returns the finished texture: planes (R, h, w) along the pattern's axes."""
    *_, last = matching(pattern, start, iterations, threads)
    assert last.planes is not None
    return last.planes


def matched_colours(pattern: Pattern, planes: np.ndarray) -> np.ndarray:
    """Returns the colours (C, h, w) of matched planes, float32 in 0..1 on the grid."""
    return snapped(pattern.colours.colours(planes))


def noise(count: int, size: tuple[int, int], seed: int) -> np.ndarray:
    """White noise, even in -1..1, by seed and place alone: float32 (count, h, w)."""
    height, width = size
    out = np.empty((count, height, width), np.float32)
    for channel in range(count):
        hashed = hash_plane(fold_key(_DOMAIN, seed, channel), 0, 0, width, height)
        np.multiply((hashed >> np.uint64(40)).astype(np.float32), np.float32(2.0**-23), out=out[channel])
    out -= np.float32(1.0)
    return out


def started(pattern: Pattern, planes: np.ndarray, seed: int) -> np.ndarray:
    """Returns planes (R', h, w) of another picture as a start: with faint noise, and only noise where it has no
    axis."""
    out = noise(pattern.colours.count, planes.shape[1:], seed)
    for own, given in zip(out, planes, strict=False):
        own *= np.float32(_FAINT)
        own += given
    return out


def _iterated(
    planes: np.ndarray, pattern: Pattern, match: Match, threads: Executor | None
) -> Generator[float, None, np.ndarray]:
    """Yields one turn: the pyramid taken apart, its subbands matched, and put together again."""
    change = _band_match(pattern, match)
    if pattern.shape.kind == "steerable":
        made = filters_for(planes, pattern.shape)
        return (yield from steerable.changed(planes, made, change, threads))
    pyramid = laplacian.build(planes, pattern.shape.levels)
    for level, band in enumerate(pyramid):
        change(Place(level), band)
        yield (level + 1) / len(pyramid)
    return laplacian.collapse(pyramid)


def filters_for(planes: np.ndarray, shape: Shape) -> steerable.Filters:
    """Gives the filters of a steerable pyramid for planes (..., h, w)."""
    height, width = planes.shape[-2:]
    return steerable.filters(height, width, shape.levels, shape.orientations, shape.arithmetic)


def _band_match(pattern: Pattern, match: Match) -> Change:
    def change(place: Place, values: np.ndarray) -> None:
        for band, bands in zip(values, pattern.bands, strict=True):
            match(band, bands[place])

    return change


def _match_pixels(planes: np.ndarray, pattern: Pattern, match: Match) -> None:
    for plane, ordered in zip(planes, pattern.pixels or (), strict=False):
        match(plane, ordered)
