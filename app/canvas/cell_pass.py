"""A program of the card over many cells of the canvas."""

from __future__ import annotations

from typing import Any

import moderngl
import numpy as np

Row = tuple[float, ...]
# Instance attributes that a program does not use are passed over.
_SKIPPED = {"cell": "16x", "source": "16x", "span": "4x"}


class CellPass:
    """One program over many cells: nine floats a cell, as canvas.vert reads them, in a buffer that grows."""

    def __init__(self, ctx: moderngl.Context, vertex: str, fragment: str) -> None:
        self._ctx = ctx
        self.program: Any = ctx.program(vertex, fragment)
        self._room_for(128)

    def _room_for(self, rows: int) -> None:
        self._most = rows
        self._buffer = self._ctx.buffer(reserve=36 * rows)
        names = [name for name in ("cell", "source", "span") if name in self.program]
        sizes = {"cell": "4f", "source": "4f", "span": "1f"}
        layout = " ".join(sizes[n] if n in names else _SKIPPED[n] for n in sizes) + "/i"
        self._cells = self._ctx.vertex_array(self.program, [(self._buffer, layout, *names)])

    def draw(self, rows: list[Row]) -> None:
        """Draws cells."""
        if not rows:
            return
        if len(rows) > self._most:
            self._room_for(2 * len(rows))
        self._buffer.orphan()
        self._buffer.write(np.array(rows, np.float32))
        self._cells.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=len(rows))
