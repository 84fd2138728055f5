"""How much of a few pixels, of any level, a stroke covered: found again from its command, by the dabs that lie near.

At levels finer than its own a stroke is expanded, at coarser ones averaged, as the canvas does it; where it is more
than three levels finer than the pixels, its dabs are laid smaller, and what thins its coverage is left out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from engine.brush import ops, prints, relief
from engine.brush.copies import Copies, Torus, copied, copied_places, each
from engine.brush.dabs import Stroker, stroke_key
from engine.brush.dynamics import most_of
from engine.brush.extent import WIDEST
from engine.brush.felt import feels, radii_around
from engine.brush.footprint import Footprint
from engine.brush.ink import Texture
from engine.brush.mask import StrokeMask
from engine.brush.mixture import Mixture, mixture
from engine.brush.print_form import Print
from engine.brush.relief import Relief
from engine.brush.settings import Brush, textures_of
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.numeric.pyramid import expand, reduce
from engine.painting.commands import Stroke
from engine.strokes import spots
from engine.texture.image import ImageSource

_EXACT = 3  # levels finer than the pixels asked for at which dabs are laid as they were
_OPACITY = 3  # column of a dab
_SEEN = 2  # px around a stroke within which it is seen at finer levels

Textures = Mapping[str, Texture | ImageSource]


def stroke_bounds(stroke: Stroke) -> Rect:
    """Returns a rectangle of pixels of the stroke's level outside which it covers nothing."""
    return bounds_of([stroke])[0]


def bounds_of(strokes: Sequence[Stroke]) -> list[Rect]:
    """Returns that of each of some strokes."""
    tables = [_places(stroke) for stroke in strokes]
    starts = np.cumsum([0, *(len(table) for table in tables[:-1])])
    at = np.concatenate(tables)
    reach = np.array([_reach(stroke) for stroke in strokes])[:, None]
    low = np.floor(np.minimum.reduceat(at, starts) - reach).astype(int).tolist()
    high = np.ceil(np.maximum.reduceat(at, starts) + reach).astype(int).tolist()
    origins = (stroke.origin for stroke in strokes)
    return [Rect(x + x0, y + y0, x + x1, y + y1) for (x, y), (x0, y0), (x1, y1) in zip(origins, low, high, strict=True)]


def _places(stroke: Stroke) -> np.ndarray:
    """Returns where a stroke's points lie, in all of its copies: float64 (n, 2)."""
    points = stroke.points[:, :2]
    return copied_places(points, stroke.copies).reshape(-1, 2) if stroke.copies else points


def _reach(stroke: Stroke) -> float:
    """Returns how far from its points a stroke's dabs may lie, pixels."""
    brush = stroke.brush
    widest = brush.radius * most_of(brush.dynamics.get("radius")) * radii_around(brush)
    widest *= max([1.0, *(copy.scale for copy in stroke.copies)])
    return widest + 2.0 + (WIDEST if brush.extent else 0.0)


@dataclass(frozen=True, eq=False, slots=True)
class OnCell(Stroke):
    """A stroke as it was laid on a cell, over whose rim it comes in again: `torus` has its copies, too."""

    torus: Torus | None = None


def near(stroke_level: int, level: int, rect: Rect) -> Rect:
    """Returns the pixels of a stroke's level whose coverage is seen in `rect` of another level."""
    found = rect.zoomed(stroke_level - level)
    return found if stroke_level >= level else found.grown(_SEEN)


class Seeds(NamedTuple):
    """Of the stroke's textures, and of the painting, to which the grain belongs."""

    own: int
    painting: int


@dataclass(frozen=True, eq=False, slots=True)
class _Parts:
    """What a brush's coverage depends on besides its dabs, at the level of its strokes."""

    tip: Print | None
    relief: Relief
    mixture: Mixture | None


class Covering:
    """Finds coverages; what is known of a brush's textures is kept from one stroke to the next of the same look."""

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], _Parts] = {}
        self._of: dict[tuple[object, ...], _Parts] = {}  # by the whole brush

    def over(self, stroke: Stroke, level: int, rect: Rect, textures: Textures, seeds: Seeds) -> np.ndarray | None:
        """Returns how much of each pixel the stroke changes, 0..1: float32 (h, w) over `rect` of `level`; None where it
        covers nothing.  `textures`: those that it was painted with, by name."""
        at, seen = _looked_at(stroke.level, level, rect)
        found = self._laid(stroke, at, seen, textures, seeds)
        return None if found is None else _carried(found[None], at, level, rect)[0]

    def _laid(self, stroke: Stroke, at: int, rect: Rect, textures: Textures, seeds: Seeds) -> np.ndarray | None:
        """Returns the coverage over a rectangle of a level that is not finer than the stroke's."""
        if stroke.brush.row.grows:
            return _taken(stroke, at, rect)
        coarser = stroke.level - at
        parts = (
            self._parts(stroke, textures, seeds) if not coarser else _Parts(prints.plain(stroke.brush), Relief(), None)
        )
        corner, dabs = _dabs(stroke, coarser, seeds.own)
        if not _keep_near(dabs, corner, rect.grown(parts.relief.reach + 1)):
            return None
        copies = _copies(stroke)
        mask = StrokeMask(at, corner, tip=prints.for_copies(parts.tip, copies), each=each(copies))
        mask.paint(dabs)
        coverage = parts.relief.over(mask.coverage())
        out = np.zeros((rect.height, rect.width), np.float32)
        for key in rect.tiles(at):
            if key in coverage.tiles:
                part = key.rect.intersect(rect)
                tile = coverage.on_grid(key)
                if parts.mixture is not None:
                    tile *= np.clip(parts.mixture.tile(key), 0.0, 1.0)
                out[part.slices(rect)] = tile[part.slices(key.rect)]
        return out if out.any() else None

    def _parts(self, stroke: Stroke, textures: Textures, seeds: Seeds) -> _Parts:
        brush = stroke.brush
        named = tuple(textures.get(name) for name in textures_of(brush))
        whole = brush, stroke.level, seeds, named
        if whole not in self._of:
            key = replace(brush, colour="#000000", flow=1.0, spacing=1.0), stroke.level, seeds, named
            if key not in self._known:
                try:
                    self._known[key] = _resolved(brush, stroke.level, textures, seeds)
                except FieldError:  # a texture that is gone: the dabs alone tell
                    self._known[key] = _Parts(prints.plain(brush), Relief(), None)
            self._of[whole] = self._known[key]
        return self._of[whole]


def plain_over(strokes: Sequence[Stroke], level: int, rect: Rect) -> np.ndarray:
    """As `Covering.over`, of several strokes of one level that `plainly` applies to: float32 (n, h, w)."""
    at, seen = _looked_at(strokes[0].level, level, rect)
    return _carried(spots.covered(strokes, strokes[0].level - at, seen), at, level, rect)


def plainly(stroke: Stroke, level: int) -> bool:
    """Tells whether how much a stroke covers of pixels of a level follows from its dabs alone."""
    row = stroke.brush.row
    return not (row.grows or stroke.copies or isinstance(stroke, OnCell)) and (
        not feels(stroke.brush) and (stroke.level > level + _EXACT or spots.is_plain(stroke.brush))
    )


def lays(brush: Brush) -> bool:
    """Tells whether a stroke lays paint where there is none."""
    return brush.row.lays_ink or brush.row.grows


def hides(brush: Brush) -> bool:
    """Tells whether a stroke at full strength leaves nothing to see of what was there: false for raster-ops that only
    change it."""
    return not brush.row.uses_op or _op_hides(brush.op)


@lru_cache(64)
def _op_hides(op: str) -> bool:
    return ops.chosen(op).hides


def _resolved(brush: Brush, level: int, textures: Textures, seeds: Seeds) -> _Parts:
    mixed = None
    if brush.row.uses_op and brush.ink and not ops.chosen(brush.op).by_texture:
        mixed = Mixture(mixture(brush, textures, level, seeds.own), level)
    return _Parts(
        prints.resolve(brush, textures, level, seeds.own), relief.resolve(brush, textures, level, seeds), mixed
    )


def _copies(stroke: Stroke) -> Copies | Torus:
    return stroke.torus if isinstance(stroke, OnCell) and stroke.torus is not None else stroke.copies


def _dabs(stroke: Stroke, coarser: int, seed: int) -> tuple[tuple[int, int], np.ndarray]:
    """Returns the stroke's origin and its dabs, float64 (n, 6..), in pixels of a level so much coarser."""
    stroker = Stroker(stroke.brush, stroke_key(seed, stroke.level, stroke.origin))
    dabs = np.concatenate([*copied(stroker.whole(stroke.points), _copies(stroke))])
    x, y = stroke.origin
    corner = x >> coarser, y >> coarser
    if coarser:
        scale = 2.0**-coarser
        dabs[:, 0] = (dabs[:, 0] + (x - (corner[0] << coarser))) * scale
        dabs[:, 1] = (dabs[:, 1] + (y - (corner[1] << coarser))) * scale
        dabs[:, 2] *= scale
    return corner, dabs


def _keep_near(dabs: np.ndarray, corner: tuple[int, int], rect: Rect) -> bool:
    """Takes the paint from the dabs that do not reach a rectangle; they still count, or tips would lie otherwise.
    Returns whether any is left."""
    x0, y0, x1, y1 = (float(edge - corner[n % 2]) for n, edge in enumerate(rect))
    x, y, reach = dabs[:, 0], dabs[:, 1], np.maximum(dabs[:, 2], 0.5) + 1.0
    met = (x + reach > x0) & (x - reach < x1) & (y + reach > y0) & (y - reach < y1)
    dabs[~met, _OPACITY] = 0.0
    return bool(met.any())


def _taken(stroke: Stroke, at: int, rect: Rect) -> np.ndarray | None:
    """Returns 1 where a stroke with an example takes pixels, 0 elsewhere: its dabs' shape is not looked at."""
    found = Footprint(stroke.brush, stroke.origin, at - stroke.level, None, rect, _copies(stroke))
    out = np.zeros((rect.height, rect.width), np.float32)
    for part, mask in found.whole(stroke.points):
        meeting = part.intersect(rect)
        view = out[meeting.slices(rect)]
        np.maximum(view, mask[meeting.slices(part)], out=view)
    return out if out.any() else None


def carried_to(covered: Callable[[Rect], np.ndarray], at: int, level: int, rect: Rect) -> np.ndarray:
    """Returns a coverage of level `at`, which `covered` gives over any rectangle there, as it is over `rect` of another
    level: float32 (h, w)."""
    there = rect.zoomed(at - level) if at >= level else _ancestors(rect, level - at)[-1]
    found: np.ndarray = _carried(covered(there)[None], at, level, rect)[0]
    return found


def _looked_at(stroke_level: int, level: int, rect: Rect) -> tuple[int, Rect]:
    """Returns the level at which the dabs of a stroke are laid, and its pixels that tell of `rect` of another."""
    at = min(stroke_level, level + _EXACT)
    return at, rect.zoomed(at - level) if at >= level else _ancestors(rect, level - at)[-1]


def _carried(coverages: np.ndarray, at: int, level: int, rect: Rect) -> np.ndarray:
    """Returns coverages (n, h, w) of one level, over what `_looked_at` gives, as they are over `rect` of another."""
    for _ in range(at - level):
        coverages = reduce(coverages)
    if at >= level:
        return coverages
    rects = _ancestors(rect, level - at)
    for outer, inner in pairwise(reversed(rects)):
        first = coverages[:, :1, :1]
        if (coverages == first).all():
            return np.broadcast_to(first, (len(coverages), rect.height, rect.width))
        coverages = expand(coverages[:, *inner.parents().slices(outer)])
    return coverages[:, *rect.slices(rects[0])]


@lru_cache(64)
def _ancestors(rect: Rect, levels: int) -> tuple[Rect, ...]:
    """Returns a rectangle, and what expand reads to make it, up to the level so many above."""
    rects = [rect.evened()]
    for _ in range(levels):
        rects.append(rects[-1].parents().evened())
    return tuple(rects)
