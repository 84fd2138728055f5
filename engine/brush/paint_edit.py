"""Edits of mode "paint": A = 1 - M, B = M times the ink, M being the stroke's coverage on the grid.

Under alpha lock, colour is scaled by the alpha that lies there, and alpha itself stays as it is, bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from engine.brush import coat
from engine.brush.covered import Covered, Looks
from engine.brush.felt import is_dyed
from engine.brush.heading import FIRST_WAY, nearest_ways
from engine.brush.ink import Ink, Texture, resolve
from engine.brush.rim import rim_of_ink
from engine.brush.settings import Brush
from engine.brush.stamp import Stamp
from engine.brush.tinted_ink import TintedInk, tinted_ink
from engine.brush.wet_edit import wet_stamp
from engine.numeric.address import TILE, TileKey
from engine.texture.image import ImageSource
from engine.texture.planes import COLOURS, Planes
from engine.texture.record import Instance

_ALPHA = 3


@dataclass(frozen=True, eq=False)
class Painting(Covered):
    """Lays the ink over what is there; its amplitudes become ink planes."""

    _flat: dict[float | None, Stamp] = field(default_factory=dict, repr=False)

    @staticmethod
    def ink_of(brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int) -> Ink | None:
        """Returns the brush's ink, as `Covered.ink_of`."""
        return (tinted_ink if is_dyed(brush) else resolve)(brush, textures, level, seed)

    @staticmethod
    def looks(brush: Brush, ink: Ink | None) -> Looks:
        """At the pressure, at the rim, and at the way that the stroke runs, where the ink goes with it."""
        swayed = () if ink is None else ink.swayed
        rim = rim_of_ink(brush).width if any(one.rim is not None for one in swayed) else 0.0
        ways = any(one.way is not None for one in swayed)
        return Looks(pressure=any(one.hat is not None for one in swayed), rim=rim, ways=ways)

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns A and B of a tile, as `Edit.stamp`; None where nothing changes."""
        assert self.ink is not None
        if self.brush.wet is not None and self.coverage.tints is not None:
            wet = wet_stamp(self, key, old)
            return None if wet is None else self._stained(key, wet)
        covered = self.coverage.tiles.get(key)
        plain = not self.ink.loaded and not self.locked and self._dyed is None
        alike = covered if isinstance(covered, float) and plain else None
        if alike in self._flat:
            return self._flat[alike]
        keep = self.keep(key)
        if keep is None:
            return None
        parts, inks = self.ink.loaded, self.ink.inks
        if plain and not self.ink.swayed and self.coverage.stain is None:
            made = Stamp(keep, self.ink.base, plain=True)
            if alike is not None:
                self._flat[alike] = made
            return made
        add = np.empty((COLOURS + 3 * len(parts), TILE, TILE), np.float32)
        if self._dyed is not None and key in self._dyed:
            inks, add = self._tint(keep, key, old)
        elif self.ink.swayed:
            inks, add = self._sway(keep, key, old)
        elif self.locked:
            self._glaze(keep, key, old, add)
        elif parts:
            coat.load(keep, self.ink.field(key), self.ink.amplitudes, add)
        else:
            coat.lay(keep, self.ink.base, add)
        made = self._stained(key, Stamp(keep, add, inks, plain=True))
        if alike is not None:
            self._flat[alike] = made
        return made

    def _stained(self, key: TileKey, made: Stamp) -> Stamp:
        """Turns what the rim has another colour to that, in place."""
        stain = self.coverage.stain
        part = None if stain is None else stain.part(key)
        if stain is not None and part is not None:
            coat.stain(part, stain.colour, made.add)
        return made

    def _sway(self, keep: np.ndarray, key: TileKey, old: Planes) -> tuple[tuple[Instance, ...], np.ndarray]:
        """Returns the inks under the pen's pressure, and B."""
        assert self.ink is not None
        felt = self.scene.pressure
        pressure = felt.on_grid(key) if felt is not None else np.ones((TILE, TILE), np.float32)
        rim, covered = None, self.scene.covered
        if covered is not None:
            within = rim_of_ink(self.brush)
            rim = within.depths(within.around(covered.tiles, key))
        ways = FIRST_WAY if self.scene.ways is None else nearest_ways(self.scene.ways.get(key))
        return self._varied(keep, old, self.ink.under(key, pressure, rim, ways))

    @property
    def _dyed(self) -> Mapping[TileKey, np.ndarray] | None:
        """Gives the tints of dabs, or where their textures lie if they have none of their own; None if nothing is laid
        under tints."""
        if self.coverage.tints is not None:
            return self.coverage.tints
        return self.coverage.places if isinstance(self.ink, TintedInk) else None

    def _tint(self, keep: np.ndarray, key: TileKey, old: Planes) -> tuple[tuple[Instance, ...], np.ndarray]:
        """Returns the inks under the dabs' tints, and B."""
        assert isinstance(self.ink, TintedInk)
        tints, places = (self.coverage.tints or {}).get(key, self.ink.untinted), (self.coverage.places or {}).get(key)
        inks = self.ink.inks_under(places)
        add = np.empty((COLOURS + 3 * len(inks), TILE, TILE), np.float32)
        weight = coat.weigh(keep, old.data[_ALPHA], self.locked, add[_ALPHA])
        self.ink.lay(key, tints, places, weight, add)
        return inks, add

    def _varied(
        self, keep: np.ndarray, old: Planes, under: tuple[np.ndarray, np.ndarray, tuple[Instance, ...]]
    ) -> tuple[tuple[Instance, ...], np.ndarray]:
        """Returns the inks, and B, of a colour and amplitudes that differ from pixel to pixel, as `Ink.under` tells."""
        colour, planes, inks = under
        add = np.empty((COLOURS + len(planes), TILE, TILE), np.float32)
        weight = coat.weigh(keep, old.data[_ALPHA], self.locked, add[_ALPHA])
        coat.glaze(weight, colour, add[:_ALPHA])
        coat.glaze(weight, planes, add[COLOURS:])
        return inks, add

    def _glaze(self, keep: np.ndarray, key: TileKey, old: Planes, add: np.ndarray) -> None:
        """B under alpha lock: as `coat.load` and `coat.lay`, the paint weighed by the alpha that lies there."""
        assert self.ink is not None
        weight = coat.weigh(keep, old.data[_ALPHA], True, add[_ALPHA])
        if self.ink.loaded:
            coat.glaze(weight, self.ink.field(key), add[:_ALPHA])
        else:
            coat.wash(weight, self.ink.base, add[:_ALPHA])
        for i, part in enumerate(self.ink.loaded):
            coat.wash(weight, part.amplitude, add[COLOURS + 3 * i : COLOURS + 3 * i + 3])
