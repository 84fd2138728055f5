"""Pictures as layers: a texture's picture, a pixel on a pixel of a level."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import count

import numpy as np

from engine.archive.grounds import lay_ground
from engine.canvas import layers
from engine.canvas.commit import commit
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.bake import Pasted
from engine.canvas.store import Pyramid
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.arithmetic import FINE
from engine.numeric.grid import snapped_to, step_of
from engine.numeric.similarity import Dyadic, Similarity
from engine.painting.commands import AddPicture, AddPictures
from engine.painting.layering.pictures_member import Brought, BroughtGroup, BroughtPicture
from engine.painting.value import Painting, with_node
from engine.texture.image import ImageSource
from engine.texture.placed import as_placed
from engine.texture.planes import Planes
from engine.texture.record import Instance


def with_picture(painting: Painting, command: AddPicture) -> Painting:
    """Returns a painting with a layer more, that begins with a texture's picture.  LayerError if it has none."""
    source = _picture(painting, command)
    detail = _detail(painting, command)
    if detail is None:
        paint = picture_paint(source, command, painting.grid)
    else:
        paint = laid_picture(source, command.level, command.at, painting.grid, detail)
    return with_node(painting, Layer(layers.next_id(painting.root), command.name, pyramid=paint, role=command.role))


def with_pictures(painting: Painting, command: AddPictures) -> Painting:
    """Returns a painting with a group more, whose layers begin with parts of a texture's picture; it is chosen,
    to be moved.  LayerError if there is no such picture."""
    source = _picture(painting, command)
    return _with_group(painting, command, lambda one: picture_paint(source, picture_of(command, one), painting.grid))


def without_pictures(painting: Painting, command: AddPictures) -> Painting:
    """Returns the same without paint.  LayerError if it cannot be."""
    return _with_group(painting, command, lambda one: Pyramid(grid=painting.grid))


def picture_of(command: AddPictures, one: BroughtPicture) -> AddPicture:
    """Returns the command that brings in one of a group's layers by itself."""
    at = (command.at[0] + one.at[0], command.at[1] + one.at[1])
    return AddPicture(one.name, command.texture, command.level, at, part=one.part)


def picture_paint(source: ImageSource, command: AddPicture, grid: int) -> Pyramid:
    """Returns the paint that a command brings, of a picture that is there.  LayerError if that has no such part."""
    if command.part is not None:
        part = Rect.at(*command.part)
        if part.x1 > source.width or part.y1 > source.height:
            whole = f"{source.width} x {source.height} pixels"
            raise LayerError(f"layer {command.name!r}: found part {list(command.part)}, expected one within {whole}")
        source = ImageSource(source.name, "", source.planes(part))
    return laid_picture(source, command.level, command.at, grid)


def _picture(painting: Painting, command: AddPicture | AddPictures) -> ImageSource:
    texture = painting.textures.get(command.texture)
    if texture is None or texture.source is None or not texture.source.there:
        found = "no texture" if texture is None else "a texture without a picture"
        raise LayerError(f"layer {command.name!r}: found {found} {command.texture!r}, expected one that is a picture")
    return texture.source


def _with_group(painting: Painting, command: AddPictures, paint: Callable[[BroughtPicture], Pyramid]) -> Painting:
    numbers = count(layers.next_id(painting.root))

    def node(one: Brought) -> Node:
        about = next(numbers), one.name, one.opacity, one.visible, one.blend
        if isinstance(one, BroughtGroup):
            return Group(*about, isolated=one.isolated, children=tuple(map(node, one.children)))
        return Layer(*about, clip=one.clip, pyramid=paint(one))

    group = Group(next(numbers), command.name, children=tuple(map(node, command.children)))
    made = with_node(painting, group, command.group, command.to)
    return replace(made, root=layers.checked(made.root), active=group.name)


def _detail(painting: Painting, command: AddPicture) -> Instance | None:
    """Returns the picture as ink where its texture is refined below its own pixels; else None."""
    texture = painting.textures[command.texture]
    if command.part is not None or command.role or texture.maps is None or texture.source is None:
        return None
    x, y = command.at
    made = texture.instance({"period": texture.source.width}, command.level, 0)
    away = Similarity(Dyadic.of(1, 0), Dyadic.of(x, y, command.level))
    return as_placed(made, away, command.level)


def laid_picture(
    source: ImageSource, level: int, at: tuple[int, int], grid: int, detail: Instance | None = None
) -> Pyramid:
    """Returns the paint of a picture that is there, with its corner at pixel `at` of a level.

    On level 0 it is the layer's ground, which a file holds as the picture itself, where 8 or 16 bits tell it; but not
    with `detail`, an ink that lies all over it.
    """
    x, y = at
    pixels = source.straight() if level == 0 and grid == FINE and detail is None else None
    if pixels is not None:
        return lay_ground(pixels, x, y)
    rect = Rect.at(x, y, source.width, source.height)

    def values(key: TileKey) -> Planes | None:
        part = key.rect.intersect(rect)
        out = np.zeros((4, TILE, TILE), np.float32)
        found = source.planes(Rect.at(part.x0 - x, part.y0 - y, part.width, part.height))
        out[:, *part.slices(key.rect)] = found if grid == FINE else snapped_to(found, step_of(grid))
        if detail is None or not out.any():
            return Planes(out) if out.any() else None
        ink = np.zeros((3, TILE, TILE), np.float32)
        ink[:, *part.slices(key.rect)] = 1.0
        return Planes(np.concatenate([out, ink]), (detail,))

    empty = Pyramid(grid=grid)
    return replace(commit(empty, Pasted(level, list(rect.tiles(level)), values)), grid=grid)
