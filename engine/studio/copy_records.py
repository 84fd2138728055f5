"""What the window asks for to copy the picture, and what it is told.

Light on purpose, as `requests`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.numeric.address import Rect


@dataclass(frozen=True, slots=True)
class CopyPicture:
    """The pixels of a rectangle of a level, as they would be exported.  The newest counts.
    `about`: what for, told back."""

    level: int
    area: Rect
    about: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Copied:
    """What was asked for: uint8 RGBA (h, w, 4), alpha not premultiplied, read-only."""

    pixels: np.ndarray
    about: str = ""
