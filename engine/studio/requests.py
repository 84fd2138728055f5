"""What the window asks of the background worker: frozen requests.  What comes back is in `results`.

Light on purpose: importing it loads neither numba nor scipy, so a window can be on the screen before the engine is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from engine.brush.copies import NO_COPIES, Copies
from engine.canvas.placing.pose import Pose
from engine.numeric.address import Rect
from engine.numeric.arithmetic import FINE
from engine.painting.layering.onto_member import ONTO_PAINT
from engine.studio.adjusting.trial_records import TryFill
from engine.studio.copy_records import CopyPicture
from engine.studio.filing.film_requests import FilmRequest
from engine.studio.filing.opening_requests import OpeningRequest
from engine.studio.journalled.tend_request import Tend
from engine.studio.land.land_records import LandRequest
from engine.studio.land.wear_records import WearRequest
from engine.studio.masked.mask_requests import ShowMask
from engine.studio.moving.move_requests import MoveRequest
from engine.studio.moving.sheet_records import SheetRequest
from engine.studio.past.past_records import PastRequest
from engine.studio.results import Note, Result
from engine.studio.selecting.ants_records import AskAnts, PreviewSelection
from engine.studio.selecting.tint_records import TintRequest
from engine.studio.stack.stack_requests import ShowOnly
from engine.studio.textures.cut_records import FindCut
from engine.studio.textures.texture_requests import LabRequest, MatchRequest, RegionRequest
from engine.studio.workshop.workshop_records import WorkshopRequest

if TYPE_CHECKING:
    from engine.brush.settings import Brush
    from engine.light.light import Light
    from engine.painting.commands import Command, DefineTexture
    from engine.painting.guiding.guides import Guide
    from engine.painting.places import Bookmark
    from engine.texture.image import ImageSource

Handlers = dict[type, Callable[[Any], None]]  # of requests, by their types
SCREEN_TILE = 256  # pixels along a side of a screen tile


@dataclass(frozen=True, slots=True)
class New:
    """A new painting with a frame in level-0 pixels, its values on a grid of so many bits, on a paper of a colour
    "#rrggbb", or on none."""

    frame: Rect
    seed: int = 0
    grid: int = FINE
    paper: str | None = None


@dataclass(frozen=True, slots=True)
class Open:
    """A painting, a picture or a recording from a file, instead of what is being opened; `live`: the recording is seen
    as it grows; `untitled`: it is not saved there again.  It is read beside the painting; the answer to
    `results.Whole` is `Show`."""

    path: Path
    live: bool = False
    untitled: bool = False


@dataclass(frozen=True, slots=True)
class Recover:
    """A painting that was not closed, from its entry's folder: as an untitled one, not saved.  It is read as a file is,
    whose `name` the window tells meanwhile; or `at_once`: all that is asked for after it waits, and is of it."""

    folder: Path
    name: str = ""
    at_once: bool = False


@dataclass(frozen=True, slots=True)
class Save:
    """The painting as it is now, as .ora; `sure`: whatever is there; `symmetry`: that of the hand, which is stored in
    place of the one that undo and redo went back to."""

    path: Path
    sure: bool = False
    symmetry: Guide | None = None


@dataclass(frozen=True, slots=True)
class Export:
    """The frame at `level` (or the rectangle `area` of that level), as .png, .tif or .exr of so many bits a channel;
    `light`: that it is lit by; `transparent`: without the paper; `apart`: each layer in a file of its own, whose name
    ends with the layer's."""

    path: Path
    level: int = 0
    area: Rect | None = None
    light: Light | None = None
    depth: int = 8
    transparent: bool = False
    apart: bool = False


@dataclass(frozen=True, slots=True)
class Do:
    """A command, carried out in the order of posting; `time`: of posting, seconds since 1970; `over_symmetry`: undo and
    redo do not count steps that only set the symmetry; `lent`: the picture that a definition names by its sha, where it
    was read already; `together`: commands in a row of one number are undone as one, 0 is none."""

    command: Command
    time: float | None = None
    over_symmetry: bool = False
    lent: ImageSource | None = None
    together: int = 0


@dataclass(frozen=True, slots=True)
class Begin:
    """The pen touches down: `radius` in pixels of `level`, points relative to `origin`, `time`, seconds since 1970;
    `layer`: None for the active one; `copies`: where it is drawn again; `onto`: the layer's paint, or its mask;
    `seen`: where the layer is seen by the selection that limits it, if not where it lies."""

    level: int
    origin: tuple[int, int]
    brush: Brush
    layer: str | None = None
    time: float | None = None
    copies: Copies = NO_COPIES
    onto: str = ONTO_PAINT
    seen: Pose | None = None


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
    """The screen tiles wanted, most urgent first: (level, x, y, revision already held or -1); `heights`: what the
    heights are taken from that are wanted with them, as `Light.height` has it.  The newest counts."""

    tiles: tuple[tuple[int, int, int, int], ...]
    heights: str | None = None


@dataclass(frozen=True, slots=True)
class Swatch:
    """A small picture painted with a brush, `size` (width, height) pixels; `zoom` levels nearer than painted.
    `textures`: definitions that the brush brings along; `soon`: before those that are not; `kept`: in a file, so that
    it is painted once."""

    ident: str
    brush: Brush
    size: tuple[int, int]
    kind: str = "stroke"
    zoom: int = 0
    textures: tuple[DefineTexture, ...] = ()
    soon: bool = False
    kept: bool = False


@dataclass(frozen=True, slots=True)
class Pick:
    """The colour of a pixel, or of a disc around it by its `radius` in pixels; of what is seen, or of a `layer` of
    paint alone."""

    level: int
    x: int
    y: int
    radius: int = 0
    layer: str | None = None


@dataclass(frozen=True, slots=True)
class Analyse:
    """Asks what the painting is made of, over a rectangle of a level.  The newest counts; None stops."""

    level: int = 0
    area: Rect | None = None


@dataclass(frozen=True, slots=True)
class Seek:
    """Asks whether there is paint in a rectangle of a level, and where the nearest is if not.  The newest counts."""

    level: int
    area: Rect


@dataclass(frozen=True, slots=True)
class AskMap:
    """Asks for the map, about `size` (width, height) pixels large.  The newest counts."""

    size: tuple[int, int]


@dataclass(frozen=True, slots=True)
class AskMiniatures:
    """Asks for small pictures of bookmarks, "place NAME", at most `size` (width, height) large.  The newest counts."""

    bookmarks: tuple[Bookmark, ...]
    size: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Prepare:
    """Brushes that are likely to be painted with, most likely first: their kernels are compiled meanwhile."""

    swatches: tuple[Swatch, ...]


@dataclass(frozen=True, slots=True)
class GetReady:
    """Examples are going to be painted with: what that needs is loaded, or compiled, meanwhile."""


@dataclass(frozen=True, slots=True)
class FileGrown:
    """What is painted with examples has been grown to the part `part`, 0..1, for the file number `file`; posted by the
    thread that writes it."""

    file: int
    part: float


@dataclass(frozen=True, slots=True)
class Written:
    """The file number `file` is written, and `told` is what to say of it, or cannot be: `fault` says why; posted by the
    thread that wrote it."""

    file: int
    fault: Note | None = None
    told: Result | None = None


Request = (
    New
    | Open
    | OpeningRequest
    | Recover
    | Save
    | Export
    | FilmRequest
    | Do
    | Begin
    | Points
    | Finish
    | Abandon
    | Look
    | Swatch
    | Pick
    | LabRequest
    | WorkshopRequest
    | RegionRequest
    | FindCut
    | Analyse
    | MatchRequest
    | Seek
    | AskMap
    | AskAnts
    | PreviewSelection
    | TintRequest
    | AskMiniatures
    | GetReady
    | FileGrown
    | Written
    | Prepare
    | PastRequest
    | Tend
    | CopyPicture
    | MoveRequest
    | SheetRequest
    | ShowMask
    | ShowOnly
    | LandRequest
    | WearRequest
    | TryFill
)


def at_time(request: Request, time: float) -> Request:
    """Returns a request that says when it was posted, seconds since 1970, if it is of a kind that does."""
    return replace(request, time=time) if isinstance(request, Do | Begin) and request.time is None else request
