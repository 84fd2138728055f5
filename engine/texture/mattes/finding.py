"""What lies on the ground of a picture: found untouched, corrected by marks, and its rim at full size."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect
from engine.texture.mattes.belonging import Belonging, corrected, untouched
from engine.texture.mattes.fine_rim import Piece, alphas, sizes, stretched
from engine.texture.mattes.patchwork import Patchwork, patchwork
from engine.texture.mattes.tracing import traced

_TOLD = 0.3  # of a superpixel: as much has to be marked, or the mark counts for its pixels alone


class Mark(NamedTuple):
    """A stroke that says what belongs (`keep`) or does not: points (x, y) and a radius, in pixels of the picture."""

    keep: bool
    points: tuple[tuple[float, float], ...]
    radius: float


@dataclass(frozen=True, eq=False, slots=True)
class Sought:
    """A picture, uint8 or uint16 RGBA (h, w, 4), alpha not premultiplied, its superpixels, and what was found
    untouched."""

    pixels: np.ndarray
    patches: Patchwork
    first: Belonging


class Outline(NamedTuple):
    """What belongs in the small picture, `trace` float32 (h, w) in 0..1; `said`: int8 (h, w), where marks say that it
    does, 1, or does not, -1; `whole`: the picture has no ground."""

    trace: np.ndarray
    said: np.ndarray
    whole: bool


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
    return Outline(trace, said, bool(found.whole))


def where_marked(marks: Sequence[Mark], size: tuple[int, int], small: tuple[int, int]) -> np.ndarray:
    """Returns where marks lie in a small picture of one of a size, later ones over earlier: int8 (h, w)."""
    out = np.zeros(small, np.int8)
    down, across = small[0] / size[0], small[1] / size[1]
    for mark in marks:
        scaled = [(x * across - 0.5, y * down - 0.5) for x, y in mark.points]
        reach = max(0.75, mark.radius * max(down, across))
        for a, b in zip(scaled, scaled[1:] or scaled, strict=False):
            _segment(out, a, b, reach, 1 if mark.keep else -1)
    return out


def _segment(out: np.ndarray, a: tuple[float, float], b: tuple[float, float], reach: float, value: int) -> None:
    """Sets what lies within reach of a line from a to b."""
    height, width = out.shape
    x0, x1 = (int(np.clip(np.floor(min(a[0], b[0]) - reach), 0, width)), min(max(a[0], b[0]) + reach + 1, width))
    y0, y1 = (int(np.clip(np.floor(min(a[1], b[1]) - reach), 0, height)), min(max(a[1], b[1]) + reach + 1, height))
    y, x = np.mgrid[y0 : max(y0, int(y1)), x0 : max(x0, int(x1))]
    dx, dy = b[0] - a[0], b[1] - a[1]
    along = np.clip(((x - a[0]) * dx + (y - a[1]) * dy) / max(dx * dx + dy * dy, 1e-9), 0.0, 1.0)
    near = np.hypot(x - a[0] - along * dx, y - a[1] - along * dy) <= reach
    out[y0 : y0 + near.shape[0], x0 : x0 + near.shape[1]][near] = value


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
            for piece in alphas(self._of.pixels, trace, said, size):
                if finer is not None:
                    finer[piece.rect.slices(known)] = piece.alpha
                else:
                    self._set(piece.rect, piece.alpha, piece.colours)
                part = (piece.rect.y0 * size[1] + piece.rect.x1 * piece.rect.height) / (size[0] * size[1])
                yield (n + min(part, 1.0)) / len(ladder), piece if last else None
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
