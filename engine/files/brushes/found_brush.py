"""A brush as it was found in another program's file, in this program's terms."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from engine.files.swatches.colour_list import plain_name

MOST_BRUSHES = 500  # of one file
LONGEST_TIP = 10_000  # px along a side of one that is read
TIP_PIXELS = 1 << 24  # of one that is read
ALL_PIXELS = 1 << 27  # of all tips of a file
_KEPT = 1024  # px along a side of what is kept of it
_FAINT = 2  # of 255: what is not seen
_WIDEST, _LEAST_SPACING, _MOST_SPACING = 4000.0, 0.02, 16.0
ByName = dict[str, object]  # members of an object of JSON, or of another form of settings


@dataclass(frozen=True, eq=False, slots=True)
class FoundBrush:
    """`settings`: members of a brush as a recording has them; `tip`: what its dabs cover, uint8 (n, n), 255 in full, as
    wide as twice the radius, None for round ones; `left`: what of it was left out, in words; `coloured`: it is about
    its colour."""

    name: str
    settings: ByName
    tip: np.ndarray | None = None
    left: tuple[str, ...] = ()
    coloured: bool = False


@dataclass(slots=True)
class FoundBrushes:
    """The brushes of one file, and what was left out of the file as a whole."""

    brushes: list[FoundBrush] = field(default_factory=list)
    left: list[str] = field(default_factory=list)


def called(name: str, file: str, number: int | None = None) -> str:
    """Returns what a brush is called: by its own name, else as its file is, with its number in that."""
    stem = (file.rpartition(".")[0] or file).replace("_", " ")
    return plain_name(name) or plain_name(stem if number is None else f"{stem} {number}") or "Brush"


def encircled(coverage: np.ndarray) -> tuple[np.ndarray, float] | None:
    """Returns a tip, uint8 (h, w), as a square around the smallest circle about its middle that holds all that is seen
    of it, and the radius of that, px; None where nothing is seen."""
    height, width = coverage.shape
    seen = coverage > _FAINT
    rows = np.flatnonzero(seen.any(axis=1))
    if not len(rows):
        return None
    first, last = seen.argmax(axis=1)[rows], width - seen[:, ::-1].argmax(axis=1)[rows]
    right = np.maximum(width / 2.0 - first, last - width / 2.0)
    down = np.abs(rows + 0.5 - height / 2.0) + 0.5
    radius = math.sqrt(float((down * down + right * right).max()))
    side = math.ceil(2.0 * radius) + 1  # room for half a pixel, where the tip's sides are odd and even
    out = np.zeros((side, side), np.uint8)
    left, top = (side - width) // 2, (side - height) // 2
    x0, y0 = max(left, 0), max(top, 0)
    x1, y1 = min(left + width, side), min(top + height, side)
    out[y0:y1, x0:x1] = coverage[y0 - top : y1 - top, x0 - left : x1 - left]
    return _shrunk(out), side / 2.0


def _shrunk(square: np.ndarray) -> np.ndarray:
    """Returns a square of at most `_KEPT` pixels along a side, by the means of whole blocks."""
    by = -(-len(square) // _KEPT)
    if by == 1:
        return square
    side = -(-len(square) // by) * by
    padded = np.pad(square, ((0, side - len(square)),) * 2)
    means = padded.reshape(side // by, by, side // by, by).mean(axis=(1, 3))
    shrunk: np.ndarray = np.rint(means).astype(np.uint8)
    return shrunk


def stamp_settings(tip: tuple[np.ndarray, float], scale: float, step: float) -> ByName:
    """Returns radius, spacing and hardness of a tip that is painted at a scale, its dabs `step` px of the picture
    apart."""
    radius = tip[1]
    return {"radius": radius_of(radius * scale), "hardness": 1.0, "spacing": spacing_of(step / radius)}


def radius_of(px: float) -> float:
    """Returns a radius that a brush may have."""
    return min(max(px, 0.25), _WIDEST)


def spacing_of(radii: float) -> float:
    """Returns a spacing that a brush may have."""
    return min(max(radii, _LEAST_SPACING), _MOST_SPACING)
