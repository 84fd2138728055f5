"""Write a painting, or a rectangle of it at any level, as .png, .tif or .ora; OUT's ending decides."""

from __future__ import annotations

import argparse
import os
from dataclasses import replace
from typing import TYPE_CHECKING

from app.cli.arguments import rectangle
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output, grown, opened_painting, picture_of, rect_of, salvage_option
from app.cli.progress import Progress

if TYPE_CHECKING:
    from engine.archive.imports import Opened

ENDINGS = (".png", ".tif", ".tiff", ".ora")


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("painting", metavar="PAINTING.ora")
    parser.add_argument("out", metavar="OUT", help=" ".join(ENDINGS))
    parser.add_argument("--rect", type=rectangle, metavar="L,X,Y,W,H", help="level, and rectangle in its pixels")
    parser.add_argument("--layer", metavar="NAME", help="only this layer or group")
    parser.add_argument("--depth", type=int, choices=(8, 16), default=8, help="bits of each channel")
    salvage_option(parser)


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    ending = checked_output(options.out, ENDINGS)
    if ending == ".ora" and options.depth != 8:
        raise Refused("--depth: found 16 for an .ora, expected it for a picture")
    if os.path.exists(options.out) and os.path.samefile(options.painting, options.out):
        raise Refused(f"{options.out}: found the painting itself, expected another file to write to")
    found = opened_painting(options.painting, salvage=options.salvage)
    from engine.canvas.layers import LayerError, find

    if options.layer is not None:
        try:
            find(found.painting.root, options.layer)
        except LayerError as error:
            raise Refused(f"--layer: {error}") from None
    found = replace(found, painting=grown(options.painting, found))
    if ending == ".ora":
        _painting(options, found)
    else:
        from engine.archive.export import export

        with Progress("writing", 100) as tell:
            export(options.out, picture_of(found.painting, options.rect, options.layer, options.depth), tell.part)
    print(f"wrote {options.out}")
    return DONE


def _painting(options: argparse.Namespace, found: Opened) -> None:
    """As a painting: the frame is the smallest one that holds the rectangle; all detail goes along."""
    from engine.archive.saving import Snapshot, save
    from engine.canvas.layers import alone, find, layers

    painting, recording = found.painting, found.recording
    if options.rect is not None:
        level, rect = rect_of(options.rect)
        painting, recording = replace(painting, frame=rect.zoomed(-level)), None
    if options.layer is not None:
        root = alone(find(painting.root, options.layer))
        top = next((layer.name for layer in reversed(list(layers(root)))), None)
        painting, recording = replace(painting, root=root, active=top), None
    with Progress("writing", 100) as tell:
        save(options.out, Snapshot(painting, recording), tell.part)
