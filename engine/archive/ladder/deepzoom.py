"""A ladder as DeepZoom: NAME.dzi, NAME_files with a PNG for each tile, and NAME.html, a page that shows it."""

from __future__ import annotations

import html
import json
import os
import re
import threading
from pathlib import Path

import numpy as np

from engine.archive.ladder.rungs import Block, Ladder, grid
from engine.files.png_writer import PngWriter
from engine.numeric.address import Rect

DZI_TILE = 510  # with a pixel of its neighbours on each side: 512
OVERLAP = 1
MARK = '<meta name="generator" content="Inkfall">'
_PAGE = Path(__file__).with_name("page.html")
_ABOUT = """<?xml version="1.0" encoding="UTF-8"?>
<Image xmlns="http://schemas.microsoft.com/deepzoom/2008" Format="png" Overlap="{overlap}" TileSize="{tile}">
  <Size Width="{width}" Height="{height}"/>
</Image>
"""


def names_of(name: str) -> tuple[str, str, str]:
    """Returns the names of all that NAME.dzi consists of, itself last."""
    stem = os.path.splitext(name)[0]
    return f"{stem}_files", f"{stem}.html", name


def begin(path: Path, ladder: Ladder) -> None:
    """Makes all of it but the tiles; `path` is that of NAME.dzi."""
    files, page, _ = (path.with_name(name) for name in names_of(path.name))
    width, height = ladder.rungs[0].size
    path.write_text(_ABOUT.format(overlap=OVERLAP, tile=DZI_TILE, width=width, height=height), "utf-8")
    page.write_text(_page(files.name, ladder), "utf-8")
    for rung in ladder.rungs:
        (files / _number(ladder, rung.step)).mkdir(parents=True)


def overlapped(ladder: Ladder, block: Block) -> Rect:
    """Returns the pixels of the block's tiles: those around it belong to them, too."""
    return block.rect.grown(OVERLAP).intersect(Rect.at(0, 0, *ladder.rungs[block.rung].size))


def put(path: Path, ladder: Ladder, block: Block, pixels: np.ndarray) -> None:
    """Writes the tiles of a block, `pixels`: those of `overlapped`: each whole, or not at all."""
    folder = path.with_name(names_of(path.name)[0]) / _number(ladder, block.rung)
    around = overlapped(ladder, block)
    for tile in grid(ladder.rungs[block.rung].size, DZI_TILE, block.rect):
        rows, columns = overlapped(ladder, Block(block.rung, tile)).slices(around)
        _write(folder / f"{tile.x0 // DZI_TILE}_{tile.y0 // DZI_TILE}.png", pixels[rows, columns], ladder.depth)


def _number(ladder: Ladder, step: int) -> str:
    """Returns the level as DeepZoom counts: 0 is a single pixel."""
    return str(len(ladder.rungs) - 1 - step)


def _write(path: Path, pixels: np.ndarray, depth: int) -> None:
    beside = path.with_name(f"{path.name}.{os.getpid()}.{threading.get_ident()}.partial")
    with open(beside, "wb") as file:
        writer = PngWriter(file, pixels.shape[1], pixels.shape[0], channels=4, depth=depth)
        writer.rows(pixels)
        writer.close()
    os.replace(beside, path)


def _page(files: str, ladder: Ladder) -> str:
    """Returns the page, which knows all that it shows: opened from the disk, it can load nothing but pictures.

    It is told where each rung begins, so it shows them where they are.
    """
    width, height = ladder.rungs[0].size
    rungs = [{"size": rung.size, "at": ladder.offset(rung)} for rung in ladder.rungs]
    told = {"files": files, "size": (width, height), "tile": DZI_TILE, "overlap": OVERLAP, "rungs": rungs}
    texts = {"MARK": MARK, "NAME": html.escape(ladder.name), "TOLD": json.dumps(told).replace("<", "\\u003c")}
    return re.sub(r"\$(MARK|NAME|TOLD)", lambda place: texts[place[1]], _PAGE.read_text("utf-8"))
