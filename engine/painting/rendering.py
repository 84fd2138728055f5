"""Pictures of any size from a painting, strip by strip, in bounded memory."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from functools import partial

import numpy as np

from engine.canvas import growth, layers
from engine.canvas.attenuate import fold
from engine.canvas.composite import composite
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.composite_steps import Planned
from engine.canvas.reading import Read, covered, kept_planes, layer_planes
from engine.canvas.selecting.mask_sheet import MaskSheet
from engine.canvas.tile_cache import TileCache
from engine.files.fault import Cancelled
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting.cascade import Cascade
from engine.painting.lighting import Lighting, needed, pictured

_STRIP = 1 << 22  # pixels of a strip, about
ROWS = 64
_SHEET_ROWS, _SHEET_COLUMNS = 256, 512  # of the pieces of sheets: those of all layers fit into a processor's caches
_HELD, HELD_OF_ALL = 1 << 19, 1 << 21  # pixels of a coarser level up to which it is held: of a layer, of all of them
_ELSEWHERE = 48 << 20  # bytes of what placements show that are kept
_COLUMNS = 1024  # of the pieces in which layers are evaluated: see `_Pieces`
_SHARING, _COARSER = 512, 3  # rows whose pieces are evaluated from one part of a level, so many levels coarser
TOGETHER = 1 << 23  # pixels of all layers' parts of a band, about: 32 MB
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


def strips(
    root: Group | Planned, level: int, rect: Rect, cancelled: Stop = None, elsewhere: Read | None = None
) -> Iterator[np.ndarray]:
    """Yields the composited picture of `rect` from the top: float32 (4, n, w) premultiplied, clamped for display;
    the same array every time.  Cancelled is raised between pieces.  `elsewhere`: that of `keeping`, where many pictures
    of the same layers are made."""
    pieces = _Pieces(root, level, rect, cancelled, elsewhere=elsewhere)
    out: np.ndarray | None = None
    for band in bands(rect):
        if out is None:
            out = np.empty((4, band.height, band.width), np.float32)
        strip = out[:, : band.height]
        for piece in pieces.of(band):
            rows, across = piece.slices(band)
            strip[:, rows, across] = pieces.composited(piece)
        yield strip


def rows_of(
    root: Group,
    level: int,
    rect: Rect,
    convert: Callable[[np.ndarray], np.ndarray],
    cancelled: Stop = None,
    lighting: Lighting | None = None,
    held: int = HELD_OF_ALL,
) -> Iterator[np.ndarray]:
    """As `strips`, but pixels as `convert` makes them of planes: (n, w, channels), a new array every time; lit, if
    there is a light.  On all cores; each strip is evaluated while the one before is worked with.  `held`: the pixels of
    all layers' coarser levels up to which these are held."""
    pieces = _Pieces(root, level, rect, cancelled, lighting, held=held)

    def made(piece: Rect) -> tuple[Rect, np.ndarray]:
        return piece, convert(pieces.composited(piece))

    pool = ThreadPoolExecutor(os.cpu_count() or 1, "inkfall rows")
    try:
        before: np.ndarray | None = None
        for band in bands(rect):
            begun = [pool.submit(made, piece) for piece in pieces.of(band)]
            if before is not None:
                yield before
            before = _joined(band, begun)
        if before is not None:
            yield before
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _joined(band: Rect, begun: Sequence[Future[tuple[Rect, np.ndarray]]]) -> np.ndarray:
    """Returns the pixels of a band from those of its pieces."""
    out: np.ndarray | None = None
    for one in begun:
        piece, pixels = one.result()
        if out is None:
            out = np.empty((band.height, band.width, pixels.shape[2]), pixels.dtype)
        out[piece.slices(band)] = pixels
    assert out is not None
    return out


def _held_of(count: int, of_all: int) -> int:
    """Returns the pixels up to which a coarser level is held, of each of so many layers."""
    return min(_HELD, of_all // max(1, count))


class _Pieces:
    """The pieces in which a rectangle of a level is composited: with all that belongs to one, they fit into a
    processor's caches.  Safe for several threads."""

    def __init__(
        self,
        root: Group | Planned,
        level: int,
        rect: Rect,
        cancelled: Stop,
        lighting: Lighting | None = None,
        elsewhere: Read | None = None,
        held: int = HELD_OF_ALL,
    ) -> None:
        root = Planned.of(root) if isinstance(root, Group) else root
        count = sum(1 for _ in layers.layers(root.root))
        self._planned, self._level, self._cancelled = root, level, cancelled
        self._lighting, rect = lighting, needed(rect, lighting)
        self._columns = max(128, _COLUMNS * HELD // max(HELD, count))
        self._evaluated = _Evaluated(level, rect, _held_of(count, held))
        self._elsewhere = keeping() if elsewhere is None else elsewhere

    def of(self, band: Rect) -> list[Rect]:
        """Returns the pieces of a band, from the left."""
        return [
            Rect(x, band.y0, min(x + self._columns, band.x1), band.y1) for x in range(band.x0, band.x1, self._columns)
        ]

    def composited(self, piece: Rect) -> np.ndarray:
        """Returns the picture of a piece: float32 (4, h, w).  Cancelled, if the one who asked says so."""
        check_cancelled(self._cancelled)
        around = needed(piece, self._lighting)
        read = piece_reader(self._level, around, self._evaluated.planes, self._elsewhere)
        return pictured(self._planned, self._level, piece, read, self._lighting)


def sheets(
    root: Group,
    level: int,
    frame: Rect,
    places: Mapping[int, Rect],
    cancelled: Stop = None,
    held: int = HELD_OF_ALL,
) -> Iterator[tuple[dict[int, np.ndarray], np.ndarray]]:
    """Yields the frame from the top, in bands, each layer evaluated once: (pixels of each layer by its id, composited).

    `places`: where each layer is to be seen (`reach`); its pixels cover the part of the band there, and are left out
    where that is empty.  All uint8 (n, w, 4) of straight alpha.  `held`: as in `rows_of`.
    """
    all_layers = list(layers.layers(root))
    evaluated = _Evaluated(level, frame, _held_of(len(all_layers), held))
    elsewhere, planned = keeping(), Planned.of(root)
    rows = max(16, min(_SHEET_ROWS, TOGETHER // (len(all_layers) + 1) // frame.width) & ~1)
    for y in range(frame.y0, frame.y1, rows):
        band = Rect(frame.x0, y, frame.x1, min(y + rows, frame.y1))
        parts = {layer.id: places[layer.id].intersect(band) for layer in all_layers}
        known = {id: _clear(part) for id, part in parts.items() if not part.empty}
        merged = _clear(band)
        for x in range(band.x0, band.x1, _SHEET_COLUMNS):
            piece = Rect(x, band.y0, min(x + _SHEET_COLUMNS, band.x1), band.y1)
            found: dict[int, np.ndarray] = {}
            for layer in all_layers:
                check_cancelled(cancelled)
                part = parts[layer.id].intersect(piece)
                planes = None if part.empty else evaluated.planes(layer, level, piece)
                if planes is not None:
                    found[layer.id] = planes
                    known[layer.id][part.slices(parts[layer.id])] = to_rgba8(planes[:, *part.slices(piece)])
            merged[piece.slices(band)] = to_rgba8(
                composite(planned, level, piece, _known(found, level, piece, evaluated, elsewhere))
            )
        yield known, merged


def _known(found: Mapping[int, np.ndarray], level: int, piece: Rect, evaluated: _Evaluated, elsewhere: Read) -> Read:
    """Hands out blocks of the planes of a piece of a level, by the ids of layers; masks are evaluated."""

    def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        return evaluated.planes(layer, level, rect) if isinstance(layer, MaskSheet) else found.get(layer.id)

    return piece_reader(level, piece, read, elsewhere)


def _clear(rect: Rect) -> np.ndarray:
    return np.zeros((rect.height, rect.width, 4), np.uint8)


def check_cancelled(cancelled: Stop) -> None:
    """Raises Cancelled if the one who asked says so."""
    if cancelled is not None and cancelled():
        raise Cancelled


def keeping() -> Read:
    """Returns what evaluates layers for placements, in tiles that it keeps: pieces beside one another, and turns of a
    picture in itself, ask for the same.  Safe for several threads."""
    return partial(kept_planes, cache=TileCache(_ELSEWHERE))


def piece_reader(level: int, piece: Rect, evaluate: Read = layer_planes, placed: Read = layer_planes) -> Read:
    """Returns what evaluates each layer once for a whole piece of a level, and hands out its blocks; what placements
    show of other places, `placed` evaluates as it is asked for."""
    known: dict[int, np.ndarray | None] = {}
    own = level

    def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        if level != own or rect.intersect(piece) != rect:
            return placed(layer, level, rect)
        if layer.id not in known:  # once for all blocks: they share most of what lies above them
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
        self._frame = frame
        self._needed, self._held = {level: frame.evened()}, held
        self._cascades: dict[int, Cascade] = {}
        self._lock = threading.Lock()

    def _row_of(self, rect: Rect) -> Rect:
        """Returns the part of the frame, of its whole width, that is evaluated from the same part of a coarser level as
        a piece."""
        y = rect.y0 - (rect.y0 - self._frame.y0) % _SHARING
        return Rect(self._frame.x0, y, self._frame.x1, max(y + _SHARING, rect.y1)).intersect(self._frame).evened()

    def planes(self, layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        """Returns a layer's pixels of a piece, as `layer_planes`."""
        if layer.pyramid.bare is not None:
            return layer_planes(layer, level, rect)
        with self._lock:
            cascade = self._cascades.get(layer.id)
            if cascade is None:
                cascade = self._cascades[layer.id] = Cascade(layer.pyramid, self._needed, self._held, level)
        around, above = rect.evened(), self._row_of(rect)
        for _ in range(_COARSER):
            above = above.parents().evened()
        cascade.hold_part(level - _COARSER, above)
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
