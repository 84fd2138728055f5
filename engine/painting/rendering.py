"""Pictures of any size from a painting, strip by strip, in bounded memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np

from engine.canvas import growth, layers
from engine.canvas.attenuate import fold
from engine.canvas.composite import Read, composite
from engine.canvas.layers import Group, Layer
from engine.canvas.reading import covered, layer_planes
from engine.files.fault import Cancelled
from engine.numeric.address import Rect
from engine.painting.cascade import Cascade

_STRIP = 1 << 22  # pixels of a strip, about
ROWS = 256
_HELD, _HELD_OF_ALL = 1 << 19, 1 << 22  # pixels of a coarser level up to which it is held: of a layer, of all of them
_COLUMNS = 1024  # of the pieces in which layers are evaluated
TOGETHER = 1 << 23  # pixels of all layers' parts of a band, about: 128 MB
HELD = 64  # layers for which a piece has that size; for more it is narrower

Stop = Callable[[], bool] | None
Progress = Callable[[float], None] | None  # gets the part done, 0..1


def folded_layers(root: Group) -> Group:
    """Returns the same tree with nothing pending, so that no strip settles it anew."""
    for layer in list(layers.layers(root)):
        settled = fold(layer.pyramid)
        if settled.levels != layer.pyramid.levels:
            root = layers.with_pyramid(root, layer.name, settled)
    return root


def bands(rect: Rect) -> Iterator[Rect]:
    """Yields the rectangle in strips of whole rows, from the top."""
    rows = max(16, min(ROWS, _STRIP // max(1, rect.width)))
    for y in range(rect.y0, rect.y1, rows):
        yield Rect(rect.x0, y, rect.x1, min(y + rows, rect.y1))


def strips(root: Group, level: int, rect: Rect, cancelled: Stop = None) -> Iterator[np.ndarray]:
    """Yields the composited picture of `rect` from the top: float32 (4, n, w) premultiplied, clamped for display;
    the same array every time.  Cancelled is raised between pieces."""
    count = sum(1 for _ in layers.layers(root))
    columns = max(128, _COLUMNS * HELD // max(HELD, count))
    out: np.ndarray | None = None
    evaluated = _Evaluated(level, rect, min(_HELD, _HELD_OF_ALL // max(1, count)))
    for band in bands(rect):
        if out is None:
            out = np.empty((4, band.height, band.width), np.float32)
        strip = out[:, : band.height]
        for x in range(band.x0, band.x1, columns):
            check_cancelled(cancelled)
            piece = Rect(x, band.y0, min(x + columns, band.x1), band.y1)
            rows, across = piece.slices(band)
            strip[:, rows, across] = composite(root, level, piece, piece_reader(piece, evaluated.planes))
        yield strip


def sheets(
    root: Group, level: int, frame: Rect, places: Mapping[int, Rect], cancelled: Stop = None
) -> Iterator[tuple[dict[int, np.ndarray], np.ndarray]]:
    """Yields the frame from the top, in bands, each layer evaluated once: (planes of each layer by its id, composited).

    `places`: where each layer is to be seen (`reach`); its planes cover the part of the band there, and are left out
    where that is empty.  All float32 (4, n, w), premultiplied; the composited ones clamped for display.
    """
    all_layers = list(layers.layers(root))
    rows = max(16, min(ROWS, TOGETHER // (len(all_layers) + 1) // frame.width))
    for y in range(frame.y0, frame.y1, rows):
        band = Rect(frame.x0, y, frame.x1, min(y + rows, frame.y1))
        known: dict[int, np.ndarray] = {}
        for layer in all_layers:
            check_cancelled(cancelled)
            part = places[layer.id].intersect(band)
            if not part.empty:
                found = layer_planes(layer, level, part)
                known[layer.id] = np.zeros((4, part.height, part.width), np.float32) if found is None else found
        yield known, composite(root, level, band, _parts(known, places, band))


def _parts(known: Mapping[int, np.ndarray], places: Mapping[int, Rect], band: Rect) -> Read:
    """Hands out blocks of what is known of each layer, empty elsewhere."""

    def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        whole = places[layer.id].intersect(band)
        part = whole.intersect(rect)
        if part.empty or layer.id not in known:
            return None
        rows, columns = part.slices(whole)
        planes = known[layer.id][:, rows, columns]
        if _nothing(planes):
            return None  # much of most layers: cheaper to see than to composite
        if part == rect:
            return planes
        out = np.zeros((4, rect.height, rect.width), np.float32)
        rows, columns = part.slices(rect)
        out[:, rows, columns] = planes
        return out

    return read


def _nothing(planes: np.ndarray) -> bool:
    """Tells whether all of (4, h, w) is zero; alpha is not below that."""
    return not planes[3].max() and not planes[:3].max() and not planes[:3].min()


def check_cancelled(cancelled: Stop) -> None:
    """Raises Cancelled if the one who asked says so."""
    if cancelled is not None and cancelled():
        raise Cancelled


def piece_reader(piece: Rect, evaluate: Read = layer_planes) -> Read:
    """Returns what evaluates each layer once for a whole piece, and hands out its blocks."""
    known: dict[int, np.ndarray | None] = {}

    def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        if layer.id not in known:
            known[layer.id] = evaluate(layer, level, piece)
        planes = known[layer.id]
        if planes is None:
            return None
        rows, columns = rect.slices(piece)
        return planes[:, rows, columns]

    return read


class _Evaluated:
    """Evaluates the pieces of a `frame` of one level; what they have in common, the coarser levels, once.

    `held`: pixels of a layer's level up to which it is held as a whole.
    """

    def __init__(self, level: int, frame: Rect, held: int) -> None:
        self._needed, self._held = {level: frame.evened()}, held
        self._cascades: dict[int, Cascade] = {}

    def planes(self, layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        """Returns a layer's pixels of a piece, as `layer_planes`."""
        if layer.pyramid.bare is not None:
            return layer_planes(layer, level, rect)
        cascade = self._cascades.get(layer.id)
        if cascade is None:
            cascade = self._cascades[layer.id] = Cascade(layer.pyramid, self._needed, self._held, level)
        around = rect.evened()
        found = cascade.at(level, around)
        return covered(None if found is None else found.rgba[:, *rect.slices(around)], layer.growth, level, rect)


def reach(layer: Layer, level: int, frame: Rect) -> Rect:
    """Returns a rectangle of `level` within `frame` outside which a layer is empty there."""
    whole = growth.bounds(layer.growth, level).intersect(frame)
    for key, record in layer.pyramid.all_records():
        x, y, r = key.rect.x0, key.rect.y0, record.rect
        placed = Rect(x + r.x0, y + r.y0, x + r.x1, y + r.y1)
        # What lies on a coarser level spreads by less than two of its pixels when it is expanded.
        spread = placed.grown(2) if key.level < level else placed
        whole = whole.union(spread.zoomed(level - key.level).intersect(frame))
    return whole
