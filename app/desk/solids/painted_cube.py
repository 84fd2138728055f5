"""The voxels that the card shows of a solid with paint on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from app.desk.solids.shown_solid import Carved
    from engine.painting.layering.touch_command import Touch
    from engine.solids.solid_lookup import Lookup


def voxel_middles(sides: tuple[int, ...], chosen: np.ndarray | None = None) -> np.ndarray:
    """Returns the middles x, y, z of voxels of a cube of `sides` (z, y, x), of those `chosen` or of all: (N, 3)."""
    places = np.nonzero(np.ones(sides, bool) if chosen is None else chosen)
    return np.stack([(places[axis] + 0.5) / sides[axis] for axis in (2, 1, 0)], axis=-1)


def as_bytes(colours: np.ndarray) -> np.ndarray:
    """Returns colours as the card has them: uint8."""
    out: np.ndarray = np.rint(255.0 * np.clip(colours, 0.0, 1.0)).astype(np.uint8)
    return out


def painted_on(solid: Lookup, touches: tuple[Touch, ...]) -> Lookup:
    """Returns a solid with nothing on it but these strokes."""
    from engine.painting.layering.touch_command import VOXELS
    from engine.solids.painted.touching import Touched

    bare = solid.bare if isinstance(solid, Touched) else solid
    return Touched(bare, touches, VOXELS) if touches else bare


def painted_cube(solid: Lookup, plain: np.ndarray, touches: tuple[Touch, ...], held: Carved | None) -> np.ndarray:
    """Returns the voxels of a solid with strokes, whose bare ones are `plain`: worked out where these are others than
    those of `held`."""
    from engine.painting.layering.touch_command import VOXELS
    from engine.solids.painted.touching import Touched

    known = held if held is not None and held.plain is plain else None
    before = () if known is None else known.touches
    alike = next((n for n, (a, b) in enumerate(zip(before, touches, strict=False)) if a != b), None)
    alike = min(len(before), len(touches)) if alike is None else alike
    changed = before[alike:] + touches[alike:]
    out: np.ndarray = plain if known is None else known.cube
    if not changed:
        return out
    cells, sides = Touched(solid, changed, VOXELS).cells(), plain.shape[:3]
    near = [((np.arange(side) + 0.5) / side * len(cells)).astype(np.int64) for side in sides]
    chosen, out = cells[np.ix_(*near)], out.copy()
    out[chosen] = plain[chosen]
    if isinstance(solid, Touched):
        out[chosen] = as_bytes(solid.over(voxel_middles(sides, chosen), plain[chosen] / 255.0, 1.0 / max(sides)))
    return out
