"""Write a painting, or a rectangle of it at any level; OUT's ending decides: .png, .tif, .exr (floats, linear light) or
.ora; .zarr (version 3, with OME metadata) or .dzi (DeepZoom, with a page that shows it), which hold coarser levels."""

from __future__ import annotations

import argparse
import os
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.cli.arguments import light, rectangle
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output, grown, opened_painting, picture_of, rect_of, salvage_option
from app.cli.progress import Progress

if TYPE_CHECKING:
    from engine.archive.imports import Opened
    from engine.light.light import Light

MANY_FILES = (".zarr", ".dzi")
ENDINGS = (".png", ".tif", ".tiff", ".exr", ".ora", *MANY_FILES)


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("painting", metavar="PAINTING.ora")
    parser.add_argument("out", metavar="OUT", help=" ".join(ENDINGS))
    parser.add_argument("--rect", type=rectangle, metavar="L,X,Y,W,H", help="level, and rectangle in its pixels")
    parser.add_argument("--transparent", action="store_true", help="without the paper")
    parser.add_argument("--layer", metavar="NAME", help="only this layer or group")
    parser.add_argument(
        "--light",
        type=light,
        metavar="AZIMUTH,ALTITUDE,DEPTH",
        help="lit by its own relief: where the sun stands, degrees clockwise from the top and above the picture, and "
        "how far white lies above black, pixels",
    )
    parser.add_argument("--gloss", type=float, metavar="G", help="of the light, 0 to 1 (0.15)")
    parser.add_argument(
        "--height", metavar="LAYER|composite|alpha|impasto", help="what the relief is taken from (composite)"
    )
    parser.add_argument("--depth", type=int, choices=(8, 16), default=8, help="bits of each channel")
    parser.add_argument(
        "--pyramid", action="store_true", help="a .tif with its coarser levels: BigTIFF, tiles, SubIFDs"
    )
    where = (
        "by the workers of a Dask cluster: its scheduler's HOST:PORT or file (.json), or local; they see OUT's folder"
    )
    parser.add_argument("--dask", metavar="SCHEDULER", help=where)
    salvage_option(parser)


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    options.out = options.out.rstrip(os.sep) or options.out  # a folder's name may be completed with one
    ending = checked_output(options.out, ENDINGS, MANY_FILES[:1]) or ""
    _check(options, ending)
    if os.path.exists(options.out) and os.path.samefile(options.painting, options.out):
        raise Refused(f"{options.out}: found the painting itself, expected another file to write to")
    found = opened_painting(options.painting, salvage=options.salvage)
    from engine.canvas.layers import find
    from engine.canvas.node_checks import LayerError
    from engine.light.light import BY_ALPHA, BY_IMPASTO, BY_PICTURE

    for option in ("layer", "height"):
        name = getattr(options, option)
        if name is None or (option == "height" and name in (BY_PICTURE, BY_ALPHA, BY_IMPASTO)):
            continue
        try:
            find(found.painting.root, name)
        except LayerError as error:
            raise Refused(f"--{option}: {error}") from None
    found = replace(found, painting=grown(options.painting, found))
    if ending == ".ora":
        _painting(options, found)
    else:
        _picture(options, found, ending)
    print(f"wrote {options.out}")
    return DONE


def _check(options: argparse.Namespace, ending: str) -> None:
    """Refuses options that do not go together, before anything is opened."""
    if ending == ".ora" and options.depth != 8:
        raise Refused("--depth: found 16 for an .ora, expected it for a picture")
    if ending == ".exr" and options.depth != 8:
        raise Refused("--depth: found 16 for an .exr, whose channels have 32")
    if options.pyramid and ending not in (".tif", ".tiff"):
        raise Refused(f"--pyramid: found it for {ending}, expected it for .tif (.zarr and .dzi are pyramids)")
    if ending in MANY_FILES:
        from engine.archive.ladder.ladder_files import folder_format

        folder_format(options.out)
    _light(options, ending)
    if options.dask is not None:
        if ending not in MANY_FILES:
            raise Refused(f"--dask: found it for {ending}, expected it for {' or '.join(MANY_FILES)}")
        from engine.archive.ladder.cluster import require

        require(options.out)


def _light(options: argparse.Namespace, ending: str) -> Light | None:
    """Returns the light that is asked for."""
    from engine.light.light import Light

    told = {name: getattr(options, name) for name in ("gloss", "height") if getattr(options, name) is not None}
    if options.light is None:
        if told:
            raise Refused(f"--{next(iter(told))}: found it without --light, expected both")
        return None
    if ending == ".ora":
        raise Refused("--light: found it for an .ora, which holds no light, expected it for a picture")
    try:
        return Light(*options.light, **told)
    except ValueError as error:
        raise Refused(f"--light: {error}") from None


def _picture(options: argparse.Namespace, found: Opened, ending: str) -> None:
    from engine.archive.export import export
    from engine.archive.ladder.ladder_files import SIDE, write_folder, write_tiff_ladder

    write = write_folder if ending in MANY_FILES else write_tiff_ladder if options.pyramid else export
    most = SIDE if ending in MANY_FILES else None
    picture = picture_of(found.painting, options.rect, options.layer, options.depth, most)
    picture = replace(picture, transparent=options.transparent, light=_light(options, ending))
    with Progress("writing", 100) as tell:
        if options.dask is None:
            write(options.out, picture, tell.part)
            return
        from engine.archive.ladder.cluster import write_on_cluster

        write_on_cluster(options.out, picture, _bytes_of(options, found), options.dask, tell.part)


def _bytes_of(options: argparse.Namespace, found: Opened) -> bytes:
    """Returns a file of the painting: the one that it came from, unless that is damaged."""
    from engine.archive.saving import Snapshot, save

    if not options.salvage:
        return Path(options.painting).read_bytes()
    with tempfile.TemporaryDirectory(prefix="inkfall-") as folder:
        path = Path(folder) / "whole.ora"
        save(path, Snapshot(found.painting))
        return path.read_bytes()


def _painting(options: argparse.Namespace, found: Opened) -> None:
    """As a painting: the frame is the smallest one that holds the rectangle; all detail goes along."""
    from engine.archive.saving import Snapshot, save
    from engine.canvas.layers import alone, find, layers, walk
    from engine.canvas.placing.loops import placements

    painting, recording = found.painting, found.recording
    if options.rect is not None:
        level, rect = rect_of(options.rect)
        painting, recording = replace(painting, frame=rect.zoomed(-level)), None
    if options.layer is not None:
        root = alone(find(painting.root, options.layer), painting.root)
        inside = {node.id for node in walk(root)}
        if any(one.of not in inside for one in placements(root)):
            raise Refused(
                f"--layer: found {options.layer!r}, which shows what lies elsewhere, expected it baked before"
            )
        top = next((layer.name for layer in reversed(list(layers(root)))), None)
        painting, recording = replace(painting, root=root, active=top), None
    with Progress("writing", 100) as tell:
        save(options.out, Snapshot(painting, recording), tell.part)
