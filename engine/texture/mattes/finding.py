"""What lies on the ground of a picture: found untouched, corrected by marks, and its rim at full size."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect
from engine.texture.mattes.belonging import Belonging, corrected, untouched
from engine.texture.mattes.fine_rim import Piece, alphas, sizes, stretched
from engine.texture.mattes.marks import Mark, where_marked
from engine.texture.mattes.patchwork import Patchwork, patchwork
from engine.texture.mattes.tracing import traced

_TOLD = 0.3  # of a superpixel: as much has to be marked, or the mark counts for its pixels alone


@dataclass(frozen=True, eq=False, slots=True)
class Sought:
    """A picture, uint8 or uint16 RGBA (h, w, 4), alpha not premultiplied, its superpixels, and what was found
    untouched."""

    pixels: np.ndarray
    patches: Patchwork
    first: Belonging


class Outline(NamedTuple):
    """What belongs in the small picture, `trace` float32 (h, w) in 0..1; `said`: int8 (h, w), where marks say that it
    does, 1, or does not, -1; `whole`: the picture has no ground; `near`: where the last mark ends, in parts of width
    and height: its rim is found there first."""

    trace: np.ndarray
    said: np.ndarray
    whole: bool
    near: tuple[float, float] = (0.5, 0.5)


def sought(pixels: np.ndarray) -> Sought:
    """Looks at a picture."""
    patches = patchwork(pixels)
    return Sought(pixels, patches, untouched(patches))


def outlined(of: Sought, marks: Sequence[Mark] = ()) -> Outline:
    """Finds what belongs, quickly, as some marks have it."""
    patches = of.patches
    said = where_marked(marks, of.pixels.shape[:2], patches.labels.shape)
    found = of.first
    if said.any():
        counts = np.bincount(patches.labels.ravel(), said.ravel().astype(np.float64), patches.count)
        found = corrected(patches, of.first, np.where(np.abs(counts) >= _TOLD * patches.areas, np.sign(counts), 0.0))
    trace = traced(patches, found, said)
    height, width = of.pixels.shape[:2]
    ends = [mark.points[-1] for mark in marks[-1:]]
    return Outline(trace, said, bool(found.whole), *((x / width, y / height) for x, y in ends))


class Cut:
    """What is cut out, as far as its rim is found.  `pixels`: RGBA (h, w, 4) of the picture's type, alpha not
    premultiplied, colours without the ground."""

    def __init__(self, of: Sought, outline: Outline) -> None:
        self._of, self._outline = of, outline
        height, width = of.pixels.shape[:2]
        self.whole = Rect(0, 0, width, height)
        self.pixels = of.pixels.copy()
        for y in range(0, height, _ROWS):
            rect = Rect(0, y, width, min(height, y + _ROWS))
            self._set(rect, stretched(outline.trace, (height, width), rect), None)

    def steps(self) -> Iterator[tuple[float, Piece | None]]:
        """Finds the rim, in steps: how far it is, 0..1, and the piece that is now as it will be."""
        trace, said = self._outline.trace, self._outline.said
        ladder = sizes((self.whole.height, self.whole.width), trace.shape)
        for n, size in enumerate(ladder):
            last, known = n == len(ladder) - 1, Rect(0, 0, size[1], size[0])
            finer = None if last else (stretched(trace, size, known) > 0.5).astype(np.float32)
            for piece in alphas(self._of.pixels, trace, said, size, self._outline.near):
                if finer is not None:
                    finer[piece.rect.slices(known)] = piece.alpha
                else:
                    self._set(piece.rect, piece.alpha, piece.colours)
                yield (n + piece.done) / len(ladder), piece if last else None
            trace = trace if finer is None else finer

    def _set(self, rect: Rect, alpha: np.ndarray, colours: np.ndarray | None) -> None:
        part, before = self.pixels[rect.slices(self.whole)], self._of.pixels[rect.slices(self.whole)]
        full = np.float32(np.iinfo(part.dtype).max)
        part[..., 3] = np.rint(alpha * before[..., 3].astype(np.float32))
        if colours is not None:
            part[..., :3] = np.where(alpha[..., None] < 1, np.rint(colours * full), before[..., :3])
        part[part[..., 3] == 0] = 0


_ROWS = 256  # of a strip


def cut_out_of(of: Sought, marks: Sequence[Mark] = ()) -> np.ndarray:
    """Returns what is cut out of a picture, to the end: RGBA (h, w, 4) of its type."""
    cut = Cut(of, outlined(of, marks))
    for _ in cut.steps():
        pass
    return cut.pixels
