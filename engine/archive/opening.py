"""Opening an .ora: our own painting as it was, or, where that is gone or overtaken, its pictures as layers."""

from __future__ import annotations

import io
import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import BinaryIO

import numpy as np
from immutables import Map

from engine.archive import grounds, maskpacks, pictures
from engine.archive.grounds import GroundEntry
from engine.archive.implied import TEXTURES, Coded, restored
from engine.archive.imports import STACK, Opened, read_raster
from engine.archive.manifest import FORMAT, MANIFEST, RECORDING, Manifest, Pack, PictureEntry, parse_manifest
from engine.archive.members import LOST, PIECE, WORKERS, Members, Stored
from engine.archive.others.lost_sources import picture_paint
from engine.archive.packing import unpack
from engine.archive.plot_files import Mark, Nursery
from engine.archive.selected import selection_files
from engine.archive.shelves.filed_pages import Gathered
from engine.archive.shelves.shelf import Filed, Shelf, shelved
from engine.canvas import layers
from engine.canvas.layers import Group
from engine.canvas.node_checks import LayerError
from engine.canvas.store import Pyramid, Record
from engine.checks.field_error import FieldError
from engine.files.fault import FileError, TooMuch, shown
from engine.files.limits import LIMITS, Limits, memory_cap
from engine.files.stack_xml import parse_stack
from engine.files.strict_json import loads
from engine.files.zip_reader import ZipArchive
from engine.keeping import memory
from engine.painting.recording import Recording, read_from
from engine.painting.rendering import Progress, Stop, check_cancelled
from engine.painting.value import Beginning
from engine.texture.example import SYNTHESIS
from engine.texture.example.tiles import Tiles
from engine.texture.image import ImageSource
from engine.texture.table import from_key

AHEAD = 4  # packs being unpacked at a time
_FILE_PART = 4  # of the budget of memory: what a file holds of layers stays in memory if it is no more
OTHER = "the textures of this version are not quite those it was saved with: the colour of {count} tiles differs{why}"
REGROWN = (
    "what was painted with examples is grown anew, and may look otherwise than it did: this version grows them"
    " another way (revision {was}, now {now})"
)
NEWER = "a newer Inkfall wrote this file: its pictures are shown, the rest is left out"


def open_painting(
    path: str | os.PathLike[str],
    progress: Progress = None,
    cancelled: Stop = None,
    limits: Limits = LIMITS,
) -> Opened:
    """Returns the painting in an .ora file.

    A file of another program, or one of ours that another program changed or stripped, gives its pictures as layers,
    `native` False, and says so in `notes`.  FileError, one line, if the file is none, or damaged.
    """
    name = os.fspath(path)
    try:
        if not os.path.isfile(path):
            raise FileError(name, "a folder, expected a file" if os.path.isdir(path) else "no such file")
        with open(path, "rb") as file:
            return painting_of(file, name, progress, cancelled, limits)
    except (OSError, ValueError) as error:
        raise FileError(name, f"cannot be read: {getattr(error, 'strerror', None) or error}") from error
    except MemoryError as error:
        raise TooMuch(name, "not enough memory to open it") from error


def painting_of(
    file: BinaryIO, name: str, progress: Progress = None, cancelled: Stop = None, limits: Limits = LIMITS
) -> Opened:
    """Returns the painting in the bytes of an .ora file, as `open_painting`; they are not read any more then."""
    return _Opening(ZipArchive(file, name, limits), limits, progress, cancelled).run()


def open_native(
    archive: ZipArchive, manifest: Manifest, limits: Limits = LIMITS, progress: Progress = None, cancelled: Stop = None
) -> Opened:
    """Returns the painting of ours that a manifest tells of, all of which must be in the archive; else FileError."""
    try:
        return _Opening(archive, limits, progress, cancelled).native(manifest, Members(archive, manifest, cancelled))
    except (FieldError, LayerError) as error:
        raise FileError(archive.name, f"{MANIFEST}: {error}") from error


Masks = Callable[[str, int], Tiles]


class _Opening:
    """One file being opened."""

    def __init__(self, archive: ZipArchive, limits: Limits, progress: Progress, cancelled: Stop) -> None:
        self._archive = archive
        self._limits = limits
        self._progress = progress
        self._cancelled = cancelled
        self._total = 1
        self._done = 0
        self._decoded = 0  # bytes of tiles that are not decoded later
        self._away = False  # whether what layers hold goes to disk as it is read

    def run(self) -> Opened:
        try:
            manifest, note = self._manifest()
            members = None if manifest is None else Members(self._archive, manifest, self._cancelled)
            if members is not None:
                note = members.overtaken()
            if note not in ("", NEWER) and not all(map(self._archive.agrees, self._archive.members.values())):
                raise FileError(self._archive.name, "its directory is damaged: it differs from its members' headers")
            if manifest is None or members is None or note:
                found = read_raster(self._archive, self._limits, self._progress, self._cancelled)
                return replace(found, notes=(*((note,) if note else ()), *found.notes))
            return self.native(manifest, members)
        except (FieldError, LayerError) as error:
            raise FileError(self._archive.name, f"{MANIFEST}: {error}") from error

    # ---- whose file it is ----

    def _manifest(self) -> tuple[Manifest | None, str]:
        """Returns the manifest, or None and what to say about that."""
        if MANIFEST not in self._archive:
            image = parse_stack(self._archive.read(STACK, self._limits.xml), self._archive.name, self._limits)
            ours = bool(image.ours) or any(entry.ours for entry in image.root.layers())
            return None, LOST if ours else ""
        value = loads(self._archive.read(MANIFEST, self._limits.json), cap=self._limits.json)
        version = value.get("inkfall") if isinstance(value, dict) else None
        if type(version) is int and version > FORMAT:
            return None, NEWER
        return parse_manifest(value), ""

    # ---- our own ----

    def native(self, manifest: Manifest, members: Members) -> Opened:
        """Returns the painting that a manifest tells of."""
        packs = [p for group in manifest.packs.values() for p in group]
        packs += [p for selection in manifest.selections for p in selection.packs]
        packs += [p for entry in manifest.pictures.values() for p in entry.packs]
        self._total = sum(p.plain for p in packs) + 1
        stored = _stored(manifest)
        self._away = stored > memory.budget() // _FILE_PART
        self._check_room(_most_at_once(manifest) + (0 if self._away else stored))
        sources = {sha: self._picture(entry, members) for sha, entry in manifest.pictures.items()}
        root, other = self._layers(manifest, members, sources)
        root, marks = self._grown(root, manifest, partial(self._masks, members), sources)
        textures = manifest.textures_with(sources)
        read = partial(self._tiles, members=members, sources=sources)
        chosen = selection_files.with_tiles_of(manifest.selections, manifest.grid, read, self._levels)
        painting = manifest.painting(root, textures, chosen)
        recording, lost = self._recording()
        if recording is not None:
            begun = Beginning(recording.header.frame, recording.header.paper)
            painting = painting if begun == painting.beginning else replace(painting, begun=begun)
        notes = (*manifest.notes, *lost)
        if other:
            why = "" if manifest.texture == TEXTURES else f" (revision {manifest.texture}, now {TEXTURES})"
            notes = (*notes, OTHER.format(count=other, why=why))
        if manifest.plots and manifest.synthesis != SYNTHESIS:
            notes = (*notes, REGROWN.format(was=manifest.synthesis, now=SYNTHESIS))
            marks = ()  # it is told already
        return Opened(painting, notes, True, recording, Map(sources), marks)

    def _check_room(self, most: int) -> None:
        if most > memory_cap():
            raise TooMuch(self._archive.name, f"its paint takes {most >> 20} MB, more than this machine has")

    def _layers(self, manifest: Manifest, members: Members, sources: Mapping[str, ImageSource]) -> tuple[Group, int]:
        """Returns the layers with what was painted, and how many tiles have another colour than when they were saved.

        The colour of a layer that ink implies is put back while the next layers are read.
        """
        root = manifest.root
        coloured: list[Future[int]] = []
        with (
            ThreadPoolExecutor(WORKERS, "lay") as pool,
            ThreadPoolExecutor(WORKERS, "imply") as squares,
            ThreadPoolExecutor(WORKERS, "colour") as colours,
        ):
            laid: dict[int, Future[Pyramid]] = {
                number: pool.submit(self._ground, found, members) for number, found in manifest.grounds.items()
            }
            try:
                for layer in list(layers.layers(root)):
                    check_cancelled(self._cancelled)
                    shelf = Shelf()
                    packs = manifest.packs[layer.id]
                    tiles = self._tiles(packs, members, sources, at_once=False)
                    gathered, apart = Gathered(self._archive.name, sum(p.tiles for p in packs)), list[Coded]()
                    for tile in shelved(tiles, shelf):
                        gathered.add(*tile[:2])
                        if not isinstance(tile[1].held, Filed):
                            apart.append(tile)
                    ground = laid.pop(layer.id).result() if layer.id in laid else layer.pyramid
                    if layer.id in manifest.pictured:
                        found = picture_paint(self._archive, layer, manifest.frame, self._limits, self._cancelled)
                        ground = found or ground
                    pyramid = shelf.laid(grounds.with_tiles(ground, gathered.levels(ground.depth)))
                    coloured.append(colours.submit(_coloured, shelf, pyramid, apart, squares.map))
                    root = layers.with_pyramid(root, layer.name, pyramid)
                return root, sum(future.result() for future in coloured)
            finally:
                for open_work in (coloured, laid.values()):
                    for future in open_work:
                        future.cancel()

    def _grown(
        self, root: Group, manifest: Manifest, masks: Masks, sources: Mapping[str, ImageSource]
    ) -> tuple[Group, tuple[Mark, ...]]:
        """With what was painted with examples, which is still to be grown; and the marks of how it was."""
        marks: list[Mark] = []
        plots = [plot for found in manifest.plots.values() for plot in found]
        nursery = Nursery.of(manifest.examples, plots, sources, manifest.arithmetic)
        for layer in list(layers.layers(root)):
            if layer.id in manifest.plots:
                where = f"{self._archive.name}: layer {shown(layer.name)}"
                grown, found = nursery.plots(manifest.plots[layer.id], masks, where)
                marks += found
                root = layers.with_growth(root, layer.name, grown)
        return root, tuple(marks)

    def _masks(self, members: Members, member: str, count: int) -> Tiles:
        check_cancelled(self._cancelled)
        stored = members.stored(member)
        return maskpacks.unpack(stored.checked(), stored.where, count)

    def _ground(self, found: GroundEntry, members: Members) -> Pyramid:
        """Returns the picture that a layer began with, laid down again."""
        return grounds.restored(found, members.ground(found.member), members.where(found.member), self._limits)

    def _levels(self, tiles: Sequence[Coded]) -> dict[int, Mapping[tuple[int, int], Record]]:
        return Gathered(self._archive.name, len(tiles), (tile[:2] for tile in tiles)).levels(0)

    def _picture(self, entry: PictureEntry, members: Members) -> ImageSource:
        parts = [(key, record) for key, record, _ in self._tiles(entry.packs, members, {})]
        return pictures.assembled(entry.name, entry.sha, entry.size, parts, self._archive.name)

    def _tiles(
        self, packs: tuple[Pack, ...], members: Members, sources: Mapping[str, ImageSource], at_once: bool = True
    ) -> Iterator[Coded]:
        """Yields all tiles of some packs; the file is read here, unpacking goes on beside."""
        waiting: deque[tuple[Pack, Future[list[Coded]]]] = deque()
        with ThreadPoolExecutor(WORKERS, "open") as pool:
            try:
                for pack in packs:
                    check_cancelled(self._cancelled)
                    stored = members.stored(pack.member)
                    waiting.append((pack, pool.submit(self._unpack, pack, stored, sources, at_once)))
                    if len(waiting) > AHEAD:
                        yield from self._next(waiting)
                while waiting:
                    yield from self._next(waiting)
            finally:
                for _, future in waiting:
                    future.cancel()

    def _unpack(self, pack: Pack, stored: Stored, sources: Mapping[str, ImageSource], at_once: bool) -> list[Coded]:
        data, told = stored.checked(), (pack.tiles, pack.plain)
        tiles = unpack(data, stored.where, lambda key: from_key(key, sources), told, at_once)
        if self._away:
            for _, record, _ in tiles:
                if isinstance(record.held, Filed):
                    record.held.block.put_away()
        return tiles

    def _next(self, waiting: deque[tuple[Pack, Future[list[Coded]]]]) -> list[Coded]:
        pack, future = waiting.popleft()
        tiles = future.result()
        self._done += pack.plain
        self._decoded += sum(record.nbytes for _, record, _ in tiles if isinstance(record.held, np.ndarray))
        self._check_room(self._decoded)
        if self._progress is not None:
            self._progress(self._done / self._total)
        return tiles

    def _recording(self) -> tuple[Recording | None, tuple[str, ...]]:
        """Returns the commands that led here, and what to say if they are left out."""
        if RECORDING not in self._archive:
            return None, ()
        size = self._archive.members[RECORDING].size
        if size > self._limits.log:
            return None, (f"its recording of {size >> 20} MB is left out",)
        stream = io.BufferedReader(self._archive.open(RECORDING), PIECE)
        return read_from(stream, f"{self._archive.name}: member {RECORDING}", Path(self._archive.name).parent), ()


def _stored(manifest: Manifest) -> int:
    """Returns the bytes of a file in which the tiles of layers lie."""
    return sum(manifest.members.get(p.member, (0, ""))[0] for group in manifest.packs.values() for p in group)


def _most_at_once(manifest: Manifest) -> int:
    """Returns the bytes that a painting takes as soon as it is open, beside those of the file: what is decoded then,
    and of the layers, whose tiles are decoded later, the largest pack.  Older formats are counted as they are read."""
    later = [p for group in manifest.packs.values() for p in group]
    now: list[Pack] = [p for selection in manifest.selections for p in selection.packs]
    now += [p for picture in manifest.pictures.values() for p in picture.packs]
    return sum(p.plain for p in now) + max((p.plain for p in later), default=0) + manifest.grown_bytes()


def _coloured(shelf: Shelf, pyramid: Pyramid, tiles: Sequence[Coded], run: Callable[..., Iterable[int]]) -> int:
    """Puts colour back into tiles that are there, and counts those of another colour than they had."""
    there = [tile for tile in tiles if isinstance(tile[1].held, np.ndarray)]
    return restored(pyramid, there, run) + shelf.others()
