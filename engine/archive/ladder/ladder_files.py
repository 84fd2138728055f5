"""Ladders into files on one machine: Zarr, DeepZoom, TIFF.  What they look like says a row of `FOLDERS`."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path, PurePath

import numpy as np

from engine.archive.export import Picture, lighting_of, shown_root
from engine.archive.ladder import deepzoom, zarr_folder
from engine.archive.ladder.blocks import Source, in_order
from engine.archive.ladder.in_place import put_in_place
from engine.archive.ladder.rungs import Block, Ladder, grid
from engine.checks.picture_sides import PICTURE_SIDE
from engine.files.atomic import replacing
from engine.files.fault import WriteError
from engine.files.tiff_levels import TIFF_TILE, TiffLevel, tiff_tile, write_tiff_levels
from engine.numeric.address import Rect
from engine.painting.rendering import Progress, Stop

EXTRA = "pip install inkfall[cluster]"
SIDE = 1 << 30  # pixels, of what is no single file


@dataclass(frozen=True, slots=True)
class FolderFormat:
    """A format of many files.

    `tile`, `smallest`: of the ladder; `parts`: names of all that a file of some name consists of; `needed`: raises
    ImportError; `replaceable`: what is wrong with what lies in the place of a part; `begin`: makes all but the pixels;
    `reach`: the pixels that a block's files hold; `put`: writes them.
    """

    tile: int
    smallest: int
    parts: Callable[[str], tuple[str, ...]]
    needed: Callable[[], None]
    replaceable: Callable[[Path], str]
    begin: Callable[[Path, Ladder], None]
    reach: Callable[[Ladder, Block], Rect]
    put: Callable[[Path, Ladder, Block, np.ndarray], None]


def _zarr_there(place: Path) -> str:
    if (place / "zarr.json").is_file():
        return ""
    return f"found {'a folder that is no Zarr' if place.is_dir() else 'a file'}, expected none or a Zarr to replace"


def _deepzoom_there(place: Path) -> str:
    if place.name.endswith("_files"):
        ours = place.is_dir() and all(entry.is_dir() and entry.name.isdecimal() for entry in place.iterdir())
        return "" if ours else "found something else than tiles of DeepZoom, expected none or those to replace"
    if not place.is_file():
        return "found a folder, expected a file name"
    if place.suffix == ".html" and deepzoom.MARK not in place.read_text("utf-8", "replace"):
        return "found a page that no export made, expected none or one to replace"
    return ""


FOLDERS = {
    ".zarr": FolderFormat(
        tile=zarr_folder.CHUNK,
        smallest=zarr_folder.CHUNK,
        parts=lambda name: (name,),
        needed=zarr_folder.require,
        replaceable=_zarr_there,
        begin=zarr_folder.begin,
        reach=lambda ladder, block: block.rect,
        put=zarr_folder.put,
    ),
    ".dzi": FolderFormat(
        tile=deepzoom.DZI_TILE,
        smallest=1,
        parts=deepzoom.names_of,
        needed=lambda: None,
        replaceable=_deepzoom_there,
        begin=deepzoom.begin,
        reach=deepzoom.overlapped,
        put=deepzoom.put,
    ),
}


def folder_format(path: str | os.PathLike[str]) -> FolderFormat:
    """Returns the row of a path's ending; WriteError for another one, or where a library is missing."""
    ending = PurePath(path).suffix.lower()
    found = FOLDERS.get(ending)
    if found is None:
        raise WriteError(path, f"found the ending {ending!r}, expected one of {', '.join(FOLDERS)}")
    try:
        found.needed()
    except ImportError:
        raise WriteError(path, f"export to {ending} needs: {EXTRA}") from None
    return found


def ladder_of(path: str | os.PathLike[str], picture: Picture, form: FolderFormat) -> Ladder:
    """Returns the ladder that a path gets; WriteError if it cannot be made."""
    return _ladder(path, picture, form.tile, form.smallest, SIDE)


def write_folder(
    path: str | os.PathLike[str], picture: Picture, progress: Progress = None, cancelled: Stop = None
) -> None:
    """Writes the picture and its coarser levels as .zarr or .dzi, by the ending of `path`, on all cores.

    As `export`: the place holds what was there or the whole new one, `progress` gets the part done, WriteError on
    failure, LayerError for an unknown layer, Cancelled if `cancelled()` becomes true.
    """
    form = folder_format(path)
    ladder = ladder_of(path, picture, form)
    source = Source(shown_root(picture), ladder, lighting_of(picture))
    name = PurePath(path).name
    with put_in_place(path, form.parts(name), form.replaceable) as folder:
        target = folder / name
        form.begin(target, ladder)

        def work(block: Block, stopped: Stop) -> None:
            form.put(target, ladder, block, source.pixels(block.rung, form.reach(ladder, block), stopped))

        tell = Telling(ladder, progress)
        with closing(in_order(ladder.blocks(), work, cancelled)) as made:
            for block, _ in made:
                tell(block.rect.area)


def write_tiff_ladder(
    path: str | os.PathLike[str], picture: Picture, progress: Progress = None, cancelled: Stop = None
) -> None:
    """Writes the picture as a BigTIFF of tiles with its coarser levels beside it; otherwise as `write_folder`."""
    ladder = _ladder(path, picture, TIFF_TILE, TIFF_TILE, PICTURE_SIDE)
    source = Source(shown_root(picture), ladder, lighting_of(picture))
    tell = Telling(ladder, progress)

    def work(block: Block, stopped: Stop) -> list[bytes]:
        pixels = source.pixels(block.rung, block.rect, stopped)
        return [tiff_tile(pixels[:, x : x + TIFF_TILE]) for x in range(0, block.rect.width, TIFF_TILE)]

    def tiles(made: Iterator[tuple[Block, list[bytes]]]) -> Iterator[bytes]:
        for block, some in made:
            tell(block.rect.area)  # what follows the last tile is never asked for
            yield from some

    blocks = (block for whole in ladder.rungs for block in _rows_of_tiles(whole.step, whole.size))
    with replacing(path) as file, closing(in_order(blocks, work, cancelled)) as all_made:
        by_rung = groupby(all_made, key=lambda made: made[0].rung)
        levels = (TiffLevel(ladder.rungs[rung].size, tiles(made)) for rung, made in by_rung)
        write_tiff_levels(file, ladder.depth, levels, len(ladder.rungs))


def _rows_of_tiles(rung: int, size: tuple[int, int]) -> Iterator[Block]:
    """Yields blocks of four tiles beside one another, in the order in which a TIFF holds its tiles."""
    width = 4 * TIFF_TILE
    for row in grid((1, size[1]), TIFF_TILE):
        for x in range(0, size[0], width):
            yield Block(rung, Rect(x, row.y0, min(x + width, size[0]), row.y1))


def _ladder(path: str | os.PathLike[str], picture: Picture, tile: int, smallest: int, most: int) -> Ladder:
    if picture.depth not in (8, 16):
        raise WriteError(path, f"found {picture.depth} bits, expected 8 or 16")
    area = picture.area
    if area.empty or max(area.width, area.height) > most:
        raise WriteError(path, f"found a picture of {area.width} x {area.height}, expected 1 to {most} each way")
    return Ladder.of(PurePath(path).stem, picture.level, area, picture.depth, tile, smallest)


class Telling:
    """Counts pixels, and tells the part of them that is done."""

    def __init__(self, ladder: Ladder, progress: Progress) -> None:
        self._total, self._done, self._progress = ladder.pixels, 0, progress

    def __call__(self, pixels: int) -> None:
        """Counts some more."""
        self._done += pixels
        if self._progress is not None:
            self._progress(self._done / self._total)
