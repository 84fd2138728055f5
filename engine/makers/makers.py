"""The makers of textures: a procedural one with its parameters, a picture, a piece of the canvas, Lewis' three,
Heeger's and Bergen's two, and examples to be grown.

The command line, a recording and the window define textures by the same command, so they get the same texture.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from engine.brush.checks import thawed
from engine.canvas.layers import Group
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.files.strict_json import Fields
from engine.keeping.disk_raster import room
from engine.makers import carved, heeger_bergen, lewis
from engine.makers.definitions import FIELDS, LEARN, USUAL, kind_of
from engine.makers.learning import learnt_of, with_maps
from engine.makers.namesakes import Namesakes, with_names
from engine.painting.capture import PictureSource, captured, read_bytes, read_straight
from engine.painting.commands import DefineTexture
from engine.painting.layering.painting_member import A_FILE, A_PICTURE, HOLDS
from engine.painting.textures import Around, Texture
from engine.painting.times import untimed
from engine.strokes import example_textures
from engine.texture.expression.library.bundled_texts import generator_library, like_in_library, written_library
from engine.texture.expression.written_ink import Named
from engine.texture.image import ImageSource
from engine.texture.table import DEFINED, EXPRESSION, KINDS

NARROWEST = 4  # pixels across the narrowest sample that tiles: a narrower one is repeated


def define(command: DefineTexture, root: Group, around: Around) -> Texture:
    """Returns the texture that a command defines over a painting with the layers `root`.

    FieldError or LayerError names what is wrong with it, FileError the picture that cannot be read.
    """
    make = MAKERS.get(command.maker)
    if make is None:
        raise FieldError("maker", f"{command.maker!a}", f"one of {', '.join(MAKERS)}")
    texture = replace(make(untimed(command), root, around), arithmetic=around.arithmetic)
    texture = with_maps(command.name, texture, around)
    texture.instance({}, 0, 0)  # its parameters are checked where it is defined, not where it is used
    return texture


def _procedural(command: DefineTexture, root: Group, around: Around) -> Texture:
    return Texture(command.maker, command.arguments)


def _written(command: DefineTexture, root: Group, around: Around) -> Texture:
    """Returns a written texture; one that comes along is known by its name, and keeps its text from then on."""
    told = command.arguments
    if "bundled" in told and "text" not in told:
        name = Fields(told, "").text("bundled", cap=64)
        found = written_library().get(name) or generator_library().get(name)
        if found is None:
            raise FieldError("bundled", f"{name!a}", like_in_library(name))
        told = told.set("text", found.text)
    return with_names(told, _namesakes(root, around))


def named_by(text: str, root: Group, around: Around) -> Named:
    """Returns the textures that a text names over a painting with the layers `root`.  WrittenError tells of a name that
    there is not."""
    return tuple(sorted(_namesakes(root, around).of_text(text).items()))


def _namesakes(root: Group, around: Around) -> Namesakes:
    make = partial(define, root=root, around=around)
    return Namesakes(around.textures, make, around.arithmetic, around.pictures)


def _image(command: DefineTexture, root: Group, around: Around) -> Texture:
    members = Fields(command.arguments, "")
    path, source = members.text("path", cap=4096), _known(command, members, around)
    if source is None:
        holds = members.text(HOLDS, A_PICTURE)
        if holds not in (A_PICTURE, A_FILE):
            raise members.fault(HOLDS, f'"{A_PICTURE}", or "{A_FILE}" for the bytes of a file')
        by_profile = members.flag("profile", False)
        read = read_bytes if holds == A_FILE else partial(read_straight, room=room, converted=by_profile)
        source = _the_same(members, ImageSource.of_raster(command.name, read(path, around.folder)))
    return Texture("image", command.arguments, source)


def _canvas(command: DefineTexture, root: Group, around: Around) -> Texture:
    planes = captured(Fields(thawed(command.arguments), ""), root)
    given = command.arguments
    parameters = given if "period" in given else given.set("period", given["rect"][3])
    return Texture("canvas", parameters, ImageSource.of(command.name, planes))


def _learnt(command: DefineTexture, root: Group, around: Around) -> Texture:
    """Returns a picture, or a piece of the canvas, that is refined below its own pixels."""
    make = _image if "path" in command.arguments else _canvas
    return learnt_of(make(command, root, around))


def _sampled(make: lewis.Maker, command: DefineTexture, root: Group, around: Around) -> Texture:
    """Returns a texture of a sample that `make` makes, tiled or scattered."""
    members = Fields(thawed(command.arguments), "")
    field = members.take("field", USUAL[command.maker])
    if field not in FIELDS:
        raise members.fault("field", f"one of {', '.join(FIELDS)}")
    parameters, source = command.arguments, _known(command, members, around)
    if source is None:
        sample = make(members, PictureSource(around.folder, root, around.pictures, around.arithmetic, around.touches))
        parameters = sample.found.update(parameters)
        rgba = sample.rgba
        if field == "tile" and rgba.shape[2] < NARROWEST:
            rgba = np.tile(rgba, (1, 1, -(-NARROWEST // rgba.shape[2])))
        source = _the_same(members, ImageSource.of(command.name, rgba))
    return Texture(kind_of(command), parameters, source)


def _matched(command: DefineTexture, root: Group, around: Around) -> Texture:
    """Returns a texture, or a series of them, matched to examples.  The sha of the result is no condition: in
    arithmetic 1 machines may differ in the last bits of a transform; those of the examples are."""
    members = Fields(thawed(command.arguments), "")
    parameters, source = command.arguments, _known(command, members, around)
    if source is None:
        place = PictureSource(around.folder, root, around.pictures, around.arithmetic)
        sample = heeger_bergen.of_examples(command.maker, members, place)
        parameters = sample.found.update(parameters)
        source = ImageSource.of(command.name, sample.rgba)
    return Texture(kind_of(command), parameters, source)


def _example(command: DefineTexture, root: Group, around: Around) -> Texture:
    return example_textures.of_definition(command, around)


def _known(command: DefineTexture, members: Fields, around: Around) -> ImageSource | None:
    """Returns the picture of a definition that was carried out before."""
    sha = members.text("sha", None, cap=64)
    return replace(around.pictures[sha], name=command.name) if sha is not None and sha in around.pictures else None


def _the_same(members: Fields, source: ImageSource) -> ImageSource:
    """FileError if a file holds other pixels than it did when the definition was recorded."""
    sha = members.text("sha", None, cap=64)
    named = "cube" if "cube" in members else "path"
    if named in members and sha is not None and sha != source.sha:
        raise FileError(members.text(named, cap=4096), "its pixels are not those that were there when it was recorded")
    return source


_Maker = Callable[[DefineTexture, Group, Around], Texture]
MAKERS: dict[str, _Maker] = {
    **{name: _procedural for name, row in KINDS.items() if not row.pictured},
    **dict.fromkeys(DEFINED, _procedural),
    EXPRESSION: _written,
    "image": _image,
    LEARN: _learnt,
    "canvas": _canvas,
    "spectrum": partial(_sampled, lewis.of_spectrum),
    "sparse": partial(_sampled, lewis.of_picture),
    "impulse": partial(_sampled, lewis.of_photograph),
    "solid": partial(_sampled, carved.of_solid),
    "match": _matched,
    "mix": _matched,
    "example": _example,
}
