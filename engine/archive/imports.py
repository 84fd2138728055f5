"""Pictures and other programs' OpenRaster files as paintings: each picture becomes one layer's pixels at level 0."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from pathlib import PurePath
from typing import Any

import numpy as np
from immutables import Map

from engine.archive import grounds
from engine.archive.plot_files import Mark
from engine.brush.stamp import Stamp
from engine.canvas import layers
from engine.canvas.commit import commit
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.store import Pyramid
from engine.checks.roles import MAX_NAME
from engine.files.fault import FileError, TooMuch, reason_of, shown
from engine.files.images import read_image
from engine.files.layered.ora_layers import STACK as STACK
from engine.files.layered.ora_layers import known_blend
from engine.files.limits import LIMITS, Limits, memory_cap, streamed
from engine.files.png_reader import PngReader
from engine.files.png_writer import SIGNATURE
from engine.files.profiles.converting import conversion_of
from engine.files.stack_xml import ImageEntry, LayerEntry, StackEntry, parse_stack
from engine.files.zip_reader import ZipArchive
from engine.keeping.disk_raster import room
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.arithmetic import NEWEST
from engine.numeric.colour import from_rgba8, from_rgba16
from engine.numeric.parted import Raster
from engine.painting.recording import Recording
from engine.painting.rendering import Progress, Stop, check_cancelled
from engine.painting.value import Painting
from engine.texture.image import ImageSource
from engine.texture.planes import Planes

_NO_PAINT = Pyramid()
NOTES = 20
PIXELS = 1 << 24  # of a band of rows that is laid down at once
_LAID_ROWS = 512  # rows of a picture that are laid down at once, at most


@dataclass(frozen=True, eq=False, slots=True)
class Opened:
    """What came out of a file.

    `native`: whether it is a whole painting of ours, to be saved in the same place; else a copy, to be named anew.
    `notes`: what was lost or replaced, a line each.  `recording`: the commands that led to it, if the file has them.
    `pictures`: those that its textures and inks use, by their sha, so that the recording can be replayed without the
    files they came from.  `marks`: of what was painted with examples, which is to be grown again.
    """

    painting: Painting
    notes: tuple[str, ...] = ()
    native: bool = False
    recording: Recording | None = None
    pictures: Map[str, ImageSource] = field(default_factory=Map)
    marks: tuple[Mark, ...] = ()


@dataclass(frozen=True, eq=False)
class Pasted:
    """An edit that puts pixels in place of what was there: A = 0 and B = the pixels, inside `rect`."""

    pixels: np.ndarray  # uint8 or uint16 RGBA (h, w, 4)
    rect: Rect
    level: int = 0
    spares_alpha: bool = False

    @property
    def tiles(self) -> Sequence[TileKey]:
        """Gives the tiles on which the picture is not wholly transparent."""
        return [key for key in self.rect.tiles(self.level) if self._part(key)[3].any()]

    def _part(self, key: TileKey) -> np.ndarray:
        rows, columns = key.rect.intersect(self.rect).slices(self.rect)
        return self.pixels[rows, columns].transpose(2, 0, 1)

    def stamp(self, key: TileKey, old: Planes) -> Stamp:
        """Lays the picture's pixels in place of what is there, as `Edit.stamp`."""
        rows, columns = key.rect.intersect(self.rect).slices(key.rect)
        keep = np.ones((TILE, TILE), np.float32)
        keep[rows, columns] = 0
        add = np.zeros((4, TILE, TILE), np.float32)
        part = self._part(key).transpose(1, 2, 0)
        add[:, rows, columns] = from_rgba16(part) if part.dtype == np.uint16 else from_rgba8(part)
        return Stamp(keep, add)


def pasted(bands: Iterator[np.ndarray], x: int, y: int, cancelled: Stop = None, height: int = 0) -> Pyramid:
    """Returns a pyramid of the rows that `bands` give, uint8 or uint16 RGBA (n, w, 4), from (x, y) of level 0 on.

    They are laid down at once and remembered as the layer's ground, if they are not too many; or, where it is known how
    many there will be (`height`), put away on disk, from which the ground is read as it is looked at.
    """
    held: list[np.ndarray] = []
    count = 0
    for band in bands:
        check_cancelled(cancelled)
        if height * band.shape[1] > grounds.LAID:
            return grounds.lay_ground(_put_away(chain([band], bands), height, cancelled), x, y)
        held.append(band)
        count += band.shape[0] * band.shape[1]
        if count > grounds.LAID:
            return committed(chain(held, bands), (x, y), cancelled)
    return grounds.lay_ground(held[0] if len(held) == 1 else np.concatenate(held), x, y) if held else Pyramid()


def _put_away(bands: Iterator[np.ndarray], height: int, cancelled: Stop) -> Raster:
    """Returns the same rows where there is room for them.  FileError if that is not on disk."""
    first = next(bands)
    try:
        pixels, top = room((height, *first.shape[1:]), first.dtype), 0
        for band in chain([first], bands):
            check_cancelled(cancelled)
            pixels[top : top + len(band)] = band
            top += len(band)
    except OSError as error:
        raise FileError("picture", f"cannot be put away on disk: {reason_of(error)}") from error
    return pixels


def committed(
    bands: Iterator[np.ndarray], corner: tuple[int, int], cancelled: Stop, pyramid: Pyramid = _NO_PAINT, level: int = 0
) -> Pyramid:
    """Returns the same, part by part, laid onto a pyramid at a level."""
    x, y = corner
    for rows in _regrouped(bands, y):
        check_cancelled(cancelled)
        pyramid = commit(pyramid, Pasted(rows, Rect.at(x, y, rows.shape[1], len(rows)), level))
        y += len(rows)
    return pyramid


def _regrouped(bands: Iterator[np.ndarray], y: int) -> Iterator[np.ndarray]:
    """Yields the same rows in larger groups that end where rows of tiles do."""
    held: list[np.ndarray] = []
    count = 0
    for band in bands:
        held.append(band)
        count += len(band)
        if count * band.shape[1] >= PIXELS:
            whole = held[0] if len(held) == 1 else np.concatenate(held)
            end = (y + count) // TILE * TILE - y
            if end > 0:
                yield whole[:end]
                held, count, y = [whole[end:]], count - end, y + end
    if count:
        yield held[0] if len(held) == 1 else np.concatenate(held)


# ---- a picture ----


def open_image(
    path: str | os.PathLike[str], limits: Limits = LIMITS, progress: Progress = None, cancelled: Stop = None
) -> Opened:
    """Returns a PNG, JPEG or TIFF as a painting of its size with one layer, its colours converted from its profile to
    sRGB.  FileError if it cannot be read."""
    streamed = _png_rows(path, limits, progress, cancelled)
    if streamed is None:
        pixels, meta = read_image(path, limits=limits, cancelled=cancelled, converted=True)
        check_cancelled(cancelled)
        size = (pixels.shape[1], pixels.shape[0])
        strips = (pixels[top : top + _LAID_ROWS] for top in range(0, size[1], _LAID_ROWS))
        pyramid, notes = pasted(_counted(strips, size[1], progress), 0, 0, cancelled, size[1]), meta.notes
    else:
        pyramid, size, notes = streamed
    layer = Layer(1, clean_name(PurePath(path).stem, "Picture"), pyramid=pyramid)
    root = layers.insert(layers.EMPTY, layer)
    return Opened(Painting(Rect(0, 0, *size), 0, root, layer.name, arithmetic=NEWEST), notes)


def _png_rows(
    path: str | os.PathLike[str], limits: Limits, progress: Progress, cancelled: Stop
) -> tuple[Pyramid, tuple[int, int], tuple[str, ...]] | None:
    """Returns the pyramid of a PNG, read strip by strip, its size and notes; None if it is none, or cannot be
    opened."""
    if not os.path.isfile(path):
        return None
    try:
        with open(path, "rb") as file:
            if file.read(len(SIGNATURE)) != SIGNATURE:
                return None
            file.seek(0)
            reader = PngReader(file, os.fspath(path), streamed(limits))
            header = reader.header
            convert, notes = conversion_of(header.profile, os.fspath(path), header.depth)
            strips = reader.strips() if convert is None else map(convert, reader.strips())
            bands = _counted(strips, header.height, progress)
            return pasted(bands, 0, 0, cancelled, header.height), (header.width, header.height), notes
    except OSError:
        return None


def _counted(bands: Iterator[np.ndarray], height: int, progress: Progress) -> Iterator[np.ndarray]:
    """Yields the same rows, and tells how far down they reach."""
    row = 0
    for band in bands:
        row += len(band)
        if progress is not None:
            progress(row / height)
        yield band


# ---- OpenRaster of other programs ----


def read_raster(
    archive: ZipArchive,
    limits: Limits = LIMITS,
    progress: Progress = None,
    cancelled: Stop = None,
) -> Opened:
    """Returns the layers of an OpenRaster file as its pictures show them.  FileError if it is none, or damaged."""
    image = parse_stack(archive.read(STACK, limits.xml), archive.name, limits)
    return _Import(archive, image, limits, progress, cancelled).run()


class _Import:
    """Builds the tree of one file."""

    def __init__(
        self,
        archive: ZipArchive,
        image: ImageEntry,
        limits: Limits,
        progress: Progress,
        cancelled: Stop,
    ) -> None:
        self._archive = archive
        self._image = image
        self._limits = limits
        self._progress = progress
        self._cancelled = cancelled
        self._notes = list(image.notes)
        self._names: set[str] = set()
        self._id = 0
        self._selected: str | None = None
        self._pixels = 0
        self._done = 0
        self._bytes = 0

    def run(self) -> Opened:
        self._total()
        try:
            children = tuple(self._node(child) for child in reversed(self._image.root.children))
            root = layers.checked(replace(layers.EMPTY, children=children))
        except LayerError as error:
            raise FileError(self._archive.name, f"stack.xml: {error}") from error
        frame = Rect(0, 0, self._image.width, self._image.height)
        top = next((layer.name for layer in reversed(list(layers.layers(root)))), None)
        return Opened(Painting(frame, 0, root, self._selected or top, arithmetic=NEWEST), self._told())

    def _told(self) -> tuple[str, ...]:
        """Returns the notes, of which nobody reads more than some."""
        more = len(self._notes) - NOTES
        return tuple(self._notes[:NOTES]) + ((f"and {more} more like these",) if more > 0 else ())

    def _total(self) -> None:
        """Adds up what all layers claim, before any is decoded; those that show a picture again count by themselves."""
        again = 0
        seen: set[str] = set()
        for entry in self._image.root.layers():
            if self._usable(entry):
                header = self._reader(entry).header
                self._pixels += header.width * header.height
                again += header.width * header.height if entry.src in seen else 0
                seen.add(entry.src)
        for what, found, most in (
            ("all layers together have", self._pixels, self._limits.total_pixels),
            ("layers that show one picture again have", again, self._limits.pixels),
        ):
            if found > most:
                raise FileError(self._archive.name, f"{what} {found} pixels; expected at most {most}")

    def _usable(self, entry: LayerEntry) -> bool:
        return entry.src in self._archive and entry.src.lower().endswith(".png")

    def _reader(self, entry: LayerEntry) -> PngReader:
        where = f"{self._archive.name}: member {shown(entry.src)}"
        return PngReader(self._archive.open(entry.src), where, self._limits)  # type: ignore[arg-type]

    def _node(self, entry: StackEntry | LayerEntry) -> Node:
        self._id += 1
        number = self._id
        fallback = f"{'Group' if isinstance(entry, StackEntry) else 'Layer'} {number}"
        common: dict[str, Any] = {
            "id": number,
            "name": self._name(entry.name, fallback),
            "opacity": entry.opacity,
            "visible": entry.visible,
            "blend": self._blend(entry),
            "locked": entry.locked,
        }
        if isinstance(entry, StackEntry):
            children = tuple(self._node(child) for child in reversed(entry.children))
            return Group(**common, isolated=entry.isolated, children=children)
        layer = Layer(**common, pyramid=self._paint(entry))
        if entry.selected:
            self._selected = layer.name
        return layer

    def _paint(self, entry: LayerEntry) -> Pyramid:
        check_cancelled(self._cancelled)
        if not self._usable(entry):
            self._notes.append(f"layer {shown(entry.name, 30)}: no PNG {shown(entry.src)}; left empty")
            return Pyramid()
        reader = self._reader(entry)
        for note in reader.header.notes:
            self._notes.append(f"layer {shown(entry.name, 30)}: {note}")
        pyramid = pasted(reader.strips(), entry.x, entry.y, self._cancelled, reader.header.height)
        self._bytes += pyramid.nbytes
        if self._bytes > memory_cap():
            raise TooMuch(self._archive.name, f"its layers take over {self._bytes >> 20} MB, all that this machine has")
        self._done += reader.header.width * reader.header.height
        if self._progress is not None:
            self._progress(self._done / max(1, self._pixels))
        return pyramid

    def _blend(self, entry: StackEntry | LayerEntry) -> str:
        name = known_blend(entry.op)
        if name is not None:
            return name
        self._notes.append(f"layer {shown(entry.name, 30)}: mode {shown(entry.op)} is not known; shown as normal")
        return "src-over"

    def _name(self, name: str, fallback: str) -> str:
        stem = clean_name(name, fallback)
        unique, count = stem, 1
        while unique in self._names:
            count += 1
            unique = f"{stem[: MAX_NAME - 12]} {count}"
        self._names.add(unique)
        return unique


def clean_name(name: str, fallback: str) -> str:
    """Returns a layer's name made of what a file says: printable, without blanks around it, not too long."""
    kept = "".join(c if c.isprintable() else " " for c in name)[:MAX_NAME].strip()
    return kept or fallback
