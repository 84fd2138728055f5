"""Opening an .ora: our own painting as it was, or, where that is gone or overtaken, its pictures as layers."""

from __future__ import annotations

import hashlib
import io
import os
import threading
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path

from immutables import Map

from engine.archive import grounds, maskpacks, pictures
from engine.archive.implied import TEXTURES, Coded, restored
from engine.archive.imports import STACK, Opened, read_raster
from engine.archive.manifest import FORMAT, MANIFEST, RECORDING, Manifest, Pack, PictureEntry, parse_manifest
from engine.archive.packing import unpack
from engine.archive.plot_files import Mark, Nursery
from engine.canvas import layers
from engine.canvas.layers import Group, LayerError
from engine.canvas.store import Pyramid, Record
from engine.files.fault import FileError, shown
from engine.files.limits import LIMITS, Limits, memory_cap
from engine.files.stack_xml import parse_stack
from engine.files.strict_json import FormatError, loads
from engine.files.zip_reader import ZipArchive
from engine.painting.recording import Recording, read_from
from engine.painting.rendering import Stop, check
from engine.painting.value import Painting
from engine.texture.example import SYNTHESIS
from engine.texture.example.tiles import Tiles
from engine.texture.image import ImageSource
from engine.texture.table import from_key

WORKERS = 2
AHEAD = 4  # packs being unpacked at a time
PIECE = 1 << 20
UNREAD = ("mergedimage", "Thumbnails")  # members that are for other programs alone
LOST = "deep detail is missing: this file was saved by another program"
OTHER = "the textures of this version are not quite those it was saved with: the colour of {count} tiles differs{why}"
REGROWN = (
    "what was painted with examples is grown anew, and may look otherwise than it did: this version grows them"
    " another way (revision {was}, now {now})"
)
CHANGED = "another program changed {what}: its pictures are shown, the deep detail that no longer fits is left out"
NEWER = "a newer Inkfall wrote this file: its pictures are shown, the rest is left out"


def open_painting(
    path: str | os.PathLike[str],
    progress: Callable[[float], None] | None = None,
    cancelled: Stop = None,
    limits: Limits = LIMITS,
) -> Opened:
    """The painting in an .ora file.

    A file of another program, or one of ours that another program changed or stripped, gives its pictures as layers,
    `native` False, and says so in `notes`.  FileError, one line, if the file is none, or damaged.
    """
    name = os.fspath(path)
    try:
        if not os.path.isfile(path):
            raise FileError(name, "a folder, expected a file" if os.path.isdir(path) else "no such file")
        with open(path, "rb") as file:
            archive = ZipArchive(file, name, limits)
            return _Opening(archive, limits, progress, cancelled).run()
    except (OSError, ValueError) as error:
        raise FileError(name, f"cannot be read: {getattr(error, 'strerror', None) or error}") from error
    except MemoryError as error:
        raise FileError(name, "not enough memory to open it") from error


class _Opening:
    """One file being opened."""

    def __init__(self, archive: ZipArchive, limits: Limits, progress, cancelled: Stop) -> None:
        self._archive = archive
        self._limits = limits
        self._progress = progress
        self._cancelled = cancelled
        self._total = 1
        self._done = 0
        self._reading = threading.Lock()  # the file has one position
        self._held: dict[str, bytes] = {}  # pictures that layers began with

    def run(self) -> Opened:
        try:
            manifest, note = self._manifest()
            if manifest is not None:
                note = self._overtaken(manifest)
            if manifest is None or note:
                found = read_raster(self._archive, self._limits, self._progress, self._cancelled)
                return replace(found, notes=(*((note,) if note else ()), *found.notes))
            return self._native(manifest)
        except (FormatError, LayerError) as error:
            raise FileError(self._archive.name, f"{MANIFEST}: {error}") from error

    # ---- whose file it is ----

    def _manifest(self) -> tuple[Manifest | None, str]:
        """The manifest, or None and what to say about that."""
        if MANIFEST not in self._archive:
            image = parse_stack(self._archive.read(STACK, self._limits.xml), self._archive.name, self._limits)
            ours = bool(image.ours) or any(entry.ours for entry in image.root.layers())
            return None, LOST if ours else ""
        value = loads(self._archive.read(MANIFEST, self._limits.json), cap=self._limits.json)
        version = value.get("inkfall") if isinstance(value, dict) else None
        if type(version) is int and version > FORMAT:
            return None, NEWER
        return parse_manifest(value), ""

    def _overtaken(self, manifest: Manifest) -> str:
        """What another program changed or left out, or nothing.

        A member that differs from the manifest but is whole, as its own checksum tells, was put there on purpose.
        """
        needed = [name for name in manifest.members if name.startswith("inkfall/")]
        if any(name not in self._archive for name in needed):
            return LOST
        read = {name: entry for name, entry in manifest.members.items() if not name.startswith(UNREAD)}
        for name, (size, _) in read.items():
            if name not in self._archive or self._archive.members[name].size != size:
                return CHANGED.format(what=shown(name))
        summed = [name for name in read if not name.endswith(".tiles")]
        kept = {found.member for found in manifest.grounds.values()}
        with ThreadPoolExecutor(WORKERS, "sum") as pool:
            for name, sha in zip(summed, pool.map(lambda name: self._sum(name, name in kept), summed), strict=True):
                if sha != read[name][1]:
                    return CHANGED.format(what=shown(name))
        return ""

    def _sum(self, name: str, kept: bool) -> str:
        """The SHA-256 of a member, which is kept in memory where it will be needed."""
        if kept:
            check(self._cancelled)
            with self._reading:
                self._held[name] = self._archive.read(name, self._archive.members[name].size)
            return hashlib.sha256(self._held[name]).hexdigest()
        digest = hashlib.sha256()
        with self._reading:
            stream = self._archive.open(name)
        while True:
            check(self._cancelled)
            with self._reading:
                piece = stream.read(PIECE)
            if not piece:
                break
            digest.update(piece)
        with self._reading:
            stream.finish()
        return digest.hexdigest()

    # ---- our own ----

    def _native(self, manifest: Manifest) -> Opened:
        packs = [p for group in manifest.packs.values() for p in group]
        packs += [p for entry in manifest.pictures.values() for p in entry.packs]
        self._total = sum(p.plain for p in packs) + 1
        most = self._total + manifest.grown_bytes()
        if most > memory_cap():
            raise FileError(self._archive.name, f"its paint takes {most >> 20} MB, more than this machine has")
        sources = {sha: self._picture(entry, manifest) for sha, entry in manifest.pictures.items()}
        root, other = self._layers(manifest, sources)
        root, marks = self._grown(root, manifest, sources)
        textures = manifest.textures_with(sources)
        painting = Painting(manifest.frame, manifest.seed, root, manifest.active, textures)
        recording, notes = self._recording()
        if other:
            why = "" if manifest.texture == TEXTURES else f" (revision {manifest.texture}, now {TEXTURES})"
            notes = (*notes, OTHER.format(count=other, why=why))
        if manifest.plots and manifest.synthesis != SYNTHESIS:
            notes = (*notes, REGROWN.format(was=manifest.synthesis, now=SYNTHESIS))
            marks = ()  # it is told already
        return Opened(painting, notes, True, recording, Map(sources), marks)

    def _layers(self, manifest: Manifest, sources: Mapping[str, ImageSource]) -> tuple[Group, int]:
        """The layers with what was painted, and how many tiles have another colour than when they were saved.

        The colour of a layer that ink implies is put back while the next layers are read.
        """
        root = manifest.root
        coloured: list[Future] = []
        with (
            ThreadPoolExecutor(WORKERS, "lay") as pool,
            ThreadPoolExecutor(WORKERS, "imply") as squares,
            ThreadPoolExecutor(WORKERS, "colour") as colours,
        ):
            laid: dict[int, Future] = {
                number: pool.submit(self._ground, number, manifest) for number in manifest.grounds
            }
            try:
                for layer in list(layers.layers(root)):
                    check(self._cancelled)
                    tiles = list(self._tiles(manifest.packs[layer.id], manifest, sources))
                    ground = laid.pop(layer.id).result() if layer.id in laid else Pyramid()
                    pyramid = grounds.with_tiles(ground, self._levels(tiles))
                    coloured.append(colours.submit(restored, pyramid, tiles, squares.map))
                    root = layers.with_pyramid(root, layer.name, pyramid)
                return root, sum(future.result() for future in coloured)
            finally:
                for future in (*coloured, *laid.values()):
                    future.cancel()

    def _grown(
        self, root: Group, manifest: Manifest, sources: Mapping[str, ImageSource]
    ) -> tuple[Group, tuple[Mark, ...]]:
        """With what was painted with examples, which is still to be grown; and the marks of how it was."""
        marks: list[Mark] = []
        plots = [plot for found in manifest.plots.values() for plot in found]
        nursery = Nursery.of(manifest.examples, plots, sources)
        for layer in list(layers.layers(root)):
            if layer.id in manifest.plots:
                where = f"{self._archive.name}: layer {shown(layer.name)}"
                grown, found = nursery.plots(manifest.plots[layer.id], partial(self._masks, manifest), where)
                marks += found
                root = layers.with_growth(root, layer.name, grown)
        return root, tuple(marks)

    def _masks(self, manifest: Manifest, member: str, count: int) -> Tiles:
        check(self._cancelled)
        data, sha = self._stored(member, manifest)
        where = f"{self._archive.name}: member {shown(member)}"
        if hashlib.sha256(data).hexdigest() != sha:
            raise FileError(where, "its bytes are not those that the manifest names")
        return maskpacks.unpack(data, where, count)

    def _ground(self, number: int, manifest: Manifest) -> Pyramid:
        """The picture that a layer began with, laid down again."""
        found = manifest.grounds[number]
        if found.member not in manifest.members:
            raise FileError(self._archive.name, f"{MANIFEST}: {shown(found.member)} is not among the members")
        png = self._held.get(found.member)
        if png is None:
            with self._reading:
                png = self._archive.read(found.member, manifest.members[found.member][0])
        return grounds.restored(found, png, f"{self._archive.name}: member {shown(found.member)}", self._limits)

    def _levels(self, tiles: Sequence[Coded]) -> dict[int, dict[tuple[int, int], Record]]:
        levels: dict[int, dict[tuple[int, int], Record]] = {}
        for key, record, _ in tiles:
            level = levels.setdefault(key.level, {})
            if (key.x, key.y) in level:
                raise FileError(self._archive.name, f"tile {key.x}, {key.y} of level {key.level} is there twice")
            level[key.x, key.y] = record
        return levels

    def _picture(self, entry: PictureEntry, manifest: Manifest) -> ImageSource:
        parts = [(key, record) for key, record, _ in self._tiles(entry.packs, manifest, {})]
        return pictures.assembled(entry.name, entry.sha, entry.size, parts, self._archive.name)

    def _tiles(
        self, packs: tuple[Pack, ...], manifest: Manifest, sources: Mapping[str, ImageSource]
    ) -> Iterator[Coded]:
        """All tiles of some packs; the file is read here, unpacking goes on beside."""
        waiting: deque[tuple[Pack, Future]] = deque()
        with ThreadPoolExecutor(WORKERS, "open") as pool:
            try:
                for pack in packs:
                    check(self._cancelled)
                    stored = self._stored(pack.member, manifest)
                    waiting.append((pack, pool.submit(self._unpack, pack, stored, sources)))
                    if len(waiting) > AHEAD:
                        yield from self._next(waiting)
                while waiting:
                    yield from self._next(waiting)
            finally:
                for _, future in waiting:
                    future.cancel()

    def _next(self, waiting: deque) -> list[Coded]:
        pack, future = waiting.popleft()
        tiles = future.result()
        self._done += pack.plain
        if self._progress is not None:
            self._progress(self._done / self._total)
        return tiles

    def _stored(self, member: str, manifest: Manifest) -> tuple[bytes, str]:
        size, sha = manifest.members.get(member, (-1, ""))
        if size < 0:
            raise FileError(self._archive.name, f"{MANIFEST}: {shown(member)} is not among the members")
        with self._reading:
            return self._archive.read(member, size), sha

    def _unpack(self, pack: Pack, stored: tuple[bytes, str], sources: Mapping[str, ImageSource]) -> list[Coded]:
        data, sha = stored
        where = f"{self._archive.name}: member {shown(pack.member)}"
        if hashlib.sha256(data).hexdigest() != sha:
            raise FileError(where, "its bytes are not those that the manifest names")
        return unpack(data, where, lambda key: from_key(key, sources), (pack.tiles, pack.plain))

    def _recording(self) -> tuple[Recording | None, tuple[str, ...]]:
        """The commands that led here, and what to say if they are left out."""
        if RECORDING not in self._archive:
            return None, ()
        size = self._archive.members[RECORDING].size
        if size > self._limits.log:
            return None, (f"its recording of {size >> 20} MB is left out",)
        stream = io.BufferedReader(self._archive.open(RECORDING), PIECE)
        return read_from(stream, f"{self._archive.name}: member {RECORDING}", Path(self._archive.name).parent), ()
