"""The pixels of a painting that are like one: what a fill covers, and what the wand selects."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from engine.brush.mask import Coverage
from engine.canvas.composite import composite
from engine.canvas.layers import Group
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.enclosures import enclosed, enclosed_all
from engine.canvas.selecting.occupied import raster
from engine.canvas.selecting.outlines import outlined
from engine.canvas.selecting.rims import tiled
from engine.canvas.tile_cache import TileCache
from engine.numeric import flood
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.torus_flood import region_around
from engine.painting.fill_command import LOOKED_AT_CAP, Like
from engine.painting.grown import settled_alone, settled_root
from engine.painting.layering.placing_members import Same
from engine.painting.value import Leak, Painting, Refusal, Unclosed


def alike(painting: Painting, like: Like, open_too: bool, cache: TileCache | None, what: str = "fill") -> Coverage:
    """Returns how much of each pixel of the region's level is in the region, 0..1.

    Refusal if its place lies outside what is looked at, or that is too large; Leak if the region reaches the border of
    that and is not meant to.
    """
    looked_at = like.looked_at
    rect = painting.frame.zoomed(like.level) if looked_at is None else looked_at
    x, y = like.at[0] - rect.x0, like.at[1] - rect.y0
    if not (0 <= x < rect.width and 0 <= y < rect.height):
        raise Refusal(f"{what}.like.at: found {like.at[0]}, {like.at[1]}, expected a pixel of {_told(rect)}")
    if rect.area > LOOKED_AT_CAP:
        raise Refusal(f"{what}.like.rect: found {_told(rect)}, expected at most {LOOKED_AT_CAP} pixels")
    if like.within is not None and like.regions == "line":
        return outlined(like.level, like.at, np.array(like.within), f"{what}.like.within")
    picture = _picture(painting, like, rect, cache)
    if like.within is not None:
        return _coverage(like.level, rect, _enclosed(like, rect, picture, what))
    found = flood.region(picture, x, y, flood.Likeness(like.tolerance, like.gap, like.contiguous))
    if found.open and not open_too:
        raise Leak(f"{what}: found a region that reaches the border of {_told(rect)}, expected one within, or open")
    return _coverage(like.level, rect, found)


def alike_around(painting: Painting, like: Like, cell: Rect, cache: TileCache | None) -> Coverage:
    """As `alike`, on a picture of a cell that repeats without end: a region that leaves the cell goes on at its other
    side, and nothing bounds it."""
    (x, y), (width, height) = like.at, (cell.width, cell.height)
    place = Rect.at(x - (x - cell.x0) % width, y - (y - cell.y0) % height, width, height)
    picture = _picture(painting, like, place, cache)
    likeness = flood.Likeness(like.tolerance, like.gap, like.contiguous)
    return tiled(like.level, place, region_around(picture, x - place.x0, y - place.y0, likeness))


def _enclosed(like: Like, rect: Rect, picture: np.ndarray, what: str) -> flood.Region:
    """Returns the regions of a picture of a rectangle that lie wholly within the line.  Refusal if there is none."""
    inside = _inside(like, rect, what)
    if like.regions == "all":
        found = enclosed_all(picture, inside, like.tolerance)
    else:
        colour = picture[:, like.at[1] - rect.y0, like.at[0] - rect.x0].copy()
        if like.regions == "empty":
            colour[:] = 0.0
        found = enclosed(picture, inside, colour, flood.Likeness(like.tolerance, like.gap))
    if not found.covered.any():
        raise Unclosed(f"{what}: found nothing closed that lies within the line, expected a region or more")
    return found


def _inside(like: Like, rect: Rect, what: str) -> np.ndarray:
    """Returns the pixels of a rectangle of which the line goes round a half at least: bool (h, w)."""
    line = outlined(like.level, like.at, np.array(like.within), f"{what}.like.within")
    return raster(line, rect) >= np.float32(0.5)


def kept_within(like: Like, region: Coverage) -> Coverage:
    """Returns what of a region lies within the line that is told, all of it where there is none."""
    if like.within is None:
        return region
    rect = region.rect
    return tiled(region.level, rect, np.where(_inside(like, rect, "fill"), raster(region, rect), np.float32(0.0)))


def _told(rect: Rect) -> str:
    return f"{rect.width} x {rect.height} at {rect.x0}, {rect.y0}"


def _picture(painting: Painting, like: Like, rect: Rect, cache: TileCache | None) -> np.ndarray:
    """Returns what is looked at: float32 (4, h, w), premultiplied, with examples grown to the end."""
    name = painting.active if isinstance(like.of, Same) else like.of
    if isinstance(like.of, Same) and name is None:
        return np.zeros((4, rect.height, rect.width), np.float32)
    root: Group = settled_root(painting.root) if name is None else settled_alone(painting.root, name)
    return composite(root, like.level, rect, partial(layer_planes, cache=cache))


def _coverage(level: int, rect: Rect, found: flood.Region) -> Coverage:
    """Returns a region as coverage of tiles of a level."""
    own = Rect(found.rect.x0 + rect.x0, found.rect.y0 + rect.y0, found.rect.x1 + rect.x0, found.rect.y1 + rect.y0)
    tiles: dict[TileKey, np.ndarray | float] = {}
    for key in own.tiles(level):
        part = key.rect.intersect(rect)
        piece = found.covered[part.slices(rect)]
        if part == key.rect and float(piece.min()) == 1.0:
            tiles[key] = 1.0
        elif piece.any():
            tile = tiles[key] = np.zeros((TILE, TILE), np.float32)
            tile[part.slices(key.rect)] = piece
    return Coverage(level, tiles, own)


def thinned(coverage: Coverage, opacity: float) -> Coverage:
    """Returns a coverage times an opacity, 0..1."""
    if opacity == 1.0:
        return coverage
    factor = np.float32(opacity)
    tiles: dict[TileKey, np.ndarray | float] = {}
    for key, tile in coverage.tiles.items():
        tiles[key] = tile * factor if isinstance(tile, np.ndarray) else float(tile * factor)
    return replace(coverage, tiles=tiles)


def taken(coverage: Coverage) -> np.ndarray:
    """Returns the pixels of its rectangle that a coverage covers by a half at least: bool (h, w)."""
    rect = coverage.rect
    out = np.zeros((rect.height, rect.width), np.bool_)
    for key, tile in coverage.tiles.items():
        part = key.rect.intersect(rect)
        inside = tile[part.slices(key.rect)] if isinstance(tile, np.ndarray) else np.float32(tile)
        out[part.slices(rect)] = inside >= np.float32(0.5)
    return out
