"""A texture sent through a shaping table: another texture, with detail of its own (Lewis 1984, section 6.1).

A curve v is no linear thing, so what a finer level adds is not v of what it adds to the texture itself.  It follows
from both appearances: with S_k the texture's, the shaped one is v(S_k), and its bandpass v(S_k) - E v(S_(k-1)).  An
edge that is sharp at every depth so stays sharp at every depth.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.numeric import shaping
from engine.numeric.address import Rect
from engine.numeric.curves import Shape
from engine.numeric.detail import cut, parents, subtract_expanded
from engine.texture.image import Image, ImageSource
from engine.texture.record import Instance

# A picture has no pixels of its own beyond its size: enlarged, it becomes smooth, and what a curve bends in it falls
# by half with every level.  So many levels later it is below the grid.
FADED = 24
# What lasts never ends, but differences of two numbers of float32 do.  So many levels below its base a texture that
# lasts varies little from pixel to pixel, and what it adds goes through the curve as through a straight line.
_NARROW = 10


@dataclass(frozen=True, slots=True)
class Shaped:
    """`inner` through `curve`: a name of CURVES, or knots.  Alpha, where the inner texture has it, stays as it is."""

    inner: Instance
    curve: Shape

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        return ("shaped", self.inner.base, self.curve, self.inner.key)

    @property
    def base(self) -> int:
        """Gives the inner texture's base level."""
        return self.inner.base

    @property
    def source(self) -> ImageSource | None:
        """Returns the picture that the inner texture needs."""
        return getattr(self.inner, "source", None)

    @property
    def coloured(self) -> bool:
        """Tells whether the inner texture has colours of its own."""
        return bool(getattr(self.inner, "coloured", False))

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`."""
        return self._shaped(self.inner.appearance(level, rect))

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        if level <= self.base or rect.empty:
            return None
        picture = unshaped(self)
        if isinstance(picture, Image) and level - self.base > picture.refinements + FADED:
            return None
        lasts = getattr(picture, "renew", True) is False and getattr(picture, "cover", None) is None
        if lasts and level - self.base > _NARROW:
            return self._narrowly(level, rect)
        even = rect.evened()
        fine = self.appearance(level, even)[:3]
        if not subtract_expanded(fine, self.appearance(level - 1, parents(even))[:3]):
            return None
        inner = cut(fine, rect, even)
        return inner if rect == even or inner.any() else None

    def _narrowly(self, level: int, rect: Rect) -> np.ndarray | None:
        """As `bandpass`, where it is what the level adds to the texture itself, times the curve's slope there."""
        added = self.inner.bandpass(level, rect)
        if added is None:
            return None
        seen = self.inner.appearance(level, rect)
        curve = shaping.table(self.curve)
        place = np.clip((seen + np.float32(1.0)) * np.float32(shaping.STEPS / 2), 0, shaping.STEPS - 1)
        slopes = np.diff(curve) * np.float32(shaping.STEPS)
        slope = np.where(np.abs(seen) < 1.0, slopes[place.astype(np.int32)], np.float32(0.0))
        out: np.ndarray = added * slope
        return out

    def _shaped(self, seen: np.ndarray) -> np.ndarray:
        curve = shaping.table(self.curve)
        if len(seen) != 4:
            return shaping.shape_signed(seen, curve)
        out = np.zeros_like(seen)
        alpha = seen[3]
        np.divide(seen[:3], alpha, out=out[:3], where=alpha > 0.0)
        out[:3] = shaping.shape(out[:3], curve) * alpha
        out[3] = alpha
        return out


def shaped(inner: Instance, *curves: Shape | None) -> Instance:
    """`inner` through the curves, one after the other; those that change nothing leave no trace."""
    for curve in curves:
        if curve is not None and not shaping.is_identity(curve):
            inner = Shaped(inner, curve)
    return inner


def unshaped(made: Instance) -> Instance:
    """Returns the texture itself, whatever curves it is sent through."""
    while isinstance(made, Shaped):
        made = made.inner
    return made
