"""The pictures that texture definitions name: files, and rectangles of the canvas."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from immutables import Map

from engine.brush.checks import thawed
from engine.canvas.layers import Group
from engine.files.fault import FileError
from engine.files.images import read_image, read_png
from engine.files.layered.reading_layers import has_layers, read_sheet
from engine.files.layered.whole_file import read_whole
from engine.files.limits import LIMITS, STREAMED
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.grid import snapped
from engine.numeric.parted import Raster, Room
from engine.painting.commands import LEVEL_LIMIT, PLACE_LIMIT
from engine.painting.grown import settled_alone, settled_root
from engine.painting.layering.touch_command import NO_TOUCHES, Touches
from engine.painting.rendering import strips
from engine.texture.image import ImageSource
from engine.texture.raster import planes_of, put_plainly
from engine.texture.record import LEARNT

PIXELS_CAP = 1 << 26  # of a picture: 1 GiB as float32 planes
DETAIL_CAP = 16  # finer levels that a captured rectangle may hold


_NO_PICTURES: Map[str, ImageSource] = Map()


@dataclass(frozen=True, slots=True)
class PictureSource:
    """Where pictures come from: files, paths starting from a folder; the canvas; those known by their sha.
    `arithmetic`: in which what is made of them is worked out; `touches`: what is painted on solids."""

    folder: Path | None
    root: Group
    pictures: Mapping[str, ImageSource] = _NO_PICTURES
    arithmetic: int = LIBRARY
    touches: Touches = NO_TOUCHES

    def picture(self, members: Fields) -> np.ndarray:
        """Returns the picture that `path`, or else `rect` and `layer`, name: premultiplied RGBA, float32 (4, h, w)."""
        if "path" in members and "rect" in members:
            raise members.fault("rect", "either path or rect")
        if "rect" in members:
            return captured(members, self.root)
        return read_picture(members.text("path", cap=4096), self.folder)

    def shape(self, shape: Mapping[str, Any]) -> np.ndarray:
        """Returns the picture that a shape of a spectrum names: that of a texture by its sha, or as `picture`."""
        members = Fields(thawed(shape), "shapes")
        if shape["shape"] != "texture":
            return self.picture(members)
        known = self.pictures.get(members.text("sha", cap=64))
        planes = None if known is None else known.data
        if planes is None:
            raise members.fault("sha", "that of a texture which the painting has")
        return planes


def read_picture(path: str, folder: Path | None) -> np.ndarray:
    """Returns the planes of a picture file, float32 (4, h, w) on the grid; of a file of layers, those side by side.  A
    relative path starts from `folder`."""
    return planes_of(_read(path, folder))


def read_straight(path: str, folder: Path | None, room: Room | None = None, converted: bool = False) -> Raster:
    """Returns the pixels of a picture file, in as few bits as tell its planes.  A relative path starts from `folder`;
    `room`: where they are put, of a PNG as they are read, which may be larger then; `converted`: to sRGB, from the
    profile in the file."""
    if room is None:
        return put_plainly(_read(path, folder, converted))
    pixels = read_png(_found(path, folder), path, replace(LIMITS, pixels=STREAMED), room, converted)
    return put_plainly(_read(path, folder, converted) if pixels is None else pixels, room)


def read_bytes(path: str, folder: Path | None) -> Raster:
    """Returns the bytes of a file as pixels (`whole_file`), so that they are kept as a picture is."""
    return read_whole(_found(path, folder), path)


def _found(path: str, folder: Path | None) -> Path:
    where = Path(path) if folder is None else folder / path
    if not os.path.isfile(where):  # also so that no pipe or device is opened
        raise FileError(path, f"found no picture there, expected a PNG, JPEG or TIFF ({where})")
    return where


def _read(path: str, folder: Path | None, converted: bool = False) -> np.ndarray:
    where = _found(path, folder)
    if has_layers(where):
        return read_sheet(where, path)
    return read_image(where, path, replace(LIMITS, pixels=PIXELS_CAP), converted=converted)[0]


def captured(members: Fields, root: Group) -> np.ndarray:
    """Returns a rectangle of the canvas as a picture, float32 (4, h, w) on the grid."""
    level, x, y, width, height = members.integers("rect", 5, limit=PLACE_LIMIT)
    learnt = members.all().get("detail") == LEARNT  # of what is made of it, not of the canvas
    detail = 0 if learnt else members.integer("detail", 0, lo=0, hi=DETAIL_CAP)
    if abs(level) > LEVEL_LIMIT or width < 1 or height < 1 or (width * height) << (2 * detail) > PIXELS_CAP:
        raise members.fault("rect", f"[L, X, Y, W, H] of at most {PIXELS_CAP} pixels at the finest level")
    name = members.text("layer", None)
    root = replace(root, paper=None)  # what is taken is paint: where there is none, there is no picture
    shown = settled_root(root) if name is None else settled_alone(root, name)
    rect = Rect.at(x, y, width, height).zoomed(detail)
    return snapped(np.concatenate([strip.copy() for strip in strips(shown, level + detail, rect)], axis=1))
