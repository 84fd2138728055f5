"""Pictures as layers: a texture's picture, a pixel on a pixel of a level."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engine.archive.grounds import lay_ground
from engine.canvas import layers
from engine.canvas.commit import commit
from engine.canvas.layers import Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.bake import Pasted
from engine.canvas.store import Pyramid
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.arithmetic import FINE
from engine.numeric.grid import snapped_to, step_of
from engine.painting.commands import AddPicture
from engine.painting.value import Painting, with_node
from engine.texture.image import ImageSource
from engine.texture.planes import Planes


def with_picture(painting: Painting, command: AddPicture) -> Painting:
    """Returns a painting with a layer more, that begins with a texture's picture.  LayerError if it has none."""
    texture = painting.textures.get(command.texture)
    if texture is None or texture.source is None or not texture.source.there:
        found = "no texture" if texture is None else "a texture without a picture"
        raise LayerError(f"layer {command.name!r}: found {found} {command.texture!r}, expected one that is a picture")
    paint = laid_picture(texture.source, command.level, command.at, painting.grid)
    return with_node(painting, Layer(layers.next_id(painting.root), command.name, pyramid=paint, role=command.role))


def laid_picture(source: ImageSource, level: int, at: tuple[int, int], grid: int) -> Pyramid:
    """Returns the paint of a picture that is there, with its corner at pixel `at` of a level.

    On level 0 it is the layer's ground, which a file holds as the picture itself, where 8 or 16 bits tell it.
    """
    x, y = at
    pixels = source.straight() if level == 0 and grid == FINE else None
    if pixels is not None:
        return lay_ground(pixels, x, y)
    rect = Rect.at(x, y, source.width, source.height)

    def values(key: TileKey) -> Planes | None:
        part = key.rect.intersect(rect)
        out = np.zeros((4, TILE, TILE), np.float32)
        found = source.planes(Rect.at(part.x0 - x, part.y0 - y, part.width, part.height))
        out[:, *part.slices(key.rect)] = found if grid == FINE else snapped_to(found, step_of(grid))
        return Planes(out) if out.any() else None

    empty = Pyramid(grid=grid)
    return replace(commit(empty, Pasted(level, list(rect.tiles(level)), values)), grid=grid)
