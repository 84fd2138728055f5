"""The layers of an OpenRaster file, as its PNGs show them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from engine.files.fault import shown
from engine.files.layered.layer_sheet import FoundGroup, FoundLayers, FoundPicture
from engine.files.limits import LIMITS
from engine.files.png_reader import PngReader
from engine.files.stack_xml import LayerEntry, StackEntry, parse_stack
from engine.files.zip_reader import ZipArchive
from engine.numeric.blend import BLENDS

STACK = "stack.xml"
ALIASES = {"svg:add": "plus", "krita:pass": "src-over"}  # names that programs give to modes of ours


def known_blend(op: str) -> str | None:
    """Returns what we call a mode of a stack.xml; None if we have none such."""
    name = ALIASES.get(op, op.removeprefix("svg:"))
    return name if name in BLENDS else None


class OraLayers:
    """An archive, open, as a `LayeredReader`."""

    def __init__(self, archive: ZipArchive) -> None:
        self._archive = archive
        self._notes: list[str] = []
        self._sources: list[str] = []
        image = parse_stack(archive.read(STACK, LIMITS.xml), archive.name)
        self._notes += image.notes
        root = self._group(image.root)
        self.found = FoundLayers((image.width, image.height), root, tuple(self._notes))

    def bands(self, number: int) -> Iterator[np.ndarray]:
        """Yields the rows of a picture."""
        yield from self._reader(self._sources[number]).strips()

    def _reader(self, source: str) -> PngReader:
        where = f"{self._archive.name}: member {shown(source)}"
        return PngReader(self._archive.open(source), where, LIMITS)  # type: ignore[arg-type]

    def _group(self, entry: StackEntry) -> FoundGroup:
        children = []
        for child in reversed(entry.children):
            one = self._group(child) if isinstance(child, StackEntry) else self._picture(child)
            if one is not None:
                children.append(one)
        blend = self._blend(entry)
        return FoundGroup(entry.name, tuple(children), entry.opacity, entry.visible, blend, entry.isolated)

    def _picture(self, entry: LayerEntry) -> FoundPicture | None:
        if entry.src not in self._archive or not entry.src.lower().endswith(".png"):
            self._notes.append(f"layer {shown(entry.name, 30)}: no PNG {shown(entry.src)}; left out")
            return None
        header = self._reader(entry.src).header
        self._notes += [f"layer {shown(entry.name, 30)}: {note}" for note in header.notes]
        self._sources.append(entry.src)
        number, size = len(self._sources) - 1, (header.width, header.height)
        at, blend = (entry.x, entry.y), self._blend(entry)
        return FoundPicture(entry.name, number, at, size, entry.opacity, entry.visible, blend)

    def _blend(self, entry: StackEntry | LayerEntry) -> str:
        blend = known_blend(entry.op)
        if blend is None:
            self._notes.append(f"layer {shown(entry.name, 30)}: mode {shown(entry.op)} is not known; shown as normal")
        return blend or "src-over"
