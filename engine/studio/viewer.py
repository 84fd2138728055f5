"""The tiles that the window wants: which are old is found by comparing paintings, and they are made and sent."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from engine.canvas.composite import composite
from engine.canvas.heaps.seen_heaps import HeapsOf, heaped_on
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.cells import SeenAreas
from engine.canvas.reading import covered, kept_planes, layer_planes
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting.difference import Areas, areas
from engine.painting.rendering import piece_reader
from engine.painting.value import Painting
from engine.session.session import Session
from engine.strokes.example_stroke import Live
from engine.strokes.live_heaps import live_heaps
from engine.strokes.paint_stroke import LiveStroke
from engine.studio import picking, results
from engine.studio import requests as q
from engine.studio.lit.seen_heights import SeenHeights
from engine.studio.masked.mask_alone import MaskAlone
from engine.studio.moving import placed_stroke
from engine.studio.seen_plan import SeenPlan
from engine.studio.sight import Key, Sight, grown_parts, tile_rect
from engine.studio.stack.layer_alone import LayerAlone

Above = Callable[[int, Rect, np.ndarray], np.ndarray]


class Subject(Protocol):
    """What the viewer looks at: the easel."""

    session: Session
    send: Callable[[results.Result], None]
    live: Live | None


class Viewer(Owned):
    """Tiles are functions of the painting and the stroke in progress.  It belongs to the engine's thread."""

    def __init__(self, subject: Subject) -> None:
        self._subject = subject
        self.sight = Sight()
        self.above: Above = lambda level, rect, pixels: pixels  # lays over a picture what is not painted yet
        self._fresh: list[Rect] = []  # pixels of the live stroke's level not sent yet
        self._level = 0
        self._where: SeenAreas = lambda level: []  # what is fresh is seen
        self._plan = SeenPlan()
        self.looking: Painting | None = None  # an earlier state, seen in place of the painting
        self._alone, self._only = MaskAlone(self.changed), LayerAlone(self.changed)
        self.heights = SeenHeights(self.changed)
        self.handlers: q.Handlers = {q.Pick: self._pick, **self._alone.handlers, **self._only.handlers}

    @property
    def fresh(self) -> bool:
        """Tells whether there is paint of the stroke in progress that the window has not seen."""
        return bool(self._fresh)

    @property
    def pending(self) -> int:
        """Returns tiles to look at."""
        return len(self.sight.open) + self.fresh

    def grew(self, level: int, parts: list[Rect]) -> None:
        """The stroke in progress laid paint on parts of its level, one for itself and for each of its copies."""
        self._plan.changed()
        more = self.fresh  # one change for all points between two pictures
        self._level, self._fresh = level, grown_parts(self._fresh, parts)
        self._where = placed_stroke.areas_of(self._subject.live, level, self._fresh)
        self.sight.grew(self._where, more)

    def changed(self, where: SeenAreas) -> None:
        """The picture changed in the areas that `where` gives for a level; whatever was fresh is among them."""
        self._plan.changed()
        self._fresh = []
        self.sight.changed(where)

    def unsee(self, live: Live) -> None:
        """The preview of a stroke that came to nothing goes from the screen."""
        whole = live.flattened or live.bed is not None  # seen at other levels too
        own, rect = live.level, live.rect
        seen = placed_stroke.areas_of(live, own, [rect])
        self.changed(lambda level: None if whole else seen(level))

    def look_back(self, painting: Painting | None, where: Areas | None = None) -> None:
        """Shows another state of the painting; None: as it is now.  `where`: in which areas it differs from what was
        seen, where that is known better than their layers tell."""
        now = self._subject.session.painting
        before, self.looking = self.looking or now, painting
        if before is not (painting or now):
            known = where is not None and not self._alone.shown
            self.changed(where if known and where is not None else areas(before, painting or now))

    def forget(self) -> None:
        """Another painting is to be seen."""
        self._fresh, self.looking = [], None
        self._plan.forget()
        self._alone.forget()
        self._only.forget()
        self.sight.forget()

    def send_fresh(self) -> None:
        """Sends the part of the wanted tiles that the stroke in progress changed."""
        self._fresh = []
        for key in self.sight.meeting(self._where):
            self._bring_up_to_date(key)

    def send_tile(self) -> None:
        """Sends the most urgent of the tiles to look at."""
        self._bring_up_to_date(self.sight.open.popleft())

    def _bring_up_to_date(self, key: Key) -> None:
        """Sends a wanted tile anew, or the part of it that changed since the window's copy, or that it is good."""
        part = self.sight.old_part(key)
        if part is None:
            return
        revision: int | None = self.sight.revision
        if part.empty:
            self.sight.sent(key)
            self._subject.send(results.Same((key,), self.sight.revision))
            return
        tile = tile_rect(key)
        picture, whole = self._plan.portions.picture(lambda: self.picture(key[0], part))
        if whole:
            self.sight.sent(key)
        else:
            revision = self.sight.unfinished(key)
        if revision is None:
            return
        pixels = results.frozen(to_premul8(picture))
        read = piece_reader(key[0], part, self._read, self._read_placed)
        heights = self.heights.of(
            self._only.seen(_seen_root(self._subject, self.looking)),
            key[0],
            part,
            picture,
            read,
            _heaps_of(self._subject),
        )
        inner = Rect(part.x0 - tile.x0, part.y0 - tile.y0, part.x1 - tile.x0, part.y1 - tile.y0)
        self._subject.send(results.Patch(key, inner, pixels, revision, heights))

    def picture(self, level: int, whole: Rect) -> np.ndarray:
        """Returns what is to be seen of a rectangle: float32 (4, h, w), premultiplied; with the stroke in progress."""
        live, root = self._subject.live, self._only.seen(_seen_root(self._subject, self.looking))
        alone = self._alone.picture(root, level, whole, self._read)
        if alone is not None:
            return alone
        read = piece_reader(level, whole, self._read, self._read_placed)
        planned = self._plan.of(root, live)
        return self.above(level, whole, composite(planned, level, whole, read))

    def _read(self, layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        live = self._subject.live
        if (
            isinstance(live, LiveStroke)
            and not live.empty
            and _the_same(layer, live.layer)
            and level == live.level
            and rect.meets(live.rect)
        ):
            return covered(live.preview(rect).rgba, layer.growth, level, rect)
        return layer_planes(layer, level, rect, self._subject.session.cache)

    def _read_placed(self, layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        """As `_read`, for placements, which show the stroke in progress at coarser levels, too."""
        live, cache = self._subject.live, self._subject.session.cache
        if isinstance(live, LiveStroke) and _the_same(layer, live.layer) and placed_stroke.reaches(live, level, rect):
            return placed_stroke.from_afar(live, layer, level, rect, cache)
        if isinstance(live, LiveStroke) and _the_same(layer, live.layer):
            return self._read(layer, level, rect)
        return kept_planes(layer, level, rect, cache)

    def _pick(self, request: q.Pick) -> None:
        rect, root = picking.looked_over(request), _seen_root(self._subject, self.looking)
        alone = picking.alone(root, request.layer)
        read = piece_reader(request.level, rect, self._read, self._read_placed)
        seen = self._plan.by_now(
            lambda: self.picture(request.level, rect) if alone is None else composite(alone, request.level, rect, read)
        )
        self._subject.send(picking.averaged(seen))


def _seen_root(subject: Subject, looking: Painting | None) -> Group:
    """Returns the layers that are seen: those of the stroke in progress, of an earlier state, or of the painting."""
    return subject.live.root if subject.live is not None else (looking or subject.session.painting).root


def _heaps_of(subject: Subject) -> HeapsOf:
    """Returns what reads the heaps of layers, with the stroke in progress."""
    live, cache = subject.live, subject.session.cache

    def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | float:
        if isinstance(live, LiveStroke) and not live.empty and level == live.level and _the_same(layer, live.layer):
            return live_heaps(live, rect)
        return heaped_on(layer, level, rect, cache)

    return read


def _the_same(layer: Layer, painted: Layer) -> bool:
    """Tells whether it is the layer, or the mask's sheet, that is painted on."""
    return layer.name == painted.name and type(layer) is type(painted)
