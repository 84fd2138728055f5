"""Fills: a region is covered as by one stroke, and that does whatever a stroke of the brush would do there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engine.brush import dynamics, edits, relief
from engine.brush.checks import BrushError
from engine.brush.covered import Looks, Read, Scene
from engine.brush.foretell import AREA_CAP
from engine.brush.ink import refuse_ways
from engine.brush.mask import Coverage
from engine.brush.settings import Brush
from engine.brush.stamp import Edit
from engine.brush.thinning import Thinning
from engine.canvas import commit, layers
from engine.canvas import growth as growths
from engine.canvas.flatten import flattened
from engine.canvas.growth import Growth
from engine.canvas.layers import Layer
from engine.canvas.selecting.limit import Limit
from engine.canvas.selecting.mask_sheet import repainted
from engine.canvas.selecting.occupied import alpha_at
from engine.canvas.selecting.rims import rim_moved
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting.commands import Fill
from engine.painting.fill_command import LOOKED_AT_CAP
from engine.painting.grown import threads
from engine.painting.value import Painting, Refusal, layer_for
from engine.strokes.all_painted import all_painted
from engine.strokes.bed import Change, lies_in
from engine.strokes.example_stroke import change_of, check_alpha, grid_of, kind_of
from engine.strokes.likeness import alike, alike_around, kept_within, taken, thinned
from engine.strokes.mask_painting import edit_of, greys_of, insist_on_paint, sheet_for
from engine.strokes.paint_stroke import LiveStroke
from engine.strokes.scenery import reader
from engine.strokes.wrapping import around, cell_at, onto_torus
from engine.texture.planes import Planes


def filled(painting: Painting, command: Fill, cache: TileCache | None = None) -> Painting:
    """Returns the painting with a region filled, previewed where that grows an example.

    Refusal, or BrushError, names what cannot be done, as for a stroke.
    """
    brush = command.brush
    edits.check(brush)
    base, layer = sheet_for(painting, command.layer, command.onto, "fill")
    if brush.row.places:
        raise Refusal("fill: found a brush that places things along a stroke, expected another: draw with it")
    grows = kind_of(brush) is not LiveStroke
    if grows:
        insist_on_paint(layer, "fill")
        check_alpha(layer, "fill")
    if command.whole and layer.growth:
        with threads() as pool:
            layer = flattened(layer, cache, pool)
    region, limit = _region(painting, layer, command, cache)
    pouring = Pouring(painting, layer, brush, cache, limit)
    after = pouring.grown(region) if grows else pouring.painted(region)
    root = base.root
    if after.pyramid is not layer.pyramid:
        root = repainted(root, layer, after.pyramid)
    if after.growth is not layer.growth:
        root = layers.with_growth(root, layer.name, after.growth)
    return base if root is base.root else replace(base, root=root)


def covered_by(painting: Painting, command: Fill, cache: TileCache | None = None) -> Coverage:
    """Returns how much of each pixel of its level a fill covers, at most."""
    _, layer = sheet_for(painting, command.layer, command.onto, "fill")
    region, limit = _region(painting, layer, command, cache)
    left = region if limit is None else limit.over(region)
    return left if kind_of(command.brush) is not LiveStroke else thinned(left, opacity_of(command.brush))


def _region(painting: Painting, layer: Layer, command: Fill, cache: TileCache | None) -> tuple[Coverage, Limit | None]:
    """Returns what is to be covered, and what the selection leaves of that: all, where it is the selection itself."""
    level = command.level if command.like is None else command.like.level
    cell = None if command.whole else cell_at(layer, level, "fill")
    if cell is None:
        return _plain_region(painting, command, cache)
    if cell.area > LOOKED_AT_CAP:
        raise Refusal(
            f"fill: found a tile of {cell.width} x {cell.height} pixels at level {level}, expected at most"
            f" {LOOKED_AT_CAP} of them: zoom out"
        )
    if command.like is not None and command.like.within is None:
        region, limit = (
            _beyond(painting, command, alike_around(painting, command.like, cell, cache)),
            Limit.of(painting.selection, level, cache, layer.wrap),
        )
    else:
        region, limit = _plain_region(painting, command, cache)
    return onto_torus(region if limit is None else limit.over(region), layer, cell), None


def _plain_region(painting: Painting, command: Fill, cache: TileCache | None) -> tuple[Coverage, Limit | None]:
    """As `_region`, of a layer that does not wrap around."""
    if command.like is not None:
        region = _beyond(painting, command, alike(painting, command.like, command.open, cache))
        return region, Limit.of(painting.selection, region.level, cache)
    if command.whole:
        if command.onto:
            raise Refusal("fill: found the whole of a mask, expected a region of it")
        _, layer = layer_for(painting, command.layer, "fill")
        region = all_painted(layer.pyramid, command.level, cache)
        return region, Limit.of(painting.selection, command.level, cache)
    selection = painting.selection
    if selection is None:
        raise Refusal("fill: found nothing selected and no like, expected one of them")
    if selection.inverse:
        raise Refusal("fill: found a selection without bounds, expected one with bounds, or like")
    return alpha_at(selection.pyramid, command.level, "fill"), None


def _beyond(painting: Painting, command: Fill, region: Coverage) -> Coverage:
    """Returns a region, grown by as many pixels as the fill says: under the soft edges of lines, and not beyond the
    line that it lies within."""
    if not command.grow:
        return region
    grown = rim_moved(region, command.grow, 0.0, painting.grid, "fill")
    return grown if command.like is None else kept_within(command.like, grown)


def opacity_of(brush: Brush) -> float:
    """Returns the opacity under the pen's full pressure."""
    return min(brush.opacity * float(dynamics.evaluate(brush.dynamics.get("opacity"), np.ones(1))[0]), 1.0)


class Pouring:
    """What a brush does to a region of a layer of a painting, all at once."""

    def __init__(
        self, painting: Painting, layer: Layer, brush: Brush, cache: TileCache | None, limit: Limit | None
    ) -> None:
        self._painting, self._layer, self._brush, self._cache, self._limit = painting, layer, brush, cache, limit

    def grown(self, region: Coverage) -> Layer:
        """Returns the layer with an example grown in a region, or with what was grown there at a depth taken away."""
        brush, layer, level = self._brush, self._layer, region.level
        grid = grid_of(brush, level)
        change = self._limited(change_of(brush, grid, self._painting, self._painting.seed)[0], grid)
        rect, mask = _carried(region.rect, taken(region), grid - level)
        return replace(layer, growth=growths.previewed(change(layer.growth, rect, mask)))

    def painted(self, region: Coverage) -> Layer:
        """Returns the layer with its paint edited; what is painted with examples is taken away with it, or made paint
        where the region meets it."""
        brush, layer, level = self._brush, self._layer, region.level
        coverage = thinned(region, opacity_of(brush))
        if layer.growth and brush.row.takes_away and not layer.alpha_locked:
            rect, mask = coverage.rect, taken(coverage)
            change = self._limited(lambda growth, rect, mask: growths.cut(growth, level, rect, mask), level)
            layer = replace(layer, growth=change(layer.growth, rect, mask))
        elif layer.growth and not brush.row.takes_away and self._meets(layer.growth, coverage):
            with threads() as pool:
                layer = flattened(layer, self._cache, pool)
        return replace(layer, pyramid=commit.commit(layer.pyramid, self._edit(layer, coverage), self._cache))

    def _edit(self, layer: Layer, coverage: Coverage) -> Edit:
        brush, painting, level, seed = self._brush, self._painting, coverage.level, self._painting.seed
        textures, made = painting.known_textures, edits.class_of(brush.mode)
        ink = made.ink_of(brush, textures, level, seed)
        own = relief.resolve(brush, textures, level, (seed, seed))
        thins: Thinning = own if self._limit is None else self._limit.after(own)
        if ink is not None:
            refuse_ways(ink, "another: a fill runs no way")
        scene = self._scene(made.looks(brush, ink), coverage)

        def read(rect: Rect) -> Planes:
            return greys_of(around(layer, level, rect, self._cache), layer)

        return edit_of(edits.edit(brush, coverage, ink, layer.alpha_locked, read, thins, scene), layer)

    def _limited(self, change: Change, level: int) -> Change:
        return change if self._limit is None else self._limit.within(change, level)

    def _meets(self, growth: Growth, coverage: Coverage) -> bool:
        """Tells whether anything grown can be seen in tiles that are covered, and selected."""
        keys = [key for key in coverage.tiles if self._limit is None or self._limit.meets(key.rect)]
        return any(lies_in(growth, coverage.level, key.rect) for key in keys)

    def _scene(self, looks: Looks, coverage: Coverage) -> Scene:
        """Returns what an op looks at: the pen's pressure is everywhere the greatest."""
        painting, rect = self._painting, coverage.rect
        if looks.whole and rect.area > AREA_CAP:
            raise BrushError("fill", f"one of {rect.area} pixels", f"at most {AREA_CAP} of {looks.whole}")
        source: Read | None = None
        if looks.layer is not None:
            source = reader(painting.root, looks.layer, coverage.level, self._cache)
        corner, pressure = (rect.x0, rect.y0), coverage if looks.pressure else None
        within = coverage if looks.rim else None
        return Scene(source, corner, pressure, corner, painting.seed, {}, painting.arithmetic, within)


def _carried(rect: Rect, mask: np.ndarray, finer: int) -> tuple[Rect, np.ndarray]:
    """Returns the pixels, so many levels finer, of a mask, bool (h, w) over a rectangle; coarser ones, if negative:
    those whose middle it has."""
    if finer >= 0:
        side = 1 << finer
        return rect.zoomed(finer), mask.repeat(side, axis=0).repeat(side, axis=1)
    side = 1 << -finer
    whole = rect.zoomed(finer)
    rows = (np.arange(whole.height) * side + (side >> 1)) + (whole.y0 * side - rect.y0)
    columns = (np.arange(whole.width) * side + (side >> 1)) + (whole.x0 * side - rect.x0)
    there = ((rows >= 0) & (rows < rect.height))[:, None] & ((columns >= 0) & (columns < rect.width))
    found: np.ndarray = mask[np.clip(rows, 0, rect.height - 1)][:, np.clip(columns, 0, rect.width - 1)] & there
    return whole, found
