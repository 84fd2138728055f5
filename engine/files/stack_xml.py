"""stack.xml of OpenRaster: read as other programs' files have it, written as other programs need it.

Reading is strict about structure and sizes (defusedxml, no DTD, no entities) and forgiving about attributes, as the
readers in the field are; whatever was replaced by a default is told in `notes`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any
from xml.etree.ElementTree import ParseError
from xml.sax.saxutils import quoteattr

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import DefusedXMLParser

from engine.files.fault import FileError, shown
from engine.files.limits import LIMITS, Limits

OURS = "urn:inkfall:openraster"
MYPAINT = "http://mypaint.org/ns/openraster"
WHOLE = re.compile(r"[+-]?[0-9]{1,18}(\.[0-9]*)?", re.ASCII)
SOURCE_OVER = "svg:src-over"


@dataclass(frozen=True)
class LayerEntry:
    """A <layer>: the picture `src` at (x, y) of the image."""

    src: str
    name: str
    x: int = 0
    y: int = 0
    opacity: float = 1.0
    visible: bool = True
    op: str = SOURCE_OVER
    locked: bool = False
    selected: bool = False
    ours: Mapping[str, str] = field(default_factory=dict)  # attributes of our namespace, without it


@dataclass(frozen=True)
class StackEntry:
    """A <stack>: `children` from the top down."""

    children: tuple[StackEntry | LayerEntry, ...]
    name: str = ""
    opacity: float = 1.0
    visible: bool = True
    op: str = SOURCE_OVER
    isolated: bool = True
    locked: bool = False
    ours: Mapping[str, str] = field(default_factory=dict)

    def layers(self) -> Iterator[LayerEntry]:
        """Yields all layers inside, from the top down."""
        for child in self.children:
            if isinstance(child, StackEntry):
                yield from child.layers()
            else:
                yield child


@dataclass(frozen=True)
class ImageEntry:
    """The <image>."""

    width: int
    height: int
    root: StackEntry
    ours: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


# ---- reading ----


def parse_stack(data: bytes, name: str, limits: Limits = LIMITS) -> ImageEntry:
    """Returns the tree of a stack.xml.  FileError if it is not one, or asks for too much; `name` is the archive's."""
    builder = _Builder(name, limits)
    parser = DefusedXMLParser(target=builder, forbid_dtd=True)
    try:
        parser.feed(data)
        parser.close()
    except DefusedXmlException as error:
        raise FileError(name, "stack.xml declares a document type or entities; expected none") from error
    except (ParseError, ValueError, LookupError) as error:
        raise FileError(name, f"stack.xml is not XML: {error}") from error
    return builder.image()


class _Builder:
    """Receives the parser's events; keeps stacks and layers, passes over everything else."""

    def __init__(self, name: str, limits: Limits) -> None:
        self._name = name
        self._limits = limits
        self._open: list[tuple[str, dict[str, str]]] = []
        self._children: list[list[StackEntry | LayerEntry]] = []
        self._elements = 0
        self._kept = 0
        self._foreign = 0  # depth below an element that is passed over
        self._image: dict[str, str] | None = None
        self._root: StackEntry | None = None
        self._notes: list[str] = []

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        self._elements += 1
        if self._elements > self._limits.elements:
            raise self._fail(f"more than {self._limits.elements} elements")
        if len(self._open) + self._foreign >= self._limits.depth:
            raise self._fail(f"elements nested more than {self._limits.depth} deep")
        for key, value in attributes.items():
            if len(key) + len(value) > self._limits.text:
                raise self._fail(f"attribute {shown(key)} of {len(value)} characters")
        if self._foreign or not self._known(tag):
            self._foreign += 1
            return
        if tag == "image":
            self._image = attributes
        else:
            self._kept += 1
            if self._kept > self._limits.layers + 1:
                raise self._fail(f"more than {self._limits.layers} layers and groups")
        self._open.append((tag, attributes))
        self._children.append([])

    def _known(self, tag: str) -> bool:
        inside = self._open[-1][0] if self._open else None
        if inside is None:
            if tag != "image":
                raise self._fail(f"found element {shown(tag)}, expected image")
            return True
        if tag == "stack":
            if inside == "image" and (self._root is not None):
                raise self._fail("a second root stack")
            return inside in ("image", "stack")
        return tag == "layer" and inside == "stack"

    def end(self, tag: str) -> None:
        if self._foreign:
            self._foreign -= 1
            return
        tag, attributes = self._open.pop()
        children = tuple(self._children.pop())
        if tag == "image":
            return
        entry: StackEntry | LayerEntry | None
        entry = self._stack(attributes, children) if tag == "stack" else self._layer(attributes)
        if len(self._open) == 1:
            assert isinstance(entry, StackEntry)
            self._root = entry
        elif entry is not None:
            self._children[-1].append(entry)

    def data(self, text: str) -> None:
        """Text between elements means nothing here."""

    def close(self) -> None:
        """Nothing is left open: the parser has seen to it."""

    def image(self) -> ImageEntry:
        if self._image is None or self._root is None:
            raise self._fail("no root stack")
        side = self._limits.offset
        width, height = (self._whole(self._image, key, None, (1, side)) for key in ("w", "h"))
        return ImageEntry(width, height, self._root, _ours(self._image), tuple(self._notes))

    # ---- attributes ----

    def _fail(self, message: str) -> FileError:
        return FileError(self._name, f"stack.xml: {message}")

    def _note(self, attributes: Mapping[str, str], message: str) -> None:
        title = attributes.get("name", "")
        note = f"{'layer ' + shown(title, 30) if title else 'a layer'}: {message}"
        if len(self._notes) < 20 and note not in self._notes:
            self._notes.append(note)

    def _whole(self, attributes: Mapping[str, str], key: str, default: int | None, span: tuple[int, int]) -> int:
        text = attributes.get(key, "").strip()
        if not text and default is not None:
            return default
        value = int(text.split(".")[0]) if WHOLE.fullmatch(text) else None
        if value is None or not span[0] <= value <= span[1]:
            raise self._fail(f"attribute {key}: found {shown(text)}, expected a whole number {span[0]} to {span[1]}")
        return value

    def _opacity(self, attributes: Mapping[str, str]) -> float:
        text = attributes.get("opacity", "1").strip()
        try:
            value = float(text) if text.isascii() and "_" not in text else math.nan
        except ValueError:
            value = math.nan
        if math.isnan(value):
            self._note(attributes, f"opacity {shown(text)} taken as 1")
            return 1.0
        return min(max(value, 0.0), 1.0)

    def _common(self, attributes: Mapping[str, str]) -> dict[str, Any]:
        visibility = attributes.get("visibility", "visible").strip()
        if visibility not in ("visible", "hidden"):
            self._note(attributes, f"visibility {shown(visibility)} taken as visible")
        return {
            "name": attributes.get("name", ""),
            "opacity": self._opacity(attributes),
            "visible": visibility != "hidden",
            "op": attributes.get("composite-op", SOURCE_OVER).strip() or SOURCE_OVER,
            "locked": attributes.get("edit-locked", "").strip() in ("true", "1"),
            "ours": _ours(attributes),
        }

    def _stack(self, attributes: Mapping[str, str], children: tuple[LayerEntry | StackEntry, ...]) -> StackEntry:
        common = self._common(attributes)
        # Without the attribute, or with `auto`, a group that does nothing itself lets its layers through.
        alone = attributes.get("isolation", "auto").strip() == "isolate"
        isolated = alone or common["opacity"] < 1 or common["op"] != SOURCE_OVER
        return StackEntry(children, isolated=isolated, **common)

    def _layer(self, attributes: Mapping[str, str]) -> LayerEntry | None:
        src = attributes.get("src", "").removeprefix("/")
        if not src:
            self._note(attributes, "no picture (src); left out")
            return None
        reach = (-self._limits.offset, self._limits.offset)
        return LayerEntry(
            src,
            x=self._whole(attributes, "x", 0, reach),
            y=self._whole(attributes, "y", 0, reach),
            selected=attributes.get("selected", "").strip() in ("true", "1"),
            **self._common(attributes),
        )


def _ours(attributes: Mapping[str, str]) -> dict[str, str]:
    mark = f"{{{OURS}}}"
    return {key.removeprefix(mark): value for key, value in attributes.items() if key.startswith(mark)}


# ---- writing ----


def stack_text(image: ImageEntry) -> bytes:
    """Returns the stack.xml of an image, every attribute written out: readers differ in what they take a missing one
    for."""
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<image version="0.0.5" w="{image.width}" h="{image.height}" xres="72" yres="72" xmlns:inkfall="{OURS}"'
        f' xmlns:mypaint="{MYPAINT}" mypaint:eotf="1.0"{_foreign(image.ours)}>',
    ]
    # The root carries no name, opacity or mode, but does say how it is isolated.
    lines.append(' <stack isolation="isolate">')
    for child in image.root.children:
        _lines(child, 2, lines)
    lines += [" </stack>", "</image>", ""]
    return "\n".join(lines).encode()


def _lines(entry: StackEntry | LayerEntry, depth: int, lines: list[str]) -> None:
    indent = " " * depth
    common = (
        f'name={quoteattr(printable(entry.name))} opacity="{entry.opacity!r}"'
        f' visibility="{"visible" if entry.visible else "hidden"}" composite-op={quoteattr(entry.op)}'
        f' edit-locked="{"true" if entry.locked else "false"}"'
    )
    if isinstance(entry, LayerEntry):
        place = f'src={quoteattr(entry.src)} x="{entry.x}" y="{entry.y}"'
        selected = ' selected="true"' if entry.selected else ""
        lines.append(f"{indent}<layer {place} {common}{selected}{_foreign(entry.ours)}/>")
        return
    isolation = "isolate" if entry.isolated else "auto"
    lines.append(f'{indent}<stack {common} isolation="{isolation}"{_foreign(entry.ours)}>')
    for child in entry.children:
        _lines(child, depth + 1, lines)
    lines.append(f"{indent}</stack>")


def _foreign(ours: Mapping[str, str]) -> str:
    return "".join(f" inkfall:{key}={quoteattr(value)}" for key, value in ours.items())


def printable(text: str) -> str:
    """Returns text without the characters that XML 1.0 cannot hold (section 2.2)."""
    return re.sub("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "\ufffd", text)
