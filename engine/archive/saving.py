"""Saving a painting as OpenRaster: pictures for every program, and beside them all that makes it refine on zoom.

Layout: mimetype (first, stored), under inkfall/ the recording, the manifest, the tiles in packs and pictures, then
data/L*.png (each layer's part of the frame), mergedimage.png, Thumbnails/thumbnail.png, stack.xml, and the manifest
once more: what gives most back lies where a file that is cut short still has it, and the manifest at both ends.  The
same painting gives the same bytes.  A save takes a frozen snapshot, so it can run on any thread.
"""

from __future__ import annotations

import io
import os
from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO

import numpy as np

from engine.archive import grounds, pictures, plot_files
from engine.archive.grounds import GroundEntry
from engine.archive.held_levels import held_pixels
from engine.archive.implied import needed
from engine.archive.jobs import Job, pack_jobs
from engine.archive.manifest import MANIFEST, MANIFEST_AGAIN, RECORDING, Pack, PictureEntry, format_of, manifest_json
from engine.archive.others.paper_picture import paper_names, paper_pictures, with_paper
from engine.archive.others.placement_pictures import PlacementPictures
from engine.archive.others.spooled_png import SpooledPng
from engine.archive.others.stack_entries import Stack, bases_of, png_name
from engine.archive.others.stack_sums import with_sums
from engine.archive.plot_files import PlotEntry
from engine.archive.saving_turn import SAVING
from engine.archive.selected import selection_files
from engine.canvas import layers
from engine.canvas.layers import Layer
from engine.canvas.placing import loops
from engine.canvas.placing.placement import Placement
from engine.canvas.store import PutAway
from engine.files.atomic import replacing
from engine.files.fault import FileError, WriteError
from engine.files.limits import LIMITS, STREAMED
from engine.files.png_reader import PngReader
from engine.files.stack_xml import ImageEntry, stack_text
from engine.files.strict_json import dumps
from engine.files.zip_reader import ZipArchive
from engine.files.zip_writer import ZipWriter
from engine.keeping import memory
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.numeric.shrink import box_reduce, fitted_size
from engine.painting.cascade import PIXEL, SMALL, Cascade
from engine.painting.grown import settled_root
from engine.painting.recording import Recording
from engine.painting.rendering import Progress, Stop, check_cancelled, folded_layers, reach, sheets, strips
from engine.painting.value import Painting
from engine.texture.image import ImageSource

MIMETYPE = b"image/openraster"
MERGED_SIDE = (1 << 15) - 1  # pixels: the largest picture that the other programs open
_THUMBNAIL = 256
MERGED, THUMB = "mergedimage.png", "Thumbnails/thumbnail.png"
WORKERS = 2
WAITING = 4  # finished jobs that may wait for their turn
_HELD_PART = 32  # of the budget of memory, that one level may take while finer ones are evaluated


@dataclass(frozen=True, eq=False, slots=True)
class Snapshot:
    """What a save writes: the painting, and the recording that led to it if that is known."""

    painting: Painting
    recording: Recording | None = None


Product = bytes | IO[bytes]


def save(
    path: str | os.PathLike[str],
    snapshot: Snapshot,
    progress: Progress = None,
    cancelled: Stop = None,
    ready: Callable[[Path], None] | None = None,
) -> None:
    """Writes the painting, when it is its turn.  The place holds the old file or the whole new one, which was read back
    and checked.

    `progress` gets the part done, 0..1, on the calling thread; `cancelled` is asked from several; `ready` gets the
    whole new file before it takes its place, and may raise.  WriteError if it cannot be done, Cancelled if it was asked
    for; either way nothing has changed.
    """
    try:
        with SAVING.taken(cancelled):
            _save(path, snapshot, progress, cancelled, ready)
    except MemoryError as error:
        raise WriteError(path, "not enough memory to save it") from error
    if progress is not None:
        progress(1.0)


def _save(
    path: str | os.PathLike[str],
    snapshot: Snapshot,
    progress: Progress,
    cancelled: Stop,
    ready: Callable[[Path], None] | None,
) -> None:
    painting = replace(snapshot.painting, root=folded_layers(settled_root(snapshot.painting.root)))
    plan = SavePlan(painting, snapshot.recording, cancelled)
    with replacing(path, verify=lambda part: _verify(part, path, plan, ready)) as file:
        writer = ZipWriter(file)
        writer.add("mimetype", MIMETYPE)
        plan.begin(writer)
        with closing(_made(plan, cancelled)) as made:
            for number, (job, product) in enumerate(made):
                _add(writer, job.name, product, job.deflate)
                if progress is not None:
                    progress((number + 1) / (len(plan.names) + 1))
        plan.finish(writer)
        writer.close()


def _made(plan: SavePlan, cancelled: Stop) -> Generator[tuple[Job, Product], None, None]:
    """Yields the members, each with its bytes: those of our own as they are made, a few ahead, then all pictures.

    The pictures are one long piece of work, so it is begun first.
    """
    waiting: deque[tuple[Job, Future[Product]]] = deque()
    shown: Future[list[tuple[Job, IO[bytes]]]] | None = None
    try:
        tight = memory.resident() > memory.budget()
        with ThreadPoolExecutor(1 if tight else WORKERS, "save") as pool:
            shown = pool.submit(plan.pictures)
            try:
                while plan.jobs:
                    job = plan.jobs.popleft()  # with the last of a layer's goes what was evaluated for them
                    waiting.append((job, pool.submit(job.make)))
                    if len(waiting) >= WAITING:
                        yield _next(waiting, cancelled)
                while waiting:
                    yield _next(waiting, cancelled)
                yield from shown.result()
            finally:
                for _, future in waiting:
                    future.cancel()
    finally:
        if shown is not None and not shown.cancelled() and shown.exception() is None:
            for _, product in shown.result():
                product.close()


def _next(waiting: deque[tuple[Job, Future[Product]]], cancelled: Stop) -> tuple[Job, Product]:
    check_cancelled(cancelled)
    job, future = waiting.popleft()
    product = future.result()
    memory.settle()  # what it took on the way is given back, not kept beside what the next one takes
    return job, product


def _add(writer: ZipWriter, name: str, product: Product, deflate: bool) -> None:
    if isinstance(product, bytes):
        writer.add(name, product, deflate)
        return
    size = product.seek(0, os.SEEK_END)
    product.seek(0)
    with writer.stored(name, size) as sink:
        while piece := product.read(1 << 20):
            sink.write(piece)
    product.close()


def _verify(part: Path, path: str | os.PathLike[str], plan: SavePlan, ready: Callable[[Path], None] | None) -> None:
    """Reads the finished file back as a stranger would."""
    try:
        with open(part, "rb") as file:
            archive = ZipArchive(file, os.fspath(path))
            archive.check()
            if set(archive.members) != {MANIFEST, MANIFEST_AGAIN, *plan.told}:
                raise WriteError(path, "the file written lacks members")
            for name in plan.names:
                if name.endswith(".png"):
                    PngReader(archive.open(name), name, replace(LIMITS, pixels=STREAMED))  # type: ignore[arg-type]
    except FileError as error:
        raise WriteError(path, f"the file written cannot be read back ({error.message})") from error
    if ready is not None:
        ready(part)


class SavePlan:
    """All members of a painting's file, and where each layer's paint goes."""

    def __init__(self, painting: Painting, recording: Recording | None, cancelled: Stop) -> None:
        self._painting = painting
        self._cancelled = cancelled
        self._level = shown_level(painting.frame)
        self._frame = painting.frame.zoomed(self._level)
        self._packs: dict[int, list[Pack]] = {}
        self._places: dict[int, Rect] = {}
        self._pictures: list[PictureEntry] = []
        self._grounds: dict[int, GroundEntry] = {}
        self._plots: dict[int, list[PlotEntry]] = {}
        self._bases = bases_of(painting.root)
        for layer in layers.layers(painting.root):
            self._places[layer.id] = self._place(layer)
        shown_root = layers.pictured(painting.root)
        self._placed = PlacementPictures(shown_root, self._bases, self._level, self._frame)
        self._placements = list(loops.placements(painting.root))
        for placement in self._placements:
            self._places[placement.id] = self._placed.place(placement)
        laid = [job for layer in layers.layers(painting.root) for job in self._ground_jobs(layer)]
        stored = [job for layer in layers.layers(painting.root) for job in self._tile_jobs(layer)]
        grown = [job for layer in layers.layers(painting.root) for job in self._growth_jobs(layer)]
        seen = [job for source in pictures.sources(painting).values() for job in self._picture_jobs(source)]
        self._selections, chosen = selection_files.entries_of(painting, pack_jobs)
        self._recording = recording
        self.jobs = deque([*seen, *laid, *stored, *grown, *chosen])  # the recording needs pictures: they follow it
        shown: list[Layer | Placement] = [*layers.layers(painting.root), *self._placements]
        self._shown = [*map(png_name, shown), *paper_names(painting.paper), MERGED, THUMB]
        self.names = [*(job.name for job in self.jobs), *self._shown]
        recorded = [] if recording is None else [RECORDING]
        self.told = ["mimetype", *recorded, *self.names, "stack.xml"]  # those that the manifest names

    # ---- pictures for other programs ----

    def _is_ground(self, layer: Layer) -> bool:
        """Tells whether the picture that a layer began with is its picture still."""
        return self._level == 0 and layer.id not in self._bases and grounds.whole(layer, self._frame)

    def _place(self, layer: Layer) -> Rect:
        if self._is_ground(layer):
            assert layer.pyramid.ground is not None
            return layer.pyramid.ground.rect
        place = reach(layer, self._level, self._frame)
        return Rect.at(self._frame.x0, self._frame.y0, 1, 1) if place.empty else place

    def pictures(self) -> list[tuple[Job, IO[bytes]]]:
        """Returns the PNGs of all layers, of them together, and the thumbnail."""
        root, level, places = layers.pictured(self._painting.root), self._level, self._places
        files: dict[str, SpooledPng] = {}
        try:
            for layer in layers.layers(root):
                if not self._is_ground(layer) and layer.id not in self._bases:
                    files[png_name(layer)] = SpooledPng(places[layer.id], len(self._shown))
            files[MERGED] = SpooledPng(self._frame, len(self._shown), small=True)
            for known, merged in sheets(root, level, self._frame, places, self._cancelled, held_pixels()):
                for layer in layers.layers(root):
                    if layer.id in known and png_name(layer) in files:
                        files[png_name(layer)].rows(known[layer.id])
                files[MERGED].rows(merged)
            single: list[Layer | Placement] = [layer for layer in layers.layers(root) if layer.id in self._bases]
            for node in [*self._placements, *single]:
                png = files[png_name(node)] = SpooledPng(places[node.id], len(self._shown))
                for planes in self._placed.drawn(node, places[node.id], self._cancelled):
                    png.rows(to_rgba8(planes))
            files |= paper_pictures(self._painting.paper, self._frame, len(self._shown))
            files[THUMB] = self._thumbnail()
            drawn = [(Job(name, bytes), png.finished()) for name, png in files.items()]
            return [*self._grounds_shown(), *drawn]
        except BaseException:
            for png in files.values():
                png.file.close()
            raise

    def _grounds_shown(self) -> list[tuple[Job, IO[bytes]]]:
        """Returns the pictures of layers that nobody has painted on: those they began with."""
        shown: list[tuple[Job, IO[bytes]]] = []
        for layer in layers.layers(self._painting.root):
            if self._is_ground(layer) and layer.pyramid.ground is not None:
                shown.append((Job(png_name(layer), bytes), _file_of(layer.pyramid.ground.pixels)))
        return shown

    def _thumbnail(self) -> SpooledPng:
        """At most 256 x 256: the level that is just large enough, reduced by exact area means."""
        size = fitted_size(self._frame.width, self._frame.height, _THUMBNAIL)
        level, frame = self._level, self._frame
        while (
            min(frame.width // 2 - size[0], frame.height // 2 - size[1]) >= 0 and max(frame.width, frame.height) > 1024
        ):
            level -= 1
            frame = self._painting.frame.zoomed(level)
        read = strips(layers.pictured(self._painting.root), level, frame, self._cancelled)
        planes = np.concatenate([planes.copy() for planes in read], axis=1)
        png = SpooledPng(Rect(0, 0, *size), 1)
        png.rows(to_rgba8(box_reduce(planes, *size)))
        return png

    # ---- our own members ----

    def _ground_jobs(self, layer: Layer) -> Iterator[Job]:
        ground = layer.pyramid.ground
        if ground is None:
            return
        shared = self._is_ground(layer)
        name = png_name(layer) if shared else f"inkfall/layers/{layer.id}/ground.png"
        found = grounds.entry(layer.pyramid, name)
        assert found is not None
        self._grounds[layer.id] = found
        if not shared:
            png = ground.pixels
            yield Job(name, (lambda: png) if isinstance(png, bytes) else png.opened)

    def _tile_jobs(self, layer: Layer) -> Iterator[Job]:
        tiles = grounds.painted_since(layer.pyramid)
        self._packs[layer.id] = []
        around = needed(grounds.painted_since(layer.pyramid))
        values = Cascade(layer.pyramid, around, min(SMALL, memory.budget() // (_HELD_PART * PIXEL)))
        yield from pack_jobs(f"inkfall/layers/{layer.id}", tiles, self._packs[layer.id], values)

    def _growth_jobs(self, layer: Layer) -> Iterator[Job]:
        self._plots[layer.id] = []
        for number, plot in enumerate(layer.growth):
            entry, makes = plot_files.stored(plot, f"inkfall/layers/{layer.id}/plot{number}")
            self._plots[layer.id].append(entry)
            yield from (Job(name, make) for name, make in makes.items())

    def _picture_jobs(self, source: ImageSource) -> Iterator[Job]:
        packs: list[Pack] = []
        yield from pack_jobs(f"inkfall/pictures/{source.sha}", pictures.tiles(source), packs)
        self._pictures.append(PictureEntry(source.name, source.sha, (source.width, source.height), tuple(packs)))

    # ---- what tells of them ----

    def begin(self, writer: ZipWriter) -> None:
        """Adds the recording, and leaves room for the manifest, whose sums are known at the end."""
        if self._recording is not None:
            told = b"".join(line.encode() + b"\n" for line in self._recording.lines())
            writer.add(RECORDING, told, deflate=True)
        widest = dict.fromkeys([*self.told, MANIFEST_AGAIN], (1 << 62, "0" * 64))
        writer.reserve(MANIFEST, len(self._manifest(widest)))

    def finish(self, writer: ZipWriter) -> None:
        """Adds stack.xml and the manifest, which tell of all that went before, and fills the room that was left."""
        told = Stack(self._painting.root, self._places, self._frame, self._painting.active).entry()
        sums = {name: entry.sha256 for name, entry in writer.written.items()}
        root = with_sums(with_paper(told, self._painting.paper), sums)
        attributes = {"format": str(format_of(self._painting)), "manifest": MANIFEST}
        text = stack_text(ImageEntry(self._frame.width, self._frame.height, root, attributes))
        writer.add("stack.xml", text, deflate=True)
        written = [writer.written[name] for name in self.told]
        members = {entry.name: (entry.size, entry.sha256) for entry in written}
        again = writer.add(MANIFEST_AGAIN, self._manifest(members), deflate=True)
        members[MANIFEST_AGAIN] = again.size, again.sha256
        writer.fill(MANIFEST, self._manifest(members).ljust(writer.written[MANIFEST].size))

    def _manifest(self, members: dict[str, tuple[int, str]]) -> bytes:
        held = self._packs, self._grounds, self._plots, self._pictures
        told = manifest_json(self._painting, *held, members, self._selections)
        return dumps(told).encode()


def _file_of(png: bytes | PutAway) -> IO[bytes]:
    return io.BytesIO(png) if isinstance(png, bytes) else png.opened()


def shown_level(frame: Rect) -> int:
    """0, or the finest coarser level at which the frame is a picture that other programs open."""
    level = 0
    while True:
        seen = frame.zoomed(level)
        if max(seen.width, seen.height) <= MERGED_SIDE and seen.area <= LIMITS.pixels:
            return level
        level -= 1
