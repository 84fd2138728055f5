"""Paint that lies at a place in plies: each shows through those above it, merged ones with the opacity they had."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from engine.canvas.merging.cleared import Outside
from engine.canvas.placing.through import Seen
from engine.canvas.selecting.selection import Selection
from engine.numeric.address import Rect
from engine.numeric.similarity import Similarity
from engine.session.here.gazes import LEAST_SHARE, Gaze, source_of
from engine.session.here.lineage import Given
from engine.texture.placed import oriented

Part = Selection | Outside
PartOf = Callable[[Part, int, Rect], "np.ndarray | float"]  # how far pixels of a level lie in it


@dataclass(frozen=True, eq=False, slots=True)
class Veil:
    """By how much a ply shows: `opacity`, through masks, in clips, and where (`within`) another has paint."""

    opacity: float = 1.0
    masks: tuple[Selection, ...] = ()
    seen: Seen | None = None
    within: Ply | None = None


CLEAR = Veil()


@dataclass(eq=False, slots=True)
class Ply:
    """Where paint lies that is looked at together, and while it is gone through, how much of each part of the place is
    `left` to be seen, how much is still `open` (no paint yet), and its `alpha`: float32 (h, w).

    `parent`: what it is a part of, seen through `by` (None: as it is, or `loose`: each for itself, by one number).
    `covers`: whether it hides what lies below; `atop`: it keeps the alpha of what it lies on; `silent`: only its alpha
    is wanted; `whole`: its gaze before that was divided into parts.
    """

    gaze: Gaze
    parent: Ply | None = None
    veil: Veil = CLEAR
    by: Similarity | None = None
    loose: bool = False
    covers: bool = True
    atop: bool = False
    silent: bool = False
    begun: bool = False
    whole: Gaze | None = None
    left: np.ndarray = field(default_factory=lambda: np.ones((1, 1), np.float32))
    open: np.ndarray = field(default_factory=lambda: np.ones((1, 1), np.float32))
    alpha: np.ndarray = field(default_factory=lambda: np.zeros((1, 1), np.float32))
    scale: np.ndarray = field(default_factory=lambda: np.ones((1, 1), np.float32))
    shows: np.ndarray = field(default_factory=lambda: np.ones((1, 1), np.float32))

    def begin(self, finer: int, part_of: PartOf) -> None:
        """Takes over from what lies above; the parts are so many levels finer than its gaze."""
        parent, self.whole = self.parent, self.gaze
        if parent is None or self.loose:
            self.gaze = self.gaze.finer(finer)
        elif self.by is None:
            self.gaze = parent.gaze
        else:
            level, rect = source_of(self.by, parent.gaze.level, parent.gaze.rect)
            self.gaze = Gaze(level, rect, oriented(parent.gaze.weights, self.by.inverse()))
        shape = self.gaze.weights.shape
        self.open, self.alpha = np.ones(shape, np.float32), np.zeros(shape, np.float32)
        self.left, scale = np.ones(shape, np.float32), np.ones(shape, np.float32)
        if parent is not None:
            if not self.silent or parent.silent:
                self.left = self._down(parent.left)
            scale = self._down(parent.scale)
        self.shows = self._shown(part_of)
        self.scale = scale * self.shows
        self.begun = True

    def end(self) -> None:
        """Lets what lies below show as far as it leaves it."""
        parent = self.parent
        if parent is None or (self.silent and not parent.silent):
            return
        hidden = self._up(self.alpha * self.shows)
        if self.covers:
            parent.left = parent.left * (1 - hidden)
        if not self.atop:
            parent.alpha = parent.alpha + hidden * parent.open
            parent.open = parent.open * (1 - hidden)

    def pixels(self, stroke_level: int) -> tuple[int, Rect, int]:
        """Returns the pixels in which a stroke's coverage is looked for, and how many parts there are along each: those
        of a stroke that is no finer than the place are not looked at in parts."""
        gaze, whole = self.gaze, self.whole
        if whole is not None and stroke_level <= whole.level:
            finer = gaze.level - whole.level
            if whole.rect.zoomed(finer) == gaze.rect:
                return whole.level, whole.rect, 1 << finer
        return gaze.level, gaze.rect, 1

    def shade(self, part: Part, outside: bool, part_of: PartOf) -> None:
        """Leaves of the paint below what lies in a part, or what does not."""
        found = part_of(part, self.gaze.level, self.gaze.rect)
        kept = 1 - found if outside else found
        self.left, self.open = self.left * np.float32(kept), self.open * np.float32(kept)

    def cover(self, alpha: np.ndarray) -> None:
        """Lays paint that is no stroke."""
        self.alpha = self.alpha + self.open * alpha
        self.open, self.left = self.open * (1 - alpha), self.left * (1 - alpha)

    @property
    def closed(self) -> bool:
        """Tells whether nothing more of it matters."""
        if not self.begun:
            return False
        most = float(self.scale.max())
        return max(float(self.left.max()), float(self.open.max()) if self.parent is not None else 0.0) * most < (
            LEAST_SHARE
        )

    def _down(self, values: np.ndarray) -> np.ndarray:
        """Returns values of the parent's parts as they lie on its own."""
        assert self.parent is not None
        if self.loose:
            weights = self.parent.gaze.weights
            mean = float((values * weights).sum()) / float(weights.sum())
            return np.full(self.gaze.weights.shape, mean, np.float32)
        return values if self.by is None else oriented(values, self.by.inverse())

    def _up(self, values: np.ndarray) -> np.ndarray:
        if self.loose:
            return np.full((1, 1), (values * self.gaze.weights).sum(), np.float32)
        return values if self.by is None else oriented(values, self.by)

    def _shown(self, part_of: PartOf) -> np.ndarray:
        veil, out = self.veil, np.full(self.gaze.weights.shape, self.veil.opacity, np.float32)
        for mask in veil.masks:
            out = out * np.float32(part_of(mask, self.gaze.level, self.gaze.rect))
        if veil.seen is not None and self.parent is not None:
            out = out * self._down(_unclipped(self.parent.gaze, veil.seen))
        return out if veil.within is None else out * veil.within.alpha * veil.within.shows


def _unclipped(gaze: Gaze, seen: Seen) -> np.ndarray:
    """Returns how much of each pixel of a gaze its clips leave."""
    part = seen.meets(gaze.level, gaze.rect)
    if part.empty:
        return np.zeros(gaze.weights.shape, np.float32)
    ones = np.ones((4, part.height, part.width), np.float32)
    found: np.ndarray = seen.clipped(ones, gaze.level, part, gaze.rect)[3]
    return found


@dataclass(frozen=True, eq=False, slots=True)
class BeginPly:
    """A ply's paint begins."""

    ply: Ply


@dataclass(frozen=True, eq=False, slots=True)
class EndPly:
    """A ply's paint ends."""

    ply: Ply


@dataclass(frozen=True, eq=False, slots=True)
class ShadePly:
    """Of what lies below in a ply, something was taken off."""

    ply: Ply
    part: Part
    outside: bool


@dataclass(frozen=True, eq=False, slots=True)
class CoverPly:
    """Paint that no stroke laid."""

    ply: Ply
    given: Given


Turn = BeginPly | EndPly | ShadePly | CoverPly
