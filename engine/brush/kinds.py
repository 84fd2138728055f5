"""What a stroke does where it covers: the table of modes, each an edit of the form v' = snap(A v) + B.

A = 1 - M everywhere, M being the stroke's coverage on the grid.  Painting adds M times the ink, erasing nothing,
smoothing M times the mean of what lies around.  Under alpha lock, colour is scaled by the alpha that lies there, and
alpha itself stays as it is, bit for bit.  Raster-ops, whose A is another, have a module of their own.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from engine.brush import coat
from engine.brush.checks import BrushError
from engine.brush.covered import Covered, Read
from engine.brush.ink import Ink
from engine.brush.mask import Coverage, StrokeMask
from engine.brush.raster import Raster, Scene
from engine.brush.relief import Relief
from engine.brush.settings import Brush
from engine.brush.stamp import Edit, Stamp
from engine.numeric.address import TILE, TileKey
from engine.texture.planes import COLOURS, Planes
from engine.texture.record import Instance

REACH_CAP = 32  # px: how far on each side a pass of smoothing looks
_ALPHA = 3


@dataclass(frozen=True, eq=False)
class _Covered(Covered):
    """What the modes share that have A = 1 - M."""

    pressure: Coverage | None = None  # the strongest that went over each pixel, where the ink goes with it
    _flat: dict[float | None, Stamp] = field(default_factory=dict, repr=False)

    @property
    def spares_alpha(self) -> bool:
        return self.locked

    def _keep(self, key: TileKey) -> np.ndarray | None:
        """A of a tile, or None where nothing is covered."""
        covered = self.coverage.tiles.get(key)
        if covered is None:
            return None
        keep = np.empty((TILE, TILE), np.float32)
        if not isinstance(covered, np.ndarray):
            keep[...] = 1.0 - np.rint(covered * 65536.0) / 65536.0
            return keep if keep[0, 0] < 1.0 else None
        return keep if coat.keep_of(covered, keep) else None


class Painting(_Covered):
    """Lays the ink over what is there; its amplitudes become ink planes."""

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        assert self.ink is not None
        covered = self.coverage.tiles.get(key)
        alike = covered if isinstance(covered, float) and not self.ink.loaded and not self.locked else None
        if alike in self._flat:
            return self._flat[alike]
        keep = self._keep(key)
        if keep is None:
            return None
        parts, inks = self.ink.loaded, self.ink.inks
        add = np.empty((COLOURS + 3 * len(parts), TILE, TILE), np.float32)
        if self.ink.swayed:
            inks, add = self._sway(keep, key, old)
        elif self.locked:
            self._glaze(keep, key, old, add)
        elif parts:
            coat.load(keep, self.ink.field(key), self.ink.amplitudes, add)
        else:
            coat.lay(keep, self.ink.base, add)
        stain = self.coverage.stain
        part = None if stain is None else stain.part(key)
        if stain is not None and part is not None:
            coat.stain(part, stain.colour, add)
        made = Stamp(keep, add, inks, plain=True)
        if alike is not None:
            self._flat[alike] = made
        return made

    def _sway(self, keep: np.ndarray, key: TileKey, old: Planes) -> tuple[tuple[Instance, ...], np.ndarray]:
        """The inks under the pen's pressure, and B."""
        assert self.ink is not None
        pressure = self.pressure.on_grid(key) if self.pressure is not None else np.ones((TILE, TILE), np.float32)
        colour, planes, inks = self.ink.under(key, pressure)
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


class Erasing(_Covered):
    """Takes away colour, alpha, ink and all finer detail.  Under alpha lock there is nothing it may take."""

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        keep = None if self.locked else self._keep(key)
        return None if keep is None else Stamp(keep, _NOTHING, plain=True)


class Smoothing(_Covered):
    """Replaces what is there by its local mean at the stroke's level, and removes ink, and so all finer detail.

    The mean is over a window in proportion to the radius: two passes of a box that reaches a quarter of the radius,
    at most 32 px, to each side (Perlin & Velho 1995, section 6.1).
    """

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        assert self.read is not None
        keep = self._keep(key)
        if keep is None:
            return None
        reach = min(max(round(self.brush.radius / 4.0), 1), REACH_CAP)
        around = self.read(key.rect.grown(2 * reach)).data[:COLOURS]
        mean = coat.local_mean(np.ascontiguousarray(around), reach)
        add = np.empty((COLOURS, TILE, TILE), np.float32)
        if self.locked:
            np.divide(mean[:_ALPHA], mean[_ALPHA], out=mean[:_ALPHA], where=mean[_ALPHA] > 0.0)
        weight = coat.weigh(keep, old.data[_ALPHA], self.locked, add[_ALPHA])
        coat.glaze(weight, mean[:_ALPHA], add[:_ALPHA])
        if not self.locked:
            coat.glaze(weight, mean[_ALPHA:], add[_ALPHA:])
        return Stamp(keep, add, plain=True)


_NOTHING = np.zeros((COLOURS, TILE, TILE), np.float32)


@dataclass(frozen=True, slots=True)
class Mode:
    """A row of the table: what the mode is called, what it does, and the class of its edits; None if it makes none,
    since it grows."""

    name: str
    label: str
    tooltip: str
    edit: type[Painting] | type[Erasing] | type[Smoothing] | type[Raster] | None


MODES: dict[str, Mode] = {
    row.name: row
    for row in (
        Mode("paint", "Paint", "Lays paint over what is there", Painting),
        Mode("erase", "Erase", "Takes away paint and the detail under it", Erasing),
        Mode("smooth", "Smooth", "Blurs, and removes the detail that zooming in would show", Smoothing),
        Mode("raster", "Raster operation", "Changes the colour that is there", Raster),
        Mode("example", "Example", "Grows a texture like an example, rim included", None),
    )
}


def check(brush: Brush, where: str = "brush") -> None:
    """BrushError, naming the field, if the brush lacks what its mode needs."""
    if brush.mode == "example" and brush.example is None:
        raise BrushError(f"{where}.example", "none", "the name of a texture of the maker example")


def edit(
    brush: Brush,
    mask: StrokeMask | Coverage,
    ink: Ink | None,
    alpha_locked: bool = False,
    read: Read | None = None,
    relief: Relief | None = None,
    scene: Scene | None = None,
) -> Edit:
    """The edit that a stroke makes: `mask` as it is now, whatever is painted later.

    `ink` (`ink.resolve`) is needed to paint; `read`, which gives the old values of any rectangle of the stroke's
    level, to smooth; `relief` (`relief.resolve`) thins the coverage; a raster-op takes
    `raster.mixture` for its ink, and looks at `scene`, as ink does that goes with the pressure.  BrushError if the
    brush's mode makes no edits.
    """
    coverage = mask.coverage() if isinstance(mask, StrokeMask) else mask
    if relief is not None:
        coverage = relief.over(coverage)
    made = MODES[brush.mode].edit
    if made is None:
        raise BrushError("brush.mode", f'"{brush.mode}"', "a mode that edits what is there")
    if made is Raster:
        return Raster(coverage, brush, ink, alpha_locked, read, scene or Scene())
    if made is Painting and scene is not None:
        return Painting(coverage, brush, ink, alpha_locked, read, scene.pressure)
    return made(coverage, brush, ink, alpha_locked, read)
