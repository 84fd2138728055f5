"""What the window asks of land, and what comes back.  Light: it loads neither numba nor scipy."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from engine.terrain.seen.eye import Eye
from engine.terrain.seen.land_tiles import LandTile, TileKey


@dataclass(frozen=True, slots=True)
class AskLand:
    """The tiles that are wanted, most urgent first, each with the revision that the window holds, -1 for none.  The
    newest counts; none: the land is not looked at any more."""

    tiles: tuple[tuple[TileKey, int], ...]


@dataclass(frozen=True, slots=True)
class AskGround:
    """How high the land lies at a place, pixels of level 0, as seen at a level."""

    x: Fraction
    y: Fraction
    level: int


@dataclass(frozen=True, slots=True)
class AskStill:
    """A picture by rays, `size` (width, height), of what an eye sees, which is `clear` pixels of level 0 above the
    ground.  The newest counts, under its number; no eye: none is wanted any more."""

    number: int
    eye: Eye | None = None
    clear: float = 1.0
    size: tuple[int, int] = (0, 0)


@dataclass(frozen=True, slots=True)
class LandMade:
    """A tile; `revision` counts what has happened to the painting."""

    tile: LandTile
    revision: int


@dataclass(frozen=True, slots=True)
class GroundFound:
    """How high the land lies at the place that was asked for."""

    asked: AskGround
    z: float


@dataclass(frozen=True, slots=True)
class StillCome:
    """The picture of that number, sharper than the one before: uint8 (h, w, 3), a pixel of which is `by` of the
    window's; `last`: no sharper one comes; `error`: pixels of the window by which the land lies elsewhere, as a rule
    and at most, None where that is not known."""

    number: int
    pixels: np.ndarray
    by: int
    last: bool
    error: tuple[float, float] | None = None


LandRequest = AskLand | AskGround | AskStill
LandResult = LandMade | GroundFound | StillCome
