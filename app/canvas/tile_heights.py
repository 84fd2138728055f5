"""The heights of the tiles that the card holds, sixteen bits each: what the light needs of them.

They come with the pixels while the light is on.  Where they have not come yet, those of the pixels' eight bits do.
"""

from __future__ import annotations

import moderngl
import numpy as np

from app.canvas.cell_pass import CellPass, Row
from app.canvas.shader_files import shader_source
from app.canvas.view import View
from engine.light.light import BRIGHTNESS, BY_ALPHA, BY_IMPASTO, RIM
from engine.numeric.address import Rect

_BRIGHT, _ALPHA, _RED_ALONE = (*BRIGHTNESS, 0.0), (0.0, 0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 0.0)
_OF_PIXELS = {BY_ALPHA: _ALPHA, BY_IMPASTO: ()}  # which of the picture's pixels have none of
_LAYER, _ABOVE = 4, 5  # where a row has its layers


class TileHeights:
    """All calls from the thread that owns the context.  Nothing is held on the card until heights come."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        # The files are read at the start, before the window waits for none.
        self._sources = shader_source("canvas.vert"), shader_source("relief.frag")
        self._pass: CellPass | None = None
        self._array: moderngl.TextureArray | None = None
        self._raised: set[int] = set()  # layers that have heights

    def take(self, layer: int, area: Rect, heights: np.ndarray | None, size: tuple[int, int, int]) -> None:
        """Takes in the heights of a part of a layer of the tiles' array, or that none come any more."""
        if heights is None:
            self._raised.clear()  # all will be sent again before they are wanted
            if self._array is not None:
                self._array.release()
                self._array = None
            return
        if self._array is None:
            self._array = self._ctx.texture_array(size, 1, dtype="nu2")
            self._array.repeat_x = self._array.repeat_y = False
        self._array.write(heights, viewport=(area.x0, area.y0, layer, area.width, area.height, 1))
        if (area.width, area.height) == size[:2]:
            self._raised.add(layer)

    def draw(self, rows: list[Row], tiles: moderngl.TextureArray, height: str, view: View) -> None:
        """Draws the heights of cells into what is drawn to, with a rim around the view; `tiles`: the array of the
        pixels; `height`: what they are taken from."""
        if self._pass is None:
            self._pass = CellPass(self._ctx, *self._sources)
        program = self._pass.program
        program["size"], program["turn"], program["rim"] = (view.width, view.height), view.matrix(), RIM
        self._ctx.disable(moderngl.BLEND)
        for array, weights, some in (
            (self._array, _RED_ALONE, [row for row in rows if self._known(row)]),
            (tiles, _OF_PIXELS.get(height, _BRIGHT), [row for row in rows if not self._known(row)]),
        ):
            if array is not None and some and weights:
                program["weights"] = weights
                array.filter = tiles.filter
                array.use(0)
                self._pass.draw(some)

    def _known(self, row: Row) -> bool:
        return all(layer < 0 or layer in self._raised for layer in (row[_LAYER], row[_ABOVE]))
