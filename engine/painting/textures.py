"""Textures defined by name: a procedural one with its parameters, a picture from a file, a rectangle of the canvas."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from immutables import Map

from engine.canvas import layers
from engine.canvas.evaluate import TileCache
from engine.canvas.layers import Group
from engine.numeric.address import Rect
from engine.numeric.colour import from_rgba8, from_rgba16
from engine.numeric.grid import snapped
from engine.painting.commands import LEVEL_LIMIT, PLACE_LIMIT, DefineTexture
from engine.painting.fault import FileError
from engine.painting.images import read_image
from engine.painting.limits import LIMITS
from engine.painting.rendering import strips
from engine.painting.strictjson import Fields, FormatError
from engine.texture.image import ImageSource
from engine.texture.record import Instance
from engine.texture.table import KINDS, instance

PIXELS_CAP = 1 << 26  # of a picture: 1 GiB as float32 planes
DETAIL_CAP = 16  # finer levels that a captured rectangle may hold
LATER = ("spectrum", "sparse", "impulse", "match", "mix", "solid", "example")


@dataclass(frozen=True, eq=False, slots=True)
class Texture:
    """`kind`: a row of KINDS; `parameters`: those that the definition gives, a brush may give others on top;
    `source`: the picture of an image."""

    kind: str
    parameters: Map[str, Any]
    source: ImageSource | None = None

    def instance(self, parameters: Mapping[str, Any], level: int, seed: int) -> Instance:
        return instance(self.kind, {**self.parameters, **parameters}, level, seed, self.source)


@dataclass(frozen=True, slots=True)
class Around:
    """What carrying out a command may use besides the painting: a cache of tiles, the folder that paths start from, and
    pictures that are known already, by their sha."""

    cache: TileCache | None = None
    folder: Path | None = None
    pictures: Mapping[str, ImageSource] = Map()


def define(command: DefineTexture, root: Group, around: Around) -> Texture:
    """The texture that a command defines over a painting with the layers `root`.

    FormatError, TextureError or LayerError name what is wrong with it, FileError the picture that cannot be read.
    """
    make = MAKERS.get(command.maker)
    if make is None:
        note = " (it comes in a later release)" if command.maker in LATER else ""
        raise FormatError("maker", f"{command.maker!a}{note}", f"one of {', '.join(MAKERS)}")
    texture = make(command, root, around)
    texture.instance({}, 0, 0)  # its parameters are checked where it is defined, not where it is used
    return texture


def recorded(command: DefineTexture, texture: Texture) -> DefineTexture:
    """The command with the sha of its picture, by which the picture is known again."""
    if texture.source is None:
        return command
    return replace(command, arguments=command.arguments.set("sha", texture.source.sha))


def _procedural(command: DefineTexture, root: Group, around: Around) -> Texture:
    return Texture(command.maker, command.arguments)


def _image(command: DefineTexture, root: Group, around: Around) -> Texture:
    members = Fields(command.arguments, "")
    path = members.text("path", cap=4096)
    sha = members.text("sha", None, cap=64)
    if sha is not None and sha in around.pictures:
        return Texture("image", command.arguments, replace(around.pictures[sha], name=command.name))
    source = ImageSource.of(command.name, read_picture(path, around.folder))
    if sha is not None and sha != source.sha:
        raise FileError(path, "its pixels are not those that were there when it was recorded")
    return Texture("image", command.arguments, source)


def read_picture(path: str, folder: Path | None) -> np.ndarray:
    """The planes of a picture file, float32 (4, h, w) on the grid.  A relative path starts from `folder`."""
    where = Path(path) if folder is None else folder / path
    if not os.path.isfile(where):  # also so that no pipe or device is opened
        raise FileError(path, f"found no picture there, expected a PNG, JPEG or TIFF beside the recording ({where})")
    pixels, _ = read_image(where, path, replace(LIMITS, pixels=PIXELS_CAP))
    return from_rgba16(pixels) if pixels.dtype == np.uint16 else from_rgba8(pixels)


def _canvas(command: DefineTexture, root: Group, around: Around) -> Texture:
    members = Fields({name: _listed(value) for name, value in command.arguments.items()}, "")
    level, x, y, width, height = members.integers("rect", 5, limit=PLACE_LIMIT)
    detail = members.integer("detail", 0, lo=0, hi=DETAIL_CAP)
    if abs(level) > LEVEL_LIMIT or width < 1 or height < 1 or (width * height) << (2 * detail) > PIXELS_CAP:
        raise members.fault("rect", f"[L, X, Y, W, H] of at most {PIXELS_CAP} pixels at the finest level")
    name = members.text("layer", None)
    shown = root if name is None else layers.alone(layers.find(root, name))
    rect = Rect.at(x, y, width, height).zoomed(detail)
    planes = np.concatenate([strip.copy() for strip in strips(shown, level + detail, rect)], axis=1)
    given = command.arguments
    parameters = given if "period" in given else given.set("period", width)
    return Texture("canvas", parameters, ImageSource.of(command.name, snapped(planes)))


def _listed(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value


Maker = Callable[[DefineTexture, Group, Around], Texture]
MAKERS: dict[str, Maker] = {
    **{name: _procedural for name, row in KINDS.items() if not row.pictured},
    "image": _image,
    "canvas": _canvas,
}
