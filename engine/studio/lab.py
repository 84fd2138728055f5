"""The texture lab: a spectrum under the artist's brush, and the texture it makes while it is painted.

Strokes and settings only mark the pictures as old; they are made once when nothing else waits, so whatever is newest is
seen first.  What the lab hands to the painting is a texture command, from which anyone makes the same sample.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from immutables import Map

from engine.brush.parts import Component
from engine.canvas.evaluate import TileCache
from engine.canvas.layers import Group
from engine.checks.owned import Owned
from engine.makers import spectrum
from engine.makers.makers import FIELDS
from engine.makers.spectrum import Design, Sheets
from engine.numeric import shapes
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.capture import Place
from engine.painting.points import rounded
from engine.painting.textures import Texture
from engine.strokes.paint_stroke import LiveStroke
from engine.studio import requests as q
from engine.studio import results, swatches
from engine.studio.easel import Easel
from engine.texture.image import ImageSource

FIELD = Rect(0, 0, 360, 360)  # the part of an endless field that is shown
NEARER = 4  # levels that the picture "lab near" is zoomed in
_TRIED = "lab"  # the texture's name in the pictures of strokes
_CACHE = 1 << 24
_DARK, _COLD, _WARM = (np.array(rgb, np.float32) / 255 for rgb in ((18, 18, 21), (90, 150, 235), (245, 165, 75)))


@dataclass(frozen=True, eq=False, slots=True)
class _Start:
    """What sheets depend on besides strokes; `own`: whether phases are a picture's; `root`: the layers, where a shape
    looks at them."""

    size: tuple[int, int]
    shapes: tuple[Map[str, Any], ...]
    forward: bool
    own: bool
    root: Group | None

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Start) or self.root is not other.root:
            return False
        mine, theirs = ((s.size, s.shapes, s.forward, s.own) for s in (self, other))
        return mine == theirs


@dataclass(eq=False, slots=True)
class _State:
    """A state of the lab that undo comes back to: its strokes, and the sheets that they made of some start."""

    strokes: tuple[c.Stroke, ...] = ()
    sheets: Sheets | None = None
    start: _Start | None = None


class Lab(Owned):
    """The lab.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._set = q.LabSet()
        self._past: list[_State] = []
        self._now = _State()
        self._future: list[_State] = []
        self._live: LiveStroke | None = None
        self._building: tuple[_Start, Sheets, int] | None = None  # start, sheets, strokes laid
        self._texture: np.ndarray | None = None
        self._stale = False  # the pictures are not of what is painted
        self._used: tuple[str, c.DefineTexture | None] = ("", None)
        self._version = 0
        self.handlers: dict[type, Callable[[Any], None]] = {
            q.LabSet: self._change,
            q.LabBegin: self._begin,
            q.LabPoints: self._extend,
            q.LabEnd: self._end,
            q.LabStep: self._travel,
            q.LabRest: self._rest,
            q.LabUse: self._use,
        }

    @property
    def pending(self) -> bool:
        return self._stale

    def step(self) -> None:
        """The next piece of work: a stroke laid anew, or the pictures."""
        try:
            if self._live is None and not self._ready():
                self._build()
            else:
                self._show()
        except Exception:
            self._stale = False  # it would fail again
            raise

    def settle(self) -> None:
        """Brings the texture in use up to date before it is painted with."""
        name, defined = self._used
        if name and self._live is None and name in self._easel.session.painting.textures:
            self._finish_building()
            if self._stale:
                self._show()
            command = self._command(name)
            if command != defined:
                self._define(command)

    # --- requests ----------------------------------------------------------------------------------------------------

    def _change(self, request: q.LabSet) -> None:
        shapes = tuple(map(self._resolved, request.shapes))
        before, self._set = self._set, replace(request, shapes=shapes)
        if before.size != request.size:
            self._live = None
            scale = request.size[0] / before.size[0], request.size[1] / before.size[1]
            self._past, self._future = [], []
            self._now = _State(tuple(_scaled(stroke, *scale) for stroke in self._now.strokes))
        self._stale = True

    def _begin(self, request: q.LabBegin) -> None:
        self._finish_building()
        assert self._now.sheets is not None
        self._live = spectrum.touch(self._now.sheets, request.brush, self._set.sheet, TileCache(_CACHE))

    def _extend(self, request: q.LabPoints) -> None:
        if self._live is not None and not self._live.add(rounded(request.points)).empty:
            self._stale = True

    def _end(self, request: q.LabEnd) -> None:
        live, self._live = self._live, None
        if live is None or live.empty:
            return
        self._stale = True
        if request.kept:
            assert self._now.sheets is not None
            after = spectrum.stroked(self._now.sheets, live, not self._set.forward)
            self._past.append(self._now)
            self._now = _State((*self._now.strokes, live.to_command()), after, self._now.start)
            self._future = []

    def _travel(self, request: q.LabStep) -> None:
        self._live = self._building = None
        if request.count == 0 and self._now.strokes:
            self._past.append(self._now)
            self._now, self._future = _State(), []
        for _ in range(min(-request.count, len(self._past))):
            self._future.append(self._now)
            self._now = self._past.pop()
        for _ in range(min(request.count, len(self._future))):
            self._past.append(self._now)
            self._now = self._future.pop()
        self._stale = True

    def _rest(self, request: q.LabRest) -> None:
        """Pictures of strokes, once nothing moves; the texture in use follows."""
        self._finish_building()
        if self._stale:
            self._show()
        self.settle()
        painting = self._easel.session.painting
        painting = replace(painting, textures=painting.textures.set(_TRIED, self._tried()))
        brush = replace(request.brush, ink=(Component(_TRIED, 1.0, "#f4f1ea"),), mode="paint")
        for ident, kind, zoom in (("lab stroke", "stroke", 0), ("lab near", "fill", NEARER)):
            pixels = swatches.painted(q.Swatch(ident, brush, request.size, kind, zoom), painting)
            self._easel.send(results.Picture(ident, results.frozen(to_premul8(pixels))))

    def _use(self, request: q.LabUse) -> None:
        self._used = request.name, None
        if request.name:
            self._finish_building()
            self._show()
            self._define(self._command(request.name))
        self._tell()

    def _resolved(self, shape: Map[str, Any]) -> Map[str, Any]:
        """A shape that names a texture knows its picture by the sha: whatever the name means later."""
        texture = self._easel.session.painting.textures.get(shape.get("texture", ""))
        if shape["shape"] != "texture" or texture is None or texture.source is None:
            return shape
        return shape.set("sha", texture.source.sha)

    # --- the spectrum ------------------------------------------------------------------------------------------------

    def _design(self) -> Design:
        s = self._set
        return Design(s.size, s.shapes, self._now.strokes, s.phase, s.seed, s.part, s.forward)

    def _start(self) -> _Start:
        s = self._set
        seen = any(shape["shape"] == "canvas" for shape in s.shapes)
        root = self._easel.session.painting.root if seen else None
        return _Start(s.size, s.shapes, s.forward, s.phase == "own", root)

    def _ready(self) -> bool:
        return self._now.sheets is not None and self._now.start == self._start()

    def _build(self) -> None:
        """One more stroke on the sheets of the present start."""
        start, strokes = self._start(), self._now.strokes
        if self._building is None or self._building[0] != start:
            self._building = start, spectrum.begun(self._design(), self._look), 0
        _, sheets, laid = self._building
        if laid < len(strokes):
            sheets, laid = spectrum.with_stroke(sheets, strokes[laid], not start.forward), laid + 1
        self._building = start, sheets, laid
        if laid >= len(strokes):
            self._now.sheets, self._now.start, self._building = sheets, start, None

    def _finish_building(self) -> None:
        while not self._ready():
            self._stale = True
            self._build()

    def _look(self, shape: Map[str, Any]) -> np.ndarray:
        session = self._easel.session
        return Place(session.folder, session.painting.root, session.around().pictures).shape(shape)

    def _show(self) -> None:
        """The spectrum and its texture as they are now."""
        sheets = self._now.sheets
        assert sheets is not None
        if self._live is not None and not self._live.empty:
            sheets = spectrum.stroked(sheets, self._live, not self._set.forward)
        self._texture = spectrum.sample(sheets, self._design())
        self._stale = False
        self._easel.send(results.Picture("lab spectrum", _shown(sheets, self._set.sheet)))
        shown = self._texture
        if self._set.field.get("field") == "sparse":
            shown = self._tried().instance({}, 0, 0).appearance(0, FIELD)
        self._easel.send(results.Picture("lab texture", _pixels(0.5 + 0.5 * shown)))
        self._tell()

    def _tell(self) -> None:
        silent = self._texture is None or not self._texture.any()
        rows = tuple(shapes.SHAPES.values())
        strokes, past, future = len(self._now.strokes), bool(self._past), bool(self._future)
        self._easel.send(results.LabScene(rows, strokes, past, future, silent, self._used[0], self._version))

    # --- the texture -------------------------------------------------------------------------------------------------

    def _command(self, name: str) -> c.DefineTexture:
        arguments = self._design().to_arguments()
        return c.DefineTexture(name, "spectrum", arguments.update(self._set.field))

    def _tried(self) -> Texture:
        """The texture as the command would make it, without making it again."""
        command = self._command(_TRIED)
        return Texture(FIELDS[command.arguments.get("field", "tile")], command.arguments, self._source(_TRIED))

    def _source(self, name: str) -> ImageSource:
        assert self._texture is not None
        return ImageSource.of(name, spectrum.picture(self._texture))

    def _define(self, command: c.DefineTexture) -> None:
        """The painting has the texture; its sample is here already, and need not be made of the strokes again."""
        self._used = command.name, command
        self._version += 1
        source = self._source(command.name)
        self._easel.carry_out(replace(command, arguments=command.arguments.set("sha", source.sha)), source)
        self._tell()


def _scaled(stroke: c.Stroke, x: float, y: float) -> c.Stroke:
    """A stroke of a spectrum of another size."""
    points = stroke.points.copy()
    points[:, :2] *= x, y
    points.flags.writeable = False
    return replace(stroke, points=points, brush=replace(stroke.brush, radius=stroke.brush.radius * (x + y) / 2))


def _shown(sheets: Sheets, sheet: str) -> np.ndarray:
    """A sheet as the panel shows it: amplitudes from dark to light, phases from cold over dark to warm."""
    if sheet == "amplitude":
        return _pixels(_DARK[:, None, None] + sheets.amplitude * (1.0 - _DARK[:, None, None]))
    turn = 2.0 * sheets.phase - 1.0
    ends = np.where(turn < 0.0, _COLD[:, None, None], _WARM[:, None, None])
    return _pixels(_DARK[:, None, None] + np.abs(turn) * (ends - _DARK[:, None, None]))


def _pixels(planes: np.ndarray) -> np.ndarray:
    """Opaque uint8 (h, w, 4) of planes (1 or 3, h, w), 0..1."""
    out = np.full((*planes.shape[1:], 4), 255, np.uint8)
    scaled = np.clip(planes, 0.0, 1.0) * np.float32(255) + np.float32(0.5)
    out[..., :3] = scaled.astype(np.uint8).transpose(1, 2, 0)
    return results.frozen(out)
