"""Tell what a painting holds: layers, ink instances, levels used, bytes, bounds; or what was painted at a place."""

from __future__ import annotations

import argparse
import json
import os
import sys
from datetime import datetime
from typing import TYPE_CHECKING, Any

from app.cli.arguments import pixel
from app.cli.outcome import DONE, Failed
from app.cli.output import grown, opened_painting, salvage_option

if TYPE_CHECKING:
    from engine.archive.imports import Opened
    from engine.canvas.growth import Plot
    from engine.canvas.layers import Node
    from engine.canvas.selecting.selection import Selection
    from engine.canvas.store import Pyramid
    from engine.numeric.address import Rect
    from engine.painting.textures import Texture
    from engine.session.here.painted_here import ShownStroke

_WIDE = 2048  # pixels: how finely bounds are found
_FEW_NUMBERS = 8


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("painting", metavar="PAINTING.ora")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    salvage_option(parser)
    parser.add_argument(
        "--at", type=pixel, metavar="L,X,Y", help="the strokes that show at a pixel of a level, newest first"
    )


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    if options.at is not None:
        seed, found = strokes_at(options.painting, options.at, not options.json, options.salvage)
        if options.json:
            strokes = [told_stroke(shown, seed) for shown in found]
            print(json.dumps({"file": options.painting, "at": list(options.at), "strokes": strokes}))
        else:
            print("\n".join(map(_line_of, found)) or "no stroke shows there")
        return DONE
    told = facts(opened_painting(options.painting, not options.json, options.salvage))
    told = {"file": options.painting, "file_bytes": os.path.getsize(options.painting), **told}
    if options.json:
        print(json.dumps(told))
    else:
        _print(told)
    return DONE


def strokes_at(
    path: str, at: tuple[int, int, int], tell: bool = True, salvage: bool = False
) -> tuple[int, tuple[ShownStroke, ...]]:
    """Returns the seed of a painting, and its strokes that show at a pixel (level, x, y), newest first.

    Failed if the painting does not say how it was made.
    """
    from engine.files.fault import FileError
    from engine.painting.value import Refusal
    from engine.session.here.painted_here import CanvasPixel, PaintedHere
    from engine.session.session import Session
    from engine.studio.past.found_again import FoundAgain

    found = opened_painting(path, tell, salvage)
    if found.recording is None:
        raise Failed(f"{path}: found no recording, expected one: what was painted where is not known")
    painting = grown(path, found)
    session = Session(painting, log=found.recording.commands, folder=found.recording.folder)
    session.pictures = found.pictures
    again = FoundAgain(session, lambda number: None)
    place = CanvasPixel(*at)
    strokes = PaintedHere(held=again.held).at(place, painting, session.steps)
    if again.wanted and again.begin():  # what fills covered is found by playing the recording
        try:
            while again.play():
                pass
        except (FileError, Refusal) as error:
            print(f"{path}: {error}; fills count for half", file=sys.stderr)
        strokes = PaintedHere(held=again.held).at(place, painting, session.steps)
    return painting.seed, strokes


def told_stroke(shown: ShownStroke, seed: int) -> dict[str, object]:
    """Returns what is told of a stroke, ready for JSON.  `index` counts the commands of the painting's recording, from
    1; `shows` is the stroke's share of the pixel, 0..1; `seed`: of the painting."""
    from engine.brush import settings
    from engine.painting.times import time_of

    stroke = shown.stroke
    return {
        "index": shown.step.index + 1,
        "layer": shown.layer,
        "level": stroke.level,
        "shows": round(shown.share, 4),
        "brush": settings.to_json(stroke.brush),
        "textures": settings.textures_of(stroke.brush),
        "seed": seed if stroke.seed is None else stroke.seed,
        "time": time_of(stroke),
    }


def facts(found: Opened) -> dict[str, Any]:
    """Returns what there is to know of a painting, ready for JSON."""
    from engine.canvas import layers
    from engine.painting.places import write_bookmark

    painting, frame = found.painting, found.painting.frame
    nodes = list(layers.walk(painting.root))
    groups = {child.id: node.name for node in nodes if isinstance(node, layers.Group) for child in node.children}
    names = {node.id: node.name for node in nodes}
    rows = [_row(node, groups.get(node.id), names) for node in nodes]
    records = [record for sheet in layers.layers(painting.root) for _, record in sheet.pyramid.all_records()]
    inks = sorted({ink.key for record in records for ink in record.inks}, key=str)
    levels = sorted({level for sheet in layers.layers(painting.root) for level in sheet.pyramid.levels})
    return {
        "native": found.native,
        "frame": [frame.x0, frame.y0, frame.width, frame.height],
        "seed": painting.seed,
        "grid": painting.grid,
        "active": painting.active,
        "layers": rows,
        "inks": [list(key) for key in inks],
        "levels": levels,
        "bytes": sum(record.nbytes for record in records),
        "textures": {name: texture.kind for name, texture in sorted(painting.textures.items())},
        "maps": {name: maps for name, texture in sorted(painting.textures.items()) if (maps := _maps(texture))},
        "bookmarks": [write_bookmark(mark) for mark in painting.bookmarks.values()],
        "selected": None if painting.selection is None else selection(painting.selection),
        "selections": {name: selection(kept) for name, kept in sorted(painting.selections.items())},
        "commands": None if found.recording is None else len(found.recording.commands),
        "notes": list(found.notes),
    }


def selection(kept: Selection) -> dict[str, Any]:
    """Tells a selection: its bounds, or those of all that it is not (`inverse`), and its bytes."""
    return {"inverse": kept.inverse, "bounds": painted_bounds(kept.pyramid), "bytes": kept.pyramid.nbytes}


def _maps(texture: Texture) -> list[str]:
    """Returns the control channels of an example."""
    return [str(row[0]) for row in texture.parameters.get("controls", ())] if texture.control is not None else []


def _row(node: Node, group: str | None, names: dict[int, str]) -> dict[str, Any]:
    """Tells a node, which lies in a group; `names`: of all nodes, by their ids."""
    from engine.canvas import layers
    from engine.canvas.placing.placement import Placement
    from engine.painting.layering.placing_members import Placing, write_placing

    row: dict[str, Any] = {
        "name": node.name,
        "kind": type(node).__name__.lower(),
        "group": group,
        "opacity": node.opacity,
        "visible": node.visible,
        "blend": node.blend,
        "locked": node.locked,
    }
    if isinstance(node, Placement):
        row |= {"of": None if node.of is None else names[node.of], **write_placing(Placing.told(node))}
    if isinstance(node, layers.Layer):
        pyramid = node.pyramid
        row |= {
            "alpha_locked": node.alpha_locked,
            "levels": sorted(pyramid.levels),
            "tiles": sum(len(stored) for stored in pyramid.levels.values()),
            "bytes": pyramid.nbytes,
            "bounds": painted_bounds(pyramid),
        }
        if node.growth:
            row["examples"] = [_plot(plot) for plot in node.growth]
    return row


def _plot(plot: Plot) -> dict[str, Any]:
    """Returns what was painted with one example at one depth; its rectangle and pixels are those of its level."""
    from engine.canvas.growth import bounds

    masks = plot.region.masks[0].values()
    rect = bounds((plot,), plot.level)
    return {
        "name": plot.name,
        "depth": plot.depth,
        "level": plot.level,
        "pixels": sum(int(mask.data.sum()) for mask in masks),
        "bounds": [rect.x0, rect.y0, rect.width, rect.height],
    }


def painted_bounds(pyramid: Pyramid) -> list[int] | None:
    """[L, X, Y, W, H]: the smallest rectangle that holds all paint, to a pixel of L, the finest level at which it is no
    more than _WIDE pixels wide and high; None if there is no paint.

    What is stored reaches far beyond the paint at coarse levels, so it is searched from the coarsest on.
    """
    level = pyramid.finest
    if level is None:
        return None
    finest, rect = level, pyramid.bounds(level)
    while (side := max(rect.width, rect.height)) > _WIDE:
        level -= max(1, side.bit_length() - _WIDE.bit_length())  # paint may be thousands of levels apart
        rect = pyramid.bounds(level)
    found = _painted(pyramid, level, rect.grown(2))
    while found is not None and level < finest and max(found.width, found.height) <= _WIDE // 2:
        finer = _painted(pyramid, level + 1, found.zoomed(1).grown(2))
        if finer is None:
            break
        level, found = level + 1, finer
    return None if found is None else [level, found.x0, found.y0, found.width, found.height]


def _painted(pyramid: Pyramid, level: int, rect: Rect) -> Rect | None:
    """Returns the smallest rectangle of the pixels in `rect` that are not empty."""
    import numpy as np

    from engine.canvas.evaluate import evaluate
    from engine.numeric.address import Rect

    planes = evaluate(pyramid, level, rect).rgba
    rows, columns = np.flatnonzero(planes.any(axis=(0, 2))), np.flatnonzero(planes.any(axis=(0, 1)))
    if not len(rows):
        return None
    return Rect(
        rect.x0 + int(columns[0]), rect.y0 + int(rows[0]), rect.x0 + int(columns[-1]) + 1, rect.y0 + int(rows[-1]) + 1
    )


def _line_of_selection(kept: dict[str, Any]) -> str:
    if kept["bounds"] is None:
        return "everything"
    level, x, y, width, height = kept["bounds"]
    return f"{'all but ' if kept['inverse'] else ''}within {width} x {height} at {x}, {y} of level {level}"


def _part_told(part: object) -> str:
    """Returns a part of a key in one line: of a text its first, of a stroke's line how long it is."""
    if isinstance(part, str):
        first = part.strip().partition("\n")[0]
        return first if first == part else f"{first}…"
    return f"{len(part)} numbers" if isinstance(part, list | tuple) and len(part) > _FEW_NUMBERS else str(part)


def _print(told: dict[str, Any]) -> None:
    frame = told["frame"]
    print(f"{told['file']}: {told['file_bytes']:,} bytes, frame {frame[2]} x {frame[3]} at {frame[0]}, {frame[1]}")
    levels = told["levels"]
    span = f"{levels[0]} to {levels[-1]}" if levels else "none"
    print(f"levels {span}; {told['bytes']:,} bytes of paint in memory; seed {told['seed']}; grid 2^-{told['grid']}")
    print("layers, from the top:")
    for row in reversed(told["layers"]):
        print("  " + _line(row))
        for plot in reversed(row.get("examples", [])):
            print("    " + _told_plot(plot))
    for key in told["inks"]:
        print(f"ink: {key[0]}, base level {key[1]}, {', '.join(map(_part_told, key[2:])) or 'no parameters'}")
    for name, kind in told["textures"].items():
        maps = f", told by {', '.join(told['maps'][name])}" if name in told["maps"] else ""
        print(f"texture: {name}, {kind}{maps}")
    for mark in told["bookmarks"]:
        (x, y), (width, height) = mark["origin"], mark["size"]
        print(f"bookmark: {mark['name']!r}, {width:g} x {height:g} at {x}, {y} of level {mark['level']:g}")
    for name, kept in (("what is selected", told["selected"]), *told["selections"].items()):
        if kept is not None:
            print(f"selection: {name}, {_line_of_selection(kept)}")
    if told["commands"] is not None:
        print(f"recording: {told['commands']} commands")


def _line_of(shown: ShownStroke) -> str:
    from engine.brush.settings import textures_of
    from engine.painting.times import time_of

    brush, textures, time = shown.stroke.brush, ", ".join(textures_of(shown.stroke.brush)), time_of(shown.stroke)
    when = "" if time is None else f"; {datetime.fromtimestamp(time):%Y-%m-%d %H:%M:%S}"
    return (
        f"command {shown.step.index + 1}: {brush.mode} {brush.colour}{f' with {textures}' if textures else ''}, radius"
        f" {brush.radius:g} at level {shown.stroke.level}, on {shown.layer!r}; {shown.share:.1%} shows{when}"
    )


def _told_plot(plot: dict[str, Any]) -> str:
    x, y, width, height = plot["bounds"]
    return (
        f"example {plot['name']!r} at depth {plot['depth']:g}: {plot['pixels']:,} pixels,"
        f" {width} x {height} at {x}, {y} of level {plot['level']}"
    )


def _line(row: dict[str, Any]) -> str:
    marks = [mark for mark, on in (("hidden", not row["visible"]), ("locked", row["locked"])) if on]
    parts = [f"{row['kind']} {row['name']!r}", f"{row['blend']} {row['opacity']:g}", *marks]
    if row["group"] is not None:
        parts.insert(1, f"in {row['group']!r}")
    if row["kind"] == "placement":
        parts.append("of " + (repr(row["of"]) if row["of"] is not None else "the painting"))
    if row["kind"] == "layer":
        at = row["bounds"]
        parts.append(f"{row['tiles']} tiles, {row['bytes']:,} bytes")
        nothing = "no paint" if row.get("examples") else "empty"
        parts.append(nothing if at is None else f"{at[3]} x {at[4]} at {at[1]}, {at[2]} of level {at[0]}")
    return "; ".join(parts)
