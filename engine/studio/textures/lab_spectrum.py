"""The spectrum that is painted in the texture lab: its strokes, what undo comes back to, and the sheets they make.

Sheets are built stroke by stroke, in small pieces of work, from what their start depends on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from immutables import Map

from engine.canvas.layers import Group
from engine.canvas.tile_cache import TileCache
from engine.checks.owned import Owned
from engine.makers import spectrum
from engine.makers.spectrum import Design, Sheets
from engine.painting import commands as c
from engine.painting.capture import PictureSource
from engine.painting.points import rounded
from engine.strokes.paint_stroke import LiveStroke
from engine.studio.easel import Easel
from engine.studio.textures import texture_requests as tq

_CACHE = 1 << 24  # bytes of evaluated tiles, for strokes on a sheet


@dataclass(frozen=True, eq=False, slots=True)
class _Start:
    """What sheets depend on besides strokes; `own`: whether phases are a picture's; `root`: the layers, where a shape
    looks at them; `arithmetic`: the painting's, in which its command makes them."""

    size: tuple[int, int]
    shapes: tuple[Map[str, Any], ...]
    forward: bool
    own: bool
    root: Group | None
    arithmetic: int

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Start) or self.root is not other.root:
            return False
        mine, theirs = ((s.size, s.shapes, s.forward, s.own, s.arithmetic) for s in (self, other))
        return mine == theirs


@dataclass(eq=False, slots=True)
class _State:
    """A state of the lab that undo comes back to: its strokes, and the sheets that they made of some start."""

    strokes: tuple[c.Stroke, ...] = ()
    sheets: Sheets | None = None
    start: _Start | None = None


class LabSpectrum(Owned):
    """A spectrum that is painted.  It belongs to the engine's thread.

    `asked`: the newest settings; `live`: the stroke in progress; `stale`: whether the pictures shown are of something
    older than what is painted.
    """

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self.asked = tq.LabSet()
        self.live: LiveStroke | None = None
        self.stale = False
        self._past: list[_State] = []
        self._now = _State()
        self._future: list[_State] = []
        self._building: tuple[_Start, Sheets, int] | None = None  # start, sheets, strokes laid
        self.handlers: dict[type, Callable[[Any], None]] = {
            tq.LabSet: self._change,
            tq.LabBegin: self._begin,
            tq.LabPoints: self._extend,
            tq.LabEnd: self._end,
            tq.LabStep: self._travel,
        }

    @property
    def steps(self) -> tuple[int, bool, bool]:
        """Tells how many strokes there are, and whether there are any to take back and to do again."""
        return len(self._now.strokes), bool(self._past), bool(self._future)

    @property
    def sheets(self) -> Sheets:
        """Returns the sheets as they are now, with the stroke in progress; they must be ready."""
        sheets = self._now.sheets
        assert sheets is not None
        if self.live is not None and not self.live.empty:
            sheets = spectrum.stroked(sheets, self.live, not self.asked.forward)
        return sheets

    def _change(self, request: tq.LabSet) -> None:
        shapes = tuple(map(self._resolved, request.shapes))
        before, self.asked = self.asked, replace(request, shapes=shapes)
        if before.size != request.size:
            self.live = None
            scale = request.size[0] / before.size[0], request.size[1] / before.size[1]
            self._past, self._future = [], []
            self._now = _State(tuple(_scaled(stroke, *scale) for stroke in self._now.strokes))
        self.stale = True

    def _begin(self, request: tq.LabBegin) -> None:
        self.finish_building()
        assert self._now.sheets is not None
        own, sheet = self._start().arithmetic, self.asked.sheet
        self.live = spectrum.touch(self._now.sheets, request.brush, sheet, TileCache(_CACHE), own)

    def _extend(self, request: tq.LabPoints) -> None:
        if self.live is not None and not self.live.add(rounded(request.points)).empty:
            self.stale = True

    def _end(self, request: tq.LabEnd) -> None:
        live, self.live = self.live, None
        if live is None or live.empty:
            return
        self.stale = True
        if request.kept:
            assert self._now.sheets is not None
            after = spectrum.stroked(self._now.sheets, live, not self.asked.forward)
            self._past.append(self._now)
            self._now = _State((*self._now.strokes, live.to_command()), after, self._now.start)
            self._future = []

    def _travel(self, request: tq.LabStep) -> None:
        self.live = self._building = None
        if request.count == 0 and self._now.strokes:
            self._past.append(self._now)
            self._now, self._future = _State(), []
        for _ in range(min(-request.count, len(self._past))):
            self._future.append(self._now)
            self._now = self._past.pop()
        for _ in range(min(request.count, len(self._future))):
            self._past.append(self._now)
            self._now = self._future.pop()
        self.stale = True

    def _resolved(self, shape: Map[str, Any]) -> Map[str, Any]:
        """Returns a shape that names a texture knows its picture by the sha: whatever the name means later."""
        texture = self._easel.session.painting.textures.get(shape.get("texture", ""))
        if shape["shape"] != "texture" or texture is None or texture.source is None:
            return shape
        return shape.set("sha", texture.source.sha)

    @property
    def design(self) -> Design:
        """Returns what a texture command tells of it."""
        s = self.asked
        own = self._easel.session.painting.arithmetic
        return Design(s.size, s.shapes, self._now.strokes, s.phase, s.seed, s.part, s.forward, own)

    def _start(self) -> _Start:
        s = self.asked
        seen = any(shape["shape"] == "canvas" for shape in s.shapes)
        painting = self._easel.session.painting
        root = painting.root if seen else None
        return _Start(s.size, s.shapes, s.forward, s.phase == "own", root, painting.arithmetic)

    @property
    def ready(self) -> bool:
        """Tells whether the sheets are those of the strokes and of the newest settings."""
        return self._now.sheets is not None and self._now.start == self._start()

    def build(self) -> None:
        """Lays one more stroke on the sheets of the present start."""
        start, strokes = self._start(), self._now.strokes
        if self._building is None or self._building[0] != start:
            self._building = start, spectrum.begun(self.design, self._look), 0
        _, sheets, laid = self._building
        if laid < len(strokes):
            sheets, laid = spectrum.with_stroke(sheets, strokes[laid], not start.forward, start.arithmetic), laid + 1
        self._building = start, sheets, laid
        if laid >= len(strokes):
            self._now.sheets, self._now.start, self._building = sheets, start, None

    def finish_building(self) -> None:
        """Makes the sheets ready."""
        while not self.ready:
            self.stale = True
            self.build()

    def _look(self, shape: Map[str, Any]) -> np.ndarray:
        session = self._easel.session
        return PictureSource(session.folder, session.painting.root, session.around().pictures).shape(shape)


def _scaled(stroke: c.Stroke, x: float, y: float) -> c.Stroke:
    """Returns a stroke of a spectrum of another size."""
    points = stroke.points.copy()
    points[:, :2] *= x, y
    points.flags.writeable = False
    return replace(stroke, points=points, brush=replace(stroke.brush, radius=stroke.brush.radius * (x + y) / 2))
