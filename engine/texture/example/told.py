"""What control channels tell of a region: planes beside its masks, the finest level first, and in windows."""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect
from engine.texture.example import tiles
from engine.texture.example.control import Control, counts, halved_planes, rim_of, stored_channels
from engine.texture.example.region_value import Region
from engine.texture.example.tiles import NONE, Tiles, sealed

_ALL = slice(None)
_NOTHING = np.zeros((0, 0, 0), np.uint8)


def told_laid(
    told: tuple[Tiles, ...], whole: Rect, masks: list[np.ndarray], at: tuple[Rect, np.ndarray], values: np.ndarray
) -> tuple[Tiles, ...]:
    """Returns planes of all levels with `values`, uint8 (C, h, w), at pixels `at`: a rectangle and bool (h, w) of it;
    `masks`: what of `whole`, and of the same place at coarser levels, belongs to the region now; all else is 0."""
    rect, pixels = at
    held = tiles.gathered(told[0], whole, np.zeros((len(values), whole.height, whole.width), np.uint8))
    part = held[:, *rect.slices(whole)]
    part[:, pixels] = values[:, pixels]
    held *= masks[0] > 0
    found = []
    for n, old in enumerate(told):
        if n:
            whole, held = whole.zoomed(-1), halved_planes(held, masks[n - 1] > 0)
        found.append(tiles.laid(old, whole, held, 0, whole))
    return tuple(found)


def coarser(told: Tiles, masks: Tiles) -> Tiles:
    """Returns what channels tell a level coarser, of a region with these masks: as `told_laid` has it."""
    found = NONE.mutate()
    for row, column in sorted({(y >> 1, x >> 1) for y, x in told}):
        rect = tiles.rect_of((row, column)).zoomed(1)
        some = next(iter(told.values())).data
        planes = tiles.gathered(told, rect, np.zeros((len(some), rect.height, rect.width), np.uint8))
        mask = tiles.gathered(masks, rect, np.zeros((1, rect.height, rect.width), np.uint8))[0]
        made = halved_planes(planes, mask > 0)
        if made.any():
            found[row, column] = sealed(made)
    return found.finish()


def altered(region: Region, n: int, masks: Rect) -> Rect:
    """Returns the smallest rectangle around what channels tell otherwise than when the level was refined, `masks` being
    that around what has joined or left the region since."""
    control = region.exemplar.control
    if control is None:
        return Rect(0, 0, 0, 0)
    found = Rect(0, 0, 0, 0)
    if region.told:
        for rect in tiles.changed_rects(region.levels[n].told, region.told[n], 0, _ALL):
            found = found.union(rect)
    if masks.empty or not _rim(control, n, len(region.levels)):
        return found
    around = masks.grown(rim_spread(control, n))
    now, before = region.both_masks(n, around.grown(rim_spread(control, n)))
    inner = around.slices(around.grown(rim_spread(control, n)))
    far = [rim_of(one, control.width, n)[inner] for one in (now, before)]
    y0, y1, x0, x1 = tiles.bounds((far[0] ^ far[1])[None])
    rims = Rect(around.x0 + x0, around.y0 + y0, around.x0 + x1, around.y0 + y1)
    return found if rims.empty else found.union(rims)


def rim_spread(control: Control, n: int) -> int:
    """Tells how far a pixel that joins or leaves a region can be seen in its rim at a level."""
    return (control.width >> n) + 2 if control.width else 0


def rim_reach(region: Region, n: int) -> int:
    """As `rim_spread`, of a region; 0 where its rim does not count."""
    control = region.exemplar.control
    return rim_spread(control, n) if control is not None and _rim(control, n, len(region.levels)) else 0


def _rim(control: Control, n: int, levels: int) -> bool:
    return control.width > 0 and counts(n, levels)


def told_within(region: Region, n: int, rect: Rect) -> tuple[np.ndarray, np.ndarray]:
    """Returns what channels tell of a rectangle of a level, now and when it was refined: uint8 (C, h, w)."""
    control = region.exemplar.control
    if control is None:
        return _NOTHING, _NOTHING
    count = control.stored
    out = np.zeros((2, len(control.channels), rect.height, rect.width), np.uint8)
    if region.told:
        tiles.gathered(region.told[n], rect, out[0, :count])
        tiles.gathered(region.levels[n].told, rect, out[1, :count])
    if _rim(control, n, len(region.levels)):
        wide = rect.grown(rim_spread(control, n))
        for planes, mask in zip(out, region.both_masks(n, wide), strict=True):
            planes[-1] = rim_of(mask, control.width, n)[rect.slices(wide)]
    return out[0], out[1]


def translated(one: Region, other: Region, key: tuple[int, int]) -> np.ndarray | None:
    """Returns what another region's stored channels tell of a tile where it takes the place of one: what channels of
    the same name told there, else what they usually tell; None where there are none."""
    control, before = other.exemplar.control, one.exemplar.control
    if control is None or not control.stored:
        return None
    out = np.empty((control.stored, tiles.TILE_SIDE, tiles.TILE_SIDE), np.uint8)
    out[:] = np.array(control.usual, np.uint8)[:, None, None]
    held = one.told[0].get(key) if one.told else None
    for n, channel in enumerate(stored_channels(control.channels)):
        known = None if before is None else before.index(channel.name)
        if known is not None and held is not None:
            out[n] = held.data[known]
    return out
