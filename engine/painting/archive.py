"""Saving a painting as OpenRaster: pictures for every program, and beside them all that makes it refine on zoom.

Layout: mimetype (first, stored), data/L*.png (each layer's part of the frame), mergedimage.png,
Thumbnails/thumbnail.png, stack.xml, then under inkfall/ the tiles in packs, pictures, recording and manifest.  The
same painting gives the same bytes.  A save takes a frozen snapshot, so it can run on any thread.
"""

from __future__ import annotations

import os
import tempfile
from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import IO

import numpy as np

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node, isolation
from engine.numeric import blend
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.numeric.shrink import box_reduce, fitted
from engine.painting import pictures
from engine.painting.atomic import replacing
from engine.painting.fault import FileError, WriteError
from engine.painting.limits import LIMITS
from engine.painting.manifest import FORMAT, MANIFEST, RECORDING, Pack, PictureEntry, manifest_json
from engine.painting.packing import Tile, encoded_size, grouped, pack
from engine.painting.pngread import PngReader
from engine.painting.pngstream import PngWriter
from engine.painting.recording import Recording
from engine.painting.rendering import Stop, bands, check, folded, layer_strips, reach, strips
from engine.painting.stackxml import ImageEntry, LayerEntry, StackEntry, stack_text
from engine.painting.strictjson import dumps
from engine.painting.value import Painting
from engine.painting.zipguard import ZipArchive
from engine.painting.zipwrite import ZipWriter

MIMETYPE = b"image/openraster"
SIDE = (1 << 15) - 1  # pixels: the largest picture that the other programs open
THUMBNAIL = 256
IN_MEMORY = 32 << 20  # bytes of a compressed picture that are kept in memory before it goes into the file
WORKERS = 2
WAITING = 4  # finished jobs that may wait for their turn


@dataclass(frozen=True, eq=False, slots=True)
class Snapshot:
    """What a save writes: the painting, and the recording that led to it if that is known."""

    painting: Painting
    recording: Recording | None = None


@dataclass(frozen=True)
class Job:
    """One member: its name, and what makes its bytes; `deflate`: text."""

    name: str
    make: Callable[[], bytes | IO[bytes]]
    deflate: bool = False


def save(
    path: str | os.PathLike[str],
    snapshot: Snapshot,
    progress: Callable[[float], None] | None = None,
    cancelled: Stop = None,
) -> None:
    """Writes the painting.  The place holds the old file or the whole new one, which was read back and checked.

    `progress` gets the part done, 0..1, on the calling thread; `cancelled` is asked from several.  WriteError if it
    cannot be done, Cancelled if it was asked for; either way nothing has changed.
    """
    painting = replace(snapshot.painting, root=folded(snapshot.painting.root))
    plan = Plan(painting, snapshot.recording, cancelled)
    try:
        with replacing(path, verify=lambda part: _verify(part, path, plan)) as file:
            writer = ZipWriter(file)
            writer.add("mimetype", MIMETYPE)
            jobs = plan.jobs
            with closing(_made(jobs, cancelled)) as made:
                for number, (job, product) in enumerate(made):
                    _add(writer, job, product)
                    if progress is not None:
                        progress((number + 1) / (len(jobs) + 1))
            plan.finish(writer)
            writer.close()
    except MemoryError as error:
        raise WriteError(path, "not enough memory to save it") from error
    if progress is not None:
        progress(1.0)


def _made(jobs: list[Job], cancelled: Stop) -> Generator[tuple[Job, bytes | IO[bytes]], None, None]:
    """The jobs in their order, each with what it made; a few are worked on ahead."""
    waiting: deque[tuple[Job, Future]] = deque()
    try:
        with ThreadPoolExecutor(WORKERS, "save") as pool:
            try:
                for job in jobs:
                    waiting.append((job, pool.submit(job.make)))
                    if len(waiting) >= WAITING:
                        yield _next(waiting, cancelled)
                while waiting:
                    yield _next(waiting, cancelled)
            finally:
                for _, future in waiting:
                    future.cancel()
    finally:
        for _, future in waiting:
            _discard(future)


def _discard(future: Future) -> None:
    """Closes what a job made that nobody wants any more."""
    if not future.cancelled() and future.exception() is None and not isinstance(future.result(), bytes):
        future.result().close()


def _next(waiting: deque, cancelled: Stop) -> tuple[Job, bytes | IO[bytes]]:
    check(cancelled)
    job, future = waiting[0]
    product = future.result()
    waiting.popleft()
    return job, product


def _add(writer: ZipWriter, job: Job, product: bytes | IO[bytes]) -> None:
    if isinstance(product, bytes):
        writer.add(job.name, product, job.deflate)
        return
    with product:
        size = product.seek(0, os.SEEK_END)
        product.seek(0)
        with writer.stored(job.name, size) as sink:
            while piece := product.read(1 << 20):
                sink.write(piece)


def _verify(part: Path, path: str | os.PathLike[str], plan: Plan) -> None:
    """Reads the finished file back as a stranger would."""
    try:
        with open(part, "rb") as file:
            archive = ZipArchive(file, os.fspath(path))
            archive.check()
            if set(archive.members) != {"mimetype", "stack.xml", MANIFEST, *(job.name for job in plan.jobs)}:
                raise WriteError(path, "the file written lacks members")
            for job in plan.jobs:
                if job.name.endswith(".png"):
                    PngReader(archive.open(job.name), job.name)  # type: ignore[arg-type]
    except FileError as error:
        raise WriteError(path, f"the file written cannot be read back ({error.message})") from error


class Plan:
    """All members of a painting's file, and where each layer's paint goes."""

    def __init__(self, painting: Painting, recording: Recording | None, cancelled: Stop) -> None:
        self._painting = painting
        self._cancelled = cancelled
        self._level = shown_level(painting.frame)
        self._frame = painting.frame.zoomed(self._level)
        self._packs: dict[int, list[Pack]] = {}
        self._places: dict[int, Rect] = {}
        self._pictures: list[PictureEntry] = []
        merged = Job("mergedimage.png", self._merged)
        thumbnail = Job("Thumbnails/thumbnail.png", self._thumbnail)
        shown = [self._layer_job(layer) for layer in layers.layers(painting.root)]
        stored = [job for layer in layers.layers(painting.root) for job in self._tile_jobs(layer)]
        seen = [job for source in pictures.sources(painting).values() for job in self._picture_jobs(source)]
        told = [] if recording is None else [Job(RECORDING, lambda: _told(recording), deflate=True)]
        # The longest first, so that the last to finish is a short one.
        self.jobs = [merged, *shown, *stored, *seen, *told, thumbnail]

    # ---- pictures for other programs ----

    def _layer_job(self, layer: Layer) -> Job:
        place = reach(layer.pyramid, self._level, self._frame)
        if place.empty:
            place = Rect.at(self._frame.x0, self._frame.y0, 1, 1)
        self._places[layer.id] = place
        return Job(f"data/L{layer.id}.png", partial(self._layer_picture, layer, place))

    def _layer_picture(self, layer: Layer, place: Rect) -> IO[bytes]:
        found = layer_strips(layer.pyramid, self._level, place, self._cancelled)
        return _png(place, ((None if p is None else to_rgba8(p)) for p in found))

    def _merged(self) -> IO[bytes]:
        found = strips(self._painting.root, self._level, self._frame, self._cancelled)
        return _png(self._frame, (to_rgba8(planes) for planes in found))

    def _thumbnail(self) -> IO[bytes]:
        """At most 256 x 256: the level that is just large enough, reduced by exact area means."""
        size = fitted(self._frame.width, self._frame.height, THUMBNAIL)
        level, frame = self._level, self._frame
        while (
            min(frame.width // 2 - size[0], frame.height // 2 - size[1]) >= 0 and max(frame.width, frame.height) > 1024
        ):
            level -= 1
            frame = self._painting.frame.zoomed(level)
        read = strips(self._painting.root, level, frame, self._cancelled)
        planes = np.concatenate([planes.copy() for planes in read], axis=1)
        small = box_reduce(planes, *size)
        return _png(Rect(0, 0, *size), iter([to_rgba8(small)]))

    def _entry(self, node: Node) -> StackEntry | LayerEntry:
        if isinstance(node, Group):
            return StackEntry(
                tuple(self._entry(child) for child in reversed(node.children)),
                node.name,
                node.opacity,
                node.visible,
                blend.BLENDS[node.blend].op,
                isolation(node) == "isolate",
                node.locked,
                {"id": str(node.id)},
            )
        place = self._places[node.id]
        return LayerEntry(
            f"data/L{node.id}.png",
            node.name,
            place.x0 - self._frame.x0,
            place.y0 - self._frame.y0,
            node.opacity,
            node.visible,
            blend.BLENDS[node.blend].op,
            node.locked,
            node.name == self._painting.active,
            {"id": str(node.id)},
        )

    # ---- our own members ----

    def _tile_jobs(self, layer: Layer) -> Iterator[Job]:
        tiles = list(layer.pyramid.all_records())
        self._packs[layer.id] = []
        yield from _pack_jobs(f"inkfall/layers/{layer.id}", tiles, self._packs[layer.id])

    def _picture_jobs(self, source) -> Iterator[Job]:
        packs: list[Pack] = []
        yield from _pack_jobs(f"inkfall/pictures/{source.sha}", pictures.tiles(source), packs)
        self._pictures.append(PictureEntry(source.name, source.sha, (source.width, source.height), tuple(packs)))

    def finish(self, writer: ZipWriter) -> None:
        """Adds stack.xml and the manifest, which tell of all that went before."""
        root = self._entry(self._painting.root)
        assert isinstance(root, StackEntry)
        root = _with_sums(root, {name: entry.sha256 for name, entry in writer.written.items()})
        attributes = {"format": str(FORMAT), "manifest": MANIFEST}
        text = stack_text(ImageEntry(self._frame.width, self._frame.height, root, attributes))
        writer.add("stack.xml", text, deflate=True)
        members = {name: (entry.size, entry.sha256) for name, entry in writer.written.items()}
        told = manifest_json(self._painting, self._packs, self._pictures, members)
        writer.add(MANIFEST, dumps(told).encode(), deflate=True)


def _with_sums(stack: StackEntry, sums: dict[str, str]) -> StackEntry:
    """The tree with the SHA-256 of each layer's picture: shows later whether another program changed it."""
    children = tuple(
        _with_sums(child, sums)
        if isinstance(child, StackEntry)
        else replace(child, ours={**child.ours, "sha256": sums[child.src]})
        for child in stack.children
    )
    return replace(stack, children=children)


def shown_level(frame: Rect) -> int:
    """0, or the finest coarser level at which the frame is a picture that other programs open."""
    level = 0
    while True:
        seen = frame.zoomed(level)
        if max(seen.width, seen.height) <= SIDE and seen.area <= LIMITS.pixels:
            return level
        level -= 1


def _png(place: Rect, strips_of: Iterator[np.ndarray | None]) -> IO[bytes]:
    """A PNG of 8-bit rows, one array for each of `bands(place)`, None for empty ones."""
    file = tempfile.SpooledTemporaryFile(IN_MEMORY)  # noqa: SIM115  # closed by the one who writes it on
    try:
        writer = PngWriter(file, place.width, place.height)  # type: ignore[arg-type]
        for band, pixels in zip(bands(place), strips_of, strict=False):
            writer.rows(np.zeros((band.height, band.width, 4), np.uint8) if pixels is None else pixels)
        writer.close()
    except BaseException:
        file.close()
        raise
    return file


def _pack_jobs(stem: str, tiles: list[Tile], packs: list[Pack]) -> Iterator[Job]:
    for number, group in enumerate(grouped(tiles)):
        name = f"{stem}/{number}.tiles"
        plain = sum(encoded_size(r.data.shape, 8 * r.data.itemsize) for _, r in group)
        packs.append(Pack(name, len(group), plain))
        yield Job(name, partial(pack, group))


def _told(recording: Recording) -> bytes:
    return b"".join(line.encode() + b"\n" for line in recording.lines())
