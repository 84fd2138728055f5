"""What was painted here: the strokes that show at a pixel, of any level.

A stroke shows where its coverage, times what later ones and the layers above leave of it, is at least 1/255.  What a
stroke leaves is 1 less its coverage; a raster-op that only changes what is there leaves all of it.  At levels coarser
than the strokes' the pixel is looked at in parts, so that strokes side by side do not hide one another.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from engine.canvas import layers
from engine.canvas.evaluate import TileCache
from engine.canvas.layers import Group, Layer
from engine.canvas.reading import layer_planes
from engine.makers.definitions import kind_of
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.textures import Texture
from engine.painting.times import untimed
from engine.painting.value import Painting
from engine.session.steps import Definitions, LoggedStep, Steps
from engine.strokes.coverage_at import Covering, Seeds, hides, near, stroke_bounds
from engine.texture.table import KINDS

LEAST_SHARE = 1.0 / 255.0  # of a pixel that is seen
_PARTS = 4  # levels finer than the pixel at which it is looked at in parts
_KEPT = 64  # sets of definitions whose textures are kept
_ALPHA = 3


class CanvasPixel(NamedTuple):
    """A pixel of a level."""

    level: int
    x: int
    y: int

    @property
    def rect(self) -> Rect:
        """Gives the pixel as a rectangle of its level."""
        return Rect.at(self.x, self.y, 1, 1)


@dataclass(frozen=True, eq=False, slots=True)
class ShownStroke:
    """A stroke that shows, 0..1 how much, and on which layer."""

    step: LoggedStep
    stroke: c.Stroke
    share: float
    layer: str


class PaintedHere:
    """Finds the strokes that show at places of one painting; what is learnt of its strokes is kept for the next place.

    `cache`: of the painting's tiles.
    """

    def __init__(self, cache: TileCache | None = None) -> None:
        self._cache = cache
        self._covering = Covering()
        self._bounds: dict[int, tuple[c.Stroke, Rect]] = {}  # by the index of the step
        self._made: dict[int, tuple[Definitions, dict[str, Texture]]] = {}  # by the definitions' identity

    def at(self, place: CanvasPixel, painting: Painting, steps: Steps) -> tuple[ShownStroke, ...]:
        """Returns the strokes that show at a place, the newest first; `steps` are those that led to the painting."""
        found: list[ShownStroke] = []
        seen = 1.0
        for sheet, weight, plain in _sheets(painting.root, 1.0, True):
            bare = next((layer for layer in layers.layers(steps.root) if layer.name == sheet.name), None)
            alpha = self._alpha(sheet, place)
            if bare is not None:
                found += self._on_layer(bare, place, (seen * weight, alpha), painting, steps)
            seen *= 1.0 - alpha * weight if plain else 1.0
            if seen < LEAST_SHARE:
                break
        return tuple(sorted(found, key=lambda shown: -shown.step.index))

    def _alpha(self, sheet: Layer, place: CanvasPixel) -> float:
        planes = layer_planes(sheet, place.level, place.rect, self._cache)
        return 0.0 if planes is None else float(planes[_ALPHA, 0, 0])

    def _on_layer(
        self, bare: Layer, place: CanvasPixel, through: tuple[float, float], painting: Painting, steps: Steps
    ) -> list[ShownStroke]:
        """`through`: how much of the layer is seen, and its alpha."""
        weight, alpha = through
        candidates = list(self._near(bare, place, steps))
        finest = max((stroke.level for _, stroke in candidates), default=place.level)
        finer = min(max(finest - place.level, 0), _PARTS)
        level, rect = place.level + finer, place.rect.zoomed(finer)
        left = np.full((rect.height, rect.width), weight, np.float32)
        found: list[ShownStroke] = []
        for step, stroke in candidates:
            seeds = Seeds(painting.seed if stroke.seed is None else stroke.seed, painting.seed)
            parts = (level, rect) if stroke.level > place.level else (place.level, place.rect)  # no finer than it is
            covered = self._covering.over(stroke, *parts, self._textures(step.textures, painting), seeds)
            if covered is None:
                continue
            share = float((covered * left).mean()) * (alpha if step.locked else 1.0)
            if share >= LEAST_SHARE:
                found.append(ShownStroke(step, stroke, share, bare.name))
            if hides(stroke.brush):
                left *= 1.0 - covered
                if left.max() < LEAST_SHARE:
                    break
        return found

    def _near(self, bare: Layer, place: CanvasPixel, steps: Steps) -> Iterator[tuple[LoggedStep, c.Stroke]]:
        """Yields the strokes whose bounds meet the place, the newest first."""
        there: dict[int, Rect] = {}
        for step in steps.strokes(bare):
            known = self._bounds.get(step.index)
            if known is None or known[0] is not step.command:
                assert isinstance(step.command, c.Stroke)
                known = self._bounds[step.index] = step.command, stroke_bounds(step.command)
            stroke, around = known
            if stroke.level not in there:
                there[stroke.level] = near(stroke.level, place.level, place.rect)
            if there[stroke.level].meets(around):
                yield step, stroke

    def _textures(self, definitions: Definitions, painting: Painting) -> dict[str, Texture]:
        """Returns textures as they were; one whose picture the painting has no more is as it is now, if it is there."""
        if id(definitions) not in self._made:
            pictures = {t.source.sha: t for t in painting.textures.values() if t.source is not None}
            made = dict(painting.textures)
            for name, command in definitions.items():
                row, plain = KINDS.get(command.maker), untimed(command)
                same = pictures.get(command.arguments.get("sha", ""))
                if row is not None and not row.pictured:
                    made[name] = Texture(command.maker, plain.arguments)
                elif same is not None:
                    made[name] = Texture(kind_of(plain), plain.arguments, same.source, same.mask)
            if len(self._made) >= _KEPT:
                self._made.clear()
            self._made[id(definitions)] = definitions, made
        return self._made[id(definitions)][1]


def _sheets(group: Group, weight: float, plain: bool) -> Iterator[tuple[Layer, float, bool]]:
    """Yields the layers that are seen from the topmost on, each with its opacity, 0..1, and whether it just lies over
    what is below."""
    for node in reversed(group.children):
        if not node.visible:
            continue
        over = plain and node.blend == "src-over"
        if isinstance(node, Group):
            yield from _sheets(node, weight * node.opacity, over)
        else:
            yield node, weight * node.opacity, over
