"""An example texture, analysed: the pyramid of its region's colours, the shapes of its neighbourhoods, and lists of
its pixels by how many of their neighbours belong to the region (Ritter et al. 2006, sections 4 to 6).

A pixel of a level is named by (row << 16) | column, both counted from PAD outside the picture.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from engine.checks.field_error import FieldError
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.blur import blurred
from engine.numeric.colour import to_rgba16
from engine.numeric.halving import halved, halved_region
from engine.numeric.neighbourhood import FULL, RADIUS, region_bits, straight_shapes
from engine.texture.example.control import Control
from engine.texture.example.parameters import MOST_LEVELS, SEAMLESS, Parameters
from engine.texture.learnt.refinement import Learning

PAD = RADIUS + 1  # a neighbourhood and one pixel more, to fill the register
EXAMPLE_SIDE = 1024  # pixels along an example, at most
COUNTS = 50  # of region pixels among 7 x 7
# Pixels along the shorter side of the coarsest level, at least.  With a rim some more: neighbourhoods that lie
# wholly inside have to be left, and the fewer levels there are, the less changes when a region grows.
_COARSEST, _COARSEST_BOUNDED = 11, 17
_CHOICES = 25  # of where a patch comes from, at least
_SMOOTHED = 0.32  # of a smoothed mask: where its region ends, a little outside the old one
_FAINT = 8  # pixels of a rim, at most, that are looked at
_RIM_SHAPES = 256  # that are looked at, about
_LUMINANCE = (0.2126, 0.7152, 0.0722)


@dataclass(frozen=True, slots=True, eq=False)
class ExampleLevel:
    """One level, all arrays padded by PAD and read-only.

    `compared`: int16 (h, w, 4), 0..255, 0 outside the region; `region`: uint8 (h, w), the pixels that may be copied;
    `bits`: uint64 (h, w), the region's 7 x 7 shapes; `order`: int32 names of the region's pixels, those with few
    neighbours inside first; `starts`: int32 (51,), where each count begins in it.  Where an example is turned all round
    these are lists one after another, of pixels that run each way: 51 more in `starts` for each.
    """

    compared: np.ndarray
    region: np.ndarray
    bits: np.ndarray
    order: np.ndarray
    starts: np.ndarray


@dataclass(frozen=True, eq=False)
class Exemplar:
    """`pixels`: the picture, uint8 or uint16 RGBA (h, w, 4), not premultiplied; `mask`: bool (h, w); `levels`, the
    finest first; `blocks`: int32 names of the upper left pixels of patches, `block` pixels along, that lie wholly
    inside at the coarsest level; `boundary`: whether the region's rim is one.

    `finer`: what there is of the example in levels below the finest of `levels`, the coarsest of them first:
    premultiplied float32 (h, w, 4) in 0..1, twice as large each.
    `origin`: what it was made of, for whoever has to make it again; `arithmetic`: in which it was analysed.
    `control`: its control channels; `learning`: how it is refined below its own pixels, if it is.
    """

    pixels: np.ndarray
    mask: np.ndarray
    parameters: Parameters
    levels: tuple[ExampleLevel, ...]
    blocks: np.ndarray
    block: int
    boundary: bool
    finer: tuple[np.ndarray, ...] = ()
    origin: Any = None
    arithmetic: int = LIBRARY
    control: Control | None = None
    learning: Learning | None = None

    @property
    def octaves(self) -> int:
        """Counts the octaves that are learnt below its own pixels."""
        return 0 if self.learning is None else self.learning.there

    @cached_property
    def average(self) -> np.ndarray:
        """Returns the mean colour of the region: premultiplied float32 (4,) in 0..1."""
        inside = premultiplied(self.pixels)[self.mask]
        return array_functions(self.arithmetic).mean(inside, axis=0, dtype=np.float64).astype(np.float32)

    @cached_property
    def shapes(self) -> tuple[np.ndarray, ...]:
        """For each level the 7 x 7 shapes around the pixels of its `order` that do not lie wholly inside, which come
        first, and FULL for all others: uint64, side by side, as searches along a rim compare many."""
        found = []
        for level in self.levels:
            several = level.starts.size > COUNTS + 1
            names = level.order if several else level.order[: level.starts[COUNTS - 1]]
            found.append(_frozen(np.append(level.bits[names >> 16, names & 0xFFFF], FULL)))
        return tuple(found)

    @property
    def seamless(self) -> bool:
        """Tells whether it is grown by the method SEAMLESS."""
        return self.parameters.method == SEAMLESS

    @cached_property
    def faint(self) -> int:
        """Tells how many pixels of the rim, from its outline on, are less than half as opaque as the region is in the
        mean, _FAINT at most."""
        if not self.boundary:
            return 0
        inside, alpha = self.mask, self.pixels[..., 3].astype(np.int64)
        whole, count = int(alpha[inside].sum()), int(inside.sum())
        for depth in range(_FAINT):
            inner = _eroded(np.pad(inside, 1), 3)[:-2, :-2]
            rim = inside & ~inner
            if 2 * int(alpha[rim].sum()) * count >= whole * int(rim.sum()) or not inner.any():
                return depth
            inside = inner
        return _FAINT

    @cached_property
    def ragged(self) -> int:
        """Tells by how many pixels of their 7 x 7, at most, three in four shapes of the rim are other than straight
        ones, at the finest level."""
        shapes = self.shapes[0]
        some = shapes[:-1][:: max(1, shapes.size // _RIM_SHAPES)]
        apart = np.sort(np.bitwise_count(some[:, None] ^ straight_shapes()).min(axis=1))
        return int(apart[3 * apart.size // 4]) if apart.size else 0

    @cached_property
    def colours(self) -> tuple[np.ndarray, ...]:
        """Returns the pyramid as premultiplied float32 (h, w, 4) in 0..1, not padded, the finest first; 0 outside
        the region.

        Levels beyond the ones compared are not there.
        """
        return tuple(_frozen(colours) for colours, _ in _pyramid(self, len(self.levels)))


def analysed(
    pixels: np.ndarray,
    mask: np.ndarray | None = None,
    parameters: Parameters | None = None,
    arithmetic: int = LIBRARY,
) -> Exemplar:
    """Returns the exemplar of a picture, uint8 or uint16 RGBA (h, w, 4), whose region is `mask`, bool (h, w), or
    alpha > 0.

    FieldError where there is nothing to learn from.
    """
    parameters = parameters or Parameters()
    mask = region_of(pixels, mask, parameters, arithmetic)
    boundary = has_rim(mask, parameters)
    return of_levels(pixels, mask, parameters, (level_count(mask, parameters, boundary), boundary), arithmetic)


def has_rim(mask: np.ndarray, parameters: Parameters) -> bool:
    """Tells whether the rim of an example's region is one."""
    return parameters.boundary == "yes" or (parameters.boundary == "auto" and not bool(mask.all()))


def of_levels(
    pixels: np.ndarray,
    mask: np.ndarray,
    parameters: Parameters,
    shape: tuple[int, bool],
    arithmetic: int,
    control: Control | None = None,
) -> Exemplar:
    """Returns the exemplar of a picture and its region, `shape`: (how many levels, whether it has a rim)."""
    count, boundary = shape
    colours, region = premultiplied(pixels), mask
    goes_on = control is not None and control.goes_on and not boundary
    levels = []
    for n in range(count):
        if n:
            colours, region = _coarser(colours, region, goes_on)
        levels.append(_level(colours, region, parameters, boundary, arithmetic))
    blocks, block = _blocks(levels[-1], parameters.block)
    held = _frozen(pixels), _frozen(mask), parameters, tuple(levels), blocks, block, boundary
    return Exemplar(*held, arithmetic=arithmetic, control=control)


def shrunk(exemplar: Exemplar, detail: int) -> Exemplar:
    """Returns the example at 1 / 2^detail of its size: synthesis begins so many octaves coarser, and `finer` holds
    the octaves that are left out, for zooming in.  Its pixels are uint16."""
    if detail <= 0:
        return exemplar
    *below, (colours, region) = _pyramid(exemplar, detail + 1)
    pixels = to_rgba16(np.ascontiguousarray(colours.transpose(2, 0, 1)))
    levels, blocks, block = exemplar.levels[detail:], exemplar.blocks, exemplar.block
    if not levels:  # there are no levels left of it: one pixel or so may be all
        levels = (_level(colours, region, exemplar.parameters, exemplar.boundary, exemplar.arithmetic),)
        blocks, block = _blocks(levels[-1], exemplar.parameters.block)
    finer = *(_frozen(colours) for colours, _ in reversed(below)), *exemplar.finer
    held = _frozen(pixels), _frozen(region), exemplar.parameters, levels, blocks, block, exemplar.boundary, finer
    control = None if exemplar.control is None else exemplar.control.coarser(detail)
    return Exemplar(*held, arithmetic=exemplar.arithmetic, control=control)


def _pyramid(exemplar: Exemplar, count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """So many levels of colours, 0 outside the region, and region."""
    mask, colours = exemplar.mask, premultiplied(exemplar.pixels)
    goes_on = exemplar.control is not None and exemplar.control.goes_on and not exemplar.boundary
    found = [(colours if goes_on else np.where(mask[..., None], colours, np.float32(0.0)), mask)]
    for _ in range(count - 1):
        found.append(_coarser(*found[-1], goes_on))
    return found


def region_of(pixels: np.ndarray, mask: np.ndarray | None, parameters: Parameters, arithmetic: int) -> np.ndarray:
    """Returns the region that is learnt from, bool (h, w); FieldError where there is none."""
    height, width = pixels.shape[:2]
    if max(height, width) > EXAMPLE_SIDE:
        raise FieldError("example", f"{width} x {height} pixels", f"at most {EXAMPLE_SIDE} x {EXAMPLE_SIDE}")
    if mask is not None and mask.shape != (height, width):
        raise FieldError("mask", f"{mask.shape[1]} x {mask.shape[0]} pixels", f"{width} x {height} as the example")
    found = pixels[..., 3] > 0 if mask is None else mask.astype(bool)
    if not found.any():
        place, what = ("example", "only transparent pixels") if mask is None else ("mask", "no white pixel")
        raise FieldError(place, what, "a region to learn from")
    return _smoothed(found, parameters.smooth, arithmetic) if parameters.smooth else found


def _smoothed(mask: np.ndarray, sigma: float, arithmetic: int) -> np.ndarray:
    """Returns a smoother outline, a little wider: what was ragged in it is then left to the alpha of the region's
    pixels."""
    if arithmetic != LIBRARY:
        return blurred(mask, sigma) > _SMOOTHED
    from scipy.ndimage import gaussian_filter

    out: np.ndarray = gaussian_filter(mask.astype(np.float32), sigma, mode="constant") > _SMOOTHED
    return out


def level_count(mask: np.ndarray, parameters: Parameters, boundary: bool) -> int:
    """As many as were asked for and there is room for, else so many that the coarsest is small."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    shorter = int(min(rows[-1] - rows[0], columns[-1] - columns[0])) + 1
    if parameters.levels:
        return min(parameters.levels, max(1, shorter.bit_length()))
    least = _COARSEST_BOUNDED if boundary else _COARSEST
    return min(MOST_LEVELS, max(1, (shorter // least).bit_length()))


def _coarser(colours: np.ndarray, region: np.ndarray, goes_on: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Returns the next level of colours (h, w, 4) and region (h, w), beyond which colours may go on."""
    above = halved_region(region)
    if goes_on:
        return halved(colours, np.ones_like(region)), above
    return halved(colours, region) * above[..., None], above


def _level(
    colours: np.ndarray, region: np.ndarray, parameters: Parameters, boundary: bool, arithmetic: int
) -> ExampleLevel:
    if boundary:
        shown = np.pad(np.where(region[..., None], colours, np.float32(0.0)), ((PAD, PAD), (PAD, PAD), (0, 0)))
    else:  # beyond its edges it goes on as its mirror image, so that all of it may be copied
        shown = np.pad(colours, ((PAD, PAD), (PAD, PAD), (0, 0)), mode="symmetric")
    padded = np.pad(region, PAD).astype(np.uint8)
    bits = np.zeros(padded.shape, np.uint64)
    region_bits(np.pad(padded, RADIUS), wide := np.zeros([n + 2 * RADIUS for n in padded.shape], np.uint64))
    bits[:] = wide[RADIUS:-RADIUS, RADIUS:-RADIUS]
    if not boundary:
        bits[padded > 0] = FULL
    order, starts = _by_count(padded, bits)
    return ExampleLevel(*map(_frozen, (_compared(shown, parameters, arithmetic), padded, bits, order, starts)))


def _compared(colours: np.ndarray, parameters: Parameters, arithmetic: int) -> np.ndarray:
    """Returns what neighbourhoods are compared by: int16 (h, w, 4)."""
    found = np.rint(np.float32(255.0) * colours)
    if parameters.channels == "luminance":  # as heavy as three channels, in one
        found[..., 0] = np.rint(255.0 * _luminance(colours, arithmetic))
        found[..., 1] = found[..., 2] = found[..., 0]
    if not parameters.alpha:
        found[..., 3] = 0.0
    return np.clip(found, 0.0, 255.0).astype(np.int16)


def _luminance(colours: np.ndarray, arithmetic: int) -> np.ndarray:
    weights = np.asarray(_LUMINANCE, np.float32)
    if arithmetic == LIBRARY:
        return np.tensordot(colours[..., :3], weights, 1)
    red, green, blue = (colours[..., c] * weight for c, weight in enumerate(weights))
    out: np.ndarray = red + green + blue
    return out


def _by_count(region: np.ndarray, bits: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    rows, columns = np.nonzero(region)
    counts = np.bitwise_count(bits[rows, columns])
    order = np.argsort(counts, kind="stable")
    names = ((rows << 16) | columns)[order].astype(np.int32)
    return names, np.searchsorted(counts[order], np.arange(COUNTS + 1)).astype(np.int32)


def by_way(level: ExampleLevel, ways: np.ndarray, number: int) -> ExampleLevel:
    """Returns a level whose pixels are listed for each of so many ways that they run: `ways`, (h, w)."""
    own = ways[level.order >> 16, level.order & 0xFFFF]
    names, starts, before = [], [], 0
    for way in range(number):
        names.append(level.order[own == way])
        counts = np.bitwise_count(level.bits[names[-1] >> 16, names[-1] & 0xFFFF])
        starts.append(before + np.searchsorted(counts, np.arange(COUNTS + 1)))
        before += len(names[-1])
    order, first = np.concatenate(names), np.concatenate(starts).astype(np.int32)
    return replace(level, order=_frozen(order), starts=_frozen(first))


def _blocks(level: ExampleLevel, block: int) -> tuple[np.ndarray, int]:
    """Tells where patches of `block` pixels begin that lie wholly in the region, as names; smaller ones where there
    are few.

    Some reach its rim: what there is to its inner side, for instance shading, is then copied with it.
    """
    fits = _eroded(level.region > 0, block)
    while block > 1 and fits.sum() < _CHOICES:
        block -= 1
        fits = _eroded(level.region > 0, block)
    rows, columns = np.nonzero(fits)
    return _frozen(((rows << 16) | columns).astype(np.int32)), block


def _eroded(mask: np.ndarray, side: int) -> np.ndarray:
    """Tells where a square of `side` pixels, from its upper left one on, lies wholly in the mask (h, w)."""
    total = np.pad(np.cumsum(np.cumsum(mask, 0, dtype=np.int64), 1), ((1, 0), (1, 0)))
    out = np.zeros(mask.shape, bool)
    rows, columns = (n - side + 1 for n in mask.shape)
    if rows > 0 and columns > 0:
        sums = total[side:, side:] - total[:-side, side:] - total[side:, :-side] + total[:-side, :-side]
        out[:rows, :columns] = sums == side * side
    return out


def premultiplied(pixels: np.ndarray) -> np.ndarray:
    """uint8 or uint16 RGBA (h, w, 4) as premultiplied float32 in 0..1."""
    planes = pixels.astype(np.float32) / np.float32(np.iinfo(pixels.dtype).max)
    planes[..., :3] *= planes[..., 3:]
    return planes


def _frozen(array: np.ndarray) -> np.ndarray:
    """Returns a copy that cannot be written to."""
    held = np.array(array, order="C")
    held.flags.writeable = False
    return held
