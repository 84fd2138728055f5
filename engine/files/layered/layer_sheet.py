"""What a file of layers holds, and its pictures side by side on one sheet, by which a painting keeps them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from engine.files.fault import TooMuch
from engine.files.limits import memory_cap
from engine.numeric.address import Rect

_UNPLACED = Rect(0, 0, 0, 0)
SHEET = 1 << 27  # pixels of a sheet: half a GiB of 8 bits
_BYTES = 16  # of memory that a pixel of a sheet takes, with the layers made of it


@dataclass(frozen=True, slots=True)
class FoundPicture:
    """A layer that is a picture: its corner lies at pixel `at` of the image; `number`: which of the file's pictures.
    `blend`: a mode that we have; `part`: its place on the sheet, once that is known."""

    name: str
    number: int
    at: tuple[int, int]
    size: tuple[int, int]
    opacity: float = 1.0
    visible: bool = True
    blend: str = "src-over"
    clip: bool = False
    part: Rect = _UNPLACED


@dataclass(frozen=True, slots=True)
class FoundGroup:
    """A group of layers, bottom first."""

    name: str
    children: tuple[FoundPicture | FoundGroup, ...]
    opacity: float = 1.0
    visible: bool = True
    blend: str = "src-over"
    isolated: bool = True

    def pictures(self) -> Iterator[FoundPicture]:
        """Yields the pictures inside, bottom first."""
        for child in self.children:
            if isinstance(child, FoundGroup):
                yield from child.pictures()
            else:
                yield child


@dataclass(frozen=True, slots=True)
class FoundLayers:
    """All layers of an image of `size` (width, height); `notes`: what is shown otherwise, or left out, a line each;
    `sheet`: the size of that."""

    size: tuple[int, int]
    root: FoundGroup
    notes: tuple[str, ...] = ()
    sheet: tuple[int, int] = (0, 0)


class LayeredReader(Protocol):
    """A file of layers, open."""

    @property
    def found(self) -> FoundLayers:
        """Gives what the file holds; its pictures have no place on a sheet."""
        ...

    def bands(self, number: int) -> Iterator[np.ndarray]:
        """Yields the rows of a picture from the top, uint8 or uint16 RGBA (n, width, 4).  FileError where it is
        damaged."""
        ...


def with_places(found: FoundLayers, name: str) -> FoundLayers:
    """Returns the layers with their places on a sheet: the highest first, in rows.  TooMuch if that is too large;
    `name` is the file's."""
    pictures = list(found.root.pictures())
    area = sum(one.size[0] * one.size[1] for one in pictures)
    widest = max((one.size[0] for one in pictures), default=1)
    width, parts = max(widest, math.isqrt(max(area - 1, 0)) + 1), {}
    x = y = high = 0
    for one in sorted(pictures, key=lambda one: (-one.size[1], one.number)):
        if x + one.size[0] > width:
            x, y, high = 0, y + high, 0
        parts[one.number] = Rect.at(x, y, *one.size)
        x, high = x + one.size[0], max(high, one.size[1])
    size = (width, y + high)
    most = min(SHEET, memory_cap() // _BYTES)
    if size[0] * size[1] > most:
        raise TooMuch(name, f"its layers side by side have {size[0] * size[1]} pixels; expected at most {most}")
    return replace(found, root=_with_parts(found.root, parts), sheet=size)


def _with_parts(group: FoundGroup, parts: dict[int, Rect]) -> FoundGroup:
    def one(child: FoundPicture | FoundGroup) -> FoundPicture | FoundGroup:
        return _with_parts(child, parts) if isinstance(child, FoundGroup) else replace(child, part=parts[child.number])

    return replace(group, children=tuple(map(one, group.children)))


def sheet_of(reader: LayeredReader, name: str) -> np.ndarray:
    """Returns all pictures of a file side by side, uint8 or, where one has 16 bits, uint16 RGBA (h, w, 4)."""
    found = with_places(reader.found, name)
    width, height = found.sheet
    sheet = np.zeros((max(height, 1), width, 4), np.uint8)
    for one in found.root.pictures():
        top = one.part.y0
        for band in reader.bands(one.number):
            if band.dtype == np.uint16 and sheet.dtype == np.uint8:
                sheet = sheet.astype(np.uint16) * np.uint16(257)
            deep = sheet.dtype == np.uint16 and band.dtype == np.uint8
            rows = band.astype(np.uint16) * np.uint16(257) if deep else band
            sheet[top : top + len(band), one.part.x0 : one.part.x1] = rows
            top += len(band)
    return sheet
