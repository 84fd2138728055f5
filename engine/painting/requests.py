"""What the window and the background worker say to one another: frozen requests, read-only results.

Light on purpose: importing it loads neither numba nor scipy, so a window can be on the screen before the engine is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from immutables import Map

from engine.numeric.address import Rect

if TYPE_CHECKING:
    from engine.brush.record import Brush
    from engine.painting.commands import Command, DefineTexture

NOTHING: Map[str, Any] = Map()
SIDE = 256  # pixels along a side of a screen tile


# Requests ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class New:
    """A new painting with a frame in level-0 pixels."""

    frame: Rect
    seed: int = 0


@dataclass(frozen=True, slots=True)
class Open:
    """A painting, a picture or a recording from a file; `live`: the recording is seen as it grows."""

    path: Path
    live: bool = False


@dataclass(frozen=True, slots=True)
class Save:
    """The painting as it is now, as .ora."""

    path: Path


@dataclass(frozen=True, slots=True)
class Export:
    """The frame at `level` (or the rectangle `area` of that level), as .png or .tif."""

    path: Path
    level: int = 0
    area: Rect | None = None


@dataclass(frozen=True, slots=True)
class Do:
    """A command, carried out in the order of posting."""

    command: Command


@dataclass(frozen=True, slots=True)
class Begin:
    """The pen touches down.  `radius` of the brush is in pixels of `level`; points come relative to `origin`."""

    level: int
    origin: tuple[int, int]
    brush: Brush


@dataclass(frozen=True, slots=True)
class Points:
    """More of the stroke: float64 (n, 6) x, y, pressure, tilt_x, tilt_y, t."""

    points: np.ndarray


@dataclass(frozen=True, slots=True)
class Finish:
    """The pen lifts: the stroke is committed."""


@dataclass(frozen=True, slots=True)
class Abandon:
    """The stroke in progress is dropped as if it had not been."""


@dataclass(frozen=True, slots=True)
class Look:
    """The screen tiles wanted, most urgent first: (level, x, y, revision already held or -1).  The newest counts."""

    tiles: tuple[tuple[int, int, int, int], ...]


@dataclass(frozen=True, slots=True)
class Swatch:
    """A small picture painted with a brush, `size` (width, height) pixels; `zoom` levels nearer than painted.
    `textures`: definitions that the brush brings along; `soon`: before those that are not."""

    ident: str
    brush: Brush
    size: tuple[int, int]
    kind: str = "stroke"
    zoom: int = 0
    textures: tuple[DefineTexture, ...] = ()
    soon: bool = False


@dataclass(frozen=True, slots=True)
class Pick:
    """The colour of a pixel."""

    level: int
    x: int
    y: int


@dataclass(frozen=True, slots=True)
class LabSet:
    """What the texture lab makes of the spectrum that is painted in it (`spectrum.Design`), and what of it is shown.

    `sheet`: "amplitude" or "phase"; `field`: the members of the texture command besides the design's own.
    """

    size: tuple[int, int] = (256, 256)
    shapes: tuple[Map[str, Any], ...] = ()
    phase: str = "random"
    seed: int = 0
    part: str = "real"
    forward: bool = False
    field: Map[str, Any] = NOTHING
    sheet: str = "amplitude"


@dataclass(frozen=True, slots=True)
class LabBegin:
    """A stroke in the lab, on its sheet: `radius` of the brush and the points in pixels of the spectrum."""

    brush: Brush


@dataclass(frozen=True, slots=True)
class LabPoints:
    """More of it, as Points."""

    points: np.ndarray


@dataclass(frozen=True, slots=True)
class LabEnd:
    """The pen lifts; `kept` unless the stroke is to be dropped."""

    kept: bool = True


@dataclass(frozen=True, slots=True)
class LabStep:
    """Takes back strokes of the lab (`count` < 0), does them again (> 0), or takes all away (0)."""

    count: int


@dataclass(frozen=True, slots=True)
class LabRest:
    """The lab has come to rest: a texture in use follows it; shows a stroke of `brush` with its texture in the ink,
    pictures `size` (width, height) large."""

    brush: Brush
    size: tuple[int, int]


@dataclass(frozen=True, slots=True)
class LabUse:
    """Defines the lab's texture under a name; from now on it follows the lab, until another name is used or none."""

    name: str


@dataclass(frozen=True, slots=True)
class Analyse:
    """Asks what the painting is made of, over a rectangle of a level.  The newest counts; None stops."""

    level: int = 0
    area: Rect | None = None


@dataclass(frozen=True, slots=True)
class MatchSet:
    """What the matching panel is to show: the members of a texture command of `maker`, "match" or "mix"; None where
    there is no example yet.  The newest counts."""

    maker: str = "match"
    arguments: Map[str, Any] | None = None


@dataclass(frozen=True, slots=True)
class MatchUse:
    """Defines the texture of such a command under a name, as soon as it is made."""

    name: str
    maker: str
    arguments: Map[str, Any]


LabRequest = LabSet | LabBegin | LabPoints | LabEnd | LabStep | LabRest | LabUse
Request = (
    New
    | Open
    | Save
    | Export
    | Do
    | Begin
    | Points
    | Finish
    | Abandon
    | Look
    | Swatch
    | Pick
    | LabRequest
    | Analyse
    | MatchSet
    | MatchUse
)


# Results -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class CurveRow:
    """A named shaping curve as an editor shows it: outputs 0..1 at inputs spread evenly over 0..1."""

    name: str
    label: str
    tooltip: str
    heights: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Ready:
    """The engine is loaded.  `blends`: name, title, hint of each blend mode; `kinds`: the rows of the texture table;
    `ops`: the rows of the table of raster operations; `curves`, `edges`: the named shaping curves."""

    blends: tuple[tuple[str, str, str], ...] = ()
    kinds: tuple[Any, ...] = ()
    ops: tuple[Any, ...] = ()
    curves: tuple[CurveRow, ...] = ()
    edges: tuple[CurveRow, ...] = ()


@dataclass(frozen=True, slots=True)
class Patch:
    """Pixels of the rectangle `area` (within 0..256) of screen tile `tile` (level, x, y): uint8 (h, w, 4),
    premultiplied, read-only.  `revision` counts what has happened to the painting."""

    tile: tuple[int, int, int]
    area: Rect
    pixels: np.ndarray
    revision: int


@dataclass(frozen=True, slots=True)
class Same:
    """These tiles still show what they showed, at `revision`."""

    tiles: tuple[tuple[int, int, int], ...]
    revision: int


@dataclass(frozen=True, slots=True)
class LayerRow:
    """A layer or group as the panel lists it, top-most first; `depth` counts the groups around it."""

    name: str
    group: bool
    depth: int
    parent: str | None
    position: int
    opacity: float
    visible: bool
    blend: str
    locked: bool
    alpha_locked: bool


@dataclass(frozen=True, slots=True)
class Scene:
    """What the panels show of a painting."""

    frame: Rect
    layers: tuple[LayerRow, ...]
    active: str | None
    can_undo: bool
    can_redo: bool
    modified: bool
    path: Path | None
    textures: tuple[str, ...] = ()  # names of those defined
    texture_kinds: tuple[tuple[str, str], ...] = ()  # and the kind of each
    definitions: tuple[tuple[str, str, Mapping[str, Any]], ...] = ()  # and its parameters: name, kind, these
    texture_widths: tuple[tuple[str, int], ...] = ()  # pixels across the pictures of those that have one
    serial: int = 0  # another number: another painting


@dataclass(frozen=True, slots=True)
class Note:
    """A line for the artist; `bad` when something did not work."""

    text: str
    bad: bool = False


@dataclass(frozen=True, slots=True)
class Saved:
    """A file was written; `serial` of the painting that it holds."""

    path: Path


@dataclass(frozen=True, slots=True)
class Picture:
    """The swatch `ident`: uint8 (h, w, 4), premultiplied, read-only."""

    ident: str
    pixels: np.ndarray


@dataclass(frozen=True, slots=True)
class LabScene:
    """What the lab's panel shows besides the pictures "lab spectrum", "lab texture", "lab stroke", "lab near".

    `shapes`: the rows of `shapes.SHAPES`; `silent`: nothing sounds, the texture is flat; `using`: the texture of the
    painting that follows the lab; `version`: another number, and that texture has changed.
    """

    shapes: tuple[Any, ...]
    strokes: int
    can_undo: bool
    can_redo: bool
    silent: bool
    using: str = ""
    version: int = 0


@dataclass(frozen=True, slots=True)
class Found:
    """A part of what Analyse asked for; those not found yet are missing.  `lines`: by name of the facts, how each
    reads; `rings`: frequency in cycles per pixel, power and that of the all-pole model, of each ring; pictures come as
    Picture, under the names in `pictures`."""

    lines: Map[str, str]
    rings: tuple[tuple[float, float, float], ...] = ()
    pictures: tuple[str, ...] = ()
    done: bool = False


@dataclass(frozen=True, slots=True)
class MatchScene:
    """What the matching panel shows besides the pictures "match example", "match second", "match texture".

    `done`: how far the texture is, 0..1; `levels`, `orientations`: of its pyramid; `colours`: of its axes, sRGB;
    `fault`: what is wrong with what was asked for; `making`: the texture being made for use.
    """

    done: float = 0.0
    levels: int = 0
    orientations: int = 0
    colours: tuple[tuple[float, float, float], ...] = ()
    sizes: tuple[tuple[int, int], ...] = ()  # width and height of the examples
    fault: str = ""
    making: str = ""


@dataclass(frozen=True, slots=True)
class Picked:
    """The colour under a Pick, straight sRGB and alpha 0..1."""

    rgb: tuple[float, float, float]
    alpha: float


@dataclass(frozen=True, slots=True)
class Looked:
    """Where a recording that plays looked: level, origin, size of its view command; `seconds` to go there."""

    level: float
    origin: tuple[float, float]
    size: tuple[float, float]
    seconds: float = 0.0


@dataclass(frozen=True, slots=True)
class Pending:
    """How much work waits: tiles, and whether files are being read or written."""

    tiles: int
    files: int = 0


@dataclass(frozen=True, slots=True)
class Growing:
    """How far what is painted with examples has grown: the part done, 0..1, and where it has not, as (level,
    rectangle); nowhere, and all of it is as it will stay."""

    done: float
    rects: tuple[tuple[int, Rect], ...] = ()


Result = (
    Ready
    | Patch
    | Same
    | Scene
    | Note
    | Saved
    | Picture
    | Picked
    | Looked
    | Pending
    | LabScene
    | Found
    | MatchScene
    | Growing
)


def frozen(array: np.ndarray) -> np.ndarray:
    """The array itself, made read-only."""
    array.flags.writeable = False
    return array
