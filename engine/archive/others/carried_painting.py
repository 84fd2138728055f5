"""Another painting that a texture carries as the bytes of its file, opened to be brought in."""

from __future__ import annotations

import io

from engine.archive.imports import Opened
from engine.archive.manifest import MANIFEST
from engine.archive.opening import painting_of
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.checks.roles import COPIED
from engine.files.fault import FileError
from engine.files.layered.whole_file import as_bytes
from engine.files.zip_reader import ZipArchive
from engine.painting.layering.painting_member import NamedNode
from engine.texture.image import ImageSource

_AT_HAND: dict[str, Opened] = {}  # the one that was opened last and not brought in yet, by the sha of its bytes


def is_ours(source: ImageSource) -> bool:
    """Tells whether a picture is the bytes of a file that Inkfall wrote.  FileError if these are no archive."""
    data = _data(source)
    return data is not None and MANIFEST in ZipArchive(io.BytesIO(data), source.name)


def open_carried(source: ImageSource) -> Opened:
    """Opens it, on any thread, and has it at hand for `brought`.  FileError if it is none, or damaged."""
    data = _data(source)
    if data is None:
        raise FileError(source.name, "found a picture, expected the bytes of a painting's file")
    found = painting_of(io.BytesIO(data), source.name)
    _AT_HAND.clear()
    _AT_HAND[source.sha] = found
    return found


def brought(source: ImageSource) -> Opened:
    """Returns what was opened, which is not at hand any more; LayerError if it cannot be opened exactly."""
    found = _AT_HAND.pop(source.sha, None)
    if found is None:
        try:
            found = open_carried(source)
        except FileError as error:
            raise LayerError(str(error)) from None
        _AT_HAND.pop(source.sha, None)
    if not found.native:
        raise LayerError(
            f"{source.name}: found {(*found.notes, 'another program’s file')[0]}, expected a whole painting"
        )
    return found


def brought_nodes(group: Group) -> tuple[Node, ...]:
    """Returns what of a group is brought in, bottom first: all but what was copied aside."""
    return tuple(node for node in group.children if not (isinstance(node, Layer) and node.role == COPIED))


def names_of(group: Group) -> tuple[NamedNode, ...]:
    """Returns those under the names that they have."""
    return tuple(
        NamedNode(node.name, names_of(node) if isinstance(node, Group) else None) for node in brought_nodes(group)
    )


def _data(source: ImageSource) -> bytes | None:
    pixels = source.straight()
    return None if pixels is None else as_bytes(pixels)
