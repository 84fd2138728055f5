"""What the window asks of the quick mask, and what it hears.

Light on purpose, as `requests`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from engine.brush.copies import NO_COPIES, Copies
from engine.numeric.address import Rect

if TYPE_CHECKING:
    from engine.brush.settings import Brush


@dataclass(frozen=True, slots=True)
class AskTint:
    """Asks for how far each pixel of a rectangle of a level is not selected, now and whenever that changes.  The newest
    counts; None: no more."""

    level: int
    area: Rect | None


@dataclass(frozen=True, slots=True)
class MaskBegin:
    """The pen touches down on the mask; as `Begin`.  `takes`: what it covers is no longer selected."""

    level: int
    origin: tuple[int, int]
    brush: Brush
    takes: bool
    copies: Copies = NO_COPIES


@dataclass(frozen=True, slots=True)
class MaskPoints:
    """More of that: float64 (n, 6), as `Points`."""

    points: np.ndarray


@dataclass(frozen=True, slots=True)
class MaskEnd:
    """What the pen covers is no longer seen by itself: it was selected by a command, or dropped."""


TintRequest = AskTint | MaskBegin | MaskPoints | MaskEnd


@dataclass(frozen=True, slots=True, eq=False)
class Tint:
    """`alpha`: how far each pixel of a part of the rectangle that was asked for is not selected, uint8 (h, w),
    read-only; `part`: in pixels of `level` from the corner of `area`."""

    level: int
    area: Rect
    part: Rect
    alpha: np.ndarray
