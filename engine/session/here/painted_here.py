"""What was painted here: the strokes that show at a pixel, of any level.

A stroke shows where its coverage, times what was selected, times what later ones and the layers above leave of it, is
at least 1/255.  What a stroke leaves is 1 less its coverage; a raster-op that only changes what is there leaves all of
it.  At levels coarser than the strokes' the pixel is looked at in parts, so that strokes side by side do not hide one
another.  Layers that were merged lie on as they lay then; what a placement shows is looked for in its source.  What is
heaped on the land adds up, and no paint hides it.
"""

from __future__ import annotations

import heapq
from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import NamedTuple

import numpy as np

from engine.brush.modes import HEAPS_UP
from engine.canvas import layers
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.selection import Selection
from engine.canvas.tile_cache import TileCache
from engine.checks.roles import AS_HEIGHT
from engine.makers.definitions import kind_of
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.textures import Texture
from engine.painting.times import untimed
from engine.painting.value import Painting
from engine.session.here.chosen import Choices, Definitions, Held
from engine.session.here.gazes import LEAST_SHARE, Gaze, SeenLayer, Sightline
from engine.session.here.lineage import Given
from engine.session.here.plies import BeginPly, CoverPly, EndPly, Part, Ply, ShadePly, Turn
from engine.session.here.poured_here import Poured
from engine.session.here.unfolded import Bounds, Candidate, Entry, Unfolding
from engine.session.picturing import picture_paint
from engine.session.steps import LoggedStep, Steps
from engine.strokes.coverage_at import Covering, Seeds, hides, lays, plain_over, plainly
from engine.texture.table import DEFINED, KINDS

_PARTS = 4  # levels finer than the pixel at which it is looked at in parts
_KEPT = 64  # sets of definitions whose textures are kept
_ALPHA = 3
_AT_FIRST, _EFFORT = 64, 1024  # plain strokes that are looked at at once, then twice as many: few may hide the others
_OWN_MASK = 32  # times as long as at a plain stroke is looked at one that goes through a mask of its own
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


@dataclass(frozen=True, eq=False, slots=True)
class ShownStroke:
    """A stroke that shows, 0..1 how much, and on which layer."""

    step: LoggedStep
    stroke: c.Stroke
    share: float
    layer: str


class _Ground:
    """A layer that is seen at a place: what its past tells of it, from the topmost stroke on, each entry with a number
    that never grows: its place in the log, or that of what lies above it."""

    def __init__(self, sight: SeenLayer, unfolding: Unfolding) -> None:
        self.sight, self.finer = sight, min(max(unfolding.finer, 0), _PARTS)
        self.entries: list[_Row] = []
        lowest = 1 << 62
        for entry in unfolding.entries:
            lowest = min(lowest, entry.step.index) if isinstance(entry, Candidate) else lowest
            self.entries.append(_Row(lowest, entry, self))


class _Row(NamedTuple):
    """An entry of a layer's past."""

    number: int
    entry: Entry
    ground: _Ground

    @property
    def open(self) -> bool:
        """Tells whether there is still something to see of it."""
        entry = self.entry
        return not isinstance(entry, Candidate) or not entry.ply.closed


class PaintedHere:
    """Finds the strokes that show at places of one painting; what is learnt of its strokes is kept for the next place.

    `cache`: of the painting's tiles; `held`: gives the painting after the step of a number, where it is at hand.
    """

    def __init__(self, cache: TileCache | None = None, held: Held = lambda number: None) -> None:
        self._cache, self._held = cache, held
        self._made: dict[int, tuple[Definitions, dict[str, Texture]]] = {}  # by the definitions' identity
        self._choices = Choices(held, self._textures, cache)
        self._poured = Poured(held, self._choices, cache)
        self._bounds, self._covering = Bounds(self._poured), Covering()
        self._painting = Painting()
        self._pictures: dict[int, tuple[c.AddPicture, layers.Layer | None]] = {}  # by the command's identity

    def at(self, place: CanvasPixel, painting: Painting, steps: Steps) -> tuple[ShownStroke, ...]:
        """Returns the strokes that show at a place, the newest first; `steps` are those that led to the painting."""
        return newest_first(shown for some in self.search(place, painting, steps) for shown in some)

    def search(self, place: CanvasPixel, painting: Painting, steps: Steps) -> Search:
        """Yields the same as they are found: a few at a time, or none, after some milliseconds each, the newest first
        but for those of merged layers, of which the topmost comes first.  The steps may go on meanwhile."""
        self._painting = painting
        self._choices.begin(painting, steps.painting)
        grounds = yield from self._grounds(place, painting, steps)
        rows = heapq.merge(*(ground.entries for ground in grounds), key=lambda row: -row.number)
        open_ones = (row for row in rows if row.open)
        effort = _AT_FIRST
        while some := _next(open_ones, effort):
            effort = min(2 * effort, _EFFORT)
            yield newest_first(shown for ground in grounds for shown in self._shown(ground, some))

    def _grounds(
        self, place: CanvasPixel, painting: Painting, steps: Steps
    ) -> Generator[tuple[ShownStroke, ...], None, list[_Ground]]:
        """Returns the layers that are seen at a place, from the topmost on, with their strokes there."""
        grounds: list[_Ground] = []
        pasts = steps.pasts
        named = {layer.name: pasts.get(layer.id) for layer in layers.layers(steps.root)}
        for sight in Sightline(painting.root, self._cache).sights(Gaze.of(place.level, place.rect)):
            yield ()
            for gaze in sight.gazes:
                unfolding = Unfolding(self._bounds, gaze)
                for _ in unfolding.unfold(named.get(sight.layer.name)):
                    yield ()
                if unfolding.strokes:
                    grounds.append(_Ground(sight, unfolding))
        return grounds

    def _shown(self, ground: _Ground, among: Sequence[_Row]) -> Iterator[ShownStroke]:
        """Yields the strokes on a layer that show, of some, and takes from what is left of it what they hide."""
        entries = (row.entry for row in among if row.ground is ground)
        for ply, some in groupby(entries, lambda entry: entry.ply if isinstance(entry, Candidate) else None):
            if ply is None:
                for turn in some:
                    assert not isinstance(turn, Candidate)
                    self._turn(turn, ground)
            elif not ply.closed:
                yield from self._seen([one for one in some if isinstance(one, Candidate)], ground)

    def _turn(self, turn: Turn, ground: _Ground) -> None:
        ply = turn.ply
        if isinstance(turn, BeginPly):
            ply.begin(ground.finer, self._part_of)
        elif isinstance(turn, EndPly):
            ply.end()
        elif isinstance(turn, ShadePly):
            ply.shade(turn.part, turn.outside, self._part_of)
        elif ply.parent is not None:
            alpha = self._given(turn, ply)
            if alpha is not None:
                ply.cover(alpha)

    def _seen(self, some: Sequence[Candidate], ground: _Ground) -> Iterator[ShownStroke]:
        """Yields the strokes of a ply that show."""
        ply, weight = some[0].ply, ground.sight.weight
        covered = self._covered(some, ply)
        heaps = ground.sight.layer.role == AS_HEIGHT
        leave = np.array([not (heaps and _adds(one.stroke)) and hides(one.stroke.brush) for one in some], np.float32)
        leave = leave[:, None, None]
        seen = np.multiply.accumulate(np.concatenate([ply.left[None], 1.0 - covered * leave]))
        if ply.parent is not None:
            _add_alpha(ply, some, covered)
        ply.left = seen[-1]
        if ply.silent:
            return
        shares = (covered * seen[:-1] * (ply.scale * ply.gaze.weights)).sum(axis=(1, 2)) * weight
        for n in np.flatnonzero(shares >= LEAST_SHARE).tolist():
            step = some[n].step
            share = float(shares[n]) * (ground.sight.alpha if step.locked else 1.0)
            if share >= LEAST_SHARE:
                yield ShownStroke(step, some[n].stroke, share, ground.sight.layer.name)

    def _covered(self, some: Sequence[Candidate], ply: Ply) -> np.ndarray:
        """Returns how much of the parts each stroke covers: float32 (n, h, w)."""
        shape = ply.gaze.weights.shape
        out = np.zeros((len(some), *shape), np.float32)
        alike: dict[int, list[int]] = {}
        for n, one in enumerate(some):
            level, rect, times = ply.pixels(one.stroke.level)
            if isinstance(one.step.command, c.Stroke) and plainly(one.stroke, level):
                alike.setdefault(one.stroke.level, []).append(n)
                continue
            covered = self._own(one, level, rect)
            if covered is not None:
                out[n] = _divided(covered[None], times)[0]
        for stroke_level, places in alike.items():
            level, rect, times = ply.pixels(stroke_level)
            found = plain_over([some[n].stroke for n in places], level, rect)
            out[places] = _divided(self._limited([some[n] for n in places], found, level, rect), times)
        return out

    def _own(self, one: Candidate, level: int, rect: Rect) -> np.ndarray | None:
        """Returns what a fill covers, or a stroke through a mask of its own."""
        step, stroke = one.step, one.stroke
        if isinstance(step.command, c.Fill):
            return self._poured.over(one.laid, step.command, level, rect)
        seeds = Seeds(self._painting.seed if stroke.seed is None else stroke.seed, self._painting.seed)
        covered = self._covering.over(stroke, level, rect, self._textures(step.textures), seeds)
        return None if covered is None else self._limited([one], covered[None], level, rect)[0]

    def _limited(self, some: Sequence[Candidate], covered: np.ndarray, level: int, rect: Rect) -> np.ndarray:
        """Returns what is left of coverages (n, h, w) by what was selected."""
        if any(one.limit is not None for one in some):
            covered = covered.copy()
        for n, one in enumerate(some):
            if one.limit is not None and covered[n].any():
                part = self._choices.part(one.limit, level, rect)
                whole = one.stroke.brush.row.grows
                covered[n] = covered[n] * (np.greater_equal(part, np.float32(0.5)) if whole else np.float32(part))
        return covered

    def _part_of(self, part: Part, level: int, rect: Rect) -> np.ndarray | float:
        if isinstance(part, Selection):
            return self._choices.part(part, level, rect)
        return part.part(level, rect)

    def _given(self, turn: CoverPly, ply: Ply) -> np.ndarray | None:
        """Returns the alpha of paint that is no stroke."""
        layer, planes = turn.given.layer, None
        if turn.given.picture is not None:
            layer = self._pictured(turn.given)
        elif turn.given.pasted is not None:
            layer = self._as_pasted(turn.given.pasted)
        if layer is not None:
            planes = layer_planes(layer, ply.gaze.level, ply.gaze.rect, self._cache)
        return None if planes is None else planes[_ALPHA]

    def _as_pasted(self, step: LoggedStep) -> layers.Layer | None:
        """Returns the layer that a step pasted, as it was then; None where that painting is not at hand."""
        there = self._held(step.number)
        assert isinstance(step.command, c.PastePaint)
        found = None if there is None else layers.find(there.root, step.command.name)
        return found if isinstance(found, layers.Layer) else None

    def _pictured(self, given: Given) -> layers.Layer | None:
        """Returns the layer that a picture was brought in as, if the painting still has that."""
        command = given.picture
        assert command is not None
        if id(command) not in self._pictures:
            texture = self._textures(given.textures).get(command.texture)
            found = None
            if texture is not None and texture.source is not None and texture.source.there:
                paint = picture_paint(texture.source, command, self._painting.grid)
                found = layers.Layer(1, "picture", pyramid=paint)
            self._pictures[id(command)] = command, found
        return self._pictures[id(command)][1]

    def _textures(self, definitions: Definitions) -> dict[str, Texture]:
        """Returns textures as they were; one whose picture the painting has no more is as it is now, if it is there."""
        if id(definitions) not in self._made:
            painting = self._painting
            pictures = {t.source.sha: t for t in painting.textures.values() if t.source is not None}
            lent = {one.sha: one for texture in painting.textures.values() for one in texture.pictures}
            made = dict(painting.textures)
            for name, command in definitions.items():
                row, plain = KINDS.get(command.maker), untimed(command)
                same = pictures.get(command.arguments.get("sha", ""))
                if command.maker in DEFINED or (row is not None and not row.pictured):
                    made[name] = Texture(command.maker, plain.arguments).lent(lent)
                elif same is not None:
                    made[name] = replace(same, kind=kind_of(plain), parameters=plain.arguments)
            if len(self._made) >= _KEPT:
                self._made.clear()
            self._made[id(definitions)] = definitions, made
        return self._made[id(definitions)][1]


def newest_first(found: Iterable[ShownStroke]) -> tuple[ShownStroke, ...]:
    """Returns strokes in order: the newest first, and of one that shows in several layers the topmost."""
    return tuple(sorted(found, key=lambda shown: -shown.step.index))


def _divided(covered: np.ndarray, times: int) -> np.ndarray:
    """Returns coverages (n, h, w) by parts of their pixels, so many along each."""
    return covered if times == 1 else covered.repeat(times, axis=1).repeat(times, axis=2)


def _add_alpha(ply: Ply, some: Sequence[Candidate], covered: np.ndarray) -> None:
    """Adds the paint that strokes lay to a ply's alpha, the topmost first."""
    laying = np.array([lays(one.stroke.brush) and not one.step.locked for one in some], np.float32)[:, None, None]
    taking = np.array([one.stroke.brush.row.takes_away for one in some], np.float32)[:, None, None]
    left = np.multiply.accumulate(np.concatenate([ply.open[None], 1.0 - covered * np.maximum(laying, taking)]))
    ply.alpha = ply.alpha + (covered * laying * left[:-1]).sum(axis=0)
    ply.open = left[-1]


def _adds(stroke: c.Stroke) -> bool:
    """Tells whether a stroke on a layer of heights heaps up, or carves: of such ones each shows, however many lie
    there."""
    return stroke.brush.height is not None and stroke.brush.row.heaps == HEAPS_UP


def _level(one: Candidate) -> int:
    return one.ply.pixels(one.stroke.level)[0]


def _next(rows: Iterator[_Row], effort: int) -> list[_Row]:
    """Takes the next entries, as many as are looked at with some effort, or one; none where there are no more."""
    some: list[_Row] = []
    while effort > 0 and (row := next(rows, None)) is not None:
        some.append(row)
        one = row.entry
        if isinstance(one, Candidate):
            quick = plainly(one.stroke, _level(one)) and isinstance(one.step.command, c.Stroke)
            effort -= 1 if quick else _OWN_MASK
    return some
