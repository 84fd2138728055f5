"""A source seen through placements: exactly where their similarity allows it, else sampled once.

Whatever stands between a layer and the canvas, placements in placements, becomes one similarity before a pixel is read,
so nothing is resampled twice.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace

import numpy as np

from engine.canvas.placing.clip import Clip, clipped, within
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.sampling import Picture, sampled, source_level
from engine.numeric.address import Rect
from engine.numeric.pyramid import reduce
from engine.numeric.similarity import IDENTITY, Similarity
from engine.texture.placed import oriented

_FINER = 2  # levels by which a source may be read finer, and averaged, where its move is by parts of pixels
_SURE, _FINEST = 192, 4200  # bits of c, and of t below level 0, that are kept of many turns in one another
_LEAST = -1.0  # log2 of the pixels along what is shown that count as none
_END = -32.0  # log2 of those of which no pixel holds 2^-60
_KEPT = 4096  # placements
_SMALL = 1 << 18  # pixels of a clipped source at its aligned level up to which that is done from any level


@dataclass(frozen=True, slots=True)
class Seen:
    """How a source is seen: through which similarity, and cut by which parts of it and of what shows it.

    `own`: the innermost of the clips, also where somebody else cuts by it.
    """

    similarity: Similarity = IDENTITY
    clips: tuple[Clip, ...] = ()
    repeats: bool = False  # whether a part of a source is repeated on the way
    own: Clip | None = None

    def of(self, placement: Placement) -> Seen:
        """Returns how a placement's source is seen where the placement itself is seen so."""
        if self is UNPLACED:
            return seen_first(placement)
        return self._then(placement)

    def _then(self, placement: Placement) -> Seen:
        similarity = placement.pose.similarity.then(self.similarity).cut(_SURE, _FINEST)
        clips, own = self.clips, self.own
        if placement.part is not None and not placement.repeat:
            own = Clip(placement.part, similarity)
            clips = own, *clips
        return Seen(similarity, clips, self.repeats or placement.repeat, own)

    def through(self, outer: Seen) -> Seen:
        """Returns how a source that is seen so within another is seen where that is seen as `outer`."""
        if outer is UNPLACED or self is UNPLACED:
            return self if outer is UNPLACED else outer
        similarity = self.similarity.then(outer.similarity).cut(_SURE, _FINEST)
        own = outer.own if self.own is None else self.own.through(outer.similarity)
        clips = (*(clip.through(outer.similarity) for clip in self.clips), *outer.clips)
        return Seen(similarity, clips, self.repeats or outer.repeats, own)

    @property
    def unclipped(self) -> Seen:
        """Gives the same where somebody else cuts by the clips."""
        return replace(self, clips=())

    @property
    def levels(self) -> int:
        """Gives how many levels finer the source is read."""
        quarter = self.similarity.quarter
        return self.similarity.like_levels if quarter is None else quarter[0]

    def finer(self, level: int) -> int | None:
        """Returns how many levels finer pixels of the source have to be averaged; None if it is sampled."""
        aligned = self.similarity.aligned_from
        if self.similarity.quarter is None:
            return None
        by = 0 if aligned is None else max(0, aligned - level)
        if by <= _FINER:
            return by
        small = self.own is not None and self.own.bounds(level + by).area <= _SMALL
        return by if small else None

    def whole(self, level: int) -> bool:
        """Tells whether pixels of a level are pixels of the source, or means of them: nothing is sampled."""
        return self.finer(level) is not None

    def vanishes(self, level: int) -> bool:
        """Tells whether what is seen is less than half a pixel wide; never of all of a source."""
        return self._narrower(level, _LEAST)

    def _narrower(self, level: int, log: float) -> bool:
        if self.own is None:
            return False
        part = self.own.part
        side = max(part.rect.width, part.rect.height).bit_length() - part.level
        return level + side + self.similarity.log_scale < log

    def ends(self, level: int) -> bool:
        """Tells whether what is seen is too small for any pixel to tell: there pictures that hold themselves end."""
        return self._narrower(level, _END)

    def meets(self, level: int, rect: Rect) -> Rect:
        """Returns the pixels of a rectangle that the clips leave."""
        return within(self.clips, level, rect)

    def clipped(self, pixels: np.ndarray, level: int, part: Rect, rect: Rect) -> np.ndarray:
        """Returns pixels of `part`, as far as the clips leave them, in their place in `rect`."""
        return set_in(clipped(pixels, self.clips, level, part), part, rect)


UNPLACED = Seen()


@functools.lru_cache(_KEPT)  # it is asked for by every tile of the screen
def seen_first(placement: Placement) -> Seen:
    """Returns how a placement's source is seen."""
    return UNPLACED._then(placement)


def looked_through(picture: Picture, level: int, rect: Rect, seen: Seen) -> np.ndarray | None:
    """Returns what is seen of a picture in a rectangle: float32 (4, h, w), not to be written to; None: nothing."""
    if seen is UNPLACED:
        return picture(level, rect)
    part = seen.meets(level, rect)
    if part.empty:
        return None
    finer = seen.finer(level)
    if finer is None:
        pixels = sampled(picture, seen.similarity, level, part, _beyond(seen, level))
    else:
        pixels = _turned(picture, seen.similarity, level + finer, part.zoomed(finer))
        for _ in range(finer):
            pixels = None if pixels is None else reduce(pixels)
    return None if pixels is None else seen.clipped(pixels, level, part, rect)


def looked_coarser(picture: Picture, level: int, rect: Rect, seen: Seen) -> np.ndarray | None:
    """As `looked_through`, of a picture of which only levels are asked for that are as much coarser as it is smaller:
    where the move is by parts of pixels it is sampled."""
    part = Rect(0, 0, 0, 0) if seen.vanishes(level) else seen.meets(level, rect)
    if part.empty:
        return None
    if seen.finer(level) == 0:
        pixels = _turned(picture, seen.similarity, level, part)
    else:
        pixels = sampled(picture, seen.similarity, level, part, _beyond(seen, level))
    return None if pixels is None else seen.clipped(pixels, level, part, rect)


def _beyond(seen: Seen, level: int) -> Rect | None:
    """Returns the pixels of the source's level that its own clip leaves."""
    if seen.own is None or seen.own.similarity != seen.similarity:
        return None
    own = seen.own.part
    return own.rect.zoomed(source_level(seen.similarity, level) - own.level)


def _turned(picture: Picture, similarity: Similarity, level: int, rect: Rect) -> np.ndarray | None:
    """Returns the source's very pixels that `rect` shows, turned as they are there; the move is by whole pixels."""
    assert similarity.quarter is not None
    levels, quarters = similarity.quarter
    back = similarity.inverse()
    found = picture(level + levels, back.shown(rect, level, level + levels))
    if found is None:
        return None
    return np.ascontiguousarray(oriented(found, similarity)) if quarters or similarity.mirror else found


def set_in(pixels: np.ndarray, part: Rect, rect: Rect) -> np.ndarray:
    """Returns pixels of a part of a rectangle on all of it, the rest empty."""
    if part == rect:
        return pixels
    out = np.zeros((4, rect.height, rect.width), np.float32)
    out[:, *part.slices(rect)] = pixels
    return out
