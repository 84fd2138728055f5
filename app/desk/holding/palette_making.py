"""Palettes made of pictures: of a file, or of what is in view."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.desk.colours import RGB, from_hex
from app.desk.desk import Desk
from app.desk.holding.palette_shelf import KeptPalette, taken_names
from app.desk.outside.pictured import seen
from engine.files.fault import FileError
from engine.files.swatches.colour_list import ColourList, plain_name
from engine.studio.copy_records import Copied, CopyPicture

TO_PALETTE = "palette"  # what a picture is copied for
_PIXELS = 1 << 17  # of what is in view that are asked for


@dataclass(frozen=True, slots=True)
class _OfFile(KeptPalette):
    path: Path

    def found(self) -> ColourList:
        from engine.files.images import read_image  # here, on the thread: it loads what reads JPEG
        from engine.files.swatches.picture_colours import picture_palette

        pixels, _ = read_image(self.path, self.path.name, converted=True)
        return _any(picture_palette(pixels, plain_name(self.path.stem) or "Picture"), self.path.name)


@dataclass(frozen=True, slots=True, eq=False)
class _OfPixels(KeptPalette):
    pixels: np.ndarray
    paper: RGB | None

    def found(self) -> ColourList:
        from engine.files.swatches.picture_colours import picture_palette

        return _any(picture_palette(self.pixels, "View", self.paper), "what is in view")


def _any(palette: ColourList, of: str) -> ColourList:
    if not palette.colours:
        raise FileError(of, "found nothing but transparency, expected colours")
    return palette


def palette_of_file(desk: Desk, path: Path) -> None:
    """Has a palette made of the colours of a picture file."""
    desk.work(_OfFile(taken_names(desk), path))


def ask_palette_of_view(desk: Desk) -> None:
    """Asks for what the window shows of the painting, of which a palette is made as soon as it is there."""
    level, area = desk.view.shown_level, seen(desk)
    while area.area > _PIXELS:
        level, area = level - 1, area.zoomed(-1)
    desk.post(CopyPicture(level, area, TO_PALETTE))


def palette_of_copied(desk: Desk, told: Copied) -> None:
    """Has a palette made of a picture that was asked for."""
    paper = desk.known.paper
    desk.work(_OfPixels(taken_names(desk), told.pixels, None if paper is None else from_hex(paper)))
