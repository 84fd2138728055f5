"""A brush's textures mixed to one number a pixel, as raster-ops take them."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import numpy as np

from engine.brush import sway, tones
from engine.brush.ink import Ink, Texture, refuse_ways, resolve
from engine.brush.settings import Brush
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.memo import remembered
from engine.texture.image import ImageSource
from engine.texture.record import Instance

ONES = np.ones((TILE, TILE), np.float32)  # of a brush without textures
LUMA = np.array(tones.LUMA, np.float32)


def mixture(brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int) -> Ink:
    """Returns the brush's textures mixed to one number, sum a_i s_i: the ink that they would be in white over black;
    those that go with the pressure are as at full pressure."""
    ink = tuple(replace(sway.still(part, textures), colour="#ffffff") for part in brush.ink)
    made = resolve(replace(brush, colour="#000000", ink=ink), textures, level, seed)
    return refuse_ways(made, f"another in mode {brush.mode}: a direction is for paint")


@dataclass(frozen=True, eq=False)
class Mixture:
    """What `mixture` made of a brush, as it is seen at one level; `ink` is None for a brush without textures."""

    ink: Ink | None
    level: int

    @property
    def inks(self) -> tuple[Instance, ...]:
        """Returns the textures, sorted by key."""
        return () if self.ink is None else self.ink.inks

    def tile(self, key: TileKey) -> np.ndarray:
        """Returns the mixture over a tile, not cut off: float32 (128, 128), not to be written to."""
        if self.ink is None:
            return ONES
        seen = self.ink.field(key)
        grey: np.ndarray = seen[0] if self._grey else np.einsum("chw,c->hw", seen, LUMA)
        return grey

    def over(self, rect: Rect) -> np.ndarray:
        """As `tile`, cut to 0..1, over any rectangle: float32 (h, w)."""
        if self.ink is None:
            return np.ones((rect.height, rect.width), np.float32)
        out = np.broadcast_to(self.ink.base[:, None, None], (3, rect.height, rect.width)).copy()
        for part in self.ink.loaded:
            out += part.amplitude[:, None, None] * part.instance.appearance(self.level, rect)[:3]
        luma: np.ndarray = np.clip(np.einsum("chw,c->hw", out, LUMA), 0.0, 1.0)
        return luma

    def gains(self, inks: tuple[Instance, ...]) -> np.ndarray:
        """Returns what one unit of each ink adds to the mixture, float32 (n,); 0 for those that are not the brush's,
        or are coloured."""
        own = {part.instance: part.amplitude[0] for part in self.ink.loaded} if self.ink is not None else {}
        # Others may have been painted finer: they have no appearance at this level.
        gains = [own[made] if made in own and _single(cast(Hashable, made), self.level) else 0.0 for made in inks]
        return np.array(gains, np.float32)

    @cached_property
    def _grey(self) -> bool:
        assert self.ink is not None
        return all(_single(cast(Hashable, part.instance), self.level) for part in self.ink.loaded)


@remembered
def _single(made: Hashable, level: int) -> bool:
    """Tells whether a texture has one number a pixel."""
    return len(cast(Instance, made).appearance(level, Rect(0, 0, 1, 1))) == 1
