"""Show a painting as land, or write its heights: OUT's ending decides. .png: a picture, or, with --for, a height map as
.exr and .tif are, with OUT.json beside it; .glb, .stl: a mesh."""

from __future__ import annotations

import argparse
import os
import sys
from typing import TYPE_CHECKING

from app.cli.arguments import rectangle
from app.cli.landscape.land_view import declare_picture, number, positive, refuse_picture, wet, write_land_view
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output, grown, opened_painting, rect_of
from app.cli.progress import Progress

if TYPE_CHECKING:
    from engine.numeric.address import Rect
    from engine.painting.value import Painting
    from engine.terrain.height_window import Relief
    from engine.terrain.plane import Land

MAPS, MESHES, PNG = (".exr", ".tif", ".tiff"), (".glb", ".stl"), ".png"
TARGETS = ("godot", "unreal", "unity", "blender", "gis")
ERROR = 0.5  # pixels that a mesh errs by if nothing is said
HEIGHT = "Height"  # the layer that heights are of, if nothing is said and none has that role


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("painting", metavar="PAINTING.ora")
    parser.add_argument("out", metavar="OUT", help=" ".join((PNG, *MAPS, *MESHES)))
    parser.add_argument("--rect", type=rectangle, metavar="L,X,Y,W,H", help="level, and rectangle in its pixels")
    what = "whose brightness is the height: a layer, or composite, alpha (default: the layer Height, else composite)"
    parser.add_argument("--height", metavar="LAYER", help=what)
    parser.add_argument("--scale", type=number, metavar="S", help="pixels of level 0 from black to white")
    parser.add_argument("--sea", type=number, metavar="H", help="brightness at which the water lies, 0 to 1")
    parser.add_argument("--for", dest="target", choices=TARGETS, help="a height map for this program")
    metres = "metres of a pixel of the rectangle's level (default 1)"
    parser.add_argument("--metres-per-pixel", type=positive, default=1.0, metavar="M", help=metres)
    declare_picture(parser)
    error = f"pixels by which a mesh may be off (default {ERROR})"
    parser.add_argument("--error", type=positive, metavar="E", help=error)
    triangles = "as fine a mesh as so many let it be, walls and base included"
    parser.add_argument("--triangles", type=int, metavar="N", help=triangles)
    base = "pixels of the base below the lowest point; an .stl has one in any case"
    parser.add_argument("--base", type=positive, metavar="T", help=base)


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    ending = checked_output(options.out, (PNG, *MAPS, *MESHES)) or ""
    _check(options, ending)
    found = opened_painting(options.painting)
    painting = grown(options.painting, found)
    land = _land(options, painting)
    if ending == PNG and options.target is None:
        write_land_view(options, land, _place(options, painting))
    elif ending in MESHES:
        _mesh(options, land, ending)
    else:
        _map(options, land)
    print(f"wrote {options.out}")
    return DONE


def _check(options: argparse.Namespace, ending: str) -> None:
    """Refuses options that do not go together, before anything is opened."""
    if os.path.exists(options.out) and os.path.samefile(options.painting, options.out):
        raise Refused(f"{options.out}: found the painting itself, expected another file to write to")
    mesh = ending in MESHES
    for name in ("error", "triangles", "base"):
        if getattr(options, name) is not None and not mesh:
            raise Refused(f"--{name}: found it for {ending}, expected it for .glb or .stl")
    if options.error is not None and options.triangles is not None:
        raise Refused("--triangles: found it with --error, expected one of them")
    if options.target is not None and mesh:
        raise Refused(f"--for: found it for {ending}, expected it for .exr, .tif or .png")
    if options.target is not None or ending != PNG:
        refuse_picture(options, ending)
    if options.target is None and ending in MAPS:
        raise Refused(f"{options.out}: found no --for, expected one of {', '.join(TARGETS)}")


def _land(options: argparse.Namespace, painting: Painting) -> Land:
    from engine.canvas.layers import has
    from engine.canvas.node_checks import LayerError
    from engine.canvas.tile_cache import TileCache
    from engine.terrain.plane import heights_of, land

    source = options.height
    if source is None and heights_of(painting) is None and has(painting.root, HEIGHT):
        source = HEIGHT
    try:
        return land(painting, source, options.scale, options.sea, cache=TileCache(64 << 20))
    except LayerError as error:
        raise Refused(f"--height: {error}") from None


def _place(options: argparse.Namespace, painting: Painting) -> tuple[int, Rect]:
    return (0, painting.frame) if options.rect is None else rect_of(options.rect)


def _relief(options: argparse.Namespace, land: Land, level: int, rect: Rect) -> Relief:
    from engine.terrain.height_window import relief

    with Progress("heights", 100) as tell:
        try:
            return relief(land, level, rect, tell.part)
        except ValueError as error:
            raise Refused(f"--rect: {error}") from None


def _map(options: argparse.Namespace, land: Land) -> None:
    from engine.files.spatial.sidecar import misfit
    from engine.terrain.outputs import write_map

    level, rect = _place(options, land.painting)
    note = misfit(options.target, (rect.width, rect.height))
    if note:
        print(f"inkfall: --rect: {note}", file=sys.stderr)
    write_map(options.out, options.target, _relief(options, land, level, rect), options.metres_per_pixel)
    _tell_rest(land, level, rect)


def _tell_rest(land: Land, level: int, rect: Rect, error: float = 0.0, where: str = "") -> None:
    """Prints how far the land is from what was written, at most; `error`: what that errs by itself."""
    from engine.terrain.height_window import in_pixels

    found = land.bound(level, rect)
    if found is not None:
        print(f"the land, at any depth, is at most {error + in_pixels(found.hard, level):.3g} pixels off{where}")


def _mesh(options: argparse.Namespace, land: Land, ending: str) -> None:
    from engine.terrain.drape import cover_of
    from engine.terrain.height_window import between
    from engine.terrain.outputs import meshed, write_mesh

    level, rect = _place(options, land.painting)
    samples = rect._replace(x1=rect.x1 + 1, y1=rect.y1 + 1)  # the centres of its pixels and of those after the last
    heights = _relief(options, land, level, samples)
    closed = ending == ".stl" or options.base is not None
    try:
        made = meshed(heights, ERROR if options.error is None else options.error, options.triangles, closed)
    except ValueError as error:
        raise Refused(f"--triangles: {error}") from None
    print(f"{made.triangles} triangles, at most {made.error:.3g} pixels off")
    _tell_rest(land, level, heights.rect, made.error + between(heights.heights), " inside the rim")
    thick = max(1.0, 0.05 * max(rect.width, rect.height)) if options.base is None else options.base
    write_mesh(options.out, made, cover_of(land, wet(options, land)), thick, options.metres_per_pixel)
