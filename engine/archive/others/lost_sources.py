"""Placements of what a file does not have: the pictures that other programs are shown stand for them."""

from __future__ import annotations

from dataclasses import replace

from engine.archive.imports import STACK, committed
from engine.archive.others.stack_entries import png_name
from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing import loops
from engine.canvas.placing.placement import Placement
from engine.canvas.store import Pyramid
from engine.files.limits import Limits
from engine.files.png_reader import PngReader
from engine.files.stack_xml import parse_stack
from engine.files.zip_reader import ZipArchive
from engine.numeric.address import Rect
from engine.painting.rendering import Stop


def lost_sources(root: Group) -> tuple[Placement, ...]:
    """Returns the placements of a tree that show nodes which are not there."""
    there = {root.id, *(node.id for node in layers.walk(root))}
    return tuple(one for one in loops.placements(root) if one.of is not None and one.of not in there)


def layers_instead(root: Group, lost: tuple[Placement, ...], grid: int) -> Group:
    """Returns the tree with a layer in the place of each of some placements, of its number and name, empty."""
    numbers = {one.id for one in lost}

    def kept(node: Node) -> Node:
        if isinstance(node, Group):
            return replace(node, children=tuple(map(kept, node.children)))
        if node.id not in numbers:
            return node
        common = node.id, node.name, node.opacity, node.visible, node.blend, node.locked
        return Layer(*common, pyramid=Pyramid(grid=grid), role=node.role, clip=node.clip)

    out = kept(root)
    assert isinstance(out, Group)
    return out


def told_of(lost: tuple[Placement, ...]) -> tuple[str, ...]:
    """Returns the notes about them, a line each."""
    return tuple(f"layer {one.name!r}: what it shows is not in the file; its picture stands for it" for one in lost)


def picture_paint(
    archive: ZipArchive, layer: Layer, frame: Rect, limits: Limits, cancelled: Stop = None
) -> Pyramid | None:
    """Returns the picture that a file has of a node, as paint; None if it has none."""
    image = parse_stack(archive.read(STACK, limits.xml), archive.name, limits)
    entry = next((one for one in image.root.layers() if one.src == png_name(layer)), None)
    if entry is None or entry.src not in archive:
        return None
    level = 0
    while frame.zoomed(level).width > image.width and image.width > 1:
        level -= 1  # of a large frame the pictures are of a coarser level
    corner = frame.zoomed(level)
    reader = PngReader(archive.open(entry.src), f"{archive.name}: member {entry.src}", limits)  # type: ignore[arg-type]
    place = corner.x0 + entry.x, corner.y0 + entry.y
    return committed(reader.strips(), place, cancelled, layer.pyramid, level)
