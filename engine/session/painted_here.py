"""What was painted here: the strokes that show at a pixel, of any level.

A stroke shows where its coverage, times what later ones and the layers above leave of it, is at least 1/255.  What a
stroke leaves is 1 less its coverage; a raster-op that only changes what is there leaves all of it.  At levels coarser
than the strokes' the pixel is looked at in parts, so that strokes side by side do not hide one another.
"""

from __future__ import annotations

import heapq
from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from engine.canvas import layers
from engine.canvas.layers import Group, Layer
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.makers.definitions import kind_of
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.textures import Texture
from engine.painting.times import untimed
from engine.painting.value import Painting
from engine.session.poured_here import Before, Poured
from engine.session.steps import Definitions, LoggedStep, Steps
from engine.strokes.coverage_at import Covering, Seeds, bounds_of, hides, near, plain_over, plainly
from engine.texture.table import GRADIENT, KINDS

LEAST_SHARE = 1.0 / 255.0  # of a pixel that is seen
_PARTS = 4  # levels finer than the pixel at which it is looked at in parts
_KEPT = 64  # sets of definitions whose textures are kept
_ALPHA = 3
_AT_FIRST, _EFFORT = 64, 1024  # plain strokes that are looked at at once, then twice as many: few may hide the others
_OWN_MASK = 32  # times as long as at a plain stroke is looked at one that goes through a mask of its own
_BOUND_AT_ONCE = 512  # strokes
_UNBOUND: tuple[c.Stroke | None, Rect] = None, Rect(0, 0, 0, 0)
Search = Iterator[tuple["ShownStroke", ...]]


class CanvasPixel(NamedTuple):
    """A pixel of a level."""

    level: int
    x: int
    y: int

    @property
    def rect(self) -> Rect:
        """Gives the pixel as a rectangle of its level."""
        return Rect.at(self.x, self.y, 1, 1)


class CanvasParts(NamedTuple):
    """Pixels of a level, which a pixel is looked at in."""

    level: int
    rect: Rect


@dataclass(frozen=True, eq=False, slots=True)
class ShownStroke:
    """A stroke that shows, 0..1 how much, and on which layer."""

    step: LoggedStep
    stroke: c.Stroke
    share: float
    layer: str


@dataclass(eq=False, slots=True)
class _Ground:
    """A layer that is seen at a place: its alpha, the parts that the place is looked at in, how much of each is `left`
    to be seen, float32 (h, w), and the strokes there, the newest first."""

    name: str
    alpha: float
    fine: CanvasParts
    left: np.ndarray
    candidates: list[_Candidate]

    @classmethod
    def of(
        cls, name: str, alpha: float, weight: float, place: CanvasPixel, strokes: Sequence[tuple[LoggedStep, c.Stroke]]
    ) -> _Ground:
        finer = min(max(max(stroke.level for _, stroke in strokes) - place.level, 0), _PARTS)
        fine = CanvasParts(place.level + finer, place.rect.zoomed(finer))
        ground = cls(name, alpha, fine, np.full((fine.rect.height, fine.rect.width), weight, np.float32), [])
        ground.candidates += [_Candidate(step, stroke, ground) for step, stroke in strokes]
        return ground


class _Candidate(NamedTuple):
    """A stroke near a place."""

    step: LoggedStep
    stroke: c.Stroke
    ground: _Ground


class PaintedHere:
    """Finds the strokes that show at places of one painting; what is learnt of its strokes is kept for the next place.

    `cache`: of the painting's tiles; `before`: gives the painting that a step was done on, where it is at hand.
    """

    def __init__(self, cache: TileCache | None = None, before: Before = lambda step: None) -> None:
        self._cache, self._poured = cache, Poured(before, cache)
        self._covering = Covering()
        self._bounds: dict[int, tuple[c.Stroke, Rect]] = {}  # by the index of the step
        self._made: dict[int, tuple[Definitions, dict[str, Texture]]] = {}  # by the definitions' identity

    def at(self, place: CanvasPixel, painting: Painting, steps: Steps) -> tuple[ShownStroke, ...]:
        """Returns the strokes that show at a place, the newest first; `steps` are those that led to the painting."""
        return tuple(shown for some in self.search(place, painting, steps) for shown in some)

    def search(self, place: CanvasPixel, painting: Painting, steps: Steps) -> Search:
        """Yields the same as they are found, the newest first: a few at a time, or none, after some milliseconds each.
        The steps may go on meanwhile."""
        grounds = yield from self._grounds(place, painting, steps)
        strokes = heapq.merge(*(ground.candidates for ground in grounds), key=lambda one: -one.step.index)
        open_ones = (one for one in strokes if one.ground.left.max() >= LEAST_SHARE)
        effort = _AT_FIRST
        while some := _next(open_ones, effort, place.level):
            effort = min(2 * effort, _EFFORT)
            found = [shown for ground in grounds for shown in self._shown(ground, some, place, painting)]
            yield tuple(sorted(found, key=lambda shown: -shown.step.index))

    def _grounds(
        self, place: CanvasPixel, painting: Painting, steps: Steps
    ) -> Generator[tuple[ShownStroke, ...], None, list[_Ground]]:
        """Returns the layers that are seen at a place, from the topmost on, with their strokes there."""
        grounds: list[_Ground] = []
        seen = 1.0
        bare = {layer.name: layer for layer in layers.layers(steps.root)}
        laid = {name: list(steps.strokes(layer)) for name, layer in bare.items()}
        for sheet, weight, plain in _sheets(painting.root, 1.0, True):
            alpha = self._alpha(sheet, place)
            yield ()
            near = yield from self._near(laid.get(sheet.name, []), place, painting.frame)
            if near:
                grounds.append(_Ground.of(sheet.name, alpha, seen * weight, place, near))
            seen *= 1.0 - alpha * weight if plain else 1.0
            if seen < LEAST_SHARE:
                break
        return grounds

    def _alpha(self, sheet: Layer, place: CanvasPixel) -> float:
        planes = layer_planes(sheet, place.level, place.rect, self._cache)
        return 0.0 if planes is None else float(planes[_ALPHA, 0, 0])

    def _shown(
        self, ground: _Ground, among: Sequence[_Candidate], place: CanvasPixel, painting: Painting
    ) -> Iterator[ShownStroke]:
        """Yields the strokes on a layer that show, of some, and takes from what is left of it what they hide."""
        some = [(one.step, one.stroke) for one in among if one.ground is ground]
        if not some:
            return
        covered = self._covered(some, place, ground.fine, painting)
        leave = np.array([hides(stroke.brush) for _, stroke in some], np.float32)[:, None, None]
        seen = np.multiply.accumulate(np.concatenate([ground.left[None], 1.0 - covered * leave]))
        shares = (covered * seen[:-1]).mean(axis=(1, 2))
        for n in np.flatnonzero(shares >= LEAST_SHARE).tolist():
            step, stroke = some[n]
            share = float(shares[n]) * (ground.alpha if step.locked else 1.0)
            if share >= LEAST_SHARE:
                yield ShownStroke(step, stroke, share, ground.name)
        ground.left = seen[-1]

    def _covered(
        self, some: Sequence[tuple[LoggedStep, c.Stroke]], place: CanvasPixel, fine: CanvasParts, painting: Painting
    ) -> np.ndarray:
        """Returns how much of the parts each stroke covers: float32 (n, h, w)."""
        out = np.zeros((len(some), fine.rect.height, fine.rect.width), np.float32)
        alike: dict[int, list[int]] = {}
        for n, (step, stroke) in enumerate(some):
            level, rect = fine if stroke.level > place.level else (place.level, place.rect)  # no finer than it is
            if isinstance(step.command, c.Fill):
                poured = self._poured.over(step, step.command, level, rect)
                out[n] = 0.0 if poured is None else poured
                continue
            if plainly(stroke, level):
                alike.setdefault(stroke.level, []).append(n)
                continue
            seeds = Seeds(painting.seed if stroke.seed is None else stroke.seed, painting.seed)
            covered = self._covering.over(stroke, level, rect, self._textures(step.textures, painting), seeds)
            if covered is not None:
                out[n] = covered
        for stroke_level, places in alike.items():
            level, rect = fine if stroke_level > place.level else (place.level, place.rect)
            out[places] = plain_over([some[n][1] for n in places], level, rect)
        return out

    def _near(
        self, strokes: Sequence[LoggedStep], place: CanvasPixel, frame: Rect
    ) -> Generator[tuple[ShownStroke, ...], None, list[tuple[LoggedStep, c.Stroke]]]:
        """Returns the strokes whose bounds meet the place, the newest first."""
        there: dict[int, Rect] = {}
        out: list[tuple[LoggedStep, c.Stroke]] = []
        for start in range(0, len(strokes), _BOUND_AT_ONCE):
            some = strokes[start : start + _BOUND_AT_ONCE]
            self._bound([step for step in some if self._bounds.get(step.index, _UNBOUND)[0] is not step.command])
            for step in some:
                if isinstance(step.command, c.Fill):
                    stroke, around = self._poured.stroke(step, step.command, frame)
                else:
                    stroke, around = self._bounds[step.index]
                if stroke.level not in there:
                    there[stroke.level] = near(stroke.level, place.level, place.rect)
                if there[stroke.level].meets(around):
                    out.append((step, stroke))
            yield ()
        return out

    def _bound(self, steps: Sequence[LoggedStep]) -> None:
        """Learns the bounds of strokes."""
        strokes = {step.index: step.command for step in steps if isinstance(step.command, c.Stroke)}
        if strokes:
            for (index, stroke), bounds in zip(strokes.items(), bounds_of([*strokes.values()]), strict=True):
                self._bounds[index] = stroke, bounds

    def _textures(self, definitions: Definitions, painting: Painting) -> dict[str, Texture]:
        """Returns textures as they were; one whose picture the painting has no more is as it is now, if it is there."""
        if id(definitions) not in self._made:
            pictures = {t.source.sha: t for t in painting.textures.values() if t.source is not None}
            made = dict(painting.textures)
            for name, command in definitions.items():
                row, plain = KINDS.get(command.maker), untimed(command)
                same = pictures.get(command.arguments.get("sha", ""))
                if command.maker == GRADIENT or (row is not None and not row.pictured):
                    made[name] = Texture(command.maker, plain.arguments)
                elif same is not None:
                    made[name] = Texture(kind_of(plain), plain.arguments, same.source, same.mask)
            if len(self._made) >= _KEPT:
                self._made.clear()
            self._made[id(definitions)] = definitions, made
        return self._made[id(definitions)][1]


def _next(strokes: Iterator[_Candidate], effort: int, level: int) -> list[_Candidate]:
    """Takes the next strokes, as many as are looked at with some effort, or one; none where there are no more."""
    some: list[_Candidate] = []
    while effort > 0 and (one := next(strokes, None)) is not None:
        some.append(one)
        effort -= 1 if plainly(one.stroke, level) and isinstance(one.step.command, c.Stroke) else _OWN_MASK
    return some


def _sheets(group: Group, weight: float, plain: bool) -> Iterator[tuple[Layer, float, bool]]:
    """Yields the layers that are seen from the topmost on, each with its opacity, 0..1, and whether it just lies over
    what is below."""
    for node in reversed(group.children):
        if not node.visible:
            continue
        over = plain and node.blend == "src-over"
        if isinstance(node, Group):
            yield from _sheets(node, weight * node.opacity, over)
        elif isinstance(node, Layer):
            yield node, weight * node.opacity, over
