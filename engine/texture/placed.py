"""A texture as a placement shows it: moved, mirrored, turned by quarters, larger or smaller by powers of two.

What a placement showed becomes paint without any arithmetic: its ink planes are turned, and refer to this.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.pyramid import reduce
from engine.numeric.similarity import Dyadic, Similarity
from engine.texture.record import Instance


def oriented(data: np.ndarray, similarity: Similarity) -> np.ndarray:
    """Returns pixels of a source, (..., h, w), as they lie where it is shown by quarter turns: a view."""
    assert similarity.quarter is not None
    found = data[..., ::-1, :] if similarity.mirror else data
    quarters = similarity.quarter[1]
    return np.rot90(found, -quarters, axes=(-2, -1)) if quarters else found


def as_placed(inner: Instance, similarity: Similarity, base: int) -> Instance:
    """Returns a texture as it is shown, with detail from above level `base` on; one that was placed before is placed
    by both similarities at once."""
    if isinstance(inner, PlacedInk):
        return PlacedInk(inner.inner, inner.similarity.then(similarity), base)
    return PlacedInk(inner, similarity, base)


@dataclass(frozen=True)
class PlacedInk:
    """`inner` through a similarity of quarter turns; its pixels are whole ones there from level `base` on."""

    inner: Instance
    similarity: Similarity
    base: int

    @cached_property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        c, t = self.similarity.c, self.similarity.t
        told = (c.x, c.y, c.e, t.x, t.y, t.e, int(self.similarity.mirror))
        return ("placed", self.base, told, self.inner.key)

    @property
    def source(self) -> object | None:
        """Returns the picture that the inner texture needs."""
        return getattr(self.inner, "source", None)

    @property
    def coloured(self) -> bool:
        """Tells whether the inner texture has colours of its own."""
        return bool(getattr(self.inner, "coloured", False))

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`; above the base the mean of the base's."""
        if level < self.base:
            return reduce(self.appearance(level + 1, rect.zoomed(1)))
        return self._turned(self.inner.appearance(level + self.levels, self._back(level, rect)))

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        if level <= self.base or rect.empty:
            return None
        found = self.inner.bandpass(level + self.levels, self._back(level, rect))
        return None if found is None else self._turned(found)

    @property
    def levels(self) -> int:
        """Gives how many levels finer the inner texture is read."""
        assert self.similarity.quarter is not None
        return self.similarity.quarter[0]

    def _back(self, level: int, rect: Rect) -> Rect:
        return self.similarity.inverse().shown(rect, level, level + self.levels)

    def _turned(self, data: np.ndarray) -> np.ndarray:
        return np.ascontiguousarray(oriented(data, self.similarity))


def similarity_of(told: object) -> Similarity | None:
    """Returns the similarity that a key tells; None if it tells none of quarter turns."""
    if not (isinstance(told, list | tuple) and len(told) == 7 and all(type(v) is int for v in told)):
        return None
    *numbers, mirror = told
    if max(map(abs, (numbers[2], numbers[5]))) > _FINEST or max(map(abs, numbers)) > _FARTHEST or mirror not in (0, 1):
        return None
    found = Similarity(Dyadic.of(*numbers[:3]), Dyadic.of(*numbers[3:]), bool(mirror))
    return found if found.quarter is not None else None


_FINEST, _FARTHEST = 1 << 14, 1 << 8300  # levels, and numbers, beyond which no placement lies
