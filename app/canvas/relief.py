"""The heights of the tiles that the card holds, sixteen bits each: what the light needs of them.

They come with the pixels while the light is on.  Where they have not come yet, those of the pixels' eight bits do.
"""

from __future__ import annotations

from typing import Any

import moderngl
import numpy as np

from app.canvas.cell_pass import CellPass, Row
from app.canvas.shader_files import shader_source
from engine.light.light import BY_ALPHA, LUMINANCE
from engine.numeric.address import Rect

_BRIGHT, _ALPHA, _FIRST = (*LUMINANCE, 0.0), (0.0, 0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 0.0)
_TILE, _ANCESTOR = 4, 5  # where a row has its layers


class Relief:
    """All calls from the thread that owns the context.  Nothing is held on the card until heights come."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        # The files are read at the start, before the window waits for none.
        self._sources = shader_source("canvas.vert"), shader_source("relief.frag")
        self._pass: CellPass | None = None
        self._array: Any = None
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

    def draw(self, rows: list[Row], tiles: Any, height: str, view: tuple[Any, ...]) -> None:
        """Draws the heights of cells into what is drawn to; `tiles`: the array of the pixels; `height`: what they are
        taken from; `view`: size, turn and rim of the screen, as canvas.vert has them."""
        if self._pass is None:
            self._pass = CellPass(self._ctx, *self._sources)
        program = self._pass.program
        program["size"], program["turn"], program["rim"] = view
        self._ctx.disable(moderngl.BLEND)
        for array, weights, some in (
            (self._array, _FIRST, [row for row in rows if self._known(row)]),
            (tiles, _ALPHA if height == BY_ALPHA else _BRIGHT, [row for row in rows if not self._known(row)]),
        ):
            if some:
                program["weights"] = weights
                array.filter = tiles.filter
                array.use(0)
                self._pass.draw(some)

    def _known(self, row: Row) -> bool:
        return all(layer < 0 or layer in self._raised for layer in (row[_TILE], row[_ANCESTOR]))
