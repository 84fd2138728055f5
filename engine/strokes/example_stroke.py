"""The stroke in progress that is painted with an example, or erases what was: no paint, but regions that grow."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from engine.brush import prints
from engine.brush.checks import BrushError
from engine.brush.copies import Copies, Torus
from engine.brush.footprint import Footprint
from engine.brush.settings import Brush
from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.layers import Group, Layer
from engine.checks.values import described
from engine.numeric.address import Rect
from engine.painting.commands import Swap
from engine.painting.value import Painting, Refusal, layer_for
from engine.strokes.bed import Bed, Change
from engine.strokes.example_textures import KIND, exemplar_of, key_of
from engine.strokes.generated.generated_stroke import GeneratedStroke
from engine.strokes.live_stroke import Drawn
from engine.strokes.mask_painting import insist_on_paint
from engine.strokes.paint_stroke import LiveStroke
from engine.strokes.pen_trail import PenTrail, Telling
from engine.texture.example.exemplar import Exemplar

FURTHEST = 8  # levels from the stroke's to that of the example's pixels


@dataclass(frozen=True, slots=True, eq=False)
class Sown:
    """What a stroke or a swap plants: an example under the name it has in the painting, and its content's key."""

    name: str
    key: str
    exemplar: Exemplar


def sown(painting: Painting, name: str, detail: int, where: str) -> Sown:
    """Returns the example of that name, whose finest `detail` levels are for zooming in; BrushError at `where` if
    there is none."""
    texture = painting.textures.get(name)
    if texture is None or texture.kind != KIND:
        what = "nothing of that name" if texture is None else f"a texture of kind {texture.kind}"
        known = ", ".join(ascii(n) for n, t in sorted(painting.textures.items()) if t.kind == KIND)
        raise BrushError(where, f"{name!a}, {what}", f"a texture of the maker example{': ' if known else ''}{known}")
    return Sown(name, key_of(texture, detail), exemplar_of(texture, detail))


class LiveGrowth(Drawn):
    """A stroke with an example that still grows; otherwise as `LiveStroke`."""

    flattened = False  # what the layer has of examples stays that

    def _begin(self) -> None:
        insist_on_paint(self.layer, "stroke")
        check_alpha(self.layer, "stroke")
        brush, level, painting = self.brush, self.level, self.before
        grid = grid_of(brush, level)
        shape = prints.resolve(brush, painting.textures, level, self.own)
        within = growths.bounds(self.layer.growth, grid) if brush.row.takes_away else None
        footprint = partial(Footprint, brush, self.origin, grid - level, shape, within, self.copies, self.chance)
        change, telling = change_of(brush, grid, painting, self.own)
        place = self.origin, grid - level, self.copies
        begin = footprint if telling is None else partial(_trail, footprint, brush, place, telling)
        self.bed = Bed(
            self.layer.growth, level, begin, change if self.limit is None else self.limit.within(change, grid)
        )

    def lay(self, points: np.ndarray) -> Rect:
        """As `LiveStroke.lay`, but nothing looks different before the bed is followed."""
        if len(points):
            self.bed.lay(points)
            self._keep(points)
        return Rect(0, 0, 0, 0)

    @property
    def rect(self) -> Rect:
        """Returns pixels of the stroke's level outside which nothing looks different."""
        return self.bed.rect

    @property
    def root(self) -> Group:
        """Returns the layers as they are to be seen."""
        return self.bed.over(self.base.root, self.layer.name)

    def commit(self) -> Painting:
        """Returns the painting with the stroke on its layer, refined as far as it is."""
        if self.empty:
            return self.before
        self.bed.finish()
        if self.bed.growth is self.layer.growth:
            return self.base
        return replace(self.base, root=layers.with_growth(self.base.root, self.layer.name, self.bed.growth))


def check_alpha(layer: Layer, what: str) -> None:
    """Refusal if the layer's alpha, which whatever grows changes, is locked."""
    if layer.alpha_locked:
        raise Refusal(f"{what}: found layer {layer.name!r} with locked alpha, expected one without")


def _trail(
    footprint: Callable[[], Footprint],
    brush: Brush,
    place: tuple[tuple[int, int], int, Copies | Torus],
    telling: Telling,
) -> Footprint | PenTrail:
    """Returns a stroke's footprint, by which `telling` knows from now on which way it runs, if that is asked for."""
    if telling.following is None:
        return footprint()
    telling.trail = PenTrail(footprint(), brush, place, telling.following)
    return telling.trail


def change_of(brush: Brush, grid: int, painting: Painting, seed: int) -> tuple[Change, Telling | None]:
    """Returns what the brush makes of a growth where it takes pixels of level `grid`, and what it tells of these."""
    if brush.row.takes_away:
        return lambda growth, rect, mask: growths.cut(growth, grid, rect, mask, brush.depth), None
    assert brush.example is not None
    plant = sown(painting, brush.example, brush.example_detail, "brush.example")
    depth = 0.0 if brush.depth is None else brush.depth
    about = depth, grid, plant.name, plant.key, plant.exemplar, seed
    told = Telling(brush, plant.exemplar.control, painting.known_textures, grid, seed)
    return lambda growth, rect, mask: growths.laid(growth, *about, rect, mask, told(rect)), told


def grid_of(brush: Brush, level: int) -> int:
    """Returns the level whose pixels are taken."""
    if brush.row.takes_away or brush.example_level is None:
        return level
    grid = brush.example_level
    if abs(grid - level) > FURTHEST:
        raise BrushError(
            "brush.example_level", described(grid), f"from {level - FURTHEST} to {level + FURTHEST} at level {level}"
        )
    return grid


Live = LiveStroke | LiveGrowth


def kind_of(brush: Brush) -> type[Live]:
    """Of the stroke that a brush makes: one that paints, places things, or one that grows an example or erases what was
    grown at a depth."""
    if brush.row.places:
        return GeneratedStroke
    grows = brush.row.grows or (brush.row.takes_away and brush.depth is not None)
    return LiveGrowth if grows else LiveStroke


def swapped(painting: Painting, command: Swap) -> Painting:
    """With another example for the topmost region at a place.  Refusal if there is none or alpha is locked, BrushError
    if it is no example."""
    _, layer = layer_for(painting, command.layer, "swap")
    check_alpha(layer, "swap")
    plot = growths.at(layer.growth, command.level, *command.at, command.depth)
    if plot is None:
        raise Refusal(f"swap: found nothing painted with an example there on layer {layer.name!r}, expected a region")
    plant = sown(painting, command.example, command.detail, "swap.example")
    grown = growths.swapped(layer.growth, plot, plant.name, plant.key, plant.exemplar)
    seen = growths.previewed(grown)  # or nothing would be there until its first level is grown
    return replace(painting, root=layers.with_growth(painting.root, layer.name, seen))
