"""The regions of examples that are painted in the examples' panel: steps taken, taken back and taken again.

A region is what its example begins with and the steps taken since, which a texture's definition tells as they are: so
what is painted here is recorded, and replayed, with the texture.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from immutables import Map

from engine.brush.checks import frozen
from engine.brush.footprint import Footprint
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.points import like_first, rounded
from engine.strokes.example_region import followed, lay, round_brush
from engine.studio import results
from engine.studio.textures import texture_requests as tq
from engine.studio.textures import texture_results as tr

KEPT = 100  # states before the present one that are held as pixels; those before them are painted anew
DIM, TINT = np.float32(0.22), np.array((28, 32, 40), np.float32)  # how much of what is outside shows over what; sRGB
CHECKER, _LIGHT, _DARK = 8, 226, 198  # the paper under a picture with holes: side of its squares, pixels; greys

Steps = tuple[Map[str, Any], ...]


@dataclass(eq=False, slots=True)
class _State:
    """The steps so far, and the region that they make, a bit a pixel; None where that is to be found."""

    steps: Steps
    bits: bytes | None = None


@dataclass(eq=False, slots=True)
class _Stroke:
    """A stroke in progress, and the points that it has had, float64 (n, 6) each."""

    op: str
    footprint: Footprint
    radius: float
    points: list[np.ndarray] = field(default_factory=list)

    def to_step(self) -> Map[str, Any]:
        """Returns the step as a definition tells it."""
        stroke = c.to_json(c.Stroke(0, (0, 0), like_first(self.points), round_brush(self.radius)))
        step: Map[str, Any] = frozen({"op": self.op, "stroke": {k: v for k, v in stroke.items() if k != "do"}})
        return step


class _Painted:
    """One region.  `first`: what it begins with; `picture`: the example, premultiplied, float32 (4, h, w)."""

    def __init__(self, request: tq.RegionOpen) -> None:
        self.picture, self.first = request.picture, request.first
        self.flat = over_paper(request.picture)
        steps = request.steps
        self.past = [_State(steps[:i]) for i in range(len(steps))]
        self.now = _State(steps)
        self.future: list[_State] = []
        self.saved = steps
        self.live: _Stroke | None = None
        self.inside = request.first
        self.whole = Rect(0, 0, request.first.shape[1], request.first.shape[0])
        self.dirty: Rect | None = self.whole  # what is not shown as it is

    def settle(self) -> None:
        """Finds the region of the present state."""
        if self.now.bits is None:
            known = next((state for state in reversed(self.past) if state.bits is not None), None)
            start = self.first if known is None else self._unpacked(known.bits)
            done = 0 if known is None else len(known.steps)
            self.now.bits = np.packbits(followed(start, self.now.steps[done:], self.picture)).tobytes()
        inside = self._unpacked(self.now.bits)
        self.touch(_around(inside != self.inside))
        self.inside = inside

    def do(self, step: Map[str, Any], instead: bool) -> None:
        """Takes a step, or takes it in place of the last one."""
        if instead and self.past:
            self.now = self.past.pop()
        self._keep()
        self.now, self.future = _State((*self.now.steps, step)), []

    def travel(self, count: int) -> None:
        """Takes back as many steps (`count` < 0), or takes them again."""
        for _ in range(min(-count, len(self.past))):
            self.future.append(self.now)
            self.now = self.past.pop()
        for _ in range(min(count, len(self.future))):
            self.past.append(self.now)
            self.now = self.future.pop()

    def begin(self, op: str, radius: float) -> None:
        """The pen touches down."""
        self.settle()
        brush = round_brush(radius)
        self.live = _Stroke(op, Footprint(brush, (0, 0), within=self.whole), radius)
        self.inside = self.inside.copy()

    def extend(self, points: np.ndarray) -> None:
        """More of the stroke in progress."""
        if self.live is not None:
            self.live.points.append(points)
            self.touch(lay(self.inside, self.live.footprint, points, self.live.op == "add"))

    def end(self, kept: bool) -> None:
        """The pen lifts."""
        live, self.live = self.live, None
        if live is not None and live.points and kept:
            self._keep()
            bits = np.packbits(self.inside).tobytes()
            self.now, self.future = _State((*self.now.steps, live.to_step()), bits), []

    def touch(self, box: Rect) -> None:
        """A part is not shown as it is."""
        if not box.empty:
            box = box.grown(1).intersect(self.whole)  # the edge lies outside
            self.dirty = box if self.dirty is None else self.dirty.union(box)

    def scene(self, ident: str) -> tr.RegionScene:
        """Returns what the panel shows of it."""
        return tr.RegionScene(
            ident,
            (self.whole.width, self.whole.height),
            self.now.steps,
            results.frozen(self.inside.copy()),
            float(self.inside.mean()),
            bool(self.past),
            bool(self.future),
            self.now.steps != self.saved,
            bool(self.picture[3].min() > 0.0),
        )

    def _keep(self) -> None:
        self.past.append(self.now)
        if len(self.past) > KEPT:
            self.past[-KEPT - 1] = replace(self.past[-KEPT - 1], bits=None)

    def _unpacked(self, bits: bytes | None) -> np.ndarray:
        assert bits is not None
        flat = np.unpackbits(np.frombuffer(bits, np.uint8), count=self.first.size)
        return flat.reshape(self.first.shape).astype(np.bool_)


class Regions(Owned):
    """The regions that were opened.  It belongs to the engine's thread."""

    def __init__(self, send: Callable[[results.Result], None]) -> None:
        self._send = send
        self._held: dict[str, _Painted] = {}
        self._ident = ""
        self._stale = False  # what was done is not seen
        self.handlers: dict[type, Callable[[Any], None]] = {
            tq.RegionOpen: self._open,
            tq.RegionBegin: self._begin,
            tq.RegionPoints: self._extend,
            tq.RegionEnd: self._end,
            tq.RegionDo: lambda r: self._change(r.ident, lambda held: held.do(r.step, r.instead)),
            tq.RegionTravel: lambda r: self._change(r.ident, lambda held: held.travel(r.count)),
            tq.RegionSaved: self._saved,
            tq.RegionClose: self._close,
        }

    @property
    def pending(self) -> bool:
        """Tells whether what was painted last is still to be seen."""
        return self._stale

    def step(self) -> None:
        """Shows the region that was changed last as it is now."""
        self._stale = False  # whatever fails would fail again
        held = self._held.get(self._ident)
        if held is not None:
            if held.live is None:
                held.settle()
            self._show(held)

    def _open(self, request: tq.RegionOpen) -> None:
        self._settle()
        self._held.setdefault(request.ident, _Painted(request))
        self._held[request.ident].dirty = self._held[request.ident].whole
        self._ident, self._stale = request.ident, True

    def _change(self, ident: str, change: Callable[[_Painted], None]) -> None:
        """The last of many changes is shown, the others are passed over."""
        if ident != self._ident:
            self._settle()
        held = self._held.get(ident)
        if held is not None:
            held.end(False)
            change(held)
            self._ident, self._stale = ident, True

    def _begin(self, request: tq.RegionBegin) -> None:
        self._change(request.ident, lambda held: held.begin(request.op, request.radius))

    def _extend(self, request: tq.RegionPoints) -> None:
        held = self._held.get(self._ident)
        if held is not None:
            held.extend(rounded(request.points))
            self._stale = True

    def _end(self, request: tq.RegionEnd) -> None:
        held = self._held.get(self._ident)
        if held is not None:
            held.end(request.kept)
            self._stale = True

    def _saved(self, request: tq.RegionSaved) -> None:
        held = self._held.pop(request.ident, None)
        if held is not None:
            held.saved, held.dirty = request.steps, held.whole
            self._held[request.name] = held
            self._ident, self._stale = request.name, True

    def _close(self, request: tq.RegionClose) -> None:
        self._held.pop(request.ident, None)

    def _settle(self) -> None:
        if self._stale:
            self.step()

    def _show(self, held: _Painted) -> None:
        box, held.dirty = held.dirty, None
        size = held.whole.width, held.whole.height
        if box is not None:
            pixels = results.frozen(region_picture(held.flat, held.inside, box))
            self._send(results.PicturePart(f"region {self._ident}", size, box, pixels))
        if held.live is None:
            self._send(held.scene(self._ident))


def _around(changed: np.ndarray) -> Rect:
    """Returns the rectangle around what is true in bool (h, w)."""
    rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    if not rows.size:
        return Rect(0, 0, 0, 0)
    return Rect(int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1)


def over_paper(picture: np.ndarray) -> np.ndarray:
    """Returns a picture, premultiplied RGBA, float32 (4, h, w), over a checker: uint8 (h, w, 3)."""
    _, height, width = picture.shape
    rows, columns = np.arange(height) // CHECKER, np.arange(width) // CHECKER
    paper = np.where((rows[:, None] + columns) % 2, np.float32(_DARK), np.float32(_LIGHT))
    flat = picture[:3] * np.float32(255) + (1 - picture[3]) * paper
    found: np.ndarray = (flat + np.float32(0.5)).clip(0, 255).astype(np.uint8).transpose(1, 2, 0)
    return np.ascontiguousarray(found)


def region_picture(flat: np.ndarray, inside: np.ndarray, box: Rect) -> np.ndarray:
    """Returns a part of a picture, uint8 (h, w, 3), with what is outside its region dimmed and the edge marked."""
    whole = Rect(0, 0, inside.shape[1], inside.shape[0])
    around = box.grown(1).intersect(whole)
    within, seen = inside[around.slices(whole)], flat[around.slices(whole)].astype(np.float32)
    out = np.where(within[..., None], seen, TINT + DIM * (seen - TINT))
    edge = _edge(within)
    out[edge] = np.float32(0.25) * out[edge] + np.float32(0.75 * 255)
    return out[box.slices(around)].round().astype(np.uint8)


def _edge(inside: np.ndarray) -> np.ndarray:
    """Returns pixels outside that touch the region."""
    grown = inside.copy()
    grown[1:] |= inside[:-1]
    grown[:-1] |= inside[1:]
    grown[:, 1:] |= inside[:, :-1]
    grown[:, :-1] |= inside[:, 1:]
    rim: np.ndarray = grown & ~inside
    return rim
