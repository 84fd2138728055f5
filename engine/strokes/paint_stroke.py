"""The stroke in progress: pen points in, the edit of the layer out.  Its preview is what its commit will be."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from engine.brush import copies as copying
from engine.brush import edits, prints, relief
from engine.brush.checks import BrushError
from engine.brush.dabs import Stroker
from engine.brush.felt import is_placed, tints_of
from engine.brush.footprint import Footprint
from engine.brush.located import PlacedMask
from engine.brush.mask import Coverage, StrokeMask
from engine.brush.stamp import Edit
from engine.brush.thinning import Thinning
from engine.brush.tinted_ink import TintedInk
from engine.brush.tinting import Tinted
from engine.brush.wetting import WET_COLUMNS, WetMask
from engine.canvas import commit, layers
from engine.canvas import growth as growths
from engine.canvas.flatten import flattened
from engine.canvas.growth import Growth
from engine.canvas.heaps import heaping
from engine.canvas.layers import Group
from engine.canvas.painted import tile_bounds
from engine.canvas.selecting.mask_sheet import repainted
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.prediction import Predictor
from engine.painting.crowding import refuse_crowd
from engine.painting.grown import threads
from engine.painting.value import Painting
from engine.strokes.bed import Bed, Meeting
from engine.strokes.heap_stroke import NO_EDITS, Untouched, heap_plan
from engine.strokes.live_stroke import Drawn
from engine.strokes.mask_painting import edit_of
from engine.strokes.scenery import Scenery, reader
from engine.strokes.wet_stroke import read_layer, wet_mask
from engine.texture.planes import Planes


class LiveStroke(Drawn):
    """A stroke that edits what is there.

    `bed`: what is painted with examples on the layer, if the stroke erases it; `flattened`: whether it was made paint
    because the stroke goes over it.
    """

    def _begin(self) -> None:
        brush, level, own, textures = self.brush, self.level, self.own, self.before.known_textures
        made = edits.class_of(brush.mode)
        self._stroker = Stroker(brush, self.chance)
        self._tip = prints.resolve(brush, textures, level, own)
        self._ink = made.ink_of(brush, textures, level, own)
        refuse_crowd(self.layer.pyramid, level, self.origin, self._ink)
        self._mask = self._new_mask()
        looks = made.looks(brush, self._ink)
        source = None if looks.layer is None else reader(self.base.root, looks.layer, level, self.cache)
        self._scenery = Scenery(looks, brush, (level, self.origin), own, source, self.copies, self.chance)
        self._relief, self._rim = relief.resolve(brush, textures, level, (own, self.before.seed)), looks.rim
        self._reach = max(self._relief.reach, math.ceil(looks.rim))
        self._thinning: Thinning = self._relief if self.limit is None else self.limit.after(self._relief)
        self._edit: Edit | None = None
        self._plan, self._heap_edits = heap_plan(brush, self.layer), NO_EDITS
        self.flattened, self.bed = False, self._new_bed()
        self._meeting = Meeting(level, self.origin, brush.radius, None if self.limit is None else self.limit.meets)

    def _new_mask(self) -> StrokeMask:
        laid, tints = prints.for_copies(self._tip, self.copies), tints_of(self.brush)
        if self.brush.wet is not None and tints and isinstance(self._ink, TintedInk):
            return wet_mask(self, self._ink, Tinted(laid, tints + WET_COLUMNS, is_placed(self.brush)))
        if is_placed(self.brush):
            return PlacedMask((self.level, self.origin), Tinted(laid, tints, True), self.copies, tints)
        laid = Tinted(laid, tints) if tints else laid
        return StrokeMask(self.level, self.origin, tip=laid, each=copying.each(self.copies))

    def _new_bed(self) -> Bed | None:
        if not self.brush.row.takes_away or not self.layer.growth or self.layer.alpha_locked:
            return None
        level = self.level
        within = growths.bounds(self.layer.growth, level)
        begin = partial(Footprint, self.brush, self.origin, 0, self._tip, within, self.copies, self.chance)

        def cut(growth: Growth, rect: Rect, mask: np.ndarray) -> Growth:
            return growths.cut(growth, level, rect, mask)

        return Bed(self.layer.growth, level, begin, cut if self.limit is None else self.limit.within(cut, level))

    def lay(self, points: np.ndarray) -> Rect:
        """Lays the dabs of more points; returns what of the level they may have changed."""
        if not len(points):
            return Rect(0, 0, 0, 0)
        try:
            touched: set[TileKey] = set()
            stood = self._mask.rect if self._stroker.waits else Rect(0, 0, 0, 0)
            dabs = self._walked(points)
            if isinstance(self._mask, WetMask) and self.layer.growth and self._flatten(dabs):
                stood = stood.union(self._mask.rect)
                self._again()  # what was laid saw the layer as it was
                dabs = self._walked(points)
            for part in copying.copied(dabs, self.copies, self.brush.shape.bristles or 1):
                touched |= self._mask.paint(part)
            dirty = tile_bounds(touched).union(stood)
            dirty = dirty if dirty.empty else dirty.grown(self._reach)
            whole = self._scenery.lay(points, self._mask)
            told = self.copies.copies if isinstance(self.copies, copying.Torus) else self.copies
            self.areas = (  # of a torus, wherever in its cells: they are seen in all of them
                copying.boxes(dabs, told, self.origin, TILE + self._reach) if self.copies and whole.empty else []
            )
            dirty = dirty.union(whole)
            if self.bed is not None:
                self.bed.lay(points)
        except BrushError:
            self._again()
            raise
        self._keep(points)
        self._edit = None
        if not self.brush.row.takes_away and self.layer.growth:
            self._flatten(dabs)
        return dirty

    def _flatten(self, dabs: np.ndarray) -> bool:
        """Makes paint of what is painted with examples on the layer, if the stroke meets any of it; tells whether it
        does."""
        spread = max(self._relief.reach, self._relief.spread)
        if any(self._meeting.any(self.layer.growth, part, spread) for part in copying.copied(dabs, self.copies)):
            self.flattened = True
            with threads() as pool:
                self.layer = flattened(self.layer, self.cache, pool)
            root = layers.with_pyramid(self.base.root, self.layer.name, self.layer.pyramid)
            self.base = replace(self.base, root=layers.with_growth(root, self.layer.name, ()))
            return True
        return False

    def _again(self) -> None:
        """Lays the points that were kept, and nothing else."""
        self._stroker = Stroker(self.brush, self.chance)
        self._mask = self._new_mask()
        self._edit = None
        for points in self._points:
            for part in copying.copied(self._walked(points), self.copies, self.brush.shape.bristles or 1):
                self._mask.paint(part)

    def _walked(self, points: np.ndarray) -> np.ndarray:
        """Returns the dabs of more points.  One that waits for the direction of the stroke is laid as if it had none,
        and again once that is known, when nothing else is laid yet."""
        waited = self._stroker.waits
        dabs = self._stroker.walk(points)
        if waited:
            self._mask = self._new_mask()
        return self._stroker.rest() if self._stroker.waits else dabs

    @property
    def predictor(self) -> Predictor | None:
        """Gives the filter that continues what is around the stroke; None for all ops but `predict`."""
        return self._scenery.predictor

    @property
    def rect(self) -> Rect:
        """Returns a rectangle of pixels of the level outside which nothing changes."""
        rect = self._mask.rect
        rect = rect if rect.empty else rect.grown(self._relief.spread)
        return rect if self.bed is None else rect.union(self.bed.rect)

    @property
    def root(self) -> Group:
        """Returns the layers as they are to be seen, but for the stroke's own paint."""
        return self.base.root if self.bed is None else self.bed.over(self.base.root, self.layer.name)

    @property
    def edit(self) -> Edit:
        """Returns the edit of the layer that the points so far make."""
        if self._edit is None:
            plan, covered, thinning = self._plan, self._mask, self._thinning
            if plan is not None:
                whole = thinning.over(covered.coverage())
                self._heap_edits = plan.edits(self.layer, self.brush, whole, self._ink, self.cache)
                self._edit = Untouched(self.level) if plan.only else self._painted(whole, None)
            else:
                self._edit = self._painted(covered, thinning)
        return self._edit

    def _painted(self, covered: StrokeMask | Coverage, thinning: Thinning | None) -> Edit:
        scene = replace(self._scenery.scene, arithmetic=self.before.arithmetic)
        if self._rim:
            scene = replace(scene, covered=self._mask.coverage())
        locked = self.layer.alpha_locked
        read = partial(read_layer, self.layer, self.level, self.cache)  # not of `self`, which would then hold itself
        made = edits.edit(self.brush, covered, self._ink, locked, read, thinning, scene)
        return edit_of(made, self.layer)

    @property
    def heap_edits(self) -> heaping.Edits:
        """Returns the edits of the layer's heaps that the points so far make."""
        if self._plan is not None and self._edit is None:
            _ = self.edit
        return self._heap_edits

    def preview(self, rect: Rect) -> Planes:
        """Returns the layer's paint in `rect` at the stroke's level, as it will be."""
        return commit.preview(self.layer.pyramid, self.edit, rect, self.cache)

    def commit(self) -> Painting:
        """Returns the painting with the stroke on its layer."""
        if self.empty:
            return self.before
        if self.bed is not None:
            self.bed.finish()
        root, name = self.base.root, self.layer.name
        pyramid = commit.commit(self.layer.pyramid, self.edit, self.cache)
        if pyramid is not self.layer.pyramid:
            root = repainted(root, self.layer, pyramid)
        heaps = heaping.heaped(self.layer.heaps, self.heap_edits, self.cache)
        if heaps is not self.layer.heaps:
            root = layers.with_heaps(root, name, heaps)
        if self.bed is not None and self.bed.growth is not self.layer.growth:
            root = layers.with_growth(root, name, self.bed.growth)
        return self.base if root is self.base.root else replace(self.base, root=root)
