"""A written texture and its lines as pictures."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from engine.light.light import Light
from engine.light.lit_relief import lit
from engine.numeric.address import Rect
from engine.texture.expression.examined import line_planes
from engine.texture.expression.written_ink import Expression

_PIECE = 4e6  # nanoseconds of work in one step, about
_BINS = 48
_CHECKER, _SQUARE = (0.45, 0.55), 8  # the ground of what is translucent; pixels
_BELOW, _ABOVE = (0.16, 0.30, 0.62), (0.80, 0.34, 0.16)  # the colours of numbers far below 0, and far above 1


class Counted(NamedTuple):
    """How often values are seen, from `least` to `most`; of colours of red, green and blue."""

    counts: tuple[tuple[int, ...], ...]
    least: float
    most: float


def in_pieces(
    made: Expression, line: int, level: int, rect: Rect, cost: float, few: bool = False
) -> Iterator[np.ndarray | None]:
    """Yields None after each piece of work, then what a line is over a rectangle, as `line_planes`; `cost`:
    nanoseconds a pixel."""
    rows = max(1, min(rect.height, int(_PIECE / max(cost * rect.width, 1.0))))
    pieces: list[np.ndarray] = []
    for y in range(rect.y0, rect.y1, rows):
        if pieces:
            yield None
        pieces.append(line_planes(made, line, level, Rect(rect.x0, y, rect.x1, min(y + rows, rect.y1)), few))
    yield np.concatenate(pieces, axis=1)


def as_seen(planes: np.ndarray, origin: tuple[int, int] = (0, 0), marked: bool = False) -> np.ndarray:
    """Returns planes of a line as a picture: uint8 (h, w, 4); `marked`: numbers below 0 and above 1 in colours."""
    _, height, width = planes.shape
    if len(planes) == 1:
        rgb = np.repeat(np.clip(planes, 0.0, 1.0), 3, axis=0)
        if marked:
            _mark(rgb, planes[0])
    else:
        rows = (np.arange(height) + origin[1]) // _SQUARE
        squares = (np.add.outer(rows, (np.arange(width) + origin[0]) // _SQUARE) & 1).astype(bool)
        ground = np.where(squares, *_CHECKER).astype(np.float32)
        rgb = planes[:3] + ground * (1.0 - np.clip(planes[3], 0.0, 1.0))
    out = np.full((height, width, 4), 255, np.uint8)
    out[..., :3] = np.floor(np.clip(rgb, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8).transpose(1, 2, 0)
    return out


def as_relief(planes: np.ndarray) -> np.ndarray:
    """Returns a line as heights in the light, of its brightness: uint8 (h - 2, w - 2, 4); `planes` have a rim of a
    pixel."""
    heights = brightness(planes)
    colours = np.ones((4, *heights.shape), np.float32)
    colours[:3] = planes[:3] if len(planes) == 4 else 0.62
    if len(planes) == 4:
        colours[:3] += 0.5 * (1.0 - np.clip(planes[3], 0.0, 1.0))
    return as_seen(lit(np.clip(colours, 0.0, 1.0), np.clip(heights, 0.0, 1.0), Light(depth=24.0)))


def brightness(planes: np.ndarray) -> np.ndarray:
    """Returns the numbers of a line, or how bright its colours are: float32 (h, w)."""
    if len(planes) == 1:
        return np.ascontiguousarray(planes[0])
    out: np.ndarray = np.float32(0.2126) * planes[0] + np.float32(0.7152) * planes[1] + np.float32(0.0722) * planes[2]
    return out


def histogram_of(planes: np.ndarray) -> Counted:
    """Returns how often values are seen."""
    shown = planes[:3] if len(planes) == 4 else planes
    least, most = math.floor(float(shown.min()) * 20.0) / 20.0, math.ceil(float(shown.max()) * 20.0) / 20.0
    if len(planes) == 4 or (least >= 0.0 and most <= 1.0):
        least, most = 0.0, 1.0
    most = max(most, least + 0.05)
    bins = [np.histogram(plane, _BINS, (least, most))[0] for plane in shown]
    return Counted(tuple(tuple(int(n) for n in row) for row in bins), least, most)


def _mark(rgb: np.ndarray, values: np.ndarray) -> None:
    """Colours what is below 0 and above 1, the more the farther."""
    for far, colour in ((-values, _BELOW), (values - 1.0, _ABOVE)):
        part = np.clip(far * 4.0, 0.0, 1.0)
        part = np.where(far > 0.0, 0.35 + 0.65 * part, 0.0)
        for plane, value in zip(rgb, colour, strict=True):
            plane += (value - plane) * part
