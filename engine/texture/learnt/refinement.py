"""The octaves that maps add below a picture's own pixels: at most two, each from the one before and from noise.

Any rectangle holds the same bits: noise goes by place, and the rest by the pixels about a place.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.detail import cut, subtract_expanded
from engine.numeric.hashing import fold_key, hash_plane
from engine.texture.image import ImageSource
from engine.texture.learnt.kinds import LOOKED_ROUND
from engine.texture.learnt.maps import Maps, maps_of
from engine.texture.learnt.refining import refined

OCTAVES = 2  # a third dissolves what there is
_DOMAIN = 0x6C65726E  # "lern": tells these hashes from those of other textures


@dataclass(frozen=True, slots=True)
class Learning:
    """How a picture is refined: by `maps`, kept as a picture; `strength` 0..1 of what they add; how many `octaves`, 1
    or 2."""

    maps: ImageSource
    strength: float = 1.0
    octaves: int = OCTAVES

    @property
    def key(self) -> tuple[object, ...]:
        """Tells it from others; JSON-ready."""
        return (self.octaves, self.strength, self.maps.name, self.maps.sha)

    @property
    def there(self) -> int:
        """Counts the octaves that there are: none where the maps are not there."""
        return self.octaves if self.maps.there and maps_of(self.maps) is not None else 0

    def added(self, octave: int, rect: Rect, own: Callable[[Rect], np.ndarray]) -> np.ndarray:
        """Returns what octave 1 or 2 adds to the expanded one before: float32 (C, h, w), C being the maps'.

        `own`: gives the picture's own pixels, (C, h, w) in 0..1, over any rectangle."""
        even = rect.evened()
        return cut(self._below(octave, even, partial(self.seen, octave - 1, own=own))[0], rect, even)

    def seen(self, octave: int, rect: Rect, own: Callable[[Rect], np.ndarray]) -> np.ndarray:
        """Returns the picture with the octaves up to one: as `added`."""
        return self.seen_below(octave, rect, partial(self.seen, octave - 1, own=own)) if octave else own(rect)

    def seen_below(self, octave: int, rect: Rect, above: Callable[[Rect], np.ndarray]) -> np.ndarray:
        """Returns an octave below a picture: as `added`; `above` gives that picture."""
        even = rect.evened()
        added, coarse = self._below(octave, even, above)
        out = np.negative(added, out=added)
        subtract_expanded(out, coarse)
        return cut(np.negative(out, out=out), rect, even)

    def _below(self, octave: int, even: Rect, seen: Callable[[Rect], np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
        """Returns what is added over an even rectangle, and what is `seen` with the octaves before over its parents."""
        maps = maps_of(self.maps)
        assert maps is not None
        above = even.zoomed(-1)
        planes = np.ascontiguousarray(seen(above.grown(LOOKED_ROUND)))
        near = above.grown(1)
        hashes = hash_plane(_key(self.maps.sha, octave), near.x0, near.y0, near.width, near.height)
        out = refined(planes, hashes, maps, octave - 1)
        coarse = np.ascontiguousarray(
            planes[:, LOOKED_ROUND - 1 : 1 - LOOKED_ROUND, LOOKED_ROUND - 1 : 1 - LOOKED_ROUND]
        )
        subtract_expanded(out, coarse)
        out *= np.float32(self.strength)
        return out, coarse


UNLEARNT = Learning(ImageSource("", ""))


@lru_cache(maxsize=256)
def _key(sha: str, octave: int) -> int:
    return fold_key(_DOMAIN, octave, int.from_bytes(sha.encode(), "little"))


def channels_of(planes: np.ndarray, maps: Maps) -> np.ndarray:
    """Returns the planes that maps are for of grey, RGB or RGBA in 0..1."""
    if maps.channels == 4 and len(planes) < 4:
        colours = np.repeat(planes, 3, axis=0) if len(planes) == 1 else planes
        return np.concatenate([colours, np.ones_like(planes[:1])])
    if maps.channels == 3 and len(planes) == 1:
        return np.repeat(planes, 3, axis=0)
    return planes[: maps.channels]
