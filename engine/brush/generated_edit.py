"""Edits of mode "generate": things laid by a written texture, whose alpha is their own coverage.

What lies below shows through where they are not, at every depth: how much of it they hide at a pixel is the amplitude
of their coverage, so that what is below is bright again between two leaves that one pixel held both of.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from engine.brush.checks import BrushError
from engine.brush.covered import Covered
from engine.brush.ink import Ink, Texture, named
from engine.brush.settings import Brush
from engine.brush.stamp import Stamp
from engine.numeric.address import TileKey
from engine.numeric.grid import SNAP
from engine.texture.expression.placing.generated import ALPHA_OF, COLOURS_OF, COVER_OF, Generated, LaidStroke
from engine.texture.expression.written_ink import Expression
from engine.texture.image import ImageSource
from engine.texture.planes import COLOURS, Planes, sort_key
from engine.texture.record import Instance

_ALPHA = 3
_ONE = np.float32(1.0)


def generators_of(
    brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int
) -> tuple[Expression, ...]:
    """Returns the written textures by which a brush places things.  BrushError if it has none, or others."""
    found = []
    for n, component in enumerate(brush.ink):
        where = f"brush.ink[{n}]"
        made = named(component, textures, level, seed, where)
        if not isinstance(made, Expression):
            raise BrushError(f"{where}.texture", ascii(component.texture), "a written texture, which places things")
        if component.amount > 0.0:
            found.append(made)
    if not found:
        raise BrushError("brush.ink", "nothing", "a written texture, which places things")
    return tuple(found)


@dataclass(frozen=True, eq=False)
class Generating(Covered):
    """Lays what generators made of a stroke, one after another, over what is there."""

    laid: tuple[LaidStroke, ...] = ()

    @staticmethod
    def ink_of(brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int) -> Ink | None:
        """Returns plain ink: the things have their own colours."""
        generators_of(brush, textures, level, seed)
        return Ink(np.array(brush.rgb, np.float32))

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns A and B of a tile, as `Edit.stamp`; None where nothing changes."""
        covered = self.coverage.tiles.get(key)
        if covered is None or (isinstance(covered, float) and covered == 0.0):
            return None
        part = np.empty(key.rect.height * key.rect.width, np.float32).reshape(key.rect.height, key.rect.width)
        part[...] = _snapped(np.asarray(covered, np.float32))
        now = Growing(old.rgba.copy(), np.ones_like(part), {})
        for laid in self.laid:
            rect = laid.rect(key.level).grown(_AROUND).intersect(key.rect)
            if not rect.empty:
                now.lay(laid, laid.means(key.level, key.rect), part, self.locked)
        if not now.planes:
            return None
        inks = tuple(sorted(now.planes, key=lambda ink: sort_key(ink.key)))
        add = np.empty((COLOURS + 3 * len(inks), *part.shape), np.float32)
        add[:COLOURS] = now.rgba - _snapped(now.keep * old.rgba)
        for n, ink in enumerate(inks):
            add[COLOURS + 3 * n : COLOURS + 3 * n + 3] = now.planes[ink]
        return Stamp(now.keep, add, inks)


@dataclass(eq=False, slots=True)
class Growing:
    """A tile while things are laid: its colours, how much is left of what was there, and what each ink has."""

    rgba: np.ndarray
    keep: np.ndarray
    planes: dict[Instance, np.ndarray]

    def lay(self, laid: LaidStroke, seen: np.ndarray, part: np.ndarray, locked: bool) -> None:
        """Lays what a stroke made, as far as `part` goes; under alpha lock, as far as there is alpha."""
        weight = _snapped(part * self.rgba[_ALPHA]) if locked else part
        if not seen[_ALPHA].any():
            return
        left = _ONE - _snapped(part * seen[_ALPHA])
        for ink, planes in self.planes.items():
            self.planes[ink] = _snapped(left * planes)
        below = self.rgba
        self._add(Generated(laid, COLOURS_OF), np.broadcast_to(weight, (3, *part.shape)))
        self._add(Generated(laid, COVER_OF), -_snapped(part * below[:_ALPHA]))
        if not locked:
            alpha = np.zeros((3, *part.shape), np.float32)
            alpha[0] = _snapped(part * (_ONE - below[_ALPHA]))
            self._add(Generated(laid, ALPHA_OF), alpha)
        self.rgba = _snapped(left * below) + _snapped(weight * seen)
        if locked:
            self.rgba[_ALPHA] = below[_ALPHA]
        self.keep = _snapped(self.keep * left)

    def _add(self, ink: Generated, planes: np.ndarray) -> None:
        if planes.any():
            self.planes[ink] = np.array(planes, np.float32)


_AROUND = 4  # pixels around what shows in which finer levels may differ


def _snapped(values: np.ndarray) -> np.ndarray:
    out: np.ndarray = (values + SNAP) - SNAP
    return out
