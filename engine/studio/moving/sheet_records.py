"""What the window asks for to draw by itself what is dragged, and what it is told."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.numeric.address import Rect


@dataclass(frozen=True, slots=True)
class AskSheets:
    """Asks for what lies below a layer, group or placement, for itself and for what lies above it, as the painting has
    them: of a rectangle of a level, of what is moved in a larger one, `around`.  `number`
    comes back; the newest counts.
    """

    number: int
    name: str
    level: int
    rect: Rect
    around: Rect


@dataclass(frozen=True, slots=True)
class DropSheets:
    """Nobody wants them any more."""


@dataclass(frozen=True, slots=True)
class AskShown:
    """Asks to be told when all that is in sight is sent as the painting is now."""

    number: int


@dataclass(frozen=True, slots=True)
class Shown:
    """It is."""

    number: int


@dataclass(frozen=True, slots=True)
class CarriedSheet:
    """A rectangle of a level, premultiplied: uint8 (h, w, 4), read-only; None where it is empty."""

    rect: Rect
    pixels: np.ndarray | None


@dataclass(frozen=True, slots=True)
class CarriedSheets:
    """What was asked for: laid over one another they are what is seen.  None: they cannot be told apart."""

    number: int
    level: int
    sheets: tuple[CarriedSheet, CarriedSheet, CarriedSheet] | None


SheetRequest = AskSheets | DropSheets | AskShown
SheetResult = CarriedSheets | Shown
