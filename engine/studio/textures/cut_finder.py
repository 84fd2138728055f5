"""What lies on the ground of a picture, found on a thread of its own, so that no stroke waits for it: at once what
belongs, then its rim, piece by piece."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.studio import results
from engine.studio.requests import Handlers
from engine.studio.textures.cut_records import CutFound, FindCut
from engine.studio.textures.region_strokes import CHECKER, DIM, TINT, over_paper

if TYPE_CHECKING:
    from engine.texture.mattes.finding import Cut, Outline, Sought
    from engine.texture.mattes.fine_rim import Piece
    from engine.texture.mattes.marks import Mark

_Send = Callable[[results.Result], None]


class CutFinder(Owned):
    """It belongs to the engine's thread.  The newest request counts: one thread at a time works, and looks after each
    piece whether its request is still the newest."""

    def __init__(self, send: _Send) -> None:
        self._send = send
        self._gone = threading.Event()  # set: what was asked for last is not wanted any more
        self._turn = threading.Lock()
        self._held: list[_Found] = []  # one, or none; whoever has the turn may touch it
        self.handlers: Handlers = {FindCut: self._ask}

    def _ask(self, request: FindCut) -> None:
        self._gone.set()
        gone = self._gone = threading.Event()
        held, send, turn = self._held, self._send, self._turn

        def work() -> None:
            with turn:
                if gone.is_set():
                    return
                if not held or held[0].pixels is not request.pixels:
                    held[:] = [_Found(request.pixels)] if request.pixels.size else []
                if held:
                    held[0].follow(request, gone.is_set, send)

        threading.Thread(target=work, name="inkfall cut", daemon=True).start()


class _Found:
    """What is found in one picture so far."""

    def __init__(self, pixels: np.ndarray) -> None:
        self.pixels = pixels
        self._flat = over_paper(_planes(pixels))
        self._marks: tuple[Mark, ...] | None = None
        self._looked: Sought | None = None
        self._cut: Cut | None = None
        self._outline: Outline | None = None
        self._rim: Iterator[tuple[float, Piece | None]] = iter(())

    def follow(self, request: FindCut, gone: Callable[[], bool], send: _Send) -> None:
        """Finds what a request asks for, as far as that is not found, and tells of it until it is gone."""
        from engine.texture.mattes.finding import Cut, outlined, sought  # here: it takes its time to load

        if self._looked is None:
            self._looked = sought(self.pixels)
        if gone():
            return
        if request.marks != self._marks:
            self._outline = outlined(self._looked, request.marks)
            self._cut = Cut(self._looked, self._outline)
            self._rim, self._marks = self._cut.steps(), request.marks
        assert self._cut is not None
        self._show(request, self._cut.whole, send)
        send(self._told(request, 0.0))
        for done, piece in self._rim:
            if piece is not None:
                self._show(request, piece.rect, send)
                send(self._told(request, min(done, 0.99)))
            if gone():
                return
        send(self._told(request, 1.0))

    def _told(self, request: FindCut, done: float) -> CutFound:
        from engine.texture.mattes.things import things

        assert self._cut is not None
        assert self._outline is not None
        told = request.ident, len(request.marks), done, self._outline.whole
        if done < 1.0:
            return CutFound(*told)
        return CutFound(*told, len(things(self._cut.pixels)), results.frozen(self._cut.pixels.copy()))

    def _show(self, request: FindCut, rect: Rect, send: _Send) -> None:
        assert self._cut is not None
        whole = self._cut.whole
        part = rect.slices(whole)
        shown = _bare(self._cut.pixels[part], rect) if request.bare else self._veiled(part)
        size = whole.width, whole.height
        send(results.PicturePart(f"cut {request.ident}", size, rect, results.frozen(shown)))

    def _veiled(self, part: tuple[slice, slice]) -> np.ndarray:
        """Returns a part of the picture, uint8 (h, w, 3), with the ground dimmed as much as it is ground."""
        assert self._cut is not None
        alpha = self._cut.pixels[part][..., 3:].astype(np.float32) / np.float32(255)
        seen = self._flat[part].astype(np.float32)
        light = DIM + (1 - DIM) * alpha
        found: np.ndarray = (TINT + light * (seen - TINT) + np.float32(0.5)).astype(np.uint8)
        return found


def _bare(pixels: np.ndarray, rect: Rect) -> np.ndarray:
    """Returns a part of what is cut out over the checker that lies under all of it."""
    by = 2 * CHECKER
    left, top = rect.x0 % by, rect.y0 % by
    moved = np.pad(pixels, ((top, 0), (left, 0), (0, 0)))
    return np.ascontiguousarray(over_paper(_planes(moved))[top:, left:])


def _planes(pixels: np.ndarray) -> np.ndarray:
    """Returns pixels, uint8 RGBA (h, w, 4), as planes: premultiplied, float32 (4, h, w) in 0..1."""
    planes = np.moveaxis(pixels, -1, 0).astype(np.float32) / np.float32(255)
    planes[:3] *= planes[3]
    return planes
