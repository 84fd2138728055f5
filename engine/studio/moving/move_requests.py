"""What the window asks for while something on the canvas is moved, and what it is told of it."""

from __future__ import annotations

from dataclasses import dataclass

from engine.canvas.placing.pose import SourcePart
from engine.numeric.address import Rect
from engine.painting.layer_commands import BakePlacement
from engine.painting.layering.placing_members import Placing


@dataclass(frozen=True, slots=True)
class Try:
    """Shows a layer, group or placement elsewhere, or a `copy` of it besides, and changes nothing; None: as the
    painting has it.  `selected`: only what is selected of a layer, "cut" out of it or as a "copy"."""

    name: str
    placing: Placing | None
    copy: bool = False
    selected: str | None = None


@dataclass(frozen=True, slots=True)
class AskExtent:
    """Asks how far a layer, group or placement, or what is `selected` of a layer, reaches, to a pixel of a level where
    that can be.  The newest counts."""

    name: str
    level: int
    selected: bool = False


@dataclass(frozen=True, slots=True)
class Extent:
    """How far a layer or group reaches; a placement, in the places of its source.  None: there is nothing.  `finest`:
    the finest level of what is selected."""

    name: str
    part: SourcePart | None
    selected: bool = False
    finest: int | None = None


@dataclass(frozen=True, slots=True)
class FitFrame:
    """Gives the painting a frame that just holds what is seen of its paint, in one step."""


@dataclass(frozen=True, slots=True)
class AskPainted:
    """Asks how far reaches what is seen of the paint."""


@dataclass(frozen=True, slots=True)
class PaintedTold:
    """How far reaches what is seen of the paint, pixels of level 0; empty where there is none."""

    rect: Rect


@dataclass(frozen=True, slots=True)
class AskBake:
    """Asks at which level a placement would become pixels."""

    name: str


@dataclass(frozen=True, slots=True)
class BakeTold:
    """The command that makes paint of a placement; `loses`: detail finer than its level; `flat`: not how
    thick it lies."""

    command: BakePlacement
    loses: bool
    flat: bool = False


MoveRequest = Try | AskExtent | FitFrame | AskPainted | AskBake
