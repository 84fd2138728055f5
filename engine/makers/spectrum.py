"""A spectrum that is painted: shapes to begin with, strokes of any brush, and the sample it is the transform of.

Lewis 1984, section 5.1: the artist paints two quadrants of an amplitude spectrum, symmetry gives the others.  What is
painted is the logarithm of the amplitude, as it is shown: 0 is silence, 1 the loudest.  Every stroke appears at the
opposite frequency too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from immutables import Map

from engine.brush.checks import thawed
from engine.canvas import layers
from engine.canvas.ground import laid
from engine.canvas.layers import Layer
from engine.canvas.tile_cache import TileCache
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.files.strict_json import Fields
from engine.numeric import shapes, spectra
from engine.numeric.address import Rect
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.grid import snapped
from engine.numeric.resample import resampled
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.strokes.paint_stroke import LiveStroke

SPAN = 4096.0  # the loudest amplitude to that of a value of 1 / ln SPAN: 72 dB from white to black
_LOG_SPAN = 8.317766166719343  # ln SPAN
SIDES = (8, 1024)  # least and most pixels along a side
SHAPES_CAP, STROKES_CAP = 64, 4096
_FURTHEST = 1 << 24  # pixels from the corner at which a stroke's points may begin
WINDOWS = 8  # along a side of a picture
PHASES = ("random", "zero", "painted", "own")
PICTURED = ("image", "canvas", "texture")  # shapes that are the spectrum of a file, of the canvas, of another texture
SHEETS = ("amplitude", "phase")  # what a stroke paints on, by the name of its layer
_PARTS = {**{name: name for name in spectra.PARTS}, "imag": "imaginary"}  # as the command line has it
_GROUND = {"amplitude": 0.0, "phase": 0.5}  # what the eraser goes back to


@dataclass(frozen=True, slots=True)
class Design:
    """All that a painted spectrum is made of, as the recording holds it.

    `size`: width, height; `shapes`: JSON-ready members of each, whose `shape` is a row of `shapes.SHAPES` or one of
    PICTURED; `strokes`: on layer "amplitude" (also where none is named) or "phase"; `phase`: one of PHASES,
    "own" being those of the last of PICTURED, painted over; `seed`: of random phases; `part`: a row of `spectra.PARTS`;
    `forward`: the painting is a pattern, not symmetric, and the texture its spectrum; `arithmetic`: in which it is
    worked out, which is the painting's to say.
    """

    size: tuple[int, int] = (256, 256)
    shapes: tuple[Map[str, Any], ...] = ()
    strokes: tuple[c.Stroke, ...] = ()
    phase: str = "random"
    seed: int = 0
    part: str = "real"
    forward: bool = False
    arithmetic: int = LIBRARY

    def to_arguments(self) -> Map[str, Any]:
        """Returns the members of a texture command that `read` gives back; defaults are left out."""
        plain = Design(phase=usual_phase(self.forward))
        out: dict[str, Any] = {"size": self.size}
        if self.shapes:
            out["shapes"] = self.shapes
        if self.strokes:
            out["strokes"] = tuple(_frozen(c.to_json(stroke)) for stroke in self.strokes)
        for name in ("phase", "seed", "part", "forward"):
            if getattr(self, name) != getattr(plain, name):
                out[name] = getattr(self, name)
        return Map(out)


def read(arguments: Any) -> Design:
    """Returns the design that a texture command describes; members of others are ignored.  FieldError names what is
    wrong."""
    members = Fields(thawed(arguments), "")
    size = members.integers("size", 2, Design().size, limit=SIDES[1])
    if min(size) < SIDES[0]:
        raise members.fault("size", f"[width, height], each from {SIDES[0]} to {SIDES[1]}")
    forward = members.flag("forward", False)
    return Design(
        size,
        tuple(_frozen(_shape(shape, f"shapes[{i}]")) for i, shape in enumerate(_list(members, "shapes", SHAPES_CAP))),
        tuple(_stroke(stroke, f"strokes[{i}]") for i, stroke in enumerate(_list(members, "strokes", STROKES_CAP))),
        _one_of(members, "phase", PHASES, usual_phase(forward)),
        members.integer("seed", 0, lo=-c.SEED_LIMIT, hi=c.SEED_LIMIT),
        _PARTS[_one_of(members, "part", tuple(_PARTS), "real")],
        forward,
    )


def usual_phase(forward: bool) -> str:
    """Tells where nothing is said: a pattern is transformed as it is."""
    return "zero" if forward else "random"


def _list(members: Fields, name: str, cap: int) -> list[Any]:
    value = members.take(name, [])
    if not isinstance(value, list) or len(value) > cap:
        raise members.fault(name, f"a list of at most {cap}")
    return value


def _one_of(members: Fields, name: str, rows: tuple[str, ...], usual: str) -> str:
    value = members.take(name, usual)
    if value not in rows:
        raise members.fault(name, f"one of {', '.join(rows)}")
    out: str = value
    return out


def _shape(value: Any, where: str) -> dict[str, Any]:
    members = Fields(value, where)
    shape: dict[str, Any] = value
    name = members.take("shape", expected="a shape's name")
    if name in PICTURED:
        members.number("strength", 1.0, lo=0.0, hi=1.0)
        return shape
    if name not in shapes.SHAPES:
        raise members.fault("shape", f"one of {', '.join((*shapes.SHAPES, *PICTURED))}")
    for quantity in shapes.SHAPES[name].parameters:
        members.number(quantity.name, quantity.default, lo=quantity.lo, hi=quantity.hi)
    return shape


def _stroke(value: Any, where: str) -> c.Stroke:
    command = c.parse({"do": "stroke", **value} if isinstance(value, dict) else value, where)
    if not isinstance(command, c.Stroke):
        raise FieldError(where, "another command", "a stroke")
    if command.level != 0:
        raise FieldError(f"{where}.level", str(command.level), "0")
    if max(map(abs, command.origin)) > _FURTHEST:
        raise FieldError(f"{where}.origin", described(list(command.origin)), f"two integers within {_FURTHEST}")
    if command.layer not in (None, *SHEETS):
        raise FieldError(f"{where}.layer", repr(command.layer), f"one of {', '.join(SHEETS)}")
    if command.copies:
        raise FieldError(f"{where}.copies", f"{len(command.copies)} copies", "none: a spectrum has its own symmetry")
    return command


def _frozen(value: Any) -> Any:
    """Returns a JSON value as one that hashes: objects as Map, lists as tuples."""
    if isinstance(value, dict):
        return Map({name: _frozen(member) for name, member in value.items()})
    return tuple(map(_frozen, value)) if isinstance(value, list | tuple) else value


# What is painted ------------------------------------------------------------------------------------------------------


class Sheets(NamedTuple):
    """A painted spectrum: float32 (1 or 3, h, w), 0..1 on the grid, read-only; zero frequency at [h // 2, w // 2].

    `amplitude`: logarithmic, one plane, or red, green and blue; F(-u) = F(u), but for a pattern.  `phase`: one plane,
    0..1 for -pi..pi, 1/2 where nothing was painted; F(-u) = 1 - F(u).
    """

    amplitude: np.ndarray
    phase: np.ndarray

    @property
    def size(self) -> tuple[int, int]:
        """Gives (width, height) in pixels."""
        return self.phase.shape[2], self.phase.shape[1]


def loudness(amplitude: np.ndarray, arithmetic: int = LIBRARY) -> np.ndarray:
    """Amplitudes, 0..1, as they are painted and shown: logarithmic, 0..1, on the grid."""
    heard = array_functions(arithmetic).log1p(amplitude * np.float32(SPAN - 1))
    return snapped(heard * np.float32(1 / _LOG_SPAN))


def amplitude(loudness: np.ndarray, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the inverse of `loudness`, up to the grid."""
    return array_functions(arithmetic).expm1(loudness * np.float32(_LOG_SPAN)) * np.float32(1 / (SPAN - 1))


Look = Callable[[Map[str, Any]], np.ndarray]  # the picture that a shape names: premultiplied RGBA, float32 (4, h, w)


def begun(design: Design, look: Look | None = None) -> Sheets:
    """Returns the shapes, before any stroke; the loudest of them counts.  `look` is needed for those of PICTURED."""
    width, height = design.size
    together = np.zeros((1, height, width), np.float32)
    phase = np.full((1, height, width), _GROUND["phase"], np.float32)
    for shape in design.shapes:
        if shape["shape"] in PICTURED:
            if look is None:
                raise FieldError("shapes", repr(shape["shape"]), f"one of {', '.join(shapes.SHAPES)}")
            picture = look(shape)
            one = of_picture(picture, (height, width), design.arithmetic) * np.float32(shape.get("strength", 1.0))
            phase = phase_of_picture(picture, (height, width), design.arithmetic) if design.phase == "own" else phase
        else:
            one = shapes.drawn(shape["shape"], (height, width), shape, design.arithmetic)[None]
        together = np.maximum(together, one)
    return _sheets(loudness(together, design.arithmetic), phase)


def of_picture(rgba: np.ndarray, size: tuple[int, int], arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the amplitude spectrum of a picture, float32 (1 or 3, h, w), 0..1: its windows of `size` (h, w), half
    over one another, averaged as powers (the modified periodogram of Lewis 1984, section 5.3).

    A picture smaller than that is enlarged to it.
    """
    rgb, (height, width) = _planes(rgba, size, arithmetic), size
    power = np.zeros((len(rgb), height, width), np.float32)
    for y in _starts(rgb.shape[1], height):
        for x in _starts(rgb.shape[2], width):
            piece = rgb[:, y : y + height, x : x + width]
            power += np.square(spectra.image_spectrum(piece, arithmetic=arithmetic))
    found = spectra.symmetric(np.sqrt(power))
    found[:, height // 2, width // 2] = 0.0
    return found / np.float32(max(float(found.max()), 1e-20))


def phase_of_picture(rgba: np.ndarray, size: tuple[int, int], arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the phases of the window of `size` (h, w) in the middle of a picture, as a sheet: float32 (1, h, w),
    0..1.

    With them, the sample looks like the picture; the field of its copies is that of a sampled impulse response
    (section 5.3), whose window it brings along.
    """
    rgb, (height, width) = _planes(rgba, size, arithmetic), size
    top, left = (rgb.shape[1] - height) // 2, (rgb.shape[2] - width) // 2
    seen = rgb[:, top : top + height, left : left + width].sum(axis=0)
    found = spectra.forward(seen - array_functions(arithmetic).mean(seen), arithmetic)
    turn = array_functions(arithmetic).angle(found)[None] * np.float32(0.5 / np.pi)
    # Odd but for rounding, and for pi where a frequency is its own opposite: there it becomes 0.
    return snapped(np.float32(0.5) * (turn - spectra.opposite(turn))) + np.float32(_GROUND["phase"])


def _planes(rgba: np.ndarray, size: tuple[int, int], arithmetic: int) -> np.ndarray:
    """Red, green and blue of a picture, or one plane if they are equal, enlarged to `size` (h, w) where it is smaller:
    float32 (1 or 3, h, w); what is transparent takes the mean colour."""
    rows, columns = max(size[0], rgba.shape[1]), max(size[1], rgba.shape[2])
    if (rows, columns) != rgba.shape[1:]:
        rgba = resampled(rgba, (rows, columns), np.arange(rows), np.arange(columns))
    mean = array_functions(arithmetic).mean
    covered = max(float(mean(rgba[3])), 1e-6)
    rgb = rgba[:3] + (1.0 - rgba[3:]) * (mean(rgba[:3], axis=(1, 2), keepdims=True) / np.float32(covered))
    out: np.ndarray = rgb[:1] if np.array_equal(rgb[0], rgb[1]) and np.array_equal(rgb[0], rgb[2]) else rgb
    return out


def _starts(length: int, window: int) -> list[int]:
    """Tells where windows begin: half over one another, at most WINDOWS, the first and the last at the ends."""
    count = min(WINDOWS, -(-2 * (length - window) // window) + 1)
    return [round(i * (length - window) / max(count - 1, 1)) for i in range(count)]


def _sheets(amplitude: np.ndarray, phase: np.ndarray) -> Sheets:
    amplitude.flags.writeable = phase.flags.writeable = False
    return Sheets(amplitude, phase)


def touch(
    sheets: Sheets,
    brush: Any,
    sheet: str = "amplitude",
    cache: TileCache | None = None,
    arithmetic: int = LIBRARY,
) -> LiveStroke:
    """Returns a stroke that begins on one of SHEETS; points in pixels from the corner.  BrushError as `LiveStroke`."""
    planes = getattr(sheets, sheet)
    width, height = sheets.size
    rect = Rect(0, 0, width, height)
    opaque = np.ones((4, height, width), np.float32)
    opaque[:3] = planes
    layer = Layer(1, sheet, pyramid=laid(lambda part: opaque[:, *part.slices(rect)], rect))
    painting = Painting(root=replace(layers.EMPTY, children=(layer,)), active=sheet, arithmetic=arithmetic)
    return LiveStroke(painting, 0, (0, 0), brush, cache, sheet)


def stroked(sheets: Sheets, live: LiveStroke, mirrored: bool = True) -> Sheets:
    """Returns the sheets with a stroke as it is now, which `touch` began on them, and its mirror image if it is to
    have one."""
    sheet = live.layer.name
    width, height = sheets.size
    before = getattr(sheets, sheet)
    rgba = live.preview(Rect(0, 0, width, height)).rgba
    after = rgba[:3] + (1.0 - rgba[3:]) * np.float32(_GROUND[sheet])
    np.clip(after, 0.0, 1.0, out=after)
    if sheet == "phase":
        after = after.mean(axis=0, keepdims=True)
    elif np.array_equal(after[0], after[1]) and np.array_equal(after[0], after[2]):
        after = after[:1]
    if len(before) < len(after):
        before = np.broadcast_to(before, after.shape)
    after = _mirrored(before, snapped(after), sheet == "phase") if mirrored or sheet == "phase" else snapped(after)
    return _sheets(sheets.amplitude, after) if sheet == "phase" else _sheets(after, sheets.phase)


def _mirrored(before: np.ndarray, after: np.ndarray, odd: bool) -> np.ndarray:
    """Returns what changed is seen at the opposite frequency too; where both changed, what changed more, or the
    mean."""
    there = spectra.opposite(after)
    if odd:
        there = 1.0 - there
    change = np.abs(after - before).max(axis=0)
    opposite = spectra.opposite(change)
    out = np.where(change > opposite, after, there)
    return np.where(change == opposite, snapped(np.float32(0.5) * (after + there)), out)


def drawn(design: Design, look: Look | None = None) -> Sheets:
    """Returns the spectrum with all its shapes and strokes.  BrushError if a brush cannot paint it."""
    sheets = begun(design, look)
    for stroke in design.strokes:
        sheets = with_stroke(sheets, stroke, not design.forward, design.arithmetic)
    return sheets


def with_stroke(sheets: Sheets, stroke: c.Stroke, mirrored: bool = True, arithmetic: int = LIBRARY) -> Sheets:
    """Returns one more stroke, whole."""
    live = touch(sheets, stroke.brush, stroke.layer or SHEETS[0], arithmetic=arithmetic)
    live.lay(stroke.points + np.array([*stroke.origin, 0, 0, 0, 0, 0])[: stroke.points.shape[1]])
    return stroked(sheets, live, mirrored)


def sample(sheets: Sheets, design: Design) -> np.ndarray:
    """Returns the texture: float32 (1 or 3, h, w), mean 0, standard deviation `spectra.SPREAD`; it tiles."""
    phase: np.ndarray | int | None = None
    if design.phase == "random":
        phase = design.seed
    elif design.phase in ("painted", "own"):
        phase = (sheets.phase[0] - np.float32(0.5)) * np.float32(2 * np.pi)
    painted = sheets.amplitude if design.forward else amplitude(sheets.amplitude, design.arithmetic)
    return spectra.texture_of(painted, phase, design.part, design.forward, design.arithmetic)


def spectrum_picture(texture: np.ndarray) -> np.ndarray:
    """Returns a sample as the picture that brushes and files hold: float32 (4, h, w) on the grid, (S + 1) / 2 over
    alpha 1."""
    out = np.ones((4, *texture.shape[1:]), np.float32)
    out[:3] = np.clip(np.float32(0.5) + np.float32(0.5) * texture, 0.0, 1.0)
    return snapped(out)
