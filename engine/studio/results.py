"""What the background worker tells the window: read-only results.  What it is asked for is in `requests`.

Light on purpose, as that: importing it loads neither numba nor scipy.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.arithmetic import FINE
from engine.painting.layering.touch_command import NO_TOUCHES, Touches
from engine.studio.adjusting.trial_records import Tried
from engine.studio.copy_records import Copied
from engine.studio.held.held_records import Held
from engine.studio.land.land_records import LandResult
from engine.studio.land.wear_records import WornTold
from engine.studio.layer_rows import LayerRow as LayerRow
from engine.studio.layer_rows import Shows as Shows
from engine.studio.moving.move_requests import BakeTold, Extent, PaintedTold
from engine.studio.moving.sheet_records import SheetResult
from engine.studio.past.past_records import PastResult
from engine.studio.selecting.ants_records import Ants
from engine.studio.selecting.tint_records import Tint
from engine.studio.textures.cut_records import CutFound
from engine.studio.textures.texture_results import TextureResult
from engine.studio.workshop.workshop_records import WorkshopResult

if TYPE_CHECKING:
    from engine.painting.commands import Bookmark, Guide


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
    premultiplied, read-only.  `revision` counts what has happened to the painting.  `heights`: of its relief, while it
    is looked at in the light: uint16 (h, w), white is WHITE_HEIGHT."""

    tile: tuple[int, int, int]
    area: Rect
    pixels: np.ndarray
    revision: int
    heights: np.ndarray | None = None


@dataclass(frozen=True, slots=True)
class Same:
    """These tiles still show what they showed, at `revision`."""

    tiles: tuple[tuple[int, int, int], ...]
    revision: int


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
    paper: str | None = None  # its colour
    textures: tuple[str, ...] = ()  # names of those defined
    texture_kinds: tuple[tuple[str, str], ...] = ()  # and the kind of each
    definitions: tuple[tuple[str, str, Mapping[str, Any]], ...] = ()  # and its parameters: name, kind, these
    texture_widths: tuple[tuple[str, int], ...] = ()  # pixels across the pictures of those that have one
    serial: int = 0  # another number: another painting
    name: str = ""  # what one without a file is called
    bookmarks: tuple[Bookmark, ...] = ()  # in the order in which they were made
    guides: tuple[Guide, ...] = ()  # and so are these
    grid: int = FINE  # on which its values lie
    touches: Touches = NO_TOUCHES  # what is painted on solids, by their names


@dataclass(frozen=True, slots=True)
class Note:
    """A line for the artist; `bad` when something did not work, `fault` when that is told in the log.

    `stays`: it is shown until it is dealt with or closed by hand; `offers`: what can be done about it, names of rows of
    ACTIONS in app.actions; `about`: of what it is ("save", "open", "journal"), a newer one of the same takes its place,
    and deals with it if it does not stay; `path`: of which file; `lines`: what more there is to tell, a line each.
    """

    text: str
    bad: bool = False
    fault: bool = False
    stays: bool = False
    offers: tuple[str, ...] = ()
    about: str = ""
    path: Path | None = None
    lines: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Stopped:
    """A fault has ended the engine's thread: nothing more is carried out, and nothing comes after this."""


@dataclass(frozen=True, slots=True)
class Opening:
    """How far the file `name` is read, the part done, 0..1; without a name: none is being opened any more."""

    name: str = ""
    part: float = 0.0


@dataclass(frozen=True, slots=True)
class Whole:
    """The file number `file` is read, and takes the painting's place with the next `Show`; `changed`: not yet, because
    the painting was changed meanwhile."""

    file: int
    name: str
    changed: bool = False


@dataclass(frozen=True, slots=True)
class Saved:
    """A file was written; `told`: what there is to say of that, "" if nothing."""

    path: Path
    told: str = ""


@dataclass(frozen=True, slots=True)
class Overtaken:
    """A file was not written: it is open in another window (`elsewhere`), or it has been changed by somebody else."""

    path: Path
    elsewhere: bool = False

    @property
    def words(self) -> str:
        """Returns why."""
        return "it is open in another window" if self.elsewhere else "another program changed it"


@dataclass(frozen=True, slots=True)
class Picture:
    """The swatch `ident`: uint8 (h, w, 4), premultiplied, read-only."""

    ident: str
    pixels: np.ndarray


@dataclass(frozen=True, slots=True)
class PicturePart:
    """A part, uint8 (h, w, 3), read-only, of the picture `ident`, whose `size` is width, height."""

    ident: str
    size: tuple[int, int]
    area: Rect
    pixels: np.ndarray


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
class Sought:
    """Whether there is paint in what Seek asked for, `area` of `level`; if not, the nearest painted pixel that was
    found, (level, x, y)."""

    level: int
    area: Rect
    in_sight: bool
    nearest: tuple[int, int, int] | None = None


@dataclass(frozen=True, slots=True)
class Spot:
    """Paint on the map: the pixels `rect` of the level at which it was painted, and how many tiles it has around
    there."""

    level: int
    rect: Rect
    tiles: int


@dataclass(frozen=True, slots=True)
class PaintMap:
    """Where there is paint; its picture, "map", shows the pixels `area` of `level`.  `spots`: the coarsest first."""

    level: int
    area: Rect
    spots: tuple[Spot, ...]


@dataclass(frozen=True, slots=True)
class Pending:
    """How many tiles wait to be made."""

    tiles: int


@dataclass(frozen=True, slots=True)
class Writing:
    """How many files are being written, whether the painting's own is among them, and the part grown for them, 0..1."""

    files: int = 0
    saving: bool = False
    grown: float = 1.0


@dataclass(frozen=True, slots=True)
class Filming:
    """How far the film is that is being made: the part done, 0..1; None: none is."""

    part: float | None = None


@dataclass(frozen=True, slots=True)
class Played:
    """How far the recording that plays is: the part done, 0..1; None: none plays."""

    part: float | None = None


@dataclass(frozen=True, slots=True)
class FilmLength:
    """How long the film would be that was asked about, in seconds and in frames; or why it cannot be made."""

    seconds: float = 0.0
    frames: int = 0
    fault: str = ""


@dataclass(frozen=True, slots=True)
class GotReady:
    """What was asked for by GetReady is done."""


@dataclass(frozen=True, slots=True)
class Prepared:
    """How many of the brushes that Prepare named can be painted with at once."""

    ready: int
    of: int


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
    | Stopped
    | Opening
    | Whole
    | Saved
    | Overtaken
    | Picture
    | Picked
    | Copied
    | Looked
    | Sought
    | PaintMap
    | Pending
    | Writing
    | PicturePart
    | TextureResult
    | WorkshopResult
    | CutFound
    | GotReady
    | Filming
    | Played
    | FilmLength
    | Prepared
    | Growing
    | PastResult
    | Extent
    | BakeTold
    | PaintedTold
    | SheetResult
    | Tried
    | LandResult
    | WornTold
    | Ants
    | Tint
    | Held
)

WHITE_HEIGHT = 65535  # of the heights of patches


def frozen(array: np.ndarray) -> np.ndarray:
    """Returns the array itself, made read-only."""
    array.flags.writeable = False
    return array
